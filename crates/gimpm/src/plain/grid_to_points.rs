//! Equations (5) and (6), one point at a time.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid::{ACCELERATION, Grid, VELOCITY};
use crate::grid_to_points::POINTS_PER_TASK;
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;

/// New velocity of the points (G11) and their displacement in the step (G12).
pub(crate) fn grid_to_points<const D: usize>(
    body: &Body,
    start: usize,
    points: &mut Points<D>,
    displacement: &mut [SVector<f64, D>],
    grid: &Grid<D>,
    dt: f64,
) {
    let mut velocity = std::mem::take(&mut points.velocity);
    let end = start + displacement.len();
    velocity[start..end]
        .par_chunks_mut(POINTS_PER_TASK)
        .zip(displacement.par_chunks_mut(POINTS_PER_TASK))
        .enumerate()
        .for_each(|(task, (velocities, displacements))| {
            let mut stencil = PointStencil::default();
            for (k, (velocity, displacement)) in
                velocities.iter_mut().zip(displacements).enumerate()
            {
                stencil.evaluate(
                    body,
                    &grid.geometry,
                    points.site(body.discretisation.frame, start + task * POINTS_PER_TASK + k),
                );
                *displacement = SVector::zeros();
                for entry in stencil.entries() {
                    let record = &grid.nodes[entry.node as usize];
                    for d in 0..D {
                        velocity[d] += dt * entry.value * record[ACCELERATION + d];
                        displacement[d] += dt * entry.value * record[VELOCITY + d];
                    }
                }
            }
        });
    points.velocity = velocity;
}
