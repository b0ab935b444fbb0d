//! Stable time step and the term that limits it (S8).

use crate::{Dissipation, Fluid, FluidError, Kernel};

/// A time step and what limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimit {
    /// Largest stable step (s).
    pub value: f64,
    /// "sound speed", "acceleration", "viscosity" or "density diffusion".
    pub term: &'static str,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// The largest stable step (S8), the smallest of
    ///
    /// - sound speed: `C h/(c0 + |v|)`, walls included in `|v|`,
    /// - acceleration: `0.25 √(h/|a|)`, with the acceleration of the last kick,
    /// - viscosity: `0.5 h/(α c0)`, or `0.5 h/min(6|v|, c0)` for the Riemann term,
    /// - density diffusion: `0.1 h/(δ c0)`.
    ///
    /// # Errors
    /// [`FluidError::TimeStep`] when a particle has become faster than `c0`.
    pub fn stable_time_step(&self) -> Result<TimeStepLimit, FluidError> {
        let p = &self.parameters;
        let (h, c0) = (p.smoothing_length, p.sound_speed);
        let speed = self.maximum_speed.max(self.maximum_wall_speed());
        let acceleration = self.maximum_acceleration.max(p.gravity.norm());
        let relative_viscosity = match p.dissipation {
            Dissipation::None => 0.0,
            Dissipation::Artificial { alpha } => alpha,
            Dissipation::Riemann { limiter } => (2.0 * limiter * speed / c0).min(1.0),
        };
        let terms = [
            ("sound speed", p.courant_number * h / (c0 + speed)),
            ("acceleration", 0.25 * (h / acceleration).sqrt()),
            ("viscosity", 0.5 * h / (relative_viscosity * c0)),
            ("density diffusion", 0.1 * h / (p.density_diffusion * c0)),
        ];
        let (term, value) = terms.into_iter().fold(terms[0], |a, b| if b.1 < a.1 { b } else { a });
        if speed.is_nan() || speed > c0 {
            let remedy = "the fluid is faster than the numerical sound speed; raise sound_speed to 10 times the largest velocity, or reduce the Courant number";
            return Err(FluidError::TimeStep { value, term, time: self.time, remedy });
        }
        Ok(TimeStepLimit { value, term })
    }

    fn maximum_wall_speed(&self) -> f64 {
        self.wall_groups
            .iter()
            .filter_map(|group| group.motion.as_ref())
            .map(|moving| moving.direction.norm() * moving.motion.velocity(self.time).abs())
            .fold(0.0, f64::max)
    }
}
