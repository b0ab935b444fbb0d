//! Contiguous-particle GIMP weights: the point's box stretches along the axes.

use nalgebra::{Matrix3, SVector};

use super::domain::{AxisNodes, LARGEST_REACH, NODES_ALONG, tensor_product};
use super::{NodeWeight, PointDomain, ShapeFunction, Ugimp};

/// Grid linear function averaged over a box of half widths `l_d = l V_dd`
/// (contiguous-particle GIMP; Bardenhagen and Kober 2004, section 4; stretch
/// instead of `F_dd`: Charlton, Coombs and Augarde 2017).
///
/// V is the left stretch of `F = V R`: the box lies in space, so it follows the
/// stretch after the rotation, and a rotation alone leaves it as it is. A box
/// wider than two cells is held at that width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cpgimp {
    half_width: f64,
}

impl Cpgimp {
    /// `half_width` is `l/h` in the reference state.
    pub fn new(half_width: f64) -> Self {
        Self { half_width }
    }
}

impl PointDomain for Cpgimp {
    fn for_each_weight<const D: usize>(
        &self,
        x: &SVector<f64, D>,
        f: &Matrix3<f64>,
        give: impl FnMut(NodeWeight<D>),
    ) {
        let stretch = left_stretch_diagonal(f);
        let mut axes = [AxisNodes::ABSENT; 3];
        for d in 0..D {
            axes[d] = box_weights(x[d], (self.half_width * stretch[d]).min(LARGEST_REACH));
        }
        tensor_product(&axes, give);
    }
}

/// `S = 1/(2l) ∫ N(s) ds` from `x - l` to `x + l`, N the grid linear function.
///
/// Wide boxes are summed cell by cell: all terms are positive, so that small
/// weights are exact to round-off (see [`Ugimp`]).
fn box_weights(x: f64, half_width: f64) -> AxisNodes {
    let mut nodes = AxisNodes {
        base: 0,
        count: NODES_ALONG,
        value: [0.0; NODES_ALONG],
        gradient: [0.0; NODES_ALONG],
    };
    if half_width <= 0.5 {
        let weights = Ugimp::new(half_width).weights(x);
        (nodes.base, nodes.count) = (weights.base, weights.count);
        nodes.value[..3].copy_from_slice(&weights.value);
        nodes.gradient[..3].copy_from_slice(&weights.gradient);
        return nodes;
    }
    let inverse = 0.5 / half_width;
    let base = (x - half_width).floor();
    nodes.base = base as i32;
    let (start, end) = (x - half_width - base, x + half_width - base);
    for cell in 0..NODES_ALONG - 1 {
        let from = (start - cell as f64).clamp(0.0, 1.0);
        let to = (end - cell as f64).clamp(0.0, 1.0);
        let length = (to - from) * inverse;
        nodes.value[cell] += 0.5 * length * ((1.0 - from) + (1.0 - to));
        nodes.value[cell + 1] += 0.5 * length * (from + to);
        // The mean of the slope ∓1 over the part of the box in this cell.
        nodes.gradient[cell] -= length;
        nodes.gradient[cell + 1] += length;
    }
    nodes
}

/// Diagonal of V in `F = V R`, for `det F > 0`. R in a plane is the angle of
/// `(F_xx + F_yy, F_yx - F_xy)`; in space it comes from Newton's iteration
/// `R ← (R + R⁻ᵀ)/2` (Higham 1986), which converges quadratically.
fn left_stretch_diagonal(f: &Matrix3<f64>) -> [f64; 3] {
    if f[(0, 2)] == 0.0 && f[(2, 0)] == 0.0 && f[(1, 2)] == 0.0 && f[(2, 1)] == 0.0 {
        let (along, across) = (f[(0, 0)] + f[(1, 1)], f[(1, 0)] - f[(0, 1)]);
        let scale = 1.0 / along.hypot(across).max(f64::MIN_POSITIVE);
        let (cos, sin) = (along * scale, across * scale);
        return [
            (f[(0, 0)] * cos - f[(0, 1)] * sin).abs(),
            (f[(1, 0)] * sin + f[(1, 1)] * cos).abs(),
            f[(2, 2)].abs(),
        ];
    }
    let mut rotation = *f;
    for _ in 0..30 {
        let Some(inverse) = rotation.try_inverse() else { break };
        let next = (rotation + inverse.transpose()) * 0.5;
        let change = (next - rotation).norm_squared();
        rotation = next;
        if change < 1e-28 {
            break;
        }
    }
    std::array::from_fn(|d| (0..3).map(|k| f[(d, k)] * rotation[(d, k)]).sum::<f64>().abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    crate::point_domain_conformance!(
        #[test]
        one_point_a_cell,
        Cpgimp::new(0.5)
    );
    crate::point_domain_conformance!(
        #[test]
        two_points_a_cell,
        Cpgimp::new(0.25)
    );

    /// `1/(2l) ∫ max(0, 1 - |s|) ds` by its antiderivative.
    fn exact(x: f64, l: f64) -> f64 {
        let whole = |s: f64| {
            let s = s.clamp(-1.0, 1.0);
            if s < 0.0 { 0.5 * (1.0 + s).powi(2) } else { 1.0 - 0.5 * (1.0 - s).powi(2) }
        };
        (whole(x + l) - whole(x - l)) / (2.0 * l)
    }

    #[test]
    fn weights_are_the_integral_over_the_box() {
        for l in [0.1, 0.25, 0.5, 0.500001, 0.6, 0.75, 0.9, 0.9999] {
            for k in 0..1000 {
                let x = 3.0 + 0.001 * f64::from(k);
                let nodes = box_weights(x, l);
                for node in -1..9 {
                    let slot = usize::try_from(node - nodes.base).ok().filter(|s| *s < 4);
                    let value = slot.map_or(0.0, |s| nodes.value[s]);
                    let expected = exact(x - f64::from(node), l);
                    assert!((value - expected).abs() < 1e-14, "l {l} x {x}: {value} {expected}");
                }
            }
        }
    }

    #[test]
    fn a_rotation_before_or_after_a_stretch_is_seen_as_it_lies_in_space() {
        let turn = *Rotation3::from_euler_angles(0.4, -0.9, 1.3).matrix();
        assert!(left_stretch_diagonal(&turn).iter().all(|v| (v - 1.0).abs() < 1e-14));
        let plane = *Rotation3::from_euler_angles(0.0, 0.0, 1.3).matrix();
        let in_plane = Matrix3::new(2.0, 0.3, 0.0, 0.3, 0.8, 0.0, 0.0, 0.0, 1.1);
        let in_space = Matrix3::new(2.0, 0.3, 0.0, 0.3, 0.8, 0.1, 0.0, 0.1, 1.1);
        for (stretch, turn) in [(in_plane, plane), (in_space, turn), (in_space, plane)] {
            let found = left_stretch_diagonal(&(stretch * turn));
            for d in 0..3 {
                assert!((found[d] - stretch[(d, d)]).abs() < 1e-13, "{found:?}");
            }
        }
    }
}
