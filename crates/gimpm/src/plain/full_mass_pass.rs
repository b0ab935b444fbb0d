//! From nodes to points and back, for the full mass matrix.

use nalgebra::SVector;

use crate::grid::{GridGeometry, RemapRecord};
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;

/// `passed_v += Σ_p m_p S_vp Σ_u S_up increment_u`: the full mass matrix times an
/// increment (`transfer/full_mass.rs`).
pub(crate) fn full_mass_pass<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &Points<D>,
    geometry: &GridGeometry<D>,
    increment: &[RemapRecord],
    passed: &mut [RemapRecord],
) {
    let frame = body.discretisation.frame;
    body.slabs.scatter(geometry, slab_offsets, passed, |range, first, nodes| {
        let mut stencil = PointStencil::default();
        for p in range {
            let f = &points.deformation_gradient[p];
            stencil.evaluate(body, geometry, points.site(frame, p), f);
            let mut momentum = SVector::<f64, D>::zeros();
            for entry in stencil.entries() {
                let record = &increment[entry.node as usize];
                (0..D).for_each(|d| momentum[d] += entry.value * record[d]);
            }
            momentum *= points.mass[p];
            for entry in stencil.entries() {
                let record = &mut nodes[entry.node as usize - first];
                (0..D).for_each(|d| record[d] += entry.value * momentum[d]);
            }
        }
    });
}
