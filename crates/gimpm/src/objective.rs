//! Strain and rotation of a step, measured at its middle.
//!
//! Hughes and Winget (1980): with the displacement gradient taken with respect
//! to the mid-step configuration, a rigid rotation of any size gives exactly no
//! strain, and the stress turns with a proper rotation; to first order in Δt it
//! is the Jaumann rate.

use crate::material::StepMotion;
use crate::real::Real;
use crate::tensor::Tensor;

/// Strain and rotation of a step, for laws in rate form.
#[derive(Debug, Clone, Copy)]
pub struct IncrementalMotion<R> {
    /// Strain increment Δε `[xx, yy, zz, xy, yz, xz]` (tensor shear).
    pub strain: [R; 6],
    /// Rotation increment Q.
    pub rotation: Tensor<R>,
}

impl<R: Real> StepMotion<R> {
    /// Splits the displacement gradient of the step (G16): `G = H (I + H/2)⁻¹`,
    /// `Δε = sym G`, `Q = (I - W/2)⁻¹ (I + W/2)` with `W = skew G`.
    ///
    /// Not finite when the mid-step configuration is degenerate; the stress then
    /// is not finite either, which the step reports.
    #[inline(always)]
    pub fn incremental(&self) -> IncrementalMotion<R> {
        let h = self.step_gradient;
        let middle = Tensor::identity() + h.scaled(R::splat(0.5));
        let g = h * middle.inverse();
        let spin = g.skew();
        // The Cayley transform in closed form, with W³ = -|w|² W and W² = w wᵀ - |w|² I
        // for the axial vector w.
        let [x, y, z] = [spin.0[2][1], spin.0[0][2], spin.0[1][0]];
        let square = x.mul_add(x, y.mul_add(y, z * z));
        let scale = R::splat(1.0) / square.mul_add(R::splat(0.25), R::splat(1.0));
        let [xs, ys, zs] = [x * scale, y * scale, z * scale];
        let half = R::splat(0.5);
        let [hx, hy, hz] = [x * half, y * half, z * half];
        let diagonal = (square * half).mul_add(-scale, R::splat(1.0));
        let rotation = Tensor([
            [hx.mul_add(xs, diagonal), hx.mul_add(ys, -zs), hx.mul_add(zs, ys)],
            [hy.mul_add(xs, zs), hy.mul_add(ys, diagonal), hy.mul_add(zs, -xs)],
            [hz.mul_add(xs, -ys), hz.mul_add(ys, xs), hz.mul_add(zs, diagonal)],
        ]);
        IncrementalMotion { strain: g.symmetric(), rotation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symmetric::{trace, transformed};
    use nalgebra::{Matrix3, Rotation3};
    use proptest::prelude::*;

    fn incremental(h: Matrix3<f64>) -> IncrementalMotion<f64> {
        let step_gradient = Tensor::from(&h);
        let deformation_gradient = Tensor::identity() + step_gradient;
        StepMotion { deformation_gradient, step_gradient }.incremental()
    }

    proptest! {
        /// A step that is a rotation R has no strain and turns stress with R,
        /// whatever its size: objectivity.
        #[test]
        fn rigid_rotation_strains_nothing(
            roll in -1.5..1.5f64, pitch in -1.5..1.5f64, yaw in -1.5..1.5f64,
            stress in proptest::array::uniform6(-1.0e6..1.0e6f64),
        ) {
            let r = *Rotation3::from_euler_angles(roll, pitch, yaw).matrix();
            let motion = incremental(r - Matrix3::identity());
            prop_assert!(motion.strain.iter().all(|e| e.abs() < 1e-12), "{:?}", motion.strain);
            prop_assert!((motion.rotation.to_matrix() - r).norm() < 1e-12);
            let turned = transformed(&stress, &motion.rotation);
            prop_assert!((trace(&turned) - trace(&stress)).abs() < 1e-8);
        }
    }

    #[test]
    fn many_small_stretches_sum_to_the_logarithmic_strain() {
        let mut total = 0.0;
        let (mut length, steps) = (1.0, 1000);
        for _ in 0..steps {
            let growth = 1.0 / f64::from(steps);
            let gradient = Matrix3::from_diagonal(&[growth / length, 0.0, 0.0].into());
            total += incremental(gradient).strain[0];
            length += growth;
        }
        assert!((total - 2.0_f64.ln()).abs() < 1e-7, "{total}");
    }

    #[test]
    fn a_degenerate_middle_is_not_finite() {
        for diagonal in [[-2.0, 0.0, 0.0], [-2.0, -2.0, -2.0], [0.5, -2.0, -2.0]] {
            let motion = incremental(Matrix3::from_diagonal(&diagonal.into()));
            let turned = transformed(&[1.0; 6], &motion.rotation);
            let finite = (0..6).all(|k| (turned[k] + motion.strain[k]).is_finite());
            assert!(!finite, "{diagonal:?}: {motion:?}");
        }
    }
}
