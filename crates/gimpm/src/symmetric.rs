//! Symmetric tensors `[xx, yy, zz, xy, yz, xz]`; shear entries are tensor
//! components (half the engineering shear strain).

use crate::real::Real;
use crate::tensor::Tensor;

/// Trace `S_xx + S_yy + S_zz`.
#[inline(always)]
pub fn trace<R: Real>(s: &[R; 6]) -> R {
    s[0] + s[1] + s[2]
}

/// Double contraction `A : B`, shear counted twice.
#[inline(always)]
pub fn double_contraction<R: Real>(a: &[R; 6], b: &[R; 6]) -> R {
    let shear = a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + shear * 2.0
}

/// `S + m I`.
#[inline(always)]
pub fn plus_isotropic<R: Real>(s: &[R; 6], m: R) -> [R; 6] {
    [s[0] + m, s[1] + m, s[2] + m, s[3], s[4], s[5]]
}

/// Deviator `S - ⅓ tr S I`.
#[inline(always)]
pub fn deviator<R: Real>(s: &[R; 6]) -> [R; 6] {
    plus_isotropic(s, trace(s) * (-1.0 / 3.0))
}

/// `A S Aᵀ`: the rotated tensor when A is a rotation, the push-forward of a
/// contravariant tensor when A is a deformation gradient.
#[inline(always)]
pub fn transformed<R: Real>(s: &[R; 6], a: &Tensor<R>) -> [R; 6] {
    let half = *a * Tensor::from_symmetric(s);
    let entry = |i: usize, j: usize| {
        let (half, a) = (&half.0[i], &a.0[j]);
        half[2].mul_add(a[2], half[1].mul_add(a[1], half[0] * a[0]))
    };
    [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; 6] = [1.0, -2.0, 3.5, 0.5, -0.25, 4.0];
    const B: [f64; 6] = [0.5, 1.0, -1.5, 2.0, 3.0, -0.75];

    #[test]
    fn agrees_with_full_tensors() {
        let (a, b) = (Tensor::from_symmetric(&A), Tensor::from_symmetric(&B));
        assert_eq!(double_contraction(&A, &B), a.double_contraction(&b));
        assert!(trace(&deviator(&A)).abs() < 1e-15);
        let f = Tensor([[1.0, 0.5, 0.0], [-0.25, 2.0, 1.0], [0.0, 0.5, 1.5]]);
        let expected = (f * a).mul_transposed(&f);
        let found = Tensor::from_symmetric(&transformed(&A, &f));
        assert!((found - expected).double_contraction(&(found - expected)) < 1e-26);
    }
}
