//! Isotropic linear elasticity: what several laws share.

use super::MaterialError;
use crate::real::Real;
use crate::symmetric::{double_contraction, plus_isotropic, trace};

/// The two elastic constants in the forms that the laws need.
#[derive(Debug, Clone, Copy)]
pub(super) struct IsotropicElasticity {
    young_modulus: f64,
    poisson_ratio: f64,
}

impl IsotropicElasticity {
    pub(super) fn new(young_modulus: f64, poisson_ratio: f64) -> Self {
        Self { young_modulus, poisson_ratio }
    }

    /// First Lamé constant `λ = Eν/((1+ν)(1-2ν))` (Pa).
    pub(super) fn lame_lambda(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.young_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus `μ = E/(2(1+ν))` (Pa).
    pub(super) fn shear_modulus(&self) -> f64 {
        self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Bulk modulus `K = E/(3(1-2ν))` (Pa).
    pub(super) fn bulk_modulus(&self) -> f64 {
        self.young_modulus / (3.0 * (1.0 - 2.0 * self.poisson_ratio))
    }

    /// P-wave modulus `λ + 2μ` (Pa): stress over strain with no lateral strain.
    pub(super) fn p_wave_modulus(&self) -> f64 {
        self.lame_lambda() + 2.0 * self.shear_modulus()
    }

    /// Hooke's law `λ tr(ε) I + 2μ ε` (Pa).
    #[inline(always)]
    pub(super) fn stress<R: Real>(&self, strain: &[R; 6]) -> [R; 6] {
        let twice_mu = 2.0 * self.shear_modulus();
        let mut stress = *strain;
        stress.iter_mut().for_each(|component| *component *= R::splat(twice_mu));
        plus_isotropic(&stress, trace(strain) * self.lame_lambda())
    }

    /// Energy density at a stress, `((1+ν) σ:σ - ν (tr σ)²)/(2E)` (J/m³).
    #[inline(always)]
    pub(super) fn energy_density<R: Real>(&self, stress: &[R; 6]) -> R {
        let (mean, nu) = (trace(stress), self.poisson_ratio);
        let square = double_contraction(stress, stress);
        (square * (1.0 + nu) - mean * mean * nu) * (0.5 / self.young_modulus)
    }

    /// Checks the ranges of both constants.
    pub(super) fn validate(&self) -> Result<(), MaterialError> {
        positive("young_modulus", self.young_modulus, "Pa")?;
        let value = self.poisson_ratio;
        let allowed =
            "above -1 and below 0.5 (0.5 is incompressible: its waves are infinitely fast)";
        check("poisson_ratio", value, "", value > -1.0 && value < 0.5, allowed)
    }
}

/// An error unless `valid`.
pub(super) fn check(
    name: &'static str,
    value: f64,
    unit: &'static str,
    valid: bool,
    allowed: &'static str,
) -> Result<(), MaterialError> {
    if valid { Ok(()) } else { Err(MaterialError { name, value, unit, allowed }) }
}

/// An error unless the value is finite and above 0.
pub(super) fn positive(
    name: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), MaterialError> {
    check(name, value, unit, value.is_finite() && value > 0.0, "finite and above 0")
}

/// An error unless the value is finite and not below 0.
pub(super) fn not_negative(
    name: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), MaterialError> {
    check(name, value, unit, value.is_finite() && value >= 0.0, "finite and at least 0")
}
