//! Equation (8), a whole record at a time.

use nalgebra::{Matrix3, SVector};
use wide::{f64x4, f64x8};

use crate::grid::{Grid, RemapRecord};
use crate::lanes::{BLOCK, Lanes, joined};
use crate::separable::weights::BlockWeights;
use crate::shape::with_shape;
use crate::solid::Body;
use crate::stress_update::Changes;
use crate::tensor::Tensor;

/// `H = Δt Σ_v v_v ⊗ ∇S_vp` (G15) from the re-mapped velocity.
pub(crate) fn displacement_gradients<const D: usize>(
    body: &Body,
    grid: &Grid<D>,
    dt: f64,
    sites: &[SVector<f64, D>],
    _: &[Matrix3<f64>],
    changes: &mut Changes,
) {
    let factor = dt * grid.geometry.inverse_spacing;
    let geometry = &grid.geometry;
    with_shape!(body, shape => {
        for (sites, change) in sites.chunks(BLOCK).zip(changes) {
            let weights = BlockWeights::<3>::new(geometry, shape, sites);
            let mut columns = [[f64x4::splat(0.0); 3]; BLOCK];
            for (k, columns) in columns.iter_mut().enumerate().take(sites.len()) {
                let nodes = &grid.remapped[weights.first[k]..];
                *columns = velocity_gradient(nodes, geometry.stride, &weights, k, D);
            }
            *change = rows(&columns).scaled(Lanes::splat(factor));
        }
    })
}

/// The tensors of eight points from their columns.
#[inline(always)]
fn rows(columns: &[[f64x4; 3]; BLOCK]) -> Tensor<Lanes> {
    let turned = |first: usize, j: usize| {
        let at = |k: usize| columns[first + k][j];
        f64x4::transpose([at(0), at(1), at(2), at(3)])
    };
    let column = |j: usize| joined(turned(0, j), turned(4, j));
    let ([xx, yx, zx, _], [xy, yy, zy, _], [xz, yz, zz, _]) = (column(0), column(1), column(2));
    Tensor([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]])
}

/// Columns of `Σ_v v_v ⊗ ∂S_vp`, per cell, for point `k`; the third row and column are
/// zero in plane strain.
#[inline(always)]
fn velocity_gradient(
    nodes: &[RemapRecord],
    stride: [usize; 3],
    weights: &BlockWeights<3>,
    k: usize,
    dimension: usize,
) -> [f64x4; 3] {
    let weight = |lanes: &f64x8| f64x4::splat(lanes.as_array()[k]);
    let [s0, s1, s2] = &weights.x[0];
    let [s0, s1, s2] = [weight(s0), weight(s1), weight(s2)];
    let [g0, g1, g2] = &weights.x[1];
    let [g0, g1, g2] = [weight(g0), weight(g1), weight(g2)];
    let [rows, planes] = weights.extent(k, k + 1, dimension);
    let [mut x, mut y, mut z] = [f64x4::splat(0.0); 3];
    for c in 0..planes {
        for b in 0..rows {
            let start = b * stride[1] + c * stride[2];
            let row = &nodes[start..start + 3];
            let [n0, n1, n2] = [f64x4::from(row[0]), f64x4::from(row[1]), f64x4::from(row[2])];
            let value = n0.mul_add(s0, n1.mul_add(s1, n2 * s2));
            let slope = n0.mul_add(g0, n1.mul_add(g1, n2 * g2));
            let [yz, dy, dz] = &weights.rows[c][b];
            x = slope.mul_add(weight(yz), x);
            y = value.mul_add(weight(dy), y);
            z = value.mul_add(weight(dz), z);
        }
    }
    [x, y, z]
}
