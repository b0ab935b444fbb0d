//! From what is carried over to the node records of a step.

use rayon::prelude::*;

use super::Lattice;
use crate::grid::{Grid, RemapRecord};
use crate::grid_momentum::NODES_PER_TASK;
use crate::points::Points;

impl<const D: usize> Lattice<D> {
    /// Mass, momentum (G5) and internal force (G6b) of all nodes of the field.
    pub fn points_to_grid(&mut self, points: &Points<D>, grid: &mut Grid<D>) {
        self.refresh_momentum(points);
        self.refresh_force(points);
        let sums = (
            self.mass.par_chunks(NODES_PER_TASK),
            self.momentum.records.par_chunks(NODES_PER_TASK),
            self.force.records.par_chunks(NODES_PER_TASK),
            grid.nodes.par_chunks_mut(NODES_PER_TASK),
        );
        sums.into_par_iter().for_each(|(masses, momenta, forces, records)| {
            for (((mass, p), f), record) in masses.iter().zip(momenta).zip(forces).zip(records) {
                *record = [*mass, p[0], p[1], p[2], f[0], f[1], f[2], 0.0];
            }
        });
    }

    /// Velocity of the nodes from the points' (G13).
    pub fn remap(&mut self, points: &Points<D>, grid: &mut Grid<D>, mass_cut: f64) {
        self.refresh_momentum(points);
        let sums = (
            self.mass.par_chunks(NODES_PER_TASK),
            self.momentum.records.par_chunks(NODES_PER_TASK),
            grid.remapped.par_chunks_mut(NODES_PER_TASK),
        );
        sums.into_par_iter().for_each(|(masses, momenta, records)| {
            for ((mass, momentum), record) in masses.iter().zip(momenta).zip(records) {
                let inverse = if *mass > mass_cut { 1.0 / mass } else { 0.0 };
                *record = momentum.map(|component| component * inverse);
            }
        });
    }
}

/// Sets all records to zero.
pub(super) fn clear(records: &mut [RemapRecord]) {
    records.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 4]));
}
