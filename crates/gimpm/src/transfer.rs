//! How velocity travels from nodes to points and back.
//!
//! A transfer says what a point keeps, what it gives to its nodes, and what it takes
//! from them. To add one: implement [`PointTransfer`] in a file of its own, add a
//! variant to [`Transfer`](crate::Transfer) and to `with_transfer`, and run
//! `transfer_conformance` on it.

#[cfg(test)]
mod conformance;

mod apic;
mod flip;
mod fmpm;
mod full_mass;
mod tpic;

pub(crate) use apic::Apic;
pub(crate) use flip::Flip;
pub(crate) use fmpm::Fmpm;
pub(crate) use tpic::Tpic;

use nalgebra::{SMatrix, SVector};

use crate::grid::{NodeRecord, VELOCITY};
use crate::parameters::Transfer;
use crate::stencil::{Entry, PointStencil};

/// Transfer of velocity between one point and its nodes.
///
/// `kept` is what the point keeps beside its velocity, `Points::affine_velocity`;
/// a transfer with `AFFINE` false has none and is given zeros, and leaves the functions
/// of the affine part as they are here.
pub(crate) trait PointTransfer: Copy + Send + Sync {
    /// Whether points keep an affine part.
    const AFFINE: bool;

    /// Gradient C (1/s), from what is kept, with which a point gives `v_p + C (x_v - x_p)`
    /// to node v.
    fn gradient<const D: usize>(
        &self,
        _: &SMatrix<f64, D, D>,
        _: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        SMatrix::zeros()
    }

    /// What a point keeps that moves with gradient C.
    fn keep<const D: usize>(&self, _: &SMatrix<f64, D, D>, _: &PointStencil) -> SMatrix<f64, D, D> {
        SMatrix::zeros()
    }

    /// New velocity and affine part from nodes `[m, v^L, a]` (after boundary conditions).
    fn gather<const D: usize>(
        &self,
        stencil: &PointStencil,
        nodes: &[NodeRecord],
        dt: f64,
        velocity: &mut SVector<f64, D>,
        kept: &mut SMatrix<f64, D, D>,
    );

    /// `Σ_v S_vp C d ⊗ d` (m²/s), d from the point to the node: what the affine part
    /// adds to the first moments of the momentum, per mass.
    fn moments<const D: usize>(
        &self,
        _: &SMatrix<f64, D, D>,
        _: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        SMatrix::zeros()
    }
}

impl Transfer {
    /// Whether points keep an affine part of the velocity.
    pub(crate) fn is_affine(self) -> bool {
        matches!(self, Self::Apic | Self::Tpic)
    }

    /// Whether points take the velocity of the nodes rather than their acceleration.
    pub(crate) fn replaces_velocity(self) -> bool {
        self != Self::Flip
    }
}

/// Evaluates an expression with `$transfer` bound to the concrete transfer of a body.
macro_rules! with_transfer {
    ($body:expr, $transfer:ident => $expression:expr) => {
        match $body.discretisation.transfer {
            $crate::parameters::Transfer::Flip => {
                let $transfer = $crate::transfer::Flip;
                $expression
            }
            $crate::parameters::Transfer::Apic => {
                let $transfer = $crate::transfer::Apic::of($body);
                $expression
            }
            $crate::parameters::Transfer::Tpic => {
                let $transfer = $crate::transfer::Tpic;
                $expression
            }
            $crate::parameters::Transfer::Fmpm { .. } => {
                let $transfer = $crate::transfer::Fmpm;
                $expression
            }
        }
    };
}
pub(crate) use with_transfer;

/// Component `d` of the velocity `v_p + C (x_v - x_p)` that a point gives to a node
/// (m/s).
#[inline(always)]
pub(crate) fn given_velocity<T: PointTransfer, const D: usize>(
    velocity: &SVector<f64, D>,
    gradient: &SMatrix<f64, D, D>,
    entry: &Entry,
    d: usize,
) -> f64 {
    let mut given = velocity[d];
    if T::AFFINE {
        given += (0..D).map(|j| gradient[(d, j)] * entry.offset[j]).sum::<f64>();
    }
    given
}

/// `Σ_v v_v^L S_vp` (m/s).
#[inline(always)]
fn gather_velocity<const D: usize>(
    stencil: &PointStencil,
    nodes: &[NodeRecord],
) -> SVector<f64, D> {
    let mut velocity = SVector::zeros();
    for entry in stencil.entries() {
        let record = &nodes[entry.node as usize];
        for d in 0..D {
            velocity[d] += entry.value * record[VELOCITY + d];
        }
    }
    velocity
}
