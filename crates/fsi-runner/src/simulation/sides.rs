//! Looks at a side of the coupling that may be absent.

use coupling::{NoFluid, NoSolid};
use gimpm::Solid;
use sph::Fluid;

/// A fluid side that can be observed.
pub trait ObservedFluid<const D: usize> {
    /// The fluid, if there is one.
    fn observed(&self) -> Option<&Fluid<D>>;

    /// The fluid to restore, if there is one.
    fn observed_mut(&mut self) -> Option<&mut Fluid<D>>;
}

/// A solid side that can be observed.
pub trait ObservedSolid<const D: usize> {
    /// The solid, if there is one.
    fn observed(&self) -> Option<&Solid<D>>;

    /// The solid to restore, if there is one.
    fn observed_mut(&mut self) -> Option<&mut Solid<D>>;
}

impl<const D: usize> ObservedFluid<D> for Fluid<D> {
    fn observed(&self) -> Option<&Fluid<D>> {
        Some(self)
    }

    fn observed_mut(&mut self) -> Option<&mut Fluid<D>> {
        Some(self)
    }
}

impl<const D: usize> ObservedFluid<D> for NoFluid {
    fn observed(&self) -> Option<&Fluid<D>> {
        None
    }

    fn observed_mut(&mut self) -> Option<&mut Fluid<D>> {
        None
    }
}

impl<const D: usize> ObservedSolid<D> for Solid<D> {
    fn observed(&self) -> Option<&Solid<D>> {
        Some(self)
    }

    fn observed_mut(&mut self) -> Option<&mut Solid<D>> {
        Some(self)
    }
}

impl<const D: usize> ObservedSolid<D> for NoSolid {
    fn observed(&self) -> Option<&Solid<D>> {
        None
    }

    fn observed_mut(&mut self) -> Option<&mut Solid<D>> {
        None
    }
}
