//! Equation (8), one point at a time.

use nalgebra::{Matrix3, SVector};

use crate::grid::Grid;
use crate::lanes::{BLOCK, Lanes};
use crate::real::Real;
use crate::solid::Body;
use crate::stencil::PointStencil;
use crate::stress_update::Changes;
use crate::tensor::Tensor;

/// `Δt Σ_v v_v ⊗ ∇S_vp` (G15, G15b) from the re-mapped velocity; the third row and
/// column are zero in plane strain.
pub(crate) fn displacement_gradients<const D: usize>(
    body: &Body,
    grid: &Grid<D>,
    dt: f64,
    sites: &[SVector<f64, D>],
    deformation_gradients: &[Matrix3<f64>],
    changes: &mut Changes,
) {
    let mut stencil = PointStencil::default();
    let blocks = sites.chunks(BLOCK).zip(deformation_gradients.chunks(BLOCK));
    for ((sites, before), change) in blocks.zip(changes) {
        let mut gradient = [[[0.0; BLOCK]; 3]; 3];
        for (k, (site, before)) in sites.iter().zip(before).enumerate() {
            stencil.evaluate(body, &grid.geometry, site, before);
            for entry in stencil.entries() {
                let velocity = &grid.remapped[entry.node as usize];
                for i in 0..D {
                    for j in 0..D {
                        gradient[i][j][k] += dt * velocity[i] * entry.gradient[j];
                    }
                }
            }
        }
        *change = Tensor::from_fn(|i, j| Lanes::from_lanes(|k| gradient[i][j][k]));
    }
}
