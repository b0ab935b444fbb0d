//! The choice of law that a body makes.

use super::{
    DruckerPrager, LinearElastic, Material, MaterialError, MaterialState, MooneyRivlin, NeoHookean,
    StVenantKirchhoff, StepMotion, VonMises,
};
use crate::real::Real;
use crate::tensor::Tensor;

/// The laws a body can choose from.
///
/// It is itself a [`Material`], which finds the law anew at every call; loops
/// over points find it once a body.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialModel {
    /// Isotropic linear elasticity in rate form.
    LinearElastic(LinearElastic),
    /// Hyperelasticity, linear between Green strain and its stress.
    StVenantKirchhoff(StVenantKirchhoff),
    /// Compressible neo-Hookean hyperelasticity.
    NeoHookean(NeoHookean),
    /// Rubber: Mooney-Rivlin with split volumetric part.
    MooneyRivlin(MooneyRivlin),
    /// Metal plasticity with linear isotropic hardening.
    VonMises(VonMises),
    /// Concrete: Drucker-Prager with tension cut-off.
    DruckerPrager(DruckerPrager),
}

/// Evaluates an expression with the concrete law of a [`MaterialModel`] bound to
/// a name, so that a loop inside it is compiled for that law.
macro_rules! with_material {
    ($model:expr, $law:ident => $body:expr) => {
        match $model {
            $crate::material::MaterialModel::LinearElastic($law) => $body,
            $crate::material::MaterialModel::StVenantKirchhoff($law) => $body,
            $crate::material::MaterialModel::NeoHookean($law) => $body,
            $crate::material::MaterialModel::MooneyRivlin($law) => $body,
            $crate::material::MaterialModel::VonMises($law) => $body,
            $crate::material::MaterialModel::DruckerPrager($law) => $body,
        }
    };
}
pub(crate) use with_material;

impl MaterialModel {
    /// Whether the law keeps history at its points.
    pub fn has_history(&self) -> bool {
        matches!(self, Self::VonMises(_) | Self::DruckerPrager(_))
    }
}

impl Material for MaterialModel {
    fn density(&self) -> f64 {
        with_material!(self, law => law.density())
    }

    fn p_wave_speed(&self) -> f64 {
        with_material!(self, law => law.p_wave_speed())
    }

    fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
        with_material!(self, law => law.update(motion, state));
    }

    fn stored_energy<R: Real>(
        &self,
        deformation_gradient: &Tensor<R>,
        state: &MaterialState<R>,
    ) -> R {
        with_material!(self, law => law.stored_energy(deformation_gradient, state))
    }

    fn validate(&self) -> Result<(), MaterialError> {
        with_material!(self, law => law.validate())
    }
}

macro_rules! from_law {
    ($($law:ident),*) => { $(
        impl From<$law> for MaterialModel {
            fn from(law: $law) -> Self {
                Self::$law(law)
            }
        }
    )* };
}
from_law!(LinearElastic, StVenantKirchhoff, NeoHookean, MooneyRivlin, VonMises, DruckerPrager);

#[cfg(test)]
mod tests {
    use super::*;

    crate::material_conformance!(
        #[test]
        a_model_answers_as_its_law,
        MaterialModel::from(MooneyRivlin::neo_hookean(1100.0, 4.0e6, 2.0e7))
    );

    #[test]
    fn only_plastic_laws_keep_history() {
        let concrete = DruckerPrager::concrete(2400.0, 30.0e9, 0.2, 30.0e6, 3.0e6);
        assert!(MaterialModel::from(concrete).has_history());
        let elastic = LinearElastic { density: 1.0, young_modulus: 1.0, poisson_ratio: 0.0 };
        assert!(!MaterialModel::from(elastic).has_history());
    }
}
