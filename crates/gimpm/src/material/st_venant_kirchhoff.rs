//! St Venant-Kirchhoff hyperelasticity.

use super::elasticity::{IsotropicElasticity, positive};
use super::finite_strain::{green_strain, volume_change};
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::Real;
use crate::symmetric::{double_contraction, trace, transformed};
use crate::tensor::Tensor;

/// St Venant-Kirchhoff material (G35): Hooke's law between Green strain
/// `E = ½(FᵀF - I)` and second Piola-Kirchhoff stress,
/// `S = λ tr(E) I + 2μ E`, `σ = F S Fᵀ/J`, `W = ½λ tr(E)² + μ E:E`
/// (Holzapfel, Nonlinear Solid Mechanics, 2000, chapter 6).
///
/// For large rotation with moderate strain. In strong compression it softens
/// (confined, its stiffness is zero at the stretch 1/√3 = 0.577) and then lets
/// the material invert: take a neo-Hookean law there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StVenantKirchhoff {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// Young's modulus E (Pa), above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν, between -1 and 0.5 (both excluded).
    pub poisson_ratio: f64,
}

impl StVenantKirchhoff {
    fn elasticity(&self) -> IsotropicElasticity {
        IsotropicElasticity::new(self.young_modulus, self.poisson_ratio)
    }
}

impl Material for StVenantKirchhoff {
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
        let second = self.elasticity().stress(&green_strain(f));
        let inverse_volume = R::splat(1.0) / (volume_change(f) + R::splat(1.0));
        state.stress = transformed(&second, f).map(|s| s * inverse_volume);
    }

    #[inline(always)]
    fn stored_energy<R: Real>(&self, deformation_gradient: &Tensor<R>, _: &MaterialState<R>) -> R {
        let strain = green_strain(deformation_gradient);
        let (mean, elasticity) = (trace(&strain), self.elasticity());
        mean * mean * (0.5 * elasticity.lame_lambda())
            + double_contraction(&strain, &strain) * elasticity.shear_modulus()
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

    /// The beam of Turek and Hron's CSM tests.
    const BEAM: StVenantKirchhoff =
        StVenantKirchhoff { density: 1000.0, young_modulus: 1.4e6, poisson_ratio: 0.4 };

    crate::material_conformance!(
        #[test]
        beam,
        BEAM
    );

    #[test]
    fn a_pulled_bar_is_a_cubic_in_the_stretch() {
        // S_axial = E ½(a²-1) and the lateral stretch² 1 - ν(a²-1), so that the
        // nominal stress is E a (a²-1)/2.
        let a = 1.3_f64;
        let end = uniaxial_stress(&BEAM, &[1.1, 1.2, a]).unwrap().pop().unwrap();
        let area = 1.0 - 0.4 * (a * a - 1.0);
        let nominal = end.stress[0] * area;
        assert!((nominal / (1.4e6 * a * (a * a - 1.0) / 2.0) - 1.0).abs() < 1e-11, "{nominal}");
        assert!((end.deformation_gradient.0[1][1] - area.sqrt()).abs() < 1e-11);
    }

    #[test]
    fn confined_it_is_a_cubic_in_the_stretch() {
        // Cauchy stress in confined compression: (λ+2μ) a (a²-1)/2.
        let modulus = 1000.0 * BEAM.p_wave_speed().powi(2);
        for a in [0.5, 1.0 / 3.0_f64.sqrt(), 0.9, 1.5] {
            let end = StrainPath::uniaxial_strain(a - 1.0, 1).drive(&BEAM).pop().unwrap();
            let exact = modulus * a * (a * a - 1.0) / 2.0;
            assert!((end.stress[0] / exact - 1.0).abs() < 1e-13, "{a}");
        }
    }

    #[test]
    fn bad_constants_are_named() {
        let bad = StVenantKirchhoff { poisson_ratio: 0.6, ..BEAM };
        assert_eq!(bad.validate().unwrap_err().name, "poisson_ratio");
    }
}
