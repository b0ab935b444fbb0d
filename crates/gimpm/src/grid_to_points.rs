//! Equations (5) and (6): velocity and displacement of the points.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::kernel::Kernel;
use crate::solid::Solid;
use crate::{plain, separable};

/// Points handled by one task.
pub(crate) const POINTS_PER_TASK: usize = 512;

impl<const D: usize> Solid<D> {
    /// `v_p += Δt Σ_v a_v S_vp` (G11) and `Δx_p = Δt Σ_v v_v^L S_vp` (G12).
    ///
    /// The displacement is kept aside: phases (7) and (8) use the weights of the
    /// step's start, so positions change after them.
    pub(crate) fn grid_to_points(&mut self, dt: f64) {
        let points = &mut self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let displacement = &mut self.displacement[start..end];
            let grid = &self.fields[body.field].grid;
            let run = match body.kernel {
                Kernel::Plain => plain::grid_to_points,
                Kernel::Separable => separable::grid_to_points,
            };
            run(body, start, points, displacement, grid, dt);
        }
    }

    /// `x_p += Δx_p` (6).
    pub(crate) fn move_points(&mut self) {
        let moved = self.state.points.position.par_iter_mut().zip(&self.displacement);
        moved.with_min_len(POINTS_PER_TASK).for_each(
            |(position, displacement): (_, &SVector<f64, D>)| {
                *position += displacement;
            },
        );
    }
}
