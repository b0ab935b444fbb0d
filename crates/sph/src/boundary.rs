//! Points of rigid walls or of a structure, with their own cell table.

use crate::FluidError;
use crate::cell_lattice::{CellLattice, CellTable};
use crate::wall_closure::WallSide;
use nalgebra::SVector;
use rayon::prelude::*;

/// Wall points in the caller's order, structure of arrays.
///
/// Used twice: for rigid walls and for the points of an externally driven structure.
#[derive(Debug, Clone, Default)]
pub struct Boundary<const D: usize> {
    /// Position (m).
    pub position: Vec<SVector<f64, D>>,
    /// Mean velocity over the fluid step `v̄_p` (m/s).
    pub velocity: Vec<SVector<f64, D>>,
    /// Volume (m^D), before the cap `Σ V W <= 1`.
    pub volume: Vec<f64>,
    /// Load `f_p` of the fluid on the point (N; N per metre of width in 2D).
    pub force: Vec<SVector<f64, D>>,
    /// Index of the wall the point belongs to; 0 for a structure.
    pub group: Vec<u16>,
    pub(crate) table: CellTable,
    /// Points inside the lattice in slot order, as located last.
    pub(crate) sorted: Vec<WallSide<D>>,
}

impl<const D: usize> Boundary<D> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Replaces all points, in the caller's order; loads become zero.
    ///
    /// `position` (m), `velocity` (m/s) is the mean over the fluid step (C1), `volume`
    /// (m^D). Takes effect at the next [`crate::Fluid::locate_structure`].
    ///
    /// # Errors
    /// [`FluidError::Length`] if the slices differ in length.
    pub fn set_points(
        &mut self,
        position: &[SVector<f64, D>],
        velocity: &[SVector<f64, D>],
        volume: &[f64],
    ) -> Result<(), FluidError> {
        let expected = position.len();
        for (array, found) in
            [("structure velocity", velocity.len()), ("structure volume", volume.len())]
        {
            if found != expected {
                return Err(FluidError::Length { array, expected, found });
            }
        }
        self.position.clear();
        self.position.extend_from_slice(position);
        self.velocity.clear();
        self.velocity.extend_from_slice(velocity);
        self.volume.clear();
        self.volume.extend_from_slice(volume);
        self.force.clear();
        self.force.resize(expected, SVector::zeros());
        self.group.resize(expected, 0);
        Ok(())
    }

    /// Sorts the points onto the lattice and copies them in slot order.
    pub(crate) fn locate(&mut self, lattice: &CellLattice<D>) {
        let Self { position, velocity, volume, table, sorted, .. } = self;
        table.sort(lattice.cells(), position.len(), |p| lattice.key(&position[p]));
        table.order[..table.inside()]
            .par_iter()
            .with_min_len(1024)
            .map(|&p| p as usize)
            .map(|p| WallSide { position: position[p], velocity: velocity[p], volume: volume[p] })
            .collect_into_vec(sorted);
    }

    /// Copies new velocities into the located points.
    pub(crate) fn refresh_velocity(&mut self) {
        let (velocity, order) = (&self.velocity, &self.table.order);
        for (point, &p) in self.sorted.iter_mut().zip(order) {
            point.velocity = velocity[p as usize];
        }
    }
}
