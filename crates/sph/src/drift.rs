//! Half drifts, kick, prescribed walls, removal and cell sort (S7, S9).

use crate::parameters::DENSITY_LIMIT;
use crate::wall_closure::{FluidSide, tension_share};
use crate::{Fluid, FluidError, Kernel};
use ordered_reduction::maximum;
use rayon::prelude::*;

const GRAIN: usize = 1024;

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// First half drift (S9): `x += v Δt/2`, `ρ += ρ̇ Δt/2` with the stored rate; walls move
    /// to mid-step; particles outside the domain are removed; the rest is sorted.
    ///
    /// # Errors
    /// [`FluidError::TimeStep`] unless `0 < dt < ∞`; [`FluidError::NonFinite`].
    pub fn drift_to_midpoint(&mut self, dt: f64) -> Result<(), FluidError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(FluidError::TimeStep {
                value: dt,
                term: "caller",
                time: self.time,
                remedy: "it must be finite and above 0",
            });
        }
        self.step_length = dt;
        self.drift(0.5 * dt);
        self.move_walls_to(self.time + 0.5 * dt, dt);
        if self.has_moving_walls() {
            self.walls.locate(&self.lattice);
        }
        self.sort()?;
        self.pack_midpoint();
        Ok(())
    }

    /// Kick (S9): `v += a Δt`; books work and losses of the step.
    pub fn kick(&mut self, dt: f64) {
        let acceleration = &self.particles.acceleration;
        self.particles
            .velocity
            .par_iter_mut()
            .zip(acceleration)
            .with_min_len(GRAIN)
            .for_each(|(v, a)| *v += a * dt);
        let squares = maximum(acceleration.len(), |i| acceleration[i].norm_squared());
        self.maximum_acceleration = squares.unwrap_or(0.0).sqrt();
        self.book_exchange(dt);
    }

    /// Second half drift (S9) with the new velocities and rates; walls move to the end.
    ///
    /// # Errors
    /// [`FluidError::NonFinite`] or [`FluidError::DensityOutOfRange`] name the particle.
    pub fn drift_to_end(&mut self, dt: f64) -> Result<(), FluidError> {
        self.drift(0.5 * dt);
        self.time += dt;
        self.steps += 1;
        if self.has_moving_walls() {
            self.move_walls_to(self.time, 0.0);
        }
        self.check_density()?;
        self.measure_speed()?;
        self.slack = 0.5 * dt * self.maximum_speed;
        Ok(())
    }

    fn drift(&mut self, interval: f64) {
        self.book_diffusion(interval);
        let particles = &mut self.particles;
        particles
            .position
            .par_iter_mut()
            .zip(&particles.velocity)
            .zip(particles.density_deviation.par_iter_mut().zip(&particles.density_rate))
            .with_min_len(GRAIN)
            .for_each(|((x, v), (density, rate))| {
                *x += v * interval;
                *density += rate * interval;
            });
    }

    fn has_moving_walls(&self) -> bool {
        self.wall_groups.iter().any(|group| group.motion.is_some())
    }

    /// Places the prescribed walls at time `t`; for `dt > 0` their velocity becomes the
    /// mean over the step that began at `self.time`, so that it integrates to the motion.
    pub(crate) fn move_walls_to(&mut self, t: f64, dt: f64) {
        for group in &self.wall_groups {
            let Some(moving) = &group.motion else { continue };
            let displacement = moving.direction * moving.motion.displacement(t);
            let points = group.first..group.end;
            let reference = &self.wall_reference[points.clone()];
            for (x, start) in self.walls.position[points.clone()].iter_mut().zip(reference) {
                *x = start + displacement;
            }
            if dt > 0.0 {
                let travel = moving.motion.displacement(self.time + dt)
                    - moving.motion.displacement(self.time);
                self.walls.velocity[points].fill(moving.direction * (travel / dt));
            } else if self.steps == 0 {
                self.walls.velocity[points].fill(moving.direction * moving.motion.velocity(t));
            }
        }
    }

    /// Sorts the particles by cell (S7) and removes those outside the domain.
    pub(crate) fn sort(&mut self) -> Result<(), FluidError> {
        let (lower, upper) = self.parameters.domain;
        let (lattice, position) = (&self.lattice, &self.particles.position);
        self.table.sort(lattice.cells(), position.len(), |i| {
            let x = &position[i];
            let inside = (0..D).all(|k| x[k] >= lower[k] && x[k] <= upper[k]);
            if inside { lattice.key(x) } else { lattice.cells() as u32 }
        });
        let inside = self.table.inside();
        for slot in inside..position.len() {
            let i = self.table.order[slot] as usize;
            if !self.particles.position[i].iter().all(|c| c.is_finite()) {
                return Err(self.non_finite("position", i));
            }
            self.book_removal(i);
        }
        if inside < self.particles.len() || !self.table.is_identity() {
            self.particles.permute(&self.table.order[..inside], &mut self.spare);
        }
        Ok(())
    }

    /// Copies the sorted mid-step state into the records of the pair loops.
    pub(crate) fn pack_midpoint(&mut self) {
        let (particles, eos) = (&self.particles, &self.equation_of_state);
        let mass = self.mass;
        (0..particles.len())
            .into_par_iter()
            .with_min_len(GRAIN)
            .map(|i| {
                let deviation = particles.density_deviation[i];
                let density = eos.reference_density + deviation;
                FluidSide {
                    position: particles.position[i],
                    velocity: particles.velocity[i],
                    volume: mass / density,
                    density,
                    pressure: eos.pressure(deviation),
                    tension: tension_share(particles.filling[i]),
                }
            })
            .collect_into_vec(&mut self.midpoint);
    }

    fn check_density(&self) -> Result<(), FluidError> {
        let deviation = &self.particles.density_deviation;
        let reference = self.parameters.reference_density;
        let largest = maximum(deviation.len(), |i| deviation[i].abs()).unwrap_or(0.0) / reference;
        if largest <= DENSITY_LIMIT {
            return Ok(());
        }
        let bad = |d: &f64| d.is_nan() || d.abs() > DENSITY_LIMIT * reference;
        let i = deviation.iter().position(bad).unwrap_or(0);
        if !deviation[i].is_finite() {
            return Err(self.non_finite("density", i));
        }
        Err(FluidError::DensityOutOfRange {
            id: self.particles.id[i],
            relative: deviation[i] / reference,
            limit: DENSITY_LIMIT,
            position: self.particles.position[i].as_slice().to_vec(),
            time: self.time,
        })
    }

    /// Updates the largest speed; every velocity must be finite.
    pub(crate) fn measure_speed(&mut self) -> Result<(), FluidError> {
        let velocity = &self.particles.velocity;
        let square = maximum(velocity.len(), |i| velocity[i].norm_squared()).unwrap_or(0.0);
        if !square.is_finite() {
            let bad = |v: &nalgebra::SVector<f64, D>| !v.norm_squared().is_finite();
            let i = velocity.iter().position(bad).unwrap_or(0);
            return Err(self.non_finite("velocity", i));
        }
        self.maximum_speed = square.sqrt();
        Ok(())
    }

    fn non_finite(&self, quantity: &'static str, i: usize) -> FluidError {
        FluidError::NonFinite {
            id: self.particles.id[i],
            quantity,
            position: self.particles.position[i].as_slice().to_vec(),
            time: self.time,
        }
    }
}
