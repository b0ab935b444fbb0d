//! Strain measures of hyperelasticity, written so that a small strain keeps its
//! digits: they are sums of the displacement gradient `F - I`, never a
//! difference of two numbers near 1.

use crate::real::Real;
use crate::tensor::Tensor;

/// Displacement gradient `F - I` with respect to the reference state.
#[inline(always)]
fn displacement_gradient<R: Real>(f: &Tensor<R>) -> Tensor<R> {
    *f - Tensor::identity()
}

/// Green strain `E = ½(FᵀF - I)`.
#[inline(always)]
pub(super) fn green_strain<R: Real>(f: &Tensor<R>) -> [R; 6] {
    let h = displacement_gradient(f);
    let transposed = h.transpose();
    let quadratic = transposed.mul_transposed(&transposed).symmetric();
    let linear = h.symmetric();
    core::array::from_fn(|k| linear[k] + quadratic[k] * 0.5)
}

/// `b - I` with the left Cauchy-Green tensor `b = F Fᵀ`.
#[inline(always)]
pub(super) fn left_cauchy_green_less_identity<R: Real>(f: &Tensor<R>) -> [R; 6] {
    let h = displacement_gradient(f);
    let quadratic = h.mul_transposed(&h).symmetric();
    let linear = h.symmetric();
    core::array::from_fn(|k| linear[k] * 2.0 + quadratic[k])
}

/// `J - 1` with `J = det F`: the sum of the three invariants of `F - I`.
#[inline(always)]
pub(super) fn volume_change<R: Real>(f: &Tensor<R>) -> R {
    let h = displacement_gradient(f);
    let a = &h.0;
    let minor = |i: usize, j: usize| a[i][i] * a[j][j] - a[i][j] * a[j][i];
    h.trace() + (minor(0, 1) + minor(1, 2) + minor(0, 2)) + h.determinant()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;

    #[test]
    fn agrees_with_the_definitions() {
        let f = Matrix3::new(1.2, 0.3, -0.1, 0.05, 0.8, 0.2, -0.15, 0.1, 1.1);
        let tensor = Tensor::from(&f);
        let near = |s: [f64; 6], m: Matrix3<f64>| {
            (Tensor::from_symmetric(&s).to_matrix() - m).norm() < 1e-15
        };
        assert!(near(green_strain(&tensor), (f.transpose() * f - Matrix3::identity()) / 2.0));
        assert!(near(
            left_cauchy_green_less_identity(&tensor),
            f * f.transpose() - Matrix3::identity()
        ));
        assert!((volume_change(&tensor) - (f.determinant() - 1.0)).abs() < 1e-15);
    }
}
