//! Equation (8), a whole record at a time.

use nalgebra::Matrix3;

use crate::grid::{Grid, Stencil};

/// `factor · Σ_v v_v ⊗ ∂S_vp` from the re-mapped velocity; the third row and
/// column are zero in plane strain.
#[inline(always)]
pub(crate) fn displacement_gradient<const D: usize>(
    grid: &Grid<D>,
    stencil: &Stencil,
    factor: f64,
) -> Matrix3<f64> {
    let [sx, sy, sz] = &stencil.value;
    let [gx, gy, gz] = &stencil.gradient;
    let stride = grid.geometry.stride;
    let mut columns = [[0.0; 4]; 3];
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let (yz, dy, dz) = (sy[b] * sz[c], gy[b] * sz[c], sy[b] * gz[c]);
            let start = stencil.first + b * stride[1] + c * stride[2];
            let row = &grid.remapped[start..start + 3];
            for k in 0..4 {
                let value = row[0][k] * sx[0] + row[1][k] * sx[1] + row[2][k] * sx[2];
                let slope = row[0][k] * gx[0] + row[1][k] * gx[1] + row[2][k] * gx[2];
                columns[0][k] += slope * yz;
                columns[1][k] += value * dy;
                columns[2][k] += value * dz;
            }
        }
    }
    Matrix3::from_fn(|i, j| factor * columns[j][i])
}
