//! Constitutive laws: from a strain increment to stress.

mod conformance;
mod linear_elastic;

pub use linear_elastic::LinearElastic;

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

/// A constitutive law without memory beyond its stress.
///
/// The solver rotates the stress first (G16), so a law sees the strain
/// increment in the frame of the rotated stress and needs no objective rate of
/// its own. Tensors are `[xx, yy, zz, xy, yz, xz]`; shear strains are tensor
/// components (half the engineering ones).
///
/// To add a law: implement this trait, add a variant to [`MaterialModel`], and
/// run the conformance test on it:
///
/// ```
/// use gimpm::{Material, MaterialError};
///
/// /// A gas: it resists a change of volume only.
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
///     fn update_stress(&self, mut stress: [f64; 6], strain: &[f64; 6]) -> [f64; 6] {
///         let mean = self.bulk_modulus * (strain[0] + strain[1] + strain[2]);
///         stress[..3].iter_mut().for_each(|s| *s += mean);
///         stress
///     }
///     fn strain_energy_density(&self, stress: &[f64; 6]) -> f64 {
///         let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
///         mean * mean / (2.0 * self.bulk_modulus)
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
    /// Density ρ0 in the reference state (kg/m³).
    fn density(&self) -> f64;

    /// Speed of a plane pressure wave (m/s), the fastest signal (G20).
    fn p_wave_speed(&self) -> f64;

    /// Stress (Pa) after a strain increment (G17).
    fn update_stress(&self, stress: [f64; 6], strain_increment: &[f64; 6]) -> [f64; 6];

    /// Elastic energy per current volume (J/m³) stored at a stress (G23).
    fn strain_energy_density(&self, stress: &[f64; 6]) -> f64;

    /// Checks the constants.
    ///
    /// # Errors
    /// [`MaterialError`] names the constant, its value and its range.
    fn validate(&self) -> Result<(), MaterialError>;
}

/// The laws a body can choose from. Loops over points match on it once a body.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialModel {
    /// Isotropic linear elasticity.
    LinearElastic(LinearElastic),
}

impl MaterialModel {
    /// The law behind the trait, for use outside loops over points.
    pub fn as_material(&self) -> &dyn Material {
        match self {
            Self::LinearElastic(material) => material,
        }
    }

    /// Checks the constants.
    ///
    /// # Errors
    /// See [`Material::validate`].
    pub fn validate(&self) -> Result<(), MaterialError> {
        self.as_material().validate()
    }
}

impl From<LinearElastic> for MaterialModel {
    fn from(material: LinearElastic) -> Self {
        Self::LinearElastic(material)
    }
}
