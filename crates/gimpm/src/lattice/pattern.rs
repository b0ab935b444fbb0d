//! Weights of the points of a block: the same in every cell that is filled alike.

use crate::lanes::{BLOCK, Lanes};
use crate::real::Real;

/// Corners of a cell, numbered x fastest; the last four only in three dimensions.
pub(crate) const CORNERS: usize = 8;

/// Weights between up to [`BLOCK`] points of one cell and the cell's corners, once
/// with the points in the lanes and once with the corners. Lanes without a point
/// or corner hold zero.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    /// `value[v]`: S_vp of the points p in the lanes.
    pub value: [Lanes; CORNERS],
    /// `gradient[v][j]`: ∂S_vp/∂X_j (1/m) of the points in the lanes.
    pub gradient: [[Lanes; 3]; CORNERS],
    /// `corner_value[p]`: S_vp of the corners v in the lanes.
    pub corner_value: [Lanes; BLOCK],
    /// `corner_gradient[p][j]`: ∂S_vp/∂X_j (1/m) of the corners in the lanes.
    pub corner_gradient: [[Lanes; 3]; BLOCK],
    /// 1 in the lanes that hold a point.
    pub present: Lanes,
}

impl Pattern {
    /// Tabulates the weights of points at `local` coordinates, 0 to 1 across the
    /// cell: linear in each (G3, G4), which any shape is inside a cell.
    pub fn new<const D: usize>(local: &[[f64; D]], inverse_spacing: f64) -> Self {
        let mut value = [[0.0; BLOCK]; CORNERS];
        let mut gradient = [[[0.0; BLOCK]; 3]; CORNERS];
        for (p, along) in local.iter().enumerate().take(BLOCK) {
            for v in 0..1 << D {
                let upper = |d: usize| v >> d & 1 == 1;
                let weight = |d: usize| if upper(d) { along[d] } else { 1.0 - along[d] };
                value[v][p] = (0..D).map(weight).product();
                for j in 0..D {
                    let slope = if upper(j) { inverse_spacing } else { -inverse_spacing };
                    let others: f64 = (0..D).filter(|&d| d != j).map(weight).product();
                    gradient[v][j][p] = slope * others;
                }
            }
        }
        let by_point = |table: &[f64; BLOCK]| Lanes::from_lanes(|p| table[p]);
        Self {
            value: value.each_ref().map(by_point),
            gradient: gradient.each_ref().map(|axes| axes.each_ref().map(by_point)),
            corner_value: std::array::from_fn(|p| Lanes::from_lanes(|v| value[v][p])),
            corner_gradient: std::array::from_fn(|p| {
                std::array::from_fn(|j| Lanes::from_lanes(|v| gradient[v][j][p]))
            }),
            present: Lanes::from_lanes(|p| if p < local.len() { 1.0 } else { 0.0 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Partition of unity, and linear functions reproduced with their slope.
    #[test]
    fn weights_reproduce_linear_functions() {
        let local = [[0.25, 0.25, 0.25], [0.9, 0.1, 0.6], [0.5, 1.0, 0.0]];
        let pattern = Pattern::new(&local, 4.0);
        for (p, along) in local.iter().enumerate() {
            let sum = |f: &dyn Fn(usize) -> f64| -> f64 { (0..8).map(f).sum() };
            assert!((sum(&|v| pattern.value[v].lane(p)) - 1.0).abs() < 1e-15);
            for d in 0..3 {
                let place = |v: usize| (v >> d & 1) as f64;
                let position = sum(&|v| pattern.value[v].lane(p) * place(v));
                assert!((position - along[d]).abs() < 1e-15, "{position}");
                for j in 0..3 {
                    let slope = sum(&|v| pattern.gradient[v][j].lane(p) * place(v));
                    let exact = if j == d { 4.0 } else { 0.0 };
                    assert!((slope - exact).abs() < 1e-14, "{slope}");
                }
            }
            for v in 0..8 {
                assert_eq!(pattern.value[v].lane(p), pattern.corner_value[p].lane(v));
                for j in 0..3 {
                    let transposed = pattern.corner_gradient[p][j].lane(v);
                    assert_eq!(pattern.gradient[v][j].lane(p), transposed);
                }
            }
        }
        assert_eq!(pattern.present.to_array(), [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!((0..8).all(|v| pattern.value[v].lane(3) == 0.0));
    }
}
