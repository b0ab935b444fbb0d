//! Input of the fluid: parameters, particle seeds, walls, and their checks.

use crate::FluidError;
use motion::Motion;
use nalgebra::SVector;

/// Largest `|ρ/ρ0 - 1|` accepted in the input and during a run.
pub(crate) const DENSITY_LIMIT: f64 = 0.2;

/// Physical and numerical parameters, SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidParameters<const D: usize> {
    /// Particle spacing `dx` (m); each particle has mass `ρ0 dx^D`.
    pub spacing: f64,
    /// Smoothing length `h` (m), 1.2 to 2.0 `dx`; the kernel reaches `2h`.
    pub smoothing_length: f64,
    /// Density at zero pressure `ρ0` (kg/m³).
    pub reference_density: f64,
    /// Numerical sound speed `c0` (m/s), at least 10 times the largest velocity.
    pub sound_speed: f64,
    /// Gravity (m/s²).
    pub gravity: SVector<f64, D>,
    /// Density diffusion `δ` (S3), 0.1 by default, 0 switches it off.
    pub density_diffusion: f64,
    /// Dissipation between fluid particles (S5, S6).
    pub dissipation: Dissipation,
    /// Fraction of `h/(c0 + |v|)` taken as time step (S8).
    pub courant_number: f64,
    /// Lower and upper corner (m); particles that leave it are removed and counted.
    pub domain: (SVector<f64, D>, SVector<f64, D>),
}

/// Dissipation model between fluid particles; alternatives, never both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dissipation {
    /// Pressure forces only.
    None,
    /// Artificial viscosity (S5; Monaghan 1992).
    Artificial {
        /// `α`, 0.01 to 0.02 for free-surface flow.
        alpha: f64,
    },
    /// Low-dissipation Riemann term (S6; Zhang, Hu and Adams 2017).
    Riemann {
        /// `η` in `β = min(η w, c0)`, 3 in the paper.
        limiter: f64,
    },
}

impl<const D: usize> FluidParameters<D> {
    /// Water at spacing `dx` (m) and sound speed `c0` (m/s) with the defaults
    /// `h = 1.5 dx`, `ρ0` 1000, `δ` 0.1, `α` 0.02, Courant number 0.6, no gravity and
    /// a domain of ±1000 `dx` about the origin.
    pub fn water(spacing: f64, sound_speed: f64) -> Self {
        Self {
            spacing,
            smoothing_length: 1.5 * spacing,
            reference_density: 1000.0,
            sound_speed,
            gravity: SVector::zeros(),
            density_diffusion: 0.1,
            dissipation: Dissipation::Artificial { alpha: 0.02 },
            courant_number: 0.6,
            domain: (SVector::repeat(-1000.0 * spacing), SVector::repeat(1000.0 * spacing)),
        }
    }

    /// Mass of one particle (kg; kg per metre of width in 2D): `ρ0 dx^D`.
    pub fn particle_mass(&self) -> f64 {
        self.reference_density * self.spacing.powi(D as i32)
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// [`FluidError::Parameter`] names the first field out of range.
    pub fn validate(&self) -> Result<(), FluidError> {
        let positive = "a finite number above 0";
        check("spacing", self.spacing, self.spacing > 0.0, positive, "Give it in metres.")?;
        let ratio = self.smoothing_length / self.spacing;
        check(
            "smoothing_length/spacing",
            ratio,
            (1.2 - 1e-9..=2.0 + 1e-9).contains(&ratio),
            "1.2 to 2.0",
            "1.5 suits most cases.",
        )?;
        let (density, sound) = (self.reference_density, self.sound_speed);
        check("reference_density", density, density > 0.0, positive, "Water has 1000 kg/m³.")?;
        let advice = "Take 10 times the largest velocity, 20 sqrt(gH) for impacts.";
        check("sound_speed", sound, sound > 0.0, positive, advice)?;
        let delta = self.density_diffusion;
        let allowed = "0 to 0.5";
        check(
            "density_diffusion",
            delta,
            (0.0..=0.5).contains(&delta),
            allowed,
            "0.1 suits most cases.",
        )?;
        let courant = self.courant_number;
        let allowed = "above 0, at most 1.5";
        let measured = "0.6 is safe in every test of this crate.";
        check("courant_number", courant, courant > 0.0 && courant <= 1.5, allowed, measured)?;
        match self.dissipation {
            Dissipation::None => {}
            Dissipation::Artificial { alpha } => {
                let advice = "0.01 to 0.02 suits free-surface flow.";
                check("alpha", alpha, (0.0..=1.0).contains(&alpha), "0 to 1", advice)?;
            }
            Dissipation::Riemann { limiter } => {
                let advice = "The paper's value is 3.";
                check("limiter", limiter, (0.0..=100.0).contains(&limiter), "0 to 100", advice)?;
            }
        }
        for axis in 0..D {
            let gravity = self.gravity[axis];
            check("gravity", gravity, true, "finite components", "Use 9.81 m/s² downwards.")?;
            let extent = self.domain.1[axis] - self.domain.0[axis];
            let advice = "The upper corner must lie above the lower one on every axis.";
            check("domain extent", extent, extent > 0.0, positive, advice)?;
        }
        Ok(())
    }
}

fn check(
    name: &'static str,
    value: f64,
    inside: bool,
    allowed: &'static str,
    remedy: &'static str,
) -> Result<(), FluidError> {
    if value.is_finite() && inside {
        Ok(())
    } else {
        Err(FluidError::Parameter { name, value, allowed, remedy })
    }
}

/// Initial state of one fluid particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluidSeed<const D: usize> {
    /// Position (m).
    pub position: SVector<f64, D>,
    /// Velocity (m/s).
    pub velocity: SVector<f64, D>,
    /// `ρ - ρ0` (kg/m³); hydrostatic water starts with `p/c0²`.
    pub density_deviation: f64,
}

impl<const D: usize> Default for FluidSeed<D> {
    fn default() -> Self {
        Self { position: SVector::zeros(), velocity: SVector::zeros(), density_deviation: 0.0 }
    }
}

impl<const D: usize> FluidSeed<D> {
    /// A particle of still water, from its place on an uncompressed lattice.
    ///
    /// `floor` and `surface` are the heights (m, against gravity) of the bottom and the
    /// surface of the lattice. A column of equal masses that carries its own weight is
    /// denser below: with `λ = c0²/g` and depth `d` on the lattice, pressure is `ρ0 g d` and
    /// the height above the floor `λ ln[(1 + H/λ)/(1 + d/λ)]`. Without this shift the stated
    /// volume `m/ρ` and the spacing disagree by up to `gH/c0²`, and so do pressures.
    ///
    /// ```
    /// use nalgebra::SVector;
    /// use sph::{FluidParameters, FluidSeed};
    /// let gravity = SVector::from([0.0, -9.81]);
    /// let parameters = FluidParameters { gravity, ..FluidParameters::water(0.1, 30.0) };
    /// let seed = FluidSeed::at_rest(&parameters, SVector::from([0.05, 0.05]), 0.0, 1.0);
    /// assert!((seed.density_deviation * 900.0 - 9810.0 * 0.95).abs() < 1e-9);
    /// assert!(seed.position[1] < 0.05);
    /// ```
    pub fn at_rest(
        parameters: &FluidParameters<D>,
        position: SVector<f64, D>,
        floor: f64,
        surface: f64,
    ) -> Self {
        let g = parameters.gravity.norm();
        let mut seed = Self { position, ..Self::default() };
        if g == 0.0 {
            return seed;
        }
        let up = -parameters.gravity / g;
        let height = position.dot(&up);
        let length = parameters.sound_speed.powi(2) / g;
        let depth = surface - height;
        let settled = length * (((surface - floor) / length).ln_1p() - (depth / length).ln_1p());
        seed.position += up * (floor + settled - height);
        seed.density_deviation = parameters.reference_density * depth / length;
        seed
    }

    /// Checks seed number `id`.
    ///
    /// # Errors
    /// [`FluidError::Seed`] if it is not finite, outside the domain or too dense.
    pub(crate) fn validate(&self, id: usize, p: &FluidParameters<D>) -> Result<(), FluidError> {
        let fail =
            |quantity, value: String, remedy| Err(FluidError::Seed { id, quantity, value, remedy });
        let inside =
            (0..D).all(|k| self.position[k] >= p.domain.0[k] && self.position[k] <= p.domain.1[k]);
        if !inside {
            let remedy = "it must be finite and inside the domain";
            return fail("position", format!("{:?}", self.position.as_slice()), remedy);
        }
        if !self.velocity.iter().all(|v| v.is_finite()) {
            return fail(
                "velocity",
                format!("{:?}", self.velocity.as_slice()),
                "it must be finite",
            );
        }
        let relative = self.density_deviation / p.reference_density;
        if relative.is_nan() || relative.abs() > DENSITY_LIMIT {
            let remedy = "|rho - rho0| may be at most 0.2 rho0; raise the sound speed";
            return fail("density deviation", format!("{} kg/m³", self.density_deviation), remedy);
        }
        Ok(())
    }
}

/// Translation of a wall along a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct WallMotion<const D: usize> {
    /// Direction; displacement is `direction · motion.displacement(t)`.
    pub direction: SVector<f64, D>,
    /// The law in time.
    pub motion: Motion,
}

/// A rigid wall: points on a lattice that continues the fluid's, volume `dx^D` each.
///
/// At least `2h/dx` layers are needed, so that no fluid particle sees past the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct WallSeed<const D: usize> {
    /// Name of the wall, used by the force gauges; unique.
    pub name: String,
    /// Positions at `t = 0` (m).
    pub points: Vec<SVector<f64, D>>,
    /// Prescribed motion, `None` for a fixed wall.
    pub motion: Option<WallMotion<D>>,
}

impl<const D: usize> WallSeed<D> {
    /// Checks points and motion.
    ///
    /// # Errors
    /// [`FluidError::Wall`] or [`FluidError::WallMotion`].
    pub(crate) fn validate(&self) -> Result<(), FluidError> {
        let fail = |problem: String| Err(FluidError::Wall { name: self.name.clone(), problem });
        if let Some(k) = self.points.iter().position(|x| !x.iter().all(|c| c.is_finite())) {
            return fail(format!("point {k} at {:?} m is not finite", self.points[k].as_slice()));
        }
        if let Some(moving) = &self.motion {
            if !moving.direction.iter().all(|c| c.is_finite()) {
                return fail(format!("direction {:?} is not finite", moving.direction.as_slice()));
            }
            moving
                .motion
                .validate()
                .map_err(|source| FluidError::WallMotion { name: self.name.clone(), source })?;
        }
        Ok(())
    }
}
