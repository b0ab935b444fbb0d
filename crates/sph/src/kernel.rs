//! Smoothing kernels (S1).

use std::f64::consts::PI;

/// A radial smoothing kernel with compact support in `D` dimensions (S1).
///
/// `W(r)` has unit volume integral and falls monotonically to zero at the support
/// radius. Implementations need only be valid inside the support: the pair loops
/// test `r < support` themselves.
///
/// # Example
/// A kernel of one's own, checked by the conformance macro:
/// ```
/// use sph::Kernel;
///
/// /// Monaghan's cubic spline in 2D, support 2h.
/// #[derive(Clone, Copy)]
/// struct CubicSpline { inverse_length: f64 }
///
/// impl Kernel<2> for CubicSpline {
///     fn new(smoothing_length: f64) -> Self {
///         Self { inverse_length: 1.0 / smoothing_length }
///     }
///     fn support(&self) -> f64 {
///         2.0 / self.inverse_length
///     }
///     fn value(&self, r: f64) -> f64 {
///         let q = r * self.inverse_length;
///         let a = 10.0 / (7.0 * std::f64::consts::PI) * self.inverse_length.powi(2);
///         if q < 1.0 { a * (1.0 - 1.5 * q * q + 0.75 * q.powi(3)) } else { 0.25 * a * (2.0 - q).powi(3) }
///     }
///     fn gradient_factor(&self, r: f64) -> f64 {
///         let q = r * self.inverse_length;
///         let a = 10.0 / (7.0 * std::f64::consts::PI) * self.inverse_length.powi(4);
///         if q < 1.0 { a * (2.25 * q - 3.0) } else { -0.75 * a * (2.0 - q).powi(2) / q }
///     }
/// }
///
/// sph::kernel_conformance!(cubic_spline, CubicSpline, 2);
/// # fn main() {}
/// ```
pub trait Kernel<const D: usize>: Copy + Send + Sync {
    /// The kernel for smoothing length `smoothing_length` (m).
    fn new(smoothing_length: f64) -> Self;
    /// Radius (m) beyond which the kernel is zero.
    fn support(&self) -> f64;
    /// `W(r)` (1/m^D) for `0 <= r < support`.
    fn value(&self, r: f64) -> f64;
    /// `F(r) = (dW/dr)/r` (1/m^(D+2)), finite at `r = 0`, so that `∇_i W_ij = F(r) x_ij`.
    fn gradient_factor(&self, r: f64) -> f64;
}

/// Wendland's C2 kernel with support `2h` (S1; Wendland 1995, Dehnen and Aly 2012 table 1).
///
/// `W = a (1 - q/2)⁴ (1 + 2q)`, `q = r/h`, `a = 7/(4π h²)` in 2D, `21/(16π h³)` in 3D;
/// `F = (dW/dr)/r = -5 (a/h²) (1 - q/2)³`.
///
/// ```
/// use sph::{Kernel, WendlandC2};
/// let kernel = <WendlandC2<2> as Kernel<2>>::new(0.1);
/// assert_eq!(kernel.support(), 0.2);
/// assert!(kernel.value(0.05) < kernel.value(0.0));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct WendlandC2<const D: usize> {
    half_inverse_length: f64,
    support: f64,
    peak: f64,
    slope: f64,
}

impl<const D: usize> Kernel<D> for WendlandC2<D> {
    fn new(smoothing_length: f64) -> Self {
        const { assert!(D == 2 || D == 3, "the fluid is two- or three-dimensional") };
        let h = smoothing_length;
        let peak = if D == 2 { 7.0 / (4.0 * PI * h * h) } else { 21.0 / (16.0 * PI * h * h * h) };
        Self { half_inverse_length: 0.5 / h, support: 2.0 * h, peak, slope: -5.0 * peak / (h * h) }
    }

    fn support(&self) -> f64 {
        self.support
    }

    #[inline(always)]
    fn value(&self, r: f64) -> f64 {
        let q = r * self.half_inverse_length;
        let s = (1.0 - q) * (1.0 - q);
        self.peak * s * s * (1.0 + 4.0 * q)
    }

    #[inline(always)]
    fn gradient_factor(&self, r: f64) -> f64 {
        let s = 1.0 - r * self.half_inverse_length;
        self.slope * s * s * s
    }
}

/// Tests that every [`Kernel`](crate::Kernel) must pass, as one module named `$name`:
/// unit integral, gradient equal to a finite difference, zero at the support,
/// monotone decay.
///
/// ```
/// sph::kernel_conformance!(wendland_c2_3d, sph::WendlandC2<3>, 3);
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! kernel_conformance {
    ($name:ident, $kernel:ty, $dimension:literal) => {
        #[cfg(test)]
        mod $name {
            #[allow(unused_imports)] // a path in `$kernel` may need it
            use super::*;

            const LENGTH: f64 = 0.37;

            fn kernel() -> $kernel {
                <$kernel as $crate::Kernel<$dimension>>::new(LENGTH)
            }

            fn value(r: f64) -> f64 {
                <$kernel as $crate::Kernel<$dimension>>::value(&kernel(), r)
            }

            fn support() -> f64 {
                <$kernel as $crate::Kernel<$dimension>>::support(&kernel())
            }

            #[test]
            fn integral_is_one() {
                let shell = if $dimension == 2 { 2.0 } else { 4.0 } * std::f64::consts::PI;
                let intervals = 20_000;
                let dr = support() / f64::from(intervals);
                let integral: f64 = (0..intervals)
                    .map(|k| (f64::from(k) + 0.5) * dr)
                    .map(|r| value(r) * shell * r.powi($dimension - 1) * dr)
                    .sum();
                assert!((integral - 1.0).abs() < 1e-7, "{integral}");
            }

            #[test]
            fn gradient_is_the_finite_difference() {
                for k in 1..40 {
                    let r = support() * f64::from(k) / 40.5;
                    let step = 1e-6 * support();
                    let difference = (value(r + step) - value(r - step)) / (2.0 * step);
                    let gradient =
                        r * <$kernel as $crate::Kernel<$dimension>>::gradient_factor(&kernel(), r);
                    let scale = value(0.0) / support();
                    assert!((gradient - difference).abs() < 1e-7 * scale, "{r}: {gradient}");
                }
            }

            #[test]
            fn vanishes_at_the_support_and_falls_monotonically() {
                let values: Vec<f64> =
                    (0..=200).map(|k| value(support() * f64::from(k) / 200.0)).collect();
                assert!(values[200].abs() < 1e-12 * values[0]);
                assert!(values.windows(2).all(|pair| pair[1] < pair[0]), "{values:?}");
            }
        }
    };
}

#[cfg(test)]
mod tests {
    crate::kernel_conformance!(wendland_c2_2d, crate::WendlandC2<2>, 2);
    crate::kernel_conformance!(wendland_c2_3d, crate::WendlandC2<3>, 3);
}
