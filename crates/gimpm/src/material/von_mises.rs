//! Metal plasticity: von Mises with linear isotropic hardening.

use super::elasticity::{IsotropicElasticity, not_negative, positive};
use super::linear_elastic::trial_stress;
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::Real;
use crate::symmetric::{deviator, double_contraction};
use crate::tensor::Tensor;

/// Von Mises plasticity with linear isotropic hardening (G38): the stress stays
/// within `q <= σ_Y + H ε̄p`, `q = √(3/2 s:s)`, s the deviator, ε̄p the equivalent
/// plastic strain. Elastic part and rotation as in
/// [`LinearElastic`](super::LinearElastic).
///
/// A trial stress outside is drawn back radially,
/// `Δε̄p = max(0, q - σ_Y - H ε̄p)/(3μ + H)`, `s ← (1 - 3μ Δε̄p/q) s`, which is
/// exact for linear hardening (Wilkins 1964; Simo and Hughes, Computational
/// Inelasticity, 1998, chapter 3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VonMises {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// Young's modulus E (Pa), above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν, between -1 and 0.5 (both excluded).
    pub poisson_ratio: f64,
    /// Yield stress σ_Y in uniaxial tension (Pa), above 0.
    pub yield_stress: f64,
    /// Hardening modulus H, stress over plastic strain (Pa), at least 0.
    pub hardening_modulus: f64,
}

impl VonMises {
    fn elasticity(&self) -> IsotropicElasticity {
        IsotropicElasticity::new(self.young_modulus, self.poisson_ratio)
    }
}

impl Material for VonMises {
    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        (self.elasticity().p_wave_modulus() / self.density).sqrt()
    }

    #[inline(always)]
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        let elasticity = self.elasticity();
        let trial = trial_stress(&elasticity, motion, &state.stress);
        let shear = deviator(&trial);
        let equivalent = (double_contraction(&shear, &shear) * 1.5).sqrt();
        let [plastic_strain, plastic_work] = state.history;
        let initial = R::splat(self.yield_stress);
        let strength = plastic_strain * self.hardening_modulus + initial;
        let stiffness = 3.0 * elasticity.shear_modulus();
        let excess = (equivalent - strength).max(R::splat(0.0));
        let increment = excess * (1.0 / (stiffness + self.hardening_modulus));
        // Where there is flow q is above σ_Y; elsewhere the quotient is 0 over σ_Y.
        let removed = increment * stiffness / equivalent.max(initial);
        state.stress = core::array::from_fn(|k| trial[k] - shear[k] * removed);
        let volume = motion.deformation_gradient.determinant();
        let mean_strength = strength + increment * (0.5 * self.hardening_modulus);
        state.history =
            [plastic_strain + increment, plastic_work + volume * mean_strength * increment];
    }

    /// `J ψ(σ)` as in [`LinearElastic`](super::LinearElastic); hardening stores
    /// nothing, its work counts as plastic.
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
        self.elasticity().validate()?;
        positive("yield_stress", self.yield_stress, "Pa")?;
        not_negative("hardening_modulus", self.hardening_modulus, "Pa")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::path::{
        PathPoint, StrainPath, plane_strain_stress, stretches, uniaxial_stress,
    };

    const STEEL: VonMises = VonMises {
        density: 7850.0,
        young_modulus: 210.0e9,
        poisson_ratio: 0.3,
        yield_stress: 250.0e6,
        hardening_modulus: 2.0e9,
    };

    crate::material_conformance!(
        #[test]
        steel,
        STEEL
    );
    crate::material_conformance!(
        #[test]
        perfectly_plastic,
        VonMises { hardening_modulus: 0.0, ..STEEL }
    );

    /// `q - σ_Y - H ε̄p` over σ_Y.
    fn overshoot(law: &VonMises, point: &PathPoint) -> f64 {
        let shear = deviator(&point.stress);
        let q = (1.5 * double_contraction(&shear, &shear)).sqrt();
        (q - law.hardening_modulus * point.history[0]) / law.yield_stress - 1.0
    }

    #[test]
    fn after_yield_the_slope_is_the_tangent_modulus() {
        let path = uniaxial_stress(&STEEL, &stretches(&[1.01], 100)).unwrap();
        let at = |k: usize| (path[k].deformation_gradient.0[0][0].ln(), path[k].stress[0]);
        let ((e0, s0), (e1, s1)) = (at(40), at(100));
        let tangent = 210.0e9 * 2.0e9 / 212.0e9;
        assert!(((s1 - s0) / (e1 - e0) / tangent - 1.0).abs() < 1e-5);
        // On the line through the yield point: σ = σ_Y + E_t(ε - σ_Y/E).
        let exact = 250.0e6 + tangent * (e1 - 250.0e6 / 210.0e9);
        assert!((s1 / exact - 1.0).abs() < 1e-7, "{}", s1 / exact);
        assert!(path.iter().all(|point| overshoot(&STEEL, point) < 1e-10));
    }

    #[test]
    fn reversed_it_yields_at_the_hardened_stress() {
        let path = uniaxial_stress(&STEEL, &stretches(&[1.01, 0.998], 400)).unwrap();
        let largest = path.iter().map(|point| point.stress[0]).fold(0.0, f64::max);
        // The first point of plastic flow after the turn.
        let turn = 400;
        let hardened = path[turn].history[0];
        let again = path[turn..].iter().position(|p| p.history[0] > hardened).unwrap() + turn;
        let strength = -path[again].stress[0];
        assert!(strength >= largest && strength < 1.0005 * largest, "{strength} {largest}");
    }

    /// With no strain along z and no stress along y, yield begins at
    /// `σ_xx = σ_Y/√(1-ν+ν²)` and perfect plasticity ends at `2σ_Y/√3`.
    #[test]
    fn plane_strain_yields_and_flows_at_the_textbook_stress() {
        let law = VonMises { hardening_modulus: 0.0, ..STEEL };
        let first = 250.0e6 / (1.0_f64 - 0.3 + 0.09).sqrt();
        let path = plane_strain_stress(&law, &stretches(&[1.002], 20000)).unwrap();
        let yielded = path.iter().position(|point| point.history[0] > 0.0).unwrap();
        assert!(
            (path[yielded].stress[0] / first - 1.0).abs() < 1e-4,
            "{}",
            path[yielded].stress[0] / first
        );
        let path = plane_strain_stress(&law, &stretches(&[1.03], 300)).unwrap();
        let limit = path.last().unwrap().stress[0] / (500.0e6 / 3.0_f64.sqrt());
        assert!((limit - 1.0).abs() < 1e-6, "{limit}");
        assert!(path.iter().all(|point| overshoot(&law, point) < 1e-10));
    }

    /// At constant volume the rate law has an exact energy, so nothing but
    /// plastic work may be missing: the work of each step, on half of its strain
    /// before the rotation and half after it, is the change of energy plus
    /// dissipation.
    #[test]
    fn shearing_never_creates_energy() {
        let path = StrainPath::through(
            &[0.02, -0.03, 0.01].map(|gamma| {
                Tensor([[1.0, gamma, 0.0], [0.0, 1.0, -0.5 * gamma], [0.0, 0.0, 1.0]])
            }),
            6000,
        )
        .drive(&STEEL);
        let mut total = 0.0;
        for pair in path.windows(2) {
            let [before, after] = pair else { unreachable!() };
            let from = before.deformation_gradient;
            let step_gradient = (after.deformation_gradient - from) * from.inverse();
            let deformation_gradient = after.deformation_gradient;
            let step = StepMotion { deformation_gradient, step_gradient }.incremental();
            let half_strain = step.strain.map(|strain| 0.5 * strain);
            let half = STEEL.elasticity().stress(&half_strain);
            let middle: [f64; 6] = core::array::from_fn(|k| before.stress[k] + half[k]);
            let turned = crate::symmetric::transformed(&middle, &step.rotation);
            let work: f64 = [(before.stress, middle), (turned, after.stress)]
                .iter()
                .map(|(start, end)| {
                    let mean: [f64; 6] = core::array::from_fn(|k| 0.5 * (start[k] + end[k]));
                    double_contraction(&mean, &half_strain)
                })
                .sum();
            let dissipated = work - (after.stored_energy - before.stored_energy);
            assert!(dissipated > -1e-12 * after.stored_energy, "{dissipated}");
            total += dissipated;
        }
        let plastic = path[path.len() - 1].history[1];
        assert!((total / plastic - 1.0).abs() < 1e-3, "{total} {plastic}");
    }

    #[test]
    fn bad_constants_are_named() {
        for (material, name) in [
            (VonMises { yield_stress: 0.0, ..STEEL }, "yield_stress"),
            (VonMises { hardening_modulus: -1.0, ..STEEL }, "hardening_modulus"),
        ] {
            assert_eq!(material.validate().unwrap_err().name, name);
        }
    }
}
