//! Linear weights of the original material point method.

use wide::f64x8;

use super::{AxisWeights, LaneWeights, ShapeFunction};

/// `S = 1 - |x|` at the point itself (G3; Sulsky, Chen and Schreyer 1994).
///
/// Its derivative jumps at nodes, so the internal force jumps when a point
/// crosses into the next cell; kept for comparison with GIMP.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear;

impl ShapeFunction for Linear {
    #[inline(always)]
    fn reach(&self) -> f64 {
        1.0
    }

    #[inline(always)]
    fn weights(&self, x: f64) -> AxisWeights {
        let base = x.floor();
        let t = x - base;
        AxisWeights {
            base: base as i32,
            count: 2,
            value: [1.0 - t, t, 0.0],
            gradient: [-1.0, 1.0, 0.0],
        }
    }

    #[inline(always)]
    fn lane_weights(&self, x: f64x8) -> LaneWeights {
        let [zero, one] = [0.0, 1.0].map(f64x8::splat);
        let base = x.floor();
        let t = x - base;
        LaneWeights { base, third: 0, value: [one - t, t, zero], gradient: [-one, one, zero] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::shape_function_conformance!(
        #[test]
        linear,
        Linear
    );
}
