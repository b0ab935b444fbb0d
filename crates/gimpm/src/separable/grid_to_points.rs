//! Equations (5) and (6), a whole node record at a time.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid::{ACCELERATION, Grid, GridGeometry, NodeRecord, Stencil, VELOCITY};
use crate::grid_to_points::POINTS_PER_TASK;
use crate::points::Points;
use crate::shape::with_shape;
use crate::solid::Body;

/// New velocity of the points (G11) and their displacement in the step (G12).
pub(crate) fn grid_to_points<const D: usize>(
    body: &Body,
    start: usize,
    points: &mut Points<D>,
    displacement: &mut [SVector<f64, D>],
    grid: &Grid<D>,
    dt: f64,
) {
    let range = start..start + displacement.len();
    let tasks = (
        points.position[range.clone()].par_chunks(POINTS_PER_TASK),
        points.velocity[range].par_chunks_mut(POINTS_PER_TASK),
        displacement.par_chunks_mut(POINTS_PER_TASK),
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
