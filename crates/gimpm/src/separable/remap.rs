//! Equation (7), a whole record at a time.

use std::ops::Range;

use nalgebra::SVector;
use wide::{f64x4, f64x8};

use crate::grid::{Grid, RemapRecord};
use crate::lanes::BLOCK;
use crate::points::Points;
use crate::separable::weights::BlockWeights;
use crate::shape::with_shape;
use crate::solid::Body;

/// Adds the momentum of the points (G13, before the division by mass).
pub(crate) fn remap<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    grid: &mut Grid<D>,
) {
    let geometry = &grid.geometry;
    with_shape!(body, shape => {
        body.slabs.scatter(geometry, slab_offsets, &mut grid.remapped, |range, first, nodes| {
            let mut block = [f64x4::splat(0.0); BLOCK];
            for start in range.clone().step_by(BLOCK) {
                let here = start..(start + BLOCK).min(range.end);
                let weights = BlockWeights::<1>::new(geometry, shape, &points.position[here.clone()]);
                let count = here.len();
                for (entry, p) in block.iter_mut().zip(here) {
                    *entry = momentum(points.mass[p], &points.velocity[p]);
                }
                add_block(nodes, first, geometry.stride, &weights, &block[..count], D);
            }
        });
    });
}

/// Momentum of a point in the layout of a [`RemapRecord`].
#[inline(always)]
pub(super) fn momentum<const D: usize>(mass: f64, velocity: &SVector<f64, D>) -> f64x4 {
    let third = if D == 3 { velocity[2] } else { 0.0 };
    f64x4::new([velocity[0], velocity[1], third, 0.0]) * f64x4::splat(mass)
}

/// Adds the momenta of a block to `nodes`, records from storage index `first` on.
#[inline(always)]
pub(super) fn add_block(
    nodes: &mut [RemapRecord],
    first: usize,
    stride: [usize; 3],
    weights: &BlockWeights<1>,
    momenta: &[f64x4],
    dimension: usize,
) {
    let mut k = 0;
    while k < momenta.len() {
        let end = weights.run_end(k, momenta.len());
        let local = &mut nodes[weights.first[k] - first..];
        add(local, stride, weights, k..end, &momenta[k..end], dimension);
        k = end;
    }
}

/// Adds the momenta of a run of points with the same nodes, summed in registers.
#[inline(always)]
fn add(
    nodes: &mut [RemapRecord],
    stride: [usize; 3],
    weights: &BlockWeights<1>,
    run: Range<usize>,
    momenta: &[f64x4],
    dimension: usize,
) {
    let [rows, planes] = weights.extent(run.start, run.end, dimension);
    for c in 0..planes {
        let plane = &mut nodes[c * stride[2]..];
        let products = &weights.rows[c];
        if rows == 2 {
            add_plane::<2>(plane, stride[1], products, &weights.x[0], run.start, momenta);
        } else {
            add_plane::<3>(plane, stride[1], products, &weights.x[0], run.start, momenta);
        }
    }
}

#[inline(always)]
fn add_plane<const ROWS: usize>(
    plane: &mut [RemapRecord],
    stride: usize,
    rows: &[[f64x8; 1]; 3],
    x: &[f64x8; 3],
    start: usize,
    momenta: &[f64x4],
) {
    let mut sum = [[f64x4::splat(0.0); 3]; ROWS];
    for (k, momentum) in momenta.iter().enumerate() {
        let weight = |lanes: &f64x8| f64x4::splat(lanes.as_array()[start + k]);
        for b in 0..ROWS {
            let part = *momentum * weight(&rows[b][0]);
            for a in 0..3 {
                sum[b][a] = part.mul_add(weight(&x[a]), sum[b][a]);
            }
        }
    }
    for b in 0..ROWS {
        let row = &mut plane[b * stride..b * stride + 3];
        for a in 0..3 {
            row[a] = (f64x4::from(row[a]) + sum[b][a]).to_array();
        }
    }
}
