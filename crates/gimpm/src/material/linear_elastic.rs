//! Isotropic linear elasticity in rate form.

use super::{Material, MaterialError};

/// Isotropic linear elastic material (G19): `Δσ = λ tr(Δε) I + 2μ Δε`.
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
    /// First Lamé constant `λ = Eν/((1+ν)(1-2ν))` (Pa).
    pub fn lame_lambda(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.young_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus `μ = E/(2(1+ν))` (Pa).
    pub fn shear_modulus(&self) -> f64 {
        self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// P-wave modulus `λ + 2μ` (Pa): stress over strain with no lateral strain.
    pub fn p_wave_modulus(&self) -> f64 {
        self.lame_lambda() + 2.0 * self.shear_modulus()
    }
}

impl Material for LinearElastic {
    fn density(&self) -> f64 {
        self.density
    }

    fn p_wave_speed(&self) -> f64 {
        (self.p_wave_modulus() / self.density).sqrt()
    }

    #[inline]
    fn update_stress(&self, stress: [f64; 6], strain_increment: &[f64; 6]) -> [f64; 6] {
        let e = strain_increment;
        let twice_mu = 2.0 * self.shear_modulus();
        let volumetric = self.lame_lambda() * (e[0] + e[1] + e[2]);
        let mut updated = stress;
        for k in 0..6 {
            updated[k] += twice_mu * e[k];
        }
        for normal in &mut updated[..3] {
            *normal += volumetric;
        }
        updated
    }

    #[inline]
    fn strain_energy_density(&self, stress: &[f64; 6]) -> f64 {
        let s = stress;
        let trace = s[0] + s[1] + s[2];
        let square = s[0] * s[0]
            + s[1] * s[1]
            + s[2] * s[2]
            + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        let nu = self.poisson_ratio;
        ((1.0 + nu) * square - nu * trace * trace) / (2.0 * self.young_modulus)
    }

    fn validate(&self) -> Result<(), MaterialError> {
        let positive = |name, value: f64, unit| {
            if value.is_finite() && value > 0.0 {
                Ok(())
            } else {
                Err(MaterialError { name, value, unit, allowed: "finite and above 0" })
            }
        };
        positive("density", self.density, "kg/m³")?;
        positive("young_modulus", self.young_modulus, "Pa")?;
        let nu = self.poisson_ratio;
        if nu > -1.0 && nu < 0.5 {
            Ok(())
        } else {
            Err(MaterialError {
                name: "poisson_ratio",
                value: nu,
                unit: "",
                allowed: "above -1 and below 0.5 (0.5 is incompressible: its waves are infinitely fast)",
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
