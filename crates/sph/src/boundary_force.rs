//! Load of the fluid on walls and structure, gathered per wall point (C4, C5).

use crate::wall_closure::WallSide;
use crate::{Boundary, Fluid, Kernel};
use nalgebra::SVector;
use rayon::prelude::*;
use std::mem::take;

/// One of the two sets of wall points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundarySet {
    /// Rigid walls.
    Walls,
    /// Externally driven structure points.
    Structure,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Gathers `f_p = -Σ_a F_ap` (N; N/m in 2D) into the set's `force` array (C5).
    ///
    /// The pair forces are the bits that [`Fluid::evaluate_acceleration`] applied.
    pub fn evaluate_boundary_force(&mut self, which: BoundarySet) {
        let boundary = match which {
            BoundarySet::Walls => &mut self.walls,
            BoundarySet::Structure => &mut self.structure,
        };
        let mut force = take(&mut boundary.force);
        let mut gathered = take(&mut self.near.loads);
        let boundary = self.boundary(which);
        boundary
            .sorted
            .par_iter()
            .with_min_len(crate::momentum::GRAIN)
            .map(|p| self.load(p))
            .collect_into_vec(&mut gathered);
        force.fill(SVector::zeros());
        for (load, &p) in gathered.iter().zip(&boundary.table.order) {
            force[p as usize] = *load;
        }
        self.near.loads = gathered;
        match which {
            BoundarySet::Walls => self.walls.force = force,
            BoundarySet::Structure => self.structure.force = force,
        }
    }

    pub(crate) fn boundary(&self, which: BoundarySet) -> &Boundary<D> {
        match which {
            BoundarySet::Walls => &self.walls,
            BoundarySet::Structure => &self.structure,
        }
    }

    /// Load (N) of the fluid at mid-step on one wall point.
    pub(crate) fn load(&self, p: &WallSide<D>) -> SVector<f64, D> {
        let closure = self.wall_closure();
        let support = self.kernel.support();
        let mut load = SVector::zeros();
        self.lattice.for_each_run(&p.position, support, |first, end| {
            for a in &self.midpoint[self.table.slots(first, end)] {
                let square = (a.position - p.position).norm_squared();
                if square < support * support {
                    load -= closure.force(a, p, square.sqrt()).force;
                }
            }
        });
        load
    }
}
