//! Equations (1) and (2), one point at a time.

use nalgebra::Matrix3;

use crate::grid::{ACCELERATION, Grid, VELOCITY};
use crate::parameters::Frame;
use crate::points::Points;
use crate::solid::Body;
use crate::stencil::PointStencil;
use crate::tensor::Tensor;
use crate::transfer::{PointTransfer, given_velocity, with_transfer};

/// Adds mass, momentum (G5) and internal force (G6; G6b in the total frame).
pub(crate) fn points_to_grid<const D: usize>(
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
    body.slabs.scatter(geometry, slab_offsets, &mut grid.nodes, |range, first, nodes| {
        let mut stencil = PointStencil::default();
        for p in range {
            let f = &points.deformation_gradient[p];
            stencil.evaluate(body, geometry, points.site(frame, p), f);
            let (mass, velocity) = (points.mass[p], &points.velocity[p]);
            let spread = points.spread(transfer, p, &stencil);
            let force = internal_force(frame, points, p);
            for entry in stencil.entries() {
                let record = &mut nodes[entry.node as usize - first];
                record[0] += entry.value * mass;
                for d in 0..D {
                    let carried = given_velocity::<T, D>(velocity, &spread, entry, d);
                    record[VELOCITY + d] += entry.value * mass * carried;
                    let pull: f64 = (0..D).map(|j| force[(d, j)] * entry.gradient[j]).sum();
                    record[ACCELERATION + d] += pull;
                }
            }
        }
    });
}

/// What a unit of weight gradient adds to the force on a node (J): `-V σ`, or
/// `-V0 P` with the first Piola–Kirchhoff stress `P = J σ F⁻ᵀ` in the total frame.
fn internal_force<const D: usize>(frame: Frame, points: &Points<D>, p: usize) -> Matrix3<f64> {
    let stress = Tensor::from_symmetric(&points.stress[p]).to_matrix();
    match frame {
        Frame::Updated => stress * -points.volume[p],
        Frame::Total => {
            let cofactor = Tensor::from(&points.deformation_gradient[p]).cofactor();
            stress * cofactor.to_matrix() * -points.reference_volume[p]
        }
    }
}
