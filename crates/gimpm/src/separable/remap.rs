//! Equation (7), a whole record at a time.

use crate::grid::{Grid, RemapRecord, Stencil};
use crate::points::Points;
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
        geometry.scatter_by_slab(slab_offsets, &mut grid.remapped, |range, first, nodes| {
            for p in range {
                let stencil = geometry.stencil(shape, &points.position[p]);
                let mut momentum = [0.0; 4];
                for d in 0..D {
                    momentum[d] = points.mass[p] * points.velocity[p][d];
                }
                let local = &mut nodes[stencil.first - first..];
                add(local, &stencil, geometry.stride, &momentum);
            }
        });
    });
}

/// Adds a momentum to the nodes of a point.
#[inline(always)]
fn add(nodes: &mut [RemapRecord], stencil: &Stencil, stride: [usize; 3], momentum: &RemapRecord) {
    let [sx, sy, sz] = &stencil.value;
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let part = momentum.map(|component| component * (sy[b] * sz[c]));
            let start = b * stride[1] + c * stride[2];
            let row = &mut nodes[start..start + 3];
            for a in 0..3 {
                for k in 0..4 {
                    row[a][k] += part[k] * sx[a];
                }
            }
        }
    }
}
