//! Equations (5) and (6): velocity and displacement of the points.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid::{ACCELERATION, GridGeometry, NodeRecord, Stencil, VELOCITY};
use crate::shape::with_shape;
use crate::solid::Solid;

/// Points handled by one task.
pub(crate) const POINTS_PER_TASK: usize = 512;

impl<const D: usize> Solid<D> {
    /// `v_p += Δt Σ_v a_v S_vp` (G11) and `Δx_p = Δt Σ_v v_v^L S_vp` (G12).
    ///
    /// The displacement is kept aside: phases (7) and (8) use the weights of the
    /// step's start, so positions change after them.
    pub(crate) fn grid_to_points(&mut self, dt: f64) {
        let grid = &self.grid;
        let points = &mut self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let range = offsets[0]..offsets[offsets.len() - 1];
            let tasks = (
                points.position[range.clone()].par_chunks(POINTS_PER_TASK),
                points.velocity[range.clone()].par_chunks_mut(POINTS_PER_TASK),
                self.displacement[range].par_chunks_mut(POINTS_PER_TASK),
            );
            with_shape!(body, shape => tasks.into_par_iter().for_each(
                |(positions, velocities, displacements)| {
                    for ((position, velocity), displacement) in
                        positions.iter().zip(velocities).zip(displacements)
                    {
                        let stencil = grid.geometry.stencil(shape, position);
                        let moved = gather(&grid.nodes, &stencil, &grid.geometry);
                        *velocity += SVector::from_fn(|d, _| dt * moved[ACCELERATION + d]);
                        *displacement = SVector::from_fn(|d, _| dt * moved[VELOCITY + d]);
                    }
                }
            ));
        }
    }
}

/// Weighted sum of node records.
#[inline(always)]
fn gather<const D: usize>(
    nodes: &[NodeRecord],
    stencil: &Stencil,
    geometry: &GridGeometry<D>,
) -> NodeRecord {
    let [sx, sy, sz] = &stencil.value;
    let mut total = [0.0; 8];
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let start = stencil.first + b * geometry.stride[1] + c * geometry.stride[2];
            let row = &nodes[start..start + 3];
            let weight = sy[b] * sz[c];
            for k in 0..8 {
                let along = row[0][k] * sx[0] + row[1][k] * sx[1] + row[2][k] * sx[2];
                total[k] += along * weight;
            }
        }
    }
    total
}
