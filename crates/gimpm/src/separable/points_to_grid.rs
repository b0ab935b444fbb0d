//! Equations (1) and (2), whole node records at a time.

use nalgebra::SVector;
use wide::{f64x4, f64x8};

use crate::grid::{Grid, NodeRecord};
use crate::lanes::BLOCK;
use crate::points::Points;
use crate::separable::weights::BlockWeights;
use crate::shape::with_shape;
use crate::solid::Body;

/// Adds mass, momentum (G5) and internal force (G6) in one sweep over the points.
pub(crate) fn points_to_grid<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    grid: &mut Grid<D>,
) {
    let geometry = &grid.geometry;
    with_shape!(body, shape => {
        body.slabs.scatter(geometry, slab_offsets, &mut grid.nodes, |range, first, nodes| {
            let mut block = [Contribution::default(); BLOCK];
            let positions = points.position[range.clone()].chunks(BLOCK);
            let moving = points.mass[range.clone()].chunks(BLOCK)
                .zip(points.velocity[range.clone()].chunks(BLOCK));
            let stressed = points.volume[range.clone()].chunks(BLOCK)
                .zip(points.stress[range].chunks(BLOCK));
            for ((positions, (mass, velocity)), (volume, stress)) in
                positions.zip(moving).zip(stressed)
            {
                let weights = BlockWeights::<3>::new(geometry, shape, positions);
                let moving = mass.iter().zip(velocity);
                let stressed = volume.iter().zip(stress);
                for (k, ((entry, (m, v)), (volume, stress))) in
                    block.iter_mut().zip(moving).zip(stressed).enumerate()
                {
                    let factor = -geometry.inverse_spacing * volume;
                    *entry = Contribution::new(*m, v, factor, stress, &weights, k);
                }
                let mut k = 0;
                while k < positions.len() {
                    let end = weights.run_end(k, positions.len());
                    let local = &mut nodes[weights.first[k] - first..];
                    add(local, geometry.stride, &weights, k..end, &block[k..end], D);
                    k = end;
                }
            }
        });
    });
}

/// What a point adds to a node, in the layout of a [`NodeRecord`]. The last entry, which
/// no one reads, repeats the one before: a zero there would take masked instructions.
#[derive(Debug, Clone, Copy, Default)]
struct Contribution {
    /// Mass and momentum for a unit of weight; force for a unit of its slope along x.
    along_x: f64x8,
    /// Force for a unit of slope along y and z.
    along_y: f64x4,
    along_z: f64x4,
    /// The three weights along x beside mass and momentum, their slopes beside force.
    weights: [f64x8; 3],
}

impl Contribution {
    /// Of point `k` of a block; `factor` is that of the stress.
    #[inline(always)]
    fn new<const D: usize>(
        m: f64,
        v: &SVector<f64, D>,
        factor: f64,
        stress: &[f64; 6],
        weights: &BlockWeights<3>,
        k: usize,
    ) -> Self {
        let [xx, yy, zz, xy, yz, xz] = *stress;
        let w = if D == 3 { v[2] } else { 0.0 };
        let weight = |a: usize| {
            let [value, slope] = &weights.x;
            let (s, g) = (value[a].as_array()[k], slope[a].as_array()[k]);
            f64x8::new([s, s, s, s, g, g, g, g])
        };
        Self {
            along_x: f64x8::new([1.0, v[0], v[1], w, xx, xy, xz, xz])
                * f64x8::new([m, m, m, m, factor, factor, factor, factor]),
            along_y: f64x4::new([xy, yy, yz, yz]) * f64x4::splat(factor),
            along_z: f64x4::new([xz, yz, zz, zz]) * f64x4::splat(factor),
            weights: [weight(0), weight(1), weight(2)],
        }
    }
}

/// Adds a run of points with the same nodes. Plane by plane, their sum is kept in
/// registers, so that a node is loaded and stored once a run.
#[inline(always)]
fn add(
    nodes: &mut [NodeRecord],
    stride: [usize; 3],
    weights: &BlockWeights<3>,
    run: std::ops::Range<usize>,
    block: &[Contribution],
    dimension: usize,
) {
    let [rows, planes] = weights.extent(run.start, run.end, dimension);
    for c in 0..planes {
        let plane = &mut nodes[c * stride[2]..];
        if rows == 2 {
            add_plane::<2>(plane, stride[1], &weights.rows[c], run.start, block);
        } else {
            add_plane::<3>(plane, stride[1], &weights.rows[c], run.start, block);
        }
    }
}

#[inline(always)]
fn add_plane<const ROWS: usize>(
    plane: &mut [NodeRecord],
    stride: usize,
    rows: &[[f64x8; 3]; 3],
    start: usize,
    block: &[Contribution],
) {
    let mut whole = [[f64x8::splat(0.0); 3]; ROWS];
    let mut force = [[f64x4::splat(0.0); 3]; ROWS];
    for (k, point) in block.iter().enumerate() {
        let weight = |lanes: &f64x8| lanes.as_array()[start + k];
        for b in 0..ROWS {
            let [yz, dy, dz] = &rows[b];
            let [yz, dy, dz] = [weight(yz), weight(dy), weight(dz)];
            let along = point.along_x * f64x8::splat(yz);
            let across = point.along_y.mul_add(f64x4::splat(dy), point.along_z * f64x4::splat(dz));
            for a in 0..3 {
                whole[b][a] = along.mul_add(point.weights[a], whole[b][a]);
                let value = f64x4::splat(point.weights[a].as_array()[0]);
                force[b][a] = across.mul_add(value, force[b][a]);
            }
        }
    }
    for b in 0..ROWS {
        let row = &mut plane[b * stride..b * stride + 3];
        for a in 0..3 {
            let [x, y, z, padding] = force[b][a].to_array();
            let force = f64x8::new([0.0, 0.0, 0.0, 0.0, x, y, z, padding]);
            row[a] = (f64x8::from(row[a]) + (whole[b][a] + force)).to_array();
        }
    }
}
