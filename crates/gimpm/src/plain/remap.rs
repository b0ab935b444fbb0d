//! Equation (7), one point at a time.

use crate::grid::Grid;
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;
use crate::transfer::{PointTransfer, given_velocity, with_transfer};

/// Adds the momentum of the points (G13, before the division by mass).
pub(crate) fn remap<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    grid: &mut Grid<D>,
) {
    with_transfer!(body, transfer => scatter(transfer, body, slab_offsets, points, grid));
}

fn scatter<T: PointTransfer, const D: usize>(
    transfer: T,
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    grid: &mut Grid<D>,
) {
    let geometry = &grid.geometry;
    let frame = body.discretisation.frame;
    body.slabs.scatter(geometry, slab_offsets, &mut grid.remapped, |range, first, nodes| {
        let mut stencil = PointStencil::default();
        for p in range {
            let f = &points.deformation_gradient[p];
            stencil.evaluate(body, geometry, points.site(frame, p), f);
            let (mass, velocity) = (points.mass[p], &points.velocity[p]);
            let spread = points.spread(transfer, p, &stencil);
            for entry in stencil.entries() {
                let record = &mut nodes[entry.node as usize - first];
                for d in 0..D {
                    let carried = given_velocity::<T, D>(velocity, &spread, entry, d);
                    record[d] += entry.value * mass * carried;
                }
            }
        }
    });
}
