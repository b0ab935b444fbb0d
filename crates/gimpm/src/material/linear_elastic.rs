//! Isotropic linear elasticity in rate form.

use super::elasticity::{IsotropicElasticity, positive};
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::Real;
use crate::symmetric::transformed;
use crate::tensor::Tensor;

/// Isotropic linear elastic material in rate form (G17, G19):
/// `σ ← Q σ Qᵀ + λ tr(Δε) I + 2μ Δε` with the strain Δε and the rotation Q of
/// the step after Hughes and Winget (1980), to first order the Jaumann rate.
///
/// Exact for small strain and any rotation. Its energy misses a relative ε/3 of
/// the work at strain ε: a rate law between Cauchy stress and strain has no
/// exact one. For larger strain take a hyperelastic law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearElastic {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// Young's modulus E (Pa), above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν, between -1 and 0.5 (both excluded).
    pub poisson_ratio: f64,
}

impl LinearElastic {
    fn elasticity(&self) -> IsotropicElasticity {
        IsotropicElasticity::new(self.young_modulus, self.poisson_ratio)
    }

    /// First Lamé constant `λ = Eν/((1+ν)(1-2ν))` (Pa).
    pub fn lame_lambda(&self) -> f64 {
        self.elasticity().lame_lambda()
    }

    /// Shear modulus `μ = E/(2(1+ν))` (Pa).
    pub fn shear_modulus(&self) -> f64 {
        self.elasticity().shear_modulus()
    }

    /// P-wave modulus `λ + 2μ` (Pa): stress over strain with no lateral strain.
    pub fn p_wave_modulus(&self) -> f64 {
        self.elasticity().p_wave_modulus()
    }
}

impl Material for LinearElastic {
    const HISTORY: bool = false;

    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        (self.p_wave_modulus() / self.density).sqrt()
    }

    #[inline(always)]
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        state.stress = trial_stress(&self.elasticity(), motion, &state.stress);
    }

    /// `J ψ(σ)` with `ψ = ((1+ν) σ:σ - ν (tr σ)²)/(2E)`.
    #[inline(always)]
    fn stored_energy<R: Real>(
        &self,
        deformation_gradient: &Tensor<R>,
        state: &MaterialState<R>,
    ) -> R {
        self.elasticity().energy_density(&state.stress) * deformation_gradient.determinant()
    }

    fn validate(&self) -> Result<(), MaterialError> {
        positive("density", self.density, "kg/m³")?;
        self.elasticity().validate()
    }
}

/// Stress after a step without plastic flow, `Q (σ + ½ C : Δε) Qᵀ + ½ C : Δε` (G17):
/// half of the strain comes before the rotation and half after it, which is of
/// second order in the rotation of a step where the whole at its end is of first.
#[inline]
pub(super) fn trial_stress<R: Real>(
    elasticity: &IsotropicElasticity,
    motion: &StepMotion<R>,
    stress: &[R; 6],
) -> [R; 6] {
    let step = motion.incremental();
    let half = elasticity.stress(&step.strain.map(|strain| strain * 0.5));
    let turned = transformed(&core::array::from_fn(|k| stress[k] + half[k]), &step.rotation);
    core::array::from_fn(|k| turned[k] + half[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::path::{StrainPath, uniaxial_stress};

    const CONCRETE: LinearElastic =
        LinearElastic { density: 2400.0, young_modulus: 30.0e9, poisson_ratio: 0.2 };

    crate::material_conformance!(
        #[test]
        concrete,
        CONCRETE
    );
    crate::material_conformance!(
        #[test]
        rubber,
        LinearElastic { density: 1100.0, young_modulus: 11.96e6, poisson_ratio: 0.4 }
    );
    crate::material_conformance!(
        #[test]
        auxetic,
        LinearElastic { density: 100.0, young_modulus: 1.0e6, poisson_ratio: -0.5 }
    );

    #[test]
    fn confined_modulus_is_the_published_one() {
        // ν = 0.2: (1-ν)/((1+ν)(1-2ν)) = 1.1111
        let ratio = CONCRETE.p_wave_modulus() / CONCRETE.young_modulus;
        assert!((ratio - 0.8 / (1.2 * 0.6)).abs() < 1e-14, "{ratio}");
    }

    #[test]
    fn a_pulled_bar_follows_the_logarithmic_strain() {
        // σ = E ln(stretch), to the second order of the step.
        let stretches: Vec<f64> = (1..=200).map(|k| 1.0 + 0.2 * f64::from(k) / 200.0).collect();
        let path = uniaxial_stress(&CONCRETE, &stretches).unwrap();
        let stress = path.last().unwrap().stress[0];
        assert!((stress / (30.0e9 * 1.2_f64.ln()) - 1.0).abs() < 1e-6, "{stress}");
    }

    /// Dienes 1979: τ = μ sin γ, σ_xx = μ(1 - cos γ), to the second order of the
    /// step's rotation.
    #[test]
    fn simple_shear_oscillates_as_the_jaumann_rate_does() {
        let mu = CONCRETE.shear_modulus();
        let end = |steps| StrainPath::simple_shear(4.0, steps).drive(&CONCRETE).pop().unwrap();
        for (k, exact) in [(3, 4.0_f64.sin()), (0, 1.0 - 4.0_f64.cos())] {
            let error = |steps| (end(steps).stress[k] / mu - exact).abs();
            let (coarse, fine) = (error(500), error(1000));
            assert!(fine < 5e-6, "{fine}");
            assert!(coarse > 3.9 * fine, "{coarse} {fine}");
        }
    }

    #[test]
    fn bad_constants_are_named() {
        for (material, name) in [
            (LinearElastic { density: -1.0, ..CONCRETE }, "density"),
            (LinearElastic { young_modulus: f64::NAN, ..CONCRETE }, "young_modulus"),
            (LinearElastic { poisson_ratio: 0.5, ..CONCRETE }, "poisson_ratio"),
            (LinearElastic { poisson_ratio: -1.0, ..CONCRETE }, "poisson_ratio"),
        ] {
            assert_eq!(material.validate().unwrap_err().name, name);
        }
    }
}
