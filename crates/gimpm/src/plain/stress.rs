//! Equation (8), one point at a time.

use nalgebra::Matrix3;

use crate::grid::Grid;
use crate::stencil::PointStencil;

/// `H = Δt Σ_v v_v ⊗ ∇S_vp` (G15) from the re-mapped velocity; the third row and
/// column are zero in plane strain.
pub(crate) fn displacement_gradient<const D: usize>(
    stencil: &PointStencil,
    grid: &Grid<D>,
    dt: f64,
) -> Matrix3<f64> {
    let mut gradient = Matrix3::zeros();
    for entry in stencil.entries() {
        let velocity = &grid.remapped[entry.node as usize];
        for i in 0..D {
            for j in 0..D {
                gradient[(i, j)] += dt * velocity[i] * entry.gradient[j];
            }
        }
    }
    gradient
}
