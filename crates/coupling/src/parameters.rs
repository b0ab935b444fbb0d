use crate::CouplingError;

/// How often a step repeats the solid with an improved wall velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Correctors {
    /// One, or three where the mass ratio μ = ρ_s t / (ρ dx) is below 3: the
    /// lighter the wall, the more the fluid's answer changes its motion.
    Automatic,
    /// Exactly this many at most (0 to 3).
    Fixed(u32),
}

/// Settings of the exchange between fluid and solid.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingParameters {
    /// Number of correctors a step.
    pub correctors: Correctors,
    /// Wall mass over the mass of the fluid layer at it,
    /// μ = ρ_s t / (ρ dx) with the wall thickness t; decides
    /// [`Correctors::Automatic`]. Infinite when nothing is coupled.
    pub mass_ratio: f64,
    /// Upper limit of the solid's sub-steps in one fluid step.
    pub largest_substep_count: u32,
}

impl Default for CouplingParameters {
    fn default() -> Self {
        Self {
            correctors: Correctors::Automatic,
            mass_ratio: f64::INFINITY,
            largest_substep_count: 1000,
        }
    }
}

impl CouplingParameters {
    /// Mass ratio below which a wall counts as light (design §4).
    const LIGHT_WALL: f64 = 3.0;

    /// Number of correctors after the automatic choice.
    pub fn corrector_count(&self) -> u32 {
        match self.correctors {
            Correctors::Fixed(count) => count,
            Correctors::Automatic if self.mass_ratio < Self::LIGHT_WALL => 3,
            Correctors::Automatic => 1,
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// [`CouplingError::Parameter`] with the name, value and limits.
    pub fn validate(&self) -> Result<(), CouplingError> {
        let bad = |name, value, allowed| Err(CouplingError::Parameter { name, value, allowed });
        if self.corrector_count() > 3 {
            return bad("correctors", f64::from(self.corrector_count()), "between 0 and 3");
        }
        if self.mass_ratio.is_nan() || self.mass_ratio <= 0.0 {
            return bad("mass_ratio", self.mass_ratio, "above 0");
        }
        if self.largest_substep_count == 0 {
            return bad("largest_substep_count", 0.0, "at least 1");
        }
        Ok(())
    }
}
