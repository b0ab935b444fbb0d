//! Equations (5) and (6), one point at a time.

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::grid::{Grid, VELOCITY};
use crate::grid_to_points::POINTS_PER_TASK;
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;
use crate::transfer::{PointTransfer, with_transfer};

/// New velocity of the points (G11, or that of their transfer) and their displacement
/// in the step (G12).
pub(crate) fn grid_to_points<const D: usize>(
    body: &Body,
    start: usize,
    points: &mut Points<D>,
    displacement: &mut [SVector<f64, D>],
    grid: &Grid<D>,
    dt: f64,
) {
    with_transfer!(body, transfer => {
        gather(transfer, body, start, points, displacement, grid, dt);
    });
}

fn gather<T: PointTransfer, const D: usize>(
    transfer: T,
    body: &Body,
    start: usize,
    points: &mut Points<D>,
    displacement: &mut [SVector<f64, D>],
    grid: &Grid<D>,
    dt: f64,
) {
    let mut velocity = std::mem::take(&mut points.velocity);
    let mut affine = std::mem::take(&mut points.affine_velocity);
    let end = start + displacement.len();
    let frame = body.discretisation.frame;
    let one = |stencil: &mut PointStencil,
               p: usize,
               velocity: &mut SVector<f64, D>,
               displacement: &mut SVector<f64, D>,
               kept: &mut SMatrix<f64, D, D>| {
        let f = &points.deformation_gradient[p];
        stencil.evaluate(body, &grid.geometry, points.site(frame, p), f);
        transfer.gather(stencil, &grid.nodes, dt, velocity, kept);
        *displacement = SVector::zeros();
        for entry in stencil.entries() {
            let record = &grid.nodes[entry.node as usize];
            (0..D).for_each(|d| displacement[d] += dt * entry.value * record[VELOCITY + d]);
        }
    };
    let tasks = velocity[start..end]
        .par_chunks_mut(POINTS_PER_TASK)
        .zip(displacement.par_chunks_mut(POINTS_PER_TASK))
        .enumerate();
    if T::AFFINE {
        tasks.zip(affine[start..end].par_chunks_mut(POINTS_PER_TASK)).for_each(
            |((task, (velocities, displacements)), kept)| {
                let mut stencil = PointStencil::default();
                let first = start + task * POINTS_PER_TASK;
                let moved = velocities.iter_mut().zip(displacements).zip(kept);
                for (k, ((velocity, displacement), kept)) in moved.enumerate() {
                    one(&mut stencil, first + k, velocity, displacement, kept);
                }
            },
        );
    } else {
        tasks.for_each(|(task, (velocities, displacements))| {
            let mut stencil = PointStencil::default();
            let first = start + task * POINTS_PER_TASK;
            let moved = velocities.iter_mut().zip(displacements);
            for (k, (velocity, displacement)) in moved.enumerate() {
                one(&mut stencil, first + k, velocity, displacement, &mut SMatrix::zeros());
            }
        });
    }
    points.velocity = velocity;
    points.affine_velocity = affine;
}
