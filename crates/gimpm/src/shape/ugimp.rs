//! Uniform GIMP weights: the point's box keeps its size.

use wide::f64x8;

use super::{AxisWeights, LaneWeights, ShapeFunction};

/// Grid linear function averaged over a box of half width l (G1, G2;
/// Bardenhagen and Kober 2004):
///
/// `S = 1 - (x² + l²)/(2hl)` for `|x| < l`, `1 - |x|/h` up to `h - l`,
/// `(h + l - |x|)²/(4hl)` up to `h + l`, 0 beyond; `0 < l ≤ h/2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ugimp {
    /// Half width over cell width, `l/h`.
    half_width: f64,
    /// `h/(4l)`.
    quarter_inverse: f64,
}

impl Ugimp {
    /// `half_width` is `l/h`; it is held between 1e-6 (a point) and ½ (one
    /// point a cell), the range in which the three pieces are in this order.
    pub fn new(half_width: f64) -> Self {
        let half_width = half_width.clamp(1e-6, 0.5);
        Self { half_width, quarter_inverse: 0.25 / half_width }
    }
}

impl ShapeFunction for Ugimp {
    #[inline(always)]
    fn reach(&self) -> f64 {
        1.0 + self.half_width
    }

    /// The box touches the cell of `base` and, by the length `c`, the next one;
    /// the part in the next cell moves weight from the first two nodes to the third.
    ///
    /// A small weight must not be a difference of large ones: its error would be
    /// that of the force over it, and where it came out at or below 0 the node
    /// would be dropped with a force of the square root of the rounding. So the first node's weight is formed
    /// from the length that is left in its cell.
    #[inline(always)]
    fn weights(&self, x: f64) -> AxisWeights {
        let base = (x - self.half_width).floor();
        let t = x - base;
        let c = (t - (1.0 - self.half_width)).max(0.0);
        let third = c * c * self.quarter_inverse;
        let third_slope = 2.0 * c * self.quarter_inverse;
        let left = (2.0 * self.half_width - c).max(0.0);
        let (first, first_slope) = if c > 0.0 {
            (left * left * self.quarter_inverse, -2.0 * left * self.quarter_inverse)
        } else {
            (1.0 - t, -1.0)
        };
        AxisWeights {
            base: base as i32,
            count: if c > 0.0 { 3 } else { 2 },
            value: [first, 1.0 - first - third, third],
            gradient: [first_slope, -first_slope - third_slope, third_slope],
        }
    }

    /// Without a branch: where `c = 0`, `left = 2l` gives the first node the weight `l`
    /// and the slope -1, and the rest of its weight is the distance to the kink.
    #[inline(always)]
    fn lane_weights(&self, x: f64x8) -> LaneWeights {
        let [zero, one, two] = [0.0, 1.0, 2.0].map(f64x8::splat);
        let half_width = f64x8::splat(self.half_width);
        let quarter_inverse = f64x8::splat(self.quarter_inverse);
        let base = (x - half_width).floor();
        let past_kink = (x - base) - (one - half_width);
        let c = past_kink.fast_max(zero);
        let left = (two * half_width - c).fast_max(zero);
        let (left_slope, third_slope) = (left * quarter_inverse, c * quarter_inverse);
        let first = left.mul_add(left_slope, (zero - past_kink).fast_max(zero));
        let third = c * third_slope;
        let (first_slope, third_slope) = (left_slope * -two, third_slope * two);
        LaneWeights {
            base,
            third: c.simd_gt(zero).to_bitmask(),
            value: [first, one - first - third, third],
            gradient: [first_slope, zero - first_slope - third_slope, third_slope],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::shape_function_conformance!(
        #[test]
        one_point_a_cell,
        Ugimp::new(0.5)
    );
    crate::shape_function_conformance!(
        #[test]
        two_points_a_cell,
        Ugimp::new(0.25)
    );
    crate::shape_function_conformance!(
        #[test]
        three_points_a_cell,
        Ugimp::new(1.0 / 6.0)
    );
    crate::shape_function_conformance!(
        #[test]
        odd_size,
        Ugimp::new(0.31)
    );

    /// The piecewise formula of the paper, node by node.
    fn published(x: f64, l: f64) -> f64 {
        let x = x.abs();
        if x < l {
            1.0 - (x * x + l * l) / (2.0 * l)
        } else if x < 1.0 - l {
            1.0 - x
        } else if x < 1.0 + l {
            (1.0 + l - x).powi(2) / (4.0 * l)
        } else {
            0.0
        }
    }

    #[test]
    fn weights_are_the_published_pieces() {
        for l in [0.5, 0.25, 0.31, 0.1, 0.01] {
            let shape = Ugimp::new(l);
            for k in 0..2000 {
                let x = 3.0 + 0.001 * f64::from(k);
                let w = shape.weights(x);
                for node in -1..8 {
                    let slot = node - w.base;
                    let value = if (0..3).contains(&slot) { w.value[slot as usize] } else { 0.0 };
                    let exact = published(x - f64::from(node), l);
                    assert!((value - exact).abs() < 1e-14, "l {l} x {x}: {value} {exact}");
                }
            }
        }
    }
}
