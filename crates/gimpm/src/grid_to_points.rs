//! Equations (5) and (6): velocity and displacement of the points.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::fastest::Fastest;
use crate::field::Field;
use crate::kernel::Kernel;
use crate::parameters::{Frame, StressUpdate};
use crate::solid::Solid;
use crate::{plain, separable};

/// Points handled by one task.
pub(crate) const POINTS_PER_TASK: usize = 512;

impl<const D: usize> Solid<D> {
    /// `v_p += Δt Σ_v a_v S_vp` (G11) and `Δx_p = Δt Σ_v v_v^L S_vp` (G12).
    ///
    /// The displacement is kept aside: phases (7) and (8) use the weights of the
    /// step's start, so positions change after them. The largest speed and displacement
    /// are kept too. Where the strain comes from re-mapped momentum, the vector loops add
    /// that of (7) here.
    pub(crate) fn grid_to_points(&mut self, dt: f64) {
        let remaps = self.parameters.stress_update == StressUpdate::ModifiedLast;
        if remaps {
            self.clear_remapped();
        }
        self.fastest = Fastest::default();
        let points = &mut self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let displacement = &mut self.displacement[start..end];
            let Field { grid, lattice, .. } = &mut self.fields[body.field];
            if let Some(lattice) = lattice {
                lattice.grid_to_points(points, grid, dt);
                self.fastest = self.fastest.and(Fastest::at_speed(lattice.maximum_speed));
                continue;
            }
            let fastest = match body.kernel {
                Kernel::Plain | Kernel::Lattice => {
                    plain::grid_to_points(body, start, points, displacement, grid, dt);
                    let fastest = Fastest::of(&points.velocity[start..end], displacement);
                    match body.discretisation.frame {
                        Frame::Updated => fastest,
                        Frame::Total => Fastest { displacement_squared: 0.0, ..fastest },
                    }
                }
                Kernel::Separable => {
                    let then = (dt, remaps);
                    separable::grid_to_points(body, offsets, points, displacement, grid, then)
                }
            };
            self.fastest = self.fastest.and(fastest);
        }
    }

    /// `x_p += Δx_p` (6), for the bodies whose points have not moved yet.
    pub(crate) fn move_points(&mut self) {
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            if self.fields[body.field].lattice.is_some() {
                continue;
            }
            let range = offsets[0]..offsets[offsets.len() - 1];
            let positions = &mut self.state.points.position[range.clone()];
            let moved = positions.par_iter_mut().zip(&self.displacement[range]);
            moved.with_min_len(POINTS_PER_TASK).for_each(
                |(position, displacement): (_, &SVector<f64, D>)| {
                    *position += displacement;
                },
            );
        }
    }
}
