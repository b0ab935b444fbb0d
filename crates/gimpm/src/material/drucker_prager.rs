//! Concrete: Drucker-Prager plasticity with tension cut-off.

use nalgebra::SymmetricEigen;

use super::elasticity::{IsotropicElasticity, check, positive};
use super::linear_elastic::trial_stress;
use super::principal_return::PrincipalReturn;
use super::{Material, MaterialError, MaterialState, StepMotion};
use crate::real::{MAXIMUM_LANES, Real};
use crate::symmetric::{deviator, double_contraction, trace};
use crate::tensor::Tensor;

/// Biaxial over uniaxial compressive strength of concrete (Kupfer, Hilsdorf and
/// Rüsch, ACI Journal 66, 1969, 656-666).
const BIAXIAL_RATIO: f64 = 1.16;

/// Perfectly plastic Drucker-Prager cone with Rankine cut-off (G39): the stress
/// stays within `α I1 + √J2 <= k` and, each principal one, `σ_i <= f_t`.
///
/// The cone passes through the uniaxial and the biaxial compressive strength:
/// `α = (f_bc - f_c)/(√3 (2 f_bc - f_c))`, `k = f_c (1/√3 - α)` (Chen and Han,
/// Plasticity for Structural Engineers, 1988); α is 0.0700 for
/// `f_bc = 1.16 f_c`. Elastic part and rotation as in
/// [`LinearElastic`](super::LinearElastic); a trial stress outside is returned
/// exactly in principal axes, corners included.
///
/// The cone flows along the potential `β I1 + √J2`, the tension planes along
/// their normals. Strength does not fall with strain: neither crushing nor
/// cracking softens, so it tells where concrete fails, not how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DruckerPrager {
    /// Density ρ0 (kg/m³), above 0.
    pub density: f64,
    /// Young's modulus E (Pa), above 0.
    pub young_modulus: f64,
    /// Poisson's ratio ν, between -1 and 0.5 (both excluded).
    pub poisson_ratio: f64,
    /// Uniaxial compressive strength f_c (Pa), above 0.
    pub compressive_strength: f64,
    /// Biaxial compressive strength f_bc (Pa), at least f_c.
    pub biaxial_strength: f64,
    /// Tensile strength f_t (Pa), above 0 and at most what the cone alone bears
    /// in tension, `k/(α + 1/√3)` (0.78 f_c for α = 0.07).
    pub tensile_strength: f64,
    /// Dilatancy β, from 0 (no plastic volume change) to α (associated).
    pub dilatancy: f64,
}

impl DruckerPrager {
    /// Concrete with `f_bc = 1.16 f_c` and associated flow, from density (kg/m³),
    /// Young's modulus (Pa), Poisson's ratio, f_c and f_t (Pa).
    ///
    /// The flow is associated: this cone is flat, and α = 0.07 dilates by no more
    /// than an angle of 20° in the plane of mean and equivalent stress. Set
    /// `dilatancy` below α for less.
    pub fn concrete(
        density: f64,
        young_modulus: f64,
        poisson_ratio: f64,
        compressive_strength: f64,
        tensile_strength: f64,
    ) -> Self {
        let law = Self {
            density,
            young_modulus,
            poisson_ratio,
            compressive_strength,
            biaxial_strength: BIAXIAL_RATIO * compressive_strength,
            tensile_strength,
            dilatancy: 0.0,
        };
        Self { dilatancy: law.friction(), ..law }
    }

    /// Friction `α = (f_bc - f_c)/(√3 (2 f_bc - f_c))` of the cone.
    pub fn friction(&self) -> f64 {
        let (uniaxial, biaxial) = (self.compressive_strength, self.biaxial_strength);
        (biaxial - uniaxial) / (3.0_f64.sqrt() * (2.0 * biaxial - uniaxial))
    }

    /// Cohesion `k = f_c (1/√3 - α)` of the cone (Pa).
    pub fn cohesion(&self) -> f64 {
        self.compressive_strength * (1.0 / 3.0_f64.sqrt() - self.friction())
    }

    fn elasticity(&self) -> IsotropicElasticity {
        IsotropicElasticity::new(self.young_modulus, self.poisson_ratio)
    }

    fn principal_return(&self) -> PrincipalReturn {
        PrincipalReturn {
            bulk_modulus: self.elasticity().bulk_modulus(),
            shear_modulus: self.elasticity().shear_modulus(),
            friction: self.friction(),
            dilatancy: self.dilatancy,
            cohesion: self.cohesion(),
            tensile_strength: self.tensile_strength,
        }
    }
}

impl Material for DruckerPrager {
    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        (self.elasticity().p_wave_modulus() / self.density).sqrt()
    }

    #[inline]
    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        let trial = trial_stress(&self.elasticity(), motion, &state.stress);
        state.stress = trial;
        let surface = self.principal_return();
        let shear = deviator(&trial);
        let radius = (double_contraction(&shear, &shear) * 0.5).sqrt();
        let first = trace(&trial);
        let cone = first * surface.friction + radius - R::splat(surface.cohesion);
        // No principal stress is above ⅓ I1 + (2/√3) √J2.
        let tension =
            first * (1.0 / 3.0) + radius * (2.0 / 3.0_f64.sqrt()) - R::splat(self.tensile_strength);
        let outside = cone.max(tension);
        if (0..R::LANES).all(|k| outside.lane(k) <= 0.0) {
            return;
        }
        let volume = motion.deformation_gradient.determinant();
        let mut returns = [Return::default(); MAXIMUM_LANES];
        for (k, lane) in returns.iter_mut().enumerate().take(R::LANES) {
            *lane = return_to(&surface, &trial.map(|s| s.lane(k)));
        }
        state.stress =
            core::array::from_fn(|component| R::from_lanes(|k| returns[k].stress[component]));
        state.history[0] += R::from_lanes(|k| returns[k].plastic_strain);
        state.history[1] += R::from_lanes(|k| returns[k].plastic_work) * volume;
    }

    /// `J ψ(σ)` as in [`LinearElastic`](super::LinearElastic).
    #[inline]
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
        let uniaxial = self.compressive_strength;
        positive("compressive_strength", uniaxial, "Pa")?;
        let biaxial = self.biaxial_strength;
        let valid = biaxial.is_finite() && biaxial >= uniaxial;
        let allowed = "finite and at least compressive_strength";
        check("biaxial_strength", biaxial, "Pa", valid, allowed)?;
        let (tension, friction) = (self.tensile_strength, self.friction());
        let bearable = self.cohesion() / (friction + 1.0 / 3.0_f64.sqrt());
        let allowed = "above 0 and at most what the cone bears in tension, k/(α + 1/√3)";
        check("tensile_strength", tension, "Pa", tension > 0.0 && tension <= bearable, allowed)?;
        let valid = (0.0..=friction).contains(&self.dilatancy);
        check("dilatancy", self.dilatancy, "", valid, "from 0 to the friction α (associated)")
    }
}

/// Stress after a return, and the plastic flow of it.
#[derive(Clone, Copy, Default)]
struct Return {
    stress: [f64; 6],
    /// Equivalent plastic strain.
    plastic_strain: f64,
    /// Plastic work per current volume (J/m³).
    plastic_work: f64,
}

/// Returns a trial stress of one point; one that is not finite stays as it is.
fn return_to(surface: &PrincipalReturn, trial: &[f64; 6]) -> Return {
    let unchanged = Return { stress: *trial, ..Return::default() };
    if !trial.iter().all(|s| s.is_finite()) {
        return unchanged;
    }
    let eigen = SymmetricEigen::new(Tensor::from_symmetric(trial).to_matrix());
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let principal = order.map(|i| eigen.eigenvalues[i]);
    if surface.violation(&principal) <= 0.0 {
        return unchanged;
    }
    let admissible = surface.project(&principal);
    let plastic = surface.strain(&core::array::from_fn(|k| principal[k] - admissible[k]));
    let mut stress = [0.0; 6];
    for (k, &i) in order.iter().enumerate() {
        let axis = eigen.eigenvectors.column(i);
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
        for (entry, (a, b)) in stress.iter_mut().zip(pairs) {
            *entry += admissible[k] * axis[a] * axis[b];
        }
    }
    let square: f64 = plastic.iter().map(|e| e * e).sum();
    Return {
        stress,
        plastic_strain: (square * (2.0 / 3.0)).sqrt(),
        plastic_work: (0..3).map(|k| admissible[k] * plastic[k]).sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::path::{StrainPath, biaxial_stress, stretches, uniaxial_stress};

    fn concrete() -> DruckerPrager {
        DruckerPrager::concrete(2400.0, 30.0e9, 0.2, 30.0e6, 3.0e6)
    }

    crate::material_conformance!(
        #[test]
        associated,
        concrete()
    );
    crate::material_conformance!(
        #[test]
        without_dilatancy,
        DruckerPrager { dilatancy: 0.0, ..concrete() }
    );

    #[test]
    fn friction_is_the_published_one() {
        assert!((concrete().friction() - 0.0700).abs() < 5e-5, "{}", concrete().friction());
    }

    #[test]
    fn reaches_its_three_strengths() {
        for dilatancy in [concrete().friction(), 0.0] {
            let law = DruckerPrager { dilatancy, ..concrete() };
            let end = |path: Vec<crate::material::path::PathPoint>| path.last().unwrap().stress[0];
            let squeezed = stretches(&[0.995], 100);
            let uniaxial = end(uniaxial_stress(&law, &squeezed).unwrap());
            assert!((uniaxial / -30.0e6 - 1.0).abs() < 1e-6, "{uniaxial}");
            let biaxial = end(biaxial_stress(&law, &squeezed).unwrap());
            assert!((biaxial / -34.8e6 - 1.0).abs() < 1e-6, "{biaxial}");
            let tension = end(uniaxial_stress(&law, &stretches(&[1.0005], 100)).unwrap());
            assert!((tension / 3.0e6 - 1.0).abs() < 1e-6, "{tension}");
        }
    }

    #[test]
    fn stress_stays_on_or_within_the_surface() {
        let law = concrete();
        let corners = [
            Tensor([[1.002, 0.001, 0.0], [-0.001, 0.998, 0.002], [0.0, 0.0, 1.001]]),
            Tensor([[0.99, 0.003, 0.001], [0.001, 0.995, 0.0], [0.002, 0.0, 1.002]]),
            Tensor::diagonal([1.003, 1.003, 1.003]),
            Tensor([[1.0, 0.02, 0.0], [0.0, 0.995, 0.0], [0.0, 0.01, 1.0]]),
        ];
        let mut flowed = 0;
        for pair in StrainPath::through(&corners, 50).drive(&law).windows(2) {
            let stress = &pair[1].stress;
            let eigenvalues = Tensor::from_symmetric(stress).to_matrix().symmetric_eigenvalues();
            let violation = law.principal_return().violation(&eigenvalues.into());
            let scale = law.compressive_strength;
            assert!(violation < 1e-10 * scale, "{violation}");
            if pair[1].history[0] > pair[0].history[0] {
                flowed += 1;
                assert!(violation > -1e-10 * scale, "flow inside the surface: {violation}");
            }
        }
        assert!(flowed > 100, "{flowed}");
    }

    /// Pulled out in all directions, concrete bears f_t in each and no more.
    #[test]
    fn equal_tension_ends_at_the_apex() {
        let path = StrainPath::through(&[Tensor::diagonal([1.001; 3])], 10).drive(&concrete());
        let [xx, yy, zz, ..] = path.last().unwrap().stress;
        for s in [xx, yy, zz] {
            assert!((s / 3.0e6 - 1.0).abs() < 1e-12, "{s}");
        }
    }

    #[test]
    fn bad_constants_are_named() {
        let good = concrete();
        for (material, name) in [
            (DruckerPrager { compressive_strength: 0.0, ..good }, "compressive_strength"),
            (DruckerPrager { biaxial_strength: 29.0e6, ..good }, "biaxial_strength"),
            (DruckerPrager { tensile_strength: 25.0e6, ..good }, "tensile_strength"),
            (DruckerPrager { dilatancy: 0.2, ..good }, "dilatancy"),
        ] {
            assert_eq!(material.validate().unwrap_err().name, name);
        }
    }
}
