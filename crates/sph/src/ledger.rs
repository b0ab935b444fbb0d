//! Energy and momentum accounts (S10).

use crate::{Fluid, Kernel};
use nalgebra::SVector;
use ordered_reduction::sum;

/// Energy of the fluid (J; J/m in 2D).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FluidEnergy {
    /// `Σ ½ m v²`.
    pub kinetic: f64,
    /// `-Σ m g·x`.
    pub potential: f64,
    /// `Σ m e(ρ)`, the energy stored by compression (S2).
    pub compression: f64,
}

impl FluidEnergy {
    /// Sum of the three.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.compression
    }
}

/// Particles that left the domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removed<const D: usize> {
    /// How many.
    pub count: u64,
    /// Their mass (kg; kg/m in 2D).
    pub mass: f64,
    /// Their energy at removal (J).
    pub energy: f64,
    /// Their momentum at removal (N s).
    pub momentum: SVector<f64, D>,
}

/// Work, losses and impulses accumulated since the start (S10).
///
/// The change of total energy is `wall_work + structure_work` less the losses and the
/// removed energy, up to a residual of the time integration
/// ([`Fluid::energy_residual`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluidLedger<const D: usize> {
    /// Work of the rigid walls on the fluid (J).
    pub wall_work: f64,
    /// Work of the structure on the fluid (J).
    pub structure_work: f64,
    /// Loss by artificial viscosity or the Riemann term (S5, S6).
    pub viscous_loss: f64,
    /// Loss by the impact term `β ρ w` of the wall closure (C4).
    pub impact_loss: f64,
    /// Loss by `p_p ≠ p_a` in the wall closure: hydrostatic offset and cut at zero
    /// (C2); may have either sign.
    pub offset_loss: f64,
    /// Loss by density diffusion (S3); may have either sign.
    pub diffusion_loss: f64,
    /// Impulse of gravity (N s).
    pub gravity_impulse: SVector<f64, D>,
    /// Impulse of the walls on the fluid (N s).
    pub wall_impulse: SVector<f64, D>,
    /// Impulse of the structure on the fluid (N s).
    pub structure_impulse: SVector<f64, D>,
    /// What left the domain.
    pub removed: Removed<D>,
}

impl<const D: usize> Default for FluidLedger<D> {
    fn default() -> Self {
        let zero = SVector::zeros();
        Self {
            wall_work: 0.0,
            structure_work: 0.0,
            viscous_loss: 0.0,
            impact_loss: 0.0,
            offset_loss: 0.0,
            diffusion_loss: 0.0,
            gravity_impulse: zero,
            wall_impulse: zero,
            structure_impulse: zero,
            removed: Removed { count: 0, mass: 0.0, energy: 0.0, momentum: zero },
        }
    }
}

impl<const D: usize> FluidLedger<D> {
    /// Sum of all losses (J).
    pub fn losses(&self) -> f64 {
        self.viscous_loss + self.impact_loss + self.offset_loss + self.diffusion_loss
    }
}

/// What one particle exchanged in the last momentum pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Exchange<const D: usize> {
    /// Force of the walls (N).
    pub wall_force: SVector<f64, D>,
    /// Force of the structure (N).
    pub structure_force: SVector<f64, D>,
    /// Power of the walls on the fluid (W).
    pub wall_power: f64,
    /// Power of the structure on the fluid (W).
    pub structure_power: f64,
    /// Losses (W).
    pub viscous_loss: f64,
    pub impact_loss: f64,
    pub offset_loss: f64,
}

impl<const D: usize> Default for Exchange<D> {
    fn default() -> Self {
        Self {
            wall_force: SVector::zeros(),
            structure_force: SVector::zeros(),
            wall_power: 0.0,
            structure_power: 0.0,
            viscous_loss: 0.0,
            impact_loss: 0.0,
            offset_loss: 0.0,
        }
    }
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Energy now (J; J/m in 2D).
    pub fn energy(&self) -> FluidEnergy {
        let (p, g, m) = (&self.particles, &self.parameters.gravity, self.mass);
        let [kinetic, potential, compression] = sum(p.len(), |i| {
            [
                0.5 * m * p.velocity[i].norm_squared(),
                -m * g.dot(&p.position[i]),
                m * self.equation_of_state.specific_energy(p.density_deviation[i]),
            ]
        });
        FluidEnergy { kinetic, potential, compression }
    }

    /// Momentum now (N s).
    pub fn momentum(&self) -> SVector<f64, D> {
        let (velocity, mass) = (&self.particles.velocity, self.mass);
        sum_vector(velocity.len(), |i| velocity[i] * mass)
    }

    /// Work, losses and impulses since the start.
    pub fn ledger(&self) -> &FluidLedger<D> {
        &self.ledger
    }

    /// Change of total energy that the ledger does not explain (J): error of the time
    /// integration.
    pub fn energy_residual(&self) -> f64 {
        let ledger = &self.ledger;
        self.energy().total() - self.initial_energy.total() + ledger.removed.energy
            - ledger.wall_work
            - ledger.structure_work
            + ledger.losses()
    }

    /// Books what the momentum pass exchanged over a step of length `dt`.
    pub(crate) fn book_exchange(&mut self, dt: f64) {
        let exchange = &self.exchange;
        let [wall_power, structure_power, viscous, impact, offset] = sum(exchange.len(), |i| {
            let e = &exchange[i];
            [e.wall_power, e.structure_power, e.viscous_loss, e.impact_loss, e.offset_loss]
        });
        let wall_force = sum_vector(exchange.len(), |i| exchange[i].wall_force);
        let structure_force = sum_vector(exchange.len(), |i| exchange[i].structure_force);
        let ledger = &mut self.ledger;
        ledger.wall_work += wall_power * dt;
        ledger.structure_work += structure_power * dt;
        ledger.viscous_loss += viscous * dt;
        ledger.impact_loss += impact * dt;
        ledger.offset_loss += offset * dt;
        let total_mass = self.mass * exchange.len() as f64;
        ledger.gravity_impulse += self.parameters.gravity * (total_mass * dt);
        ledger.wall_impulse += wall_force * dt;
        ledger.structure_impulse += structure_force * dt;
    }

    /// Books the compression energy that density diffusion adds in a half drift.
    pub(crate) fn book_diffusion(&mut self, interval: f64) {
        let (p, eos, mass) = (&self.particles, &self.equation_of_state, self.mass);
        let [gain] = sum(p.len(), |i| {
            let deviation = p.density_deviation[i] + 0.5 * interval * p.density_rate[i];
            let density = eos.reference_density + deviation;
            [mass * eos.pressure(deviation) / (density * density) * p.diffusion_rate[i]]
        });
        self.ledger.diffusion_loss -= gain * interval;
    }

    /// Books particle `i` as removed.
    pub(crate) fn book_removal(&mut self, i: usize) {
        let p = &self.particles;
        let compression = self.equation_of_state.specific_energy(p.density_deviation[i]);
        let specific = 0.5 * p.velocity[i].norm_squared()
            - self.parameters.gravity.dot(&p.position[i])
            + compression;
        let removed = &mut self.ledger.removed;
        removed.count += 1;
        removed.mass += self.mass;
        removed.energy += self.mass * specific;
        removed.momentum += p.velocity[i] * self.mass;
    }
}

/// Ordered sum of vectors; the unused third entry is zero in 2D.
pub(crate) fn sum_vector<const D: usize>(
    count: usize,
    term: impl Fn(usize) -> SVector<f64, D> + Sync,
) -> SVector<f64, D> {
    let total: [f64; 3] = sum(count, |i| {
        let vector = term(i);
        std::array::from_fn(|axis| if axis < D { vector[axis] } else { 0.0 })
    });
    SVector::from_fn(|axis, _| total[axis])
}
