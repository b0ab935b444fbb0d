//! Constitutive laws: from the motion of a step to stress.

pub mod conformance;
mod drucker_prager;
mod elasticity;
mod finite_strain;
mod linear_elastic;
mod model;
mod mooney_rivlin;
mod neo_hookean;
pub mod path;
mod principal_return;
mod st_venant_kirchhoff;
mod von_mises;

pub use drucker_prager::DruckerPrager;
pub use linear_elastic::LinearElastic;
pub use model::MaterialModel;
pub(crate) use model::with_material;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use von_mises::VonMises;

use crate::real::Real;
use crate::tensor::Tensor;

/// A material constant outside its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{name} is {value} {unit}; it must be {allowed}")]
pub struct MaterialError {
    /// Name of the constant.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// The allowed range.
    pub allowed: &'static str,
}

/// What a step did to the neighbourhood of a point.
///
/// A law of hyperelasticity reads the deformation gradient; a law in rate form
/// asks for [`StepMotion::incremental`].
#[derive(Debug, Clone, Copy)]
pub struct StepMotion<R> {
    /// Deformation gradient F after the step.
    pub deformation_gradient: Tensor<R>,
    /// Displacement gradient of the step, `H = F_{n+1} F_n⁻¹ - I`.
    pub step_gradient: Tensor<R>,
}

/// What a law remembers at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialState<R> {
    /// Cauchy stress (Pa) `[xx, yy, zz, xy, yz, xz]`, tension positive.
    pub stress: [R; 6],
    /// Memory of laws that have it. `[0]`: equivalent plastic strain
    /// `∫ √(⅔ ε̇p:ε̇p) dt`; `[1]`: plastic work per reference volume (J/m³).
    pub history: [R; 2],
}

impl<R: Real> MaterialState<R> {
    /// No stress, no history.
    pub fn initial() -> Self {
        Self { stress: [R::splat(0.0); 6], history: [R::splat(0.0); 2] }
    }
}

/// A constitutive law, written once over [`Real`] for one point and for several
/// points at once.
///
/// To add a law: implement this trait, add a variant to [`MaterialModel`], and
/// hold it to the conformance check:
///
/// ```
/// use gimpm::{Material, MaterialError, MaterialState, Real, StepMotion, Tensor};
///
/// /// A gas: it resists a change of volume only, with pressure `-K ln J/J`.
/// struct Gas {
///     density: f64,
///     bulk_modulus: f64,
/// }
///
/// impl Material for Gas {
///     fn density(&self) -> f64 {
///         self.density
///     }
///     fn p_wave_speed(&self) -> f64 {
///         (self.bulk_modulus / self.density).sqrt()
///     }
///     fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
///         let volume = motion.deformation_gradient.determinant();
///         let (mean, zero) = (volume.ln() / volume * self.bulk_modulus, R::splat(0.0));
///         state.stress = [mean, mean, mean, zero, zero, zero];
///     }
///     fn stored_energy<R: Real>(&self, f: &Tensor<R>, _: &MaterialState<R>) -> R {
///         let logarithm = f.determinant().ln();
///         logarithm * logarithm * (0.5 * self.bulk_modulus)
///     }
///     fn validate(&self) -> Result<(), MaterialError> {
///         let (value, allowed) = (self.bulk_modulus, "above 0");
///         let error = MaterialError { name: "bulk_modulus", value, unit: "Pa", allowed };
///         if value > 0.0 { Ok(()) } else { Err(error) }
///     }
/// }
///
/// gimpm::material_conformance!(gas_conforms, Gas { density: 1.2, bulk_modulus: 1.4e5 });
/// gas_conforms();
/// ```
pub trait Material: Send + Sync {
    /// Whether the law reads or writes the history of its points.
    const HISTORY: bool = true;

    /// Density ρ0 in the reference state (kg/m³).
    fn density(&self) -> f64;

    /// Speed of a plane pressure wave (m/s) in the reference state, the fastest
    /// signal (G20).
    fn p_wave_speed(&self) -> f64;

    /// Stress and history after a step; both come in as they were before it.
    ///
    /// Never panics: an impossible motion (`det F <= 0`, a degenerate middle of
    /// the step) may give NaN or infinity, which the step reports.
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>);

    /// Elastic energy per reference volume (J/m³), G23.
    fn stored_energy<R: Real>(
        &self,
        deformation_gradient: &Tensor<R>,
        state: &MaterialState<R>,
    ) -> R;

    /// Checks the constants.
    ///
    /// # Errors
    /// [`MaterialError`] names the constant, its value and its range.
    fn validate(&self) -> Result<(), MaterialError>;
}
