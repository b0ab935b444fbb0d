//! How large a step may be.

use crate::error::SolidError;
use crate::solid::Solid;

/// A time step and what limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimit {
    /// Step (s).
    pub value: f64,
    /// Limiting term: "P-wave speed" or "point velocity".
    pub term: &'static str,
}

impl<const D: usize> Solid<D> {
    /// `Δt = C h/(c_p + max|v|)` (G21) with the fastest body's P-wave speed.
    ///
    /// Measured stable in two and three dimensions up to C = 1 with uGIMP and two
    /// points a cell and axis, 0.7 with linear weights (`tests/stability.rs`).
    ///
    /// # Errors
    /// The error of an earlier step, if one failed.
    pub fn stable_time_step(&self) -> Result<TimeStepLimit, SolidError> {
        if let Some(error) = &self.failure {
            return Err(error.clone());
        }
        let value = self.parameters.courant_number * self.limit();
        Ok(TimeStepLimit { value, term: self.limiting_term() })
    }

    /// Step at Courant number 1.
    fn limit(&self) -> f64 {
        self.parameters.grid_spacing / (self.wave_speed + self.state.maximum_speed)
    }

    fn limiting_term(&self) -> &'static str {
        if self.state.maximum_speed > self.wave_speed { "point velocity" } else { "P-wave speed" }
    }

    /// Refuses a step beyond Courant number 1.
    pub(crate) fn check_time_step(&self, time_step: f64) -> Result<(), SolidError> {
        if let Some(error) = &self.failure {
            return Err(error.clone());
        }
        if !(time_step.is_finite() && time_step > 0.0) {
            return Err(SolidError::TimeStep(time_step));
        }
        let limit = self.limit();
        if time_step > limit * (1.0 + 1e-12) {
            let (term, time) = (self.limiting_term(), self.state.time);
            return Err(SolidError::TimeStepTooLarge { time_step, limit, term, time });
        }
        Ok(())
    }
}
