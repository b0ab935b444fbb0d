//! Compressible neo-Hookean hyperelasticity.

use super::elasticity::{IsotropicElasticity, positive};
use super::finite_strain::{green_strain, left_cauchy_green_less_identity, volume_change};
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::Real;
use crate::symmetric::{plus_isotropic, trace};
use crate::tensor::Tensor;

/// Compressible neo-Hookean material (G36):
/// `W = ½μ(tr C - 3) - μ ln J + ½λ (ln J)²`,
/// `P = μ(F - F⁻ᵀ) + λ ln J F⁻ᵀ`, `σ = (μ(b - I) + λ ln J I)/J`
/// (Bonet and Wood, Nonlinear Continuum Mechanics, 2008, chapter 6; the law
/// of the manufactured solutions of Kamojjala et al. 2015).
///
/// For large strain in tension and compression: the energy goes to infinity with
/// `J → 0`. Shear and volume are coupled; nearly incompressible rubber (ν above
/// about 0.45) is better described by [`MooneyRivlin`](super::MooneyRivlin).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// Young's modulus E at small strain (Pa), above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν at small strain, between -1 and 0.5 (both excluded).
    pub poisson_ratio: f64,
}

impl NeoHookean {
    fn elasticity(&self) -> IsotropicElasticity {
        IsotropicElasticity::new(self.young_modulus, self.poisson_ratio)
    }
}

impl Material for NeoHookean {
    const HISTORY: bool = false;

    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        (self.elasticity().p_wave_modulus() / self.density).sqrt()
    }

    #[inline(always)]
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        let f = &motion.deformation_gradient;
        let (elasticity, change) = (self.elasticity(), volume_change(f));
        let inverse_volume = R::splat(1.0) / (change + R::splat(1.0));
        let shear = inverse_volume * elasticity.shear_modulus();
        let mean = change.ln_1p() * inverse_volume * elasticity.lame_lambda();
        let stretch = left_cauchy_green_less_identity(f);
        state.stress = plus_isotropic(&stretch.map(|b| b * shear), mean);
    }

    #[inline(always)]
    fn stored_energy<R: Real>(&self, deformation_gradient: &Tensor<R>, _: &MaterialState<R>) -> R {
        let elasticity = self.elasticity();
        let logarithm = volume_change(deformation_gradient).ln_1p();
        // ½(tr C - 3) is the trace of the Green strain.
        let shear = trace(&green_strain(deformation_gradient)) - logarithm;
        shear * elasticity.shear_modulus()
            + logarithm * logarithm * (0.5 * elasticity.lame_lambda())
    }

    fn validate(&self) -> Result<(), MaterialError> {
        positive("density", self.density, "kg/m³")?;
        self.elasticity().validate()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::path::{StrainPath, uniaxial_stress};

    const SOFT: NeoHookean =
        NeoHookean { density: 1000.0, young_modulus: 1.0e7, poisson_ratio: 0.3 };

    crate::material_conformance!(
        #[test]
        soft,
        SOFT
    );
    crate::material_conformance!(
        #[test]
        nearly_incompressible,
        NeoHookean { poisson_ratio: 0.4999, ..SOFT }
    );

    #[test]
    fn confined_stretch_has_the_closed_form() {
        // σ = (μ(a²-1) + λ ln a)/a
        let (lambda, mu) = (SOFT.elasticity().lame_lambda(), SOFT.elasticity().shear_modulus());
        for a in [0.2_f64, 0.7, 1.5, 4.0] {
            let end = StrainPath::uniaxial_strain(a - 1.0, 1).drive(&SOFT).pop().unwrap();
            let exact = (mu * (a * a - 1.0) + lambda * a.ln()) / a;
            assert!((end.stress[0] / exact - 1.0).abs() < 1e-13, "{a}");
            let lateral = lambda * a.ln() / a;
            assert!((end.stress[1] / lateral - 1.0).abs() < 1e-13, "{a}");
        }
    }

    #[test]
    fn pulled_without_poisson_effect_the_closed_form_holds() {
        // ν = 0 makes λ = 0, so the sides keep their length: σ = μ(a²-1)/a.
        let law = NeoHookean { poisson_ratio: 0.0, ..SOFT };
        let end = uniaxial_stress(&law, &[1.25, 1.5, 2.0]).unwrap().pop().unwrap();
        assert!((end.stress[0] / (0.5e7 * 1.5) - 1.0).abs() < 1e-12, "{:?}", end.stress);
    }

    #[test]
    fn nearly_incompressible_it_pulls_as_incompressible_rubber() {
        // σ = μ(a² - 1/a), reached with a relative error of the order of 1-2ν.
        let law = NeoHookean { poisson_ratio: 0.4999, ..SOFT };
        let end = uniaxial_stress(&law, &[1.25, 1.5, 1.75, 2.0]).unwrap().pop().unwrap();
        let exact = law.elasticity().shear_modulus() * (4.0 - 0.5);
        assert!((end.stress[0] / exact - 1.0).abs() < 1e-3, "{}", end.stress[0] / exact);
        let volume = end.deformation_gradient.determinant();
        assert!((volume - 1.0).abs() < 1e-3, "{volume}");
    }

    #[test]
    fn bad_constants_are_named() {
        let bad = NeoHookean { young_modulus: 0.0, ..SOFT };
        assert_eq!(bad.validate().unwrap_err().name, "young_modulus");
    }
}
