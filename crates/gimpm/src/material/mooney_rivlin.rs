//! Rubber: Mooney-Rivlin hyperelasticity with a split volumetric part.

use super::elasticity::{check, not_negative, positive};
use super::finite_strain::{green_strain, left_cauchy_green_less_identity, volume_change};
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::Real;
use crate::symmetric::{deviator, double_contraction, plus_isotropic, trace};
use crate::tensor::Tensor;

/// Mooney-Rivlin material, shape and volume uncoupled (G37):
/// `W = c10(Ī1 - 3) + c01(Ī2 - 3) + ½K(J - 1)²` with `Ī1 = J^(-2/3) I1`,
/// `Ī2 = J^(-4/3) I2` of C, so
/// `σ = (2/J) dev[(c10 + c01 Ī1) b̄ - c01 b̄²] + K(J - 1) I`, `b̄ = J^(-2/3) F Fᵀ`
/// (Mooney 1940; Rivlin 1948; split as in Holzapfel, Nonlinear Solid Mechanics,
/// 2000, chapter 6).
///
/// The shear modulus at small strain is `2(c10 + c01)`. With `c01 = 0` it is the
/// nearly incompressible neo-Hookean law, see [`MooneyRivlin::neo_hookean`].
/// For K far above the shear modulus average the volume change over a cell
/// (mean dilatation), else the solid locks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MooneyRivlin {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// First constant c10 (Pa), at least 0.
    pub c10: f64,
    /// Second constant c01 (Pa), at least 0; `c10 + c01` is above 0.
    pub c01: f64,
    /// Bulk modulus K (Pa), above 0.
    pub bulk_modulus: f64,
}

impl MooneyRivlin {
    /// Nearly incompressible neo-Hookean rubber: `c10 = μ/2`, `c01 = 0`, from
    /// density (kg/m³), shear modulus μ (Pa) and bulk modulus K (Pa).
    pub fn neo_hookean(density: f64, shear_modulus: f64, bulk_modulus: f64) -> Self {
        Self { density, c10: 0.5 * shear_modulus, c01: 0.0, bulk_modulus }
    }

    /// Shear modulus at small strain, `2(c10 + c01)` (Pa).
    pub fn shear_modulus(&self) -> f64 {
        2.0 * (self.c10 + self.c01)
    }
}

impl Material for MooneyRivlin {
    const HISTORY: bool = false;

    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        ((self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus()) / self.density).sqrt()
    }

    #[inline(always)]
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        let f = &motion.deformation_gradient;
        let change = volume_change(f);
        let shape = (change.ln_1p() * (-2.0 / 3.0)).exp(); // J^(-2/3)
        // With g = b - I: dev b = dev g and dev b² = dev(2g + g²).
        let g = left_cauchy_green_less_identity(f);
        let full = Tensor::from_symmetric(&g);
        let square = (full * full).symmetric();
        let first = shape * (trace(&g) + R::splat(3.0)); // Ī1
        let linear = (first * self.c01 + R::splat(self.c10) - shape * (2.0 * self.c01)) * shape;
        let quadratic = shape * shape * -self.c01;
        let twice_inverse_volume = R::splat(2.0) / (change + R::splat(1.0));
        let shear: [R; 6] = core::array::from_fn(|k| {
            (g[k] * linear + square[k] * quadratic) * twice_inverse_volume
        });
        state.stress = plus_isotropic(&deviator(&shear), change * self.bulk_modulus);
    }

    #[inline(always)]
    fn stored_energy<R: Real>(&self, deformation_gradient: &Tensor<R>, _: &MaterialState<R>) -> R {
        let change = volume_change(deformation_gradient);
        let logarithm = change.ln_1p();
        let strain = green_strain(deformation_gradient);
        let mean = trace(&strain);
        let second = (mean * mean - double_contraction(&strain, &strain)) * 0.5;
        // I1 = 3 + 2 tr E, I2 = 3 + 4 tr E + 4 I2(E); the exponentials less 1 keep
        // the digits of a small strain.
        let less_three = |power: f64, excess: R| {
            let factor = (logarithm * power).exp_m1();
            factor * 3.0 + (factor + R::splat(1.0)) * excess
        };
        less_three(-2.0 / 3.0, mean * 2.0) * self.c10
            + less_three(-4.0 / 3.0, (mean + second) * 4.0) * self.c01
            + change * change * (0.5 * self.bulk_modulus)
    }

    fn validate(&self) -> Result<(), MaterialError> {
        positive("density", self.density, "kg/m³")?;
        not_negative("c10", self.c10, "Pa")?;
        not_negative("c01", self.c01, "Pa")?;
        let sum = self.c10 + self.c01;
        check("c10 + c01", sum, "Pa", sum > 0.0, "above 0 (it is half the shear modulus)")?;
        positive("bulk_modulus", self.bulk_modulus, "Pa")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::path::{StrainPath, biaxial_stress, uniaxial_stress};

    const RUBBER: MooneyRivlin =
        MooneyRivlin { density: 1100.0, c10: 0.3e6, c01: 0.1e6, bulk_modulus: 2.0e9 };

    crate::material_conformance!(
        #[test]
        rubber,
        RUBBER
    );
    crate::material_conformance!(
        #[test]
        compressible_neo_hookean,
        MooneyRivlin::neo_hookean(1100.0, 4.27e6, 2.0e7)
    );

    /// Incompressible closed forms, Rivlin 1948 (Holzapfel 2000, chapter 6):
    /// uniaxial `2(a² - 1/a)(c10 + c01/a)`, equibiaxial
    /// `2(a² - 1/a⁴)(c10 + c01 a²)`. K/μ = 2500 leaves about 1e-3.
    #[test]
    fn pulled_it_follows_rivlin() {
        let stretches: Vec<f64> = (1..=10).map(|k| 1.0 + 0.1 * f64::from(k)).collect();
        let MooneyRivlin { c10, c01, .. } = RUBBER;
        for (point, a) in uniaxial_stress(&RUBBER, &stretches).unwrap()[1..].iter().zip(&stretches)
        {
            let exact = 2.0 * (a * a - 1.0 / a) * (c10 + c01 / a);
            assert!(
                (point.stress[0] / exact - 1.0).abs() < 2e-3,
                "{a}: {}",
                point.stress[0] / exact
            );
        }
        for (point, a) in biaxial_stress(&RUBBER, &stretches).unwrap()[1..].iter().zip(&stretches) {
            let exact = 2.0 * (a * a - a.powi(-4)) * (c10 + c01 * a * a);
            assert!(
                (point.stress[0] / exact - 1.0).abs() < 4e-3,
                "{a}: {}",
                point.stress[0] / exact
            );
        }
    }

    #[test]
    fn simple_shear_keeps_the_modulus_and_has_normal_stress_differences() {
        // τ = 2(c10 + c01)γ, σxx - σyy = 2(c10 + c01)γ², σyy - σzz = -2 c01 γ².
        let end = StrainPath::simple_shear(1.5, 1).drive(&RUBBER).pop().unwrap();
        let [xx, yy, zz, xy, ..] = end.stress;
        assert!((xy / (0.8e6 * 1.5) - 1.0).abs() < 1e-12);
        assert!(((xx - yy) / (0.8e6 * 2.25) - 1.0).abs() < 1e-12);
        assert!(((yy - zz) / (-0.2e6 * 2.25) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn bad_constants_are_named() {
        for (material, name) in [
            (MooneyRivlin { c10: -1.0, ..RUBBER }, "c10"),
            (MooneyRivlin { c10: 0.0, c01: 0.0, ..RUBBER }, "c10 + c01"),
            (MooneyRivlin { bulk_modulus: f64::INFINITY, ..RUBBER }, "bulk_modulus"),
        ] {
            assert_eq!(material.validate().unwrap_err().name, name);
        }
    }
}
