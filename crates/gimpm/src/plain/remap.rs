//! Equation (7), one point at a time.

use crate::grid::Grid;
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;

/// Adds the momentum of the points (G13, before the division by mass).
pub(crate) fn remap<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    grid: &mut Grid<D>,
) {
    let geometry = &grid.geometry;
    geometry.scatter_by_slab(slab_offsets, &mut grid.remapped, |range, first, nodes| {
        let mut stencil = PointStencil::default();
        for p in range {
            stencil.evaluate(body, geometry, points.site(body.discretisation.frame, p));
            let momentum = points.velocity[p] * points.mass[p];
            for entry in stencil.entries() {
                let record = &mut nodes[entry.node as usize - first];
                (0..D).for_each(|d| record[d] += entry.value * momentum[d]);
            }
        }
    });
}
