//! The number type that constitutive laws are written over.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use wide::f64x8;

/// The most numbers that any [`Real`] of this crate handles at once.
pub(crate) const MAXIMUM_LANES: usize = 8;

/// A number, or one number for each of several points handled at once (the
/// lanes of a vector register).
///
/// A law written over it is compiled once for `f64` and once for eight points
/// together. It must not branch on values: use [`Real::max`], [`Real::min`] and
/// [`Real::abs`]. A law that cannot do without branches works lane by lane with
/// [`Real::lane`] and [`Real::from_lanes`].
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Numbers handled at once, at most 8.
    const LANES: usize;

    /// The same number in every lane.
    fn splat(value: f64) -> Self;

    /// The number in lane `k`, `k < LANES`.
    fn lane(self, k: usize) -> f64;

    /// `value(k)` in lane `k`.
    fn from_lanes(value: impl FnMut(usize) -> f64) -> Self;

    /// `self · factor + addend`, rounded once where the processor can.
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// Square root.
    fn sqrt(self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;

    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;

    // Lane by lane with the standard library: its error is below one unit in the
    // last place and the same in every lane.

    /// `ln x`.
    #[inline(always)]
    fn ln(self) -> Self {
        Self::from_lanes(|k| self.lane(k).ln())
    }

    /// `ln(1 + x)`, accurate for small x.
    #[inline(always)]
    fn ln_1p(self) -> Self {
        Self::from_lanes(|k| self.lane(k).ln_1p())
    }

    /// `e^x`.
    #[inline(always)]
    fn exp(self) -> Self {
        Self::from_lanes(|k| self.lane(k).exp())
    }

    /// `e^x - 1`, accurate for small x.
    #[inline(always)]
    fn exp_m1(self) -> Self {
        Self::from_lanes(|k| self.lane(k).exp_m1())
    }
}

impl Real for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> Self {
        value(0)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        // Without the instruction the standard library's version is a slow function.
        if cfg!(target_feature = "fma") {
            f64::mul_add(self, factor, addend)
        } else {
            self * factor + addend
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.min(other)
    }
}

impl Real for f64x8 {
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self::splat(value)
    }

    #[inline(always)]
    fn lane(self, k: usize) -> f64 {
        self.to_array()[k]
    }

    #[inline(always)]
    fn from_lanes(value: impl FnMut(usize) -> f64) -> Self {
        Self::from(core::array::from_fn::<f64, 8, _>(value))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        f64x8::mul_add(self, factor, addend)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.min(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_hold_what_was_put_in() {
        let x = f64x8::from_lanes(|k| k as f64 - 3.5);
        for k in 0..8 {
            let value = k as f64 - 3.5;
            assert_eq!(x.lane(k), value);
            assert_eq!(Real::abs(x).sqrt().lane(k), value.abs().sqrt());
            assert_eq!(Real::max(x, Real::splat(0.25)).lane(k), value.max(0.25));
            assert_eq!(Real::min(x, Real::splat(0.25)).lane(k), value.min(0.25));
            assert_eq!(Real::exp_m1(x).lane(k), value.exp_m1());
            assert_eq!(
                (x * 2.0 - x / <f64x8 as Real>::splat(4.0)).lane(k),
                value * 2.0 - value / 4.0
            );
        }
    }
}
