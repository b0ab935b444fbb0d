//! Second-order tensors in three dimensions over [`Real`].

use core::ops::{Add, Mul, Sub};

use nalgebra::Matrix3;

use crate::real::Real;

/// Second-order tensor in three dimensions, row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tensor<R>(pub [[R; 3]; 3]);

impl<R: Real> Tensor<R> {
    /// The tensor with components `component(i, j)`.
    #[inline(always)]
    pub fn from_fn(mut component: impl FnMut(usize, usize) -> R) -> Self {
        Self([
            [component(0, 0), component(0, 1), component(0, 2)],
            [component(1, 0), component(1, 1), component(1, 2)],
            [component(2, 0), component(2, 1), component(2, 2)],
        ])
    }

    /// The identity.
    #[inline(always)]
    pub fn identity() -> Self {
        Self::diagonal([R::splat(1.0); 3])
    }

    /// The diagonal tensor with these components.
    #[inline(always)]
    pub fn diagonal(components: [R; 3]) -> Self {
        Self::from_fn(|i, j| if i == j { components[i] } else { R::splat(0.0) })
    }

    /// Transpose `Aᵀ`.
    #[inline(always)]
    pub fn transpose(&self) -> Self {
        Self::from_fn(|i, j| self.0[j][i])
    }

    /// `A B + C`.
    #[inline(always)]
    pub fn mul_add(&self, b: &Self, c: &Self) -> Self {
        let (a, b, c) = (&self.0, &b.0, &c.0);
        Self::from_fn(|i, j| {
            a[i][2].mul_add(b[2][j], a[i][1].mul_add(b[1][j], a[i][0].mul_add(b[0][j], c[i][j])))
        })
    }

    /// `A Bᵀ`.
    #[inline(always)]
    pub fn mul_transposed(&self, other: &Self) -> Self {
        Self::from_fn(|i, j| {
            let (a, b) = (&self.0[i], &other.0[j]);
            a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
        })
    }

    /// `factor · A`.
    #[inline(always)]
    pub fn scaled(&self, factor: R) -> Self {
        Self::from_fn(|i, j| self.0[i][j] * factor)
    }

    /// Trace.
    #[inline(always)]
    pub fn trace(&self) -> R {
        self.0[0][0] + self.0[1][1] + self.0[2][2]
    }

    /// Cofactor tensor `det A · A⁻ᵀ`: it turns a reference area into the current
    /// one (Nanson), and Cauchy stress into the first Piola-Kirchhoff stress,
    /// `P = σ cof F`.
    #[inline(always)]
    pub fn cofactor(&self) -> Self {
        let a = &self.0;
        Self::from_fn(|i, j| {
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            a[i1][j1].mul_add(a[i2][j2], -(a[i1][j2] * a[i2][j1]))
        })
    }

    /// Determinant.
    #[inline(always)]
    pub fn determinant(&self) -> R {
        let a = &self.0;
        let minor = |j: usize, k: usize| a[1][j].mul_add(a[2][k], -(a[1][k] * a[2][j]));
        let last = a[0][2] * minor(0, 1);
        a[0][0].mul_add(minor(1, 2), a[0][1].mul_add(minor(2, 0), last))
    }

    /// Inverse `cof Aᵀ/det A`; not finite for a singular tensor.
    #[inline(always)]
    pub fn inverse(&self) -> Self {
        let cofactor = self.cofactor();
        let [a, c] = [&self.0[0], &cofactor.0[0]];
        let scale = R::splat(1.0) / (a[0] * c[0] + a[1] * c[1] + a[2] * c[2]);
        Self::from_fn(|i, j| cofactor.0[j][i] * scale)
    }

    /// Symmetric part `½(A + Aᵀ)` as `[xx, yy, zz, xy, yz, xz]`.
    #[inline(always)]
    pub fn symmetric(&self) -> [R; 6] {
        let a = &self.0;
        let mean = |i: usize, j: usize| (a[i][j] + a[j][i]) * 0.5;
        [a[0][0], a[1][1], a[2][2], mean(0, 1), mean(1, 2), mean(0, 2)]
    }

    /// Skew part `½(A - Aᵀ)`.
    #[inline(always)]
    pub fn skew(&self) -> Self {
        Self::from_fn(|i, j| (self.0[i][j] - self.0[j][i]) * 0.5)
    }

    /// The full tensor of a symmetric one, `[xx, yy, zz, xy, yz, xz]`.
    #[inline(always)]
    pub fn from_symmetric(symmetric: &[R; 6]) -> Self {
        let [xx, yy, zz, xy, yz, xz] = *symmetric;
        Self([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }

    /// Double contraction `A : B = Σ A_ij B_ij`.
    #[inline(always)]
    pub fn double_contraction(&self, other: &Self) -> R {
        self.mul_transposed(other).trace()
    }

    /// The tensor of one lane.
    #[inline(always)]
    pub fn lane(&self, k: usize) -> Tensor<f64> {
        Tensor(self.0.map(|row| row.map(|component| component.lane(k))))
    }
}

impl Tensor<f64> {
    /// As a matrix of nalgebra.
    pub fn to_matrix(&self) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| self.0[i][j])
    }
}

impl From<&Matrix3<f64>> for Tensor<f64> {
    #[inline(always)]
    fn from(matrix: &Matrix3<f64>) -> Self {
        Self::from_fn(|i, j| matrix[(i, j)])
    }
}

impl<R: Real> Mul for Tensor<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self::from_fn(|i, j| a[i][2].mul_add(b[2][j], a[i][1].mul_add(b[1][j], a[i][0] * b[0][j])))
    }
}

impl<R: Real> Add for Tensor<R> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::from_fn(|i, j| self.0[i][j] + other.0[i][j])
    }
}

impl<R: Real> Sub for Tensor<R> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::from_fn(|i, j| self.0[i][j] - other.0[i][j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// nalgebra is the independent reference.
        #[test]
        fn agrees_with_nalgebra(
            a in proptest::array::uniform9(-1.0..1.0f64), b in proptest::array::uniform9(-1.0..1.0f64),
        ) {
            let (a, b) = (Matrix3::from_row_slice(&a), Matrix3::from_row_slice(&b));
            let (s, t) = (Tensor::from(&a), Tensor::from(&b));
            let near = |x: Tensor<f64>, y: Matrix3<f64>| (x.to_matrix() - y).norm() < 1e-14;
            prop_assert!(near(s * t, a * b));
            prop_assert!(near(s + t, a + b));
            prop_assert!(near(s - t, a - b));
            prop_assert!(near(s.mul_transposed(&t), a * b.transpose()));
            prop_assert!(near(s.skew(), (a - a.transpose()) / 2.0));
            prop_assert!(near(Tensor::from_symmetric(&s.symmetric()), (a + a.transpose()) / 2.0));
            prop_assert!((s.determinant() - a.determinant()).abs() < 1e-14);
            prop_assert!((s.double_contraction(&t) - a.dot(&b)).abs() < 1e-14);
            if let Some(inverse) = a.try_inverse() {
                let error = (s.inverse().to_matrix() - inverse).norm();
                prop_assert!(error < 1e-12 * inverse.norm().powi(2).max(1.0), "{error}");
            }
        }
    }
}
