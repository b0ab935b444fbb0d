//! Constitutive laws as written in a case file.

use gimpm::{
    DruckerPrager, LinearElastic, MaterialModel, MooneyRivlin, NeoHookean, StVenantKirchhoff,
    VonMises,
};
use serde::Deserialize;

/// Constitutive law and its constants; ranges are those of the law in `gimpm`.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Material")]
pub enum MaterialForm {
    /// Isotropic linear elasticity with an objective stress rate.
    LinearElastic {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν, above -1 and below 0.5.
        poisson_ratio: f64,
    },
    /// Hyperelasticity, linear between Green strain and its stress.
    StVenantKirchhoff {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν, above -1 and below 0.5.
        poisson_ratio: f64,
    },
    /// Compressible neo-Hookean hyperelasticity.
    NeoHookean {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E at small strain (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν at small strain, above -1 and below 0.5.
        poisson_ratio: f64,
    },
    /// Nearly incompressible rubber.
    MooneyRivlin {
        /// Density (kg/m³), above 0.
        density: f64,
        /// First constant (Pa), at least 0.
        c10: f64,
        /// Second constant (Pa), at least 0; their sum is half the shear modulus. Default 0.
        #[serde(default)]
        c01: f64,
        /// Bulk modulus K (Pa), above 0.
        bulk_modulus: f64,
    },
    /// Metal plasticity with linear isotropic hardening.
    VonMises {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν, above -1 and below 0.5.
        poisson_ratio: f64,
        /// Yield stress in uniaxial tension (Pa), above 0.
        yield_stress: f64,
        /// Stress over plastic strain (Pa), at least 0. Default 0: perfectly plastic.
        #[serde(default)]
        hardening_modulus: f64,
    },
    /// Concrete: Drucker-Prager plasticity with tension cut-off.
    DruckerPrager {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν, above -1 and below 0.5.
        poisson_ratio: f64,
        /// Uniaxial compressive strength f_c (Pa), above 0.
        compressive_strength: f64,
        /// Biaxial compressive strength (Pa), at least f_c. Default 1.16 f_c.
        #[serde(default)]
        biaxial_strength: Option<f64>,
        /// Tensile strength f_t (Pa), above 0.
        tensile_strength: f64,
        /// Dilatancy β, from 0 to the friction α of the cone. Default α: associated flow.
        #[serde(default)]
        dilatancy: Option<f64>,
    },
}

impl MaterialForm {
    /// The law as the solver knows it.
    pub fn model(&self) -> MaterialModel {
        match *self {
            Self::LinearElastic { density, young_modulus, poisson_ratio } => {
                LinearElastic { density, young_modulus, poisson_ratio }.into()
            }
            Self::StVenantKirchhoff { density, young_modulus, poisson_ratio } => {
                StVenantKirchhoff { density, young_modulus, poisson_ratio }.into()
            }
            Self::NeoHookean { density, young_modulus, poisson_ratio } => {
                NeoHookean { density, young_modulus, poisson_ratio }.into()
            }
            Self::MooneyRivlin { density, c10, c01, bulk_modulus } => {
                MooneyRivlin { density, c10, c01, bulk_modulus }.into()
            }
            Self::VonMises {
                density,
                young_modulus,
                poisson_ratio,
                yield_stress,
                hardening_modulus,
            } => {
                VonMises { density, young_modulus, poisson_ratio, yield_stress, hardening_modulus }
                    .into()
            }
            Self::DruckerPrager {
                density,
                young_modulus,
                poisson_ratio,
                compressive_strength,
                biaxial_strength,
                tensile_strength,
                dilatancy,
            } => {
                let mut law = DruckerPrager::concrete(
                    density,
                    young_modulus,
                    poisson_ratio,
                    compressive_strength,
                    tensile_strength,
                );
                law.biaxial_strength = biaxial_strength.unwrap_or(law.biaxial_strength);
                law.dilatancy = dilatancy.unwrap_or(law.friction());
                law.into()
            }
        }
    }

    /// Name of the law, as in the file.
    pub fn law(&self) -> &'static str {
        match self {
            Self::LinearElastic { .. } => "LinearElastic",
            Self::StVenantKirchhoff { .. } => "StVenantKirchhoff",
            Self::NeoHookean { .. } => "NeoHookean",
            Self::MooneyRivlin { .. } => "MooneyRivlin",
            Self::VonMises { .. } => "VonMises",
            Self::DruckerPrager { .. } => "DruckerPrager",
        }
    }
}
