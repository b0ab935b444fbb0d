//! Equations (1) and (2), a whole node record at a time.

use nalgebra::SVector;

use crate::grid::{Grid, NodeRecord, Stencil};
use crate::points::Points;
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
        geometry.scatter_by_slab(slab_offsets, &mut grid.nodes, |range, first, nodes| {
            for p in range {
                let stencil = geometry.stencil(shape, &points.position[p]);
                let moved = moved_record(points.mass[p], &points.velocity[p]);
                let factor = -points.volume[p] * geometry.inverse_spacing;
                let force = force_records(factor, &points.stress[p]);
                let local = &mut nodes[stencil.first - first..];
                add(local, &stencil, geometry.stride, &moved, &force);
            }
        });
    });
}

/// Mass and momentum of a point in the layout of a node record.
#[inline(always)]
fn moved_record<const D: usize>(mass: f64, velocity: &SVector<f64, D>) -> NodeRecord {
    let mut record = [0.0; 8];
    record[0] = mass;
    for d in 0..D {
        record[1 + d] = mass * velocity[d];
    }
    record
}

/// Columns of `factor · σ` in the layout of a node record: what one unit of
/// weight gradient along x, y and z adds to the internal force.
#[inline(always)]
fn force_records(factor: f64, s: &[f64; 6]) -> [NodeRecord; 3] {
    let [xx, yy, zz, xy, yz, xz] = s.map(|component| factor * component);
    [
        [0.0, 0.0, 0.0, 0.0, xx, xy, xz, 0.0],
        [0.0, 0.0, 0.0, 0.0, xy, yy, yz, 0.0],
        [0.0, 0.0, 0.0, 0.0, xz, yz, zz, 0.0],
    ]
}

/// Adds a point to its nodes: eight components at a time, so that a node costs
/// two multiply-adds of a whole record. The third node along x is always written
/// (with weight zero if absent); rows and planes without weight are skipped.
#[inline(always)]
fn add(
    nodes: &mut [NodeRecord],
    stencil: &Stencil,
    stride: [usize; 3],
    moved: &NodeRecord,
    force: &[NodeRecord; 3],
) {
    let [sx, sy, sz] = &stencil.value;
    let [gx, gy, gz] = &stencil.gradient;
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let (yz, dy, dz) = (sy[b] * sz[c], gy[b] * sz[c], sy[b] * gz[c]);
            let mut by_value = [0.0; 8];
            let mut by_gradient = [0.0; 8];
            for k in 0..8 {
                by_value[k] = moved[k] * yz + force[1][k] * dy + force[2][k] * dz;
                by_gradient[k] = force[0][k] * yz;
            }
            let start = b * stride[1] + c * stride[2];
            let row = &mut nodes[start..start + 3];
            for a in 0..3 {
                for k in 0..8 {
                    row[a][k] += by_value[k] * sx[a] + by_gradient[k] * gx[a];
                }
            }
        }
    }
}
