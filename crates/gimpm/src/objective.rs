//! Strain and rotation of a step, measured at its middle.
//!
//! Hughes and Winget (1980): with the displacement gradient taken with respect
//! to the mid-step configuration, a rigid rotation of any size gives exactly no
//! strain, and the stress turns with a proper rotation; to first order in Δt it
//! is the Jaumann rate.

use nalgebra::Matrix3;

/// What a step did to the neighbourhood of a point.
pub(crate) struct IncrementalMotion {
    /// Strain increment `[xx, yy, zz, xy, yz, xz]` (tensor shear).
    pub strain: [f64; 6],
    /// Rotation increment.
    pub rotation: Matrix3<f64>,
}

/// Splits the displacement gradient of a step, `H = Δt Σ_v v_v ⊗ ∇S_vp` (G16):
/// `G = H (I + H/2)⁻¹`, `Δε = sym G`, `Q = (I - W/2)⁻¹ (I + W/2)` with
/// `W = skew G`. `None` when the mid-step configuration is degenerate.
#[inline]
pub(crate) fn incremental_motion(gradient: &Matrix3<f64>) -> Option<IncrementalMotion> {
    let middle = Matrix3::identity() + gradient * 0.5;
    let g = gradient * middle.try_inverse()?;
    let strain = [
        g[(0, 0)],
        g[(1, 1)],
        g[(2, 2)],
        0.5 * (g[(0, 1)] + g[(1, 0)]),
        0.5 * (g[(1, 2)] + g[(2, 1)]),
        0.5 * (g[(0, 2)] + g[(2, 0)]),
    ];
    let spin = (g - g.transpose()) * 0.5;
    // The Cayley transform in closed form: W³ = -|w|² W for the axial vector w.
    let axial = spin[(2, 1)].powi(2) + spin[(0, 2)].powi(2) + spin[(1, 0)].powi(2);
    let scale = 1.0 / (1.0 + 0.25 * axial);
    let rotation = Matrix3::identity() + (spin + spin * spin * 0.5) * scale;
    Some(IncrementalMotion { strain, rotation })
}

/// Rotates a symmetric tensor: `Q σ Qᵀ`.
#[inline]
pub(crate) fn rotated(stress: &[f64; 6], rotation: &Matrix3<f64>) -> [f64; 6] {
    let [xx, yy, zz, xy, yz, xz] = *stress;
    let full = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let turned = rotation * full * rotation.transpose();
    [turned[(0, 0)], turned[(1, 1)], turned[(2, 2)], turned[(0, 1)], turned[(1, 2)], turned[(0, 2)]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    proptest! {
        /// A step that is a rotation R has no strain and turns stress with R,
        /// whatever its size: objectivity.
        #[test]
        fn rigid_rotation_strains_nothing(
            roll in -1.5..1.5f64, pitch in -1.5..1.5f64, yaw in -1.5..1.5f64,
            stress in proptest::array::uniform6(-1.0e6..1.0e6f64),
        ) {
            let r = *Rotation3::from_euler_angles(roll, pitch, yaw).matrix();
            let motion = incremental_motion(&(r - Matrix3::identity())).unwrap();
            prop_assert!(motion.strain.iter().all(|e| e.abs() < 1e-12), "{:?}", motion.strain);
            prop_assert!((motion.rotation - r).norm() < 1e-12);
            let turned = rotated(&stress, &motion.rotation);
            let invariant = |s: &[f64; 6]| s[0] + s[1] + s[2];
            prop_assert!((invariant(&turned) - invariant(&stress)).abs() < 1e-8);
        }
    }

    #[test]
    fn many_small_stretches_sum_to_the_logarithmic_strain() {
        let mut total = 0.0;
        let (mut length, steps) = (1.0, 1000);
        for _ in 0..steps {
            let growth = 1.0 / f64::from(steps);
            let gradient = Matrix3::from_diagonal(&[growth / length, 0.0, 0.0].into());
            total += incremental_motion(&gradient).unwrap().strain[0];
            length += growth;
        }
        assert!((total - 2.0_f64.ln()).abs() < 1e-7, "{total}");
    }
}
