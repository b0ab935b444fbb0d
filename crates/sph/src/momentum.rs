//! Momentum pass: acceleration of every fluid particle at mid-step (S4–S6, C2, C4).

use crate::ledger::Exchange;
use crate::wall_closure::{FluidSide, WallClosure, WallSide};
use crate::{ArtificialViscosity, Dissipation, Fluid, Inviscid, Kernel, PairDissipation};
use crate::{Boundary, RiemannLimiter};
use nalgebra::SVector;
use rayon::prelude::*;
use std::mem::take;

/// Acceleration of one particle and what it exchanged.
pub(crate) type Accelerated<const D: usize> = (SVector<f64, D>, Exchange<D>);

/// Fewest particles given to one thread.
pub(crate) const GRAIN: usize = 64;

#[derive(Clone, Copy)]
enum Scope {
    All,
    NearStructure,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Momentum pass over all particles at mid-step (S4–S6, C2, C4):
    ///
    /// `a_i = g - (1/m) Σ_j V_i V_j (p_i + p_j + Q_ij) ∇W_ij + (1/m) Σ_p F_ip`,
    /// with `Q_ij` from the dissipation model and `F_ip` from the wall closure.
    pub fn evaluate_acceleration(&mut self) {
        self.accelerate_scope(Scope::All);
    }

    /// The same, only for particles whose acceleration depends on the structure: those
    /// within reach of a structure point and their neighbours (whose pair forces change
    /// with [`Fluid::correct_density`]). Bit for bit what the full pass would give.
    pub fn evaluate_near_structure(&mut self) {
        self.accelerate_scope(Scope::NearStructure);
    }

    fn accelerate_scope(&mut self, scope: Scope) {
        let (sound_speed, length) = (self.parameters.sound_speed, self.parameters.smoothing_length);
        match self.parameters.dissipation {
            Dissipation::None => self.accelerate_with(scope, Inviscid),
            Dissipation::Artificial { alpha } => {
                self.accelerate_with(scope, ArtificialViscosity::new(alpha, sound_speed, length));
            }
            Dissipation::Riemann { limiter } => {
                self.accelerate_with(scope, RiemannLimiter { limiter, sound_speed });
            }
        }
    }

    fn accelerate_with(&mut self, scope: Scope, dissipation: impl PairDissipation) {
        let mut acceleration = take(&mut self.particles.acceleration);
        let mut exchange = take(&mut self.exchange);
        exchange.resize(acceleration.len(), Exchange::default());
        match scope {
            Scope::All => {
                acceleration
                    .par_iter_mut()
                    .zip(exchange.par_iter_mut())
                    .enumerate()
                    .with_min_len(GRAIN)
                    .for_each(|(i, (a, e))| (*a, *e) = self.accelerate(i, dissipation));
            }
            Scope::NearStructure => {
                let mut results = take(&mut self.near.results);
                self.near
                    .affected
                    .par_iter()
                    .with_min_len(GRAIN)
                    .map(|&i| self.accelerate(i as usize, dissipation))
                    .collect_into_vec(&mut results);
                for (&i, &result) in self.near.affected.iter().zip(&results) {
                    (acceleration[i as usize], exchange[i as usize]) = result;
                }
                self.near.results = results;
            }
        }
        self.particles.acceleration = acceleration;
        self.exchange = exchange;
    }

    fn accelerate(&self, i: usize, dissipation: impl PairDissipation) -> Accelerated<D> {
        let a = &self.midpoint[i];
        let closure = self.wall_closure();
        let support = self.kernel.support();
        let mut pressure = SVector::zeros();
        let mut viscous = SVector::zeros();
        let mut walls = BoundarySum::default();
        let mut structure = BoundarySum::default();
        self.lattice.for_each_run(&a.position, support, |first, end| {
            for b in &self.midpoint[self.table.slots(first, end)] {
                let offset = a.position - b.position;
                let square = offset.norm_squared();
                if square < support * support {
                    let distance = square.sqrt();
                    let approach = (a.velocity - b.velocity).dot(&offset);
                    let density = 0.5 * (a.density + b.density);
                    let q = dissipation.pressure(density, approach, distance);
                    let area = offset * (b.volume * self.kernel.gradient_factor(distance));
                    pressure += area * (a.pressure + b.pressure);
                    viscous += area * q;
                }
            }
            walls.add(&closure, a, points(&self.walls, first, end));
            structure.add(&closure, a, points(&self.structure, first, end));
        });
        let viscous = viscous * -a.volume;
        let force = pressure * -a.volume + viscous + walls.force + structure.force;
        let acceleration = self.parameters.gravity + force / self.mass;
        // The kick moves the velocity through this mean, so the power is exact.
        let mean = a.velocity + acceleration * (0.5 * self.step_length);
        let exchange = Exchange {
            wall_force: walls.force,
            structure_force: structure.force,
            wall_power: walls.power,
            structure_power: structure.power,
            viscous_loss: -viscous.dot(&mean),
            impact_loss: walls.impact_loss(&mean) + structure.impact_loss(&mean),
            offset_loss: walls.offset_loss(&mean) + structure.offset_loss(&mean),
        };
        (acceleration, exchange)
    }
}

/// Located points of a boundary in the cells `first..end`; none if it has no points.
#[inline(always)]
pub(crate) fn points<const D: usize>(
    boundary: &Boundary<D>,
    first: usize,
    end: usize,
) -> &[WallSide<D>] {
    if boundary.sorted.is_empty() {
        return &[];
    }
    &boundary.sorted[boundary.table.slots(first, end)]
}

/// Force of one boundary set on one particle, with the parts the ledger needs.
struct BoundarySum<const D: usize> {
    force: SVector<f64, D>,
    /// `Σ F·v̄_p` (W).
    power: f64,
    impact: SVector<f64, D>,
    impact_power: f64,
    offset: SVector<f64, D>,
    offset_power: f64,
}

impl<const D: usize> Default for BoundarySum<D> {
    fn default() -> Self {
        let zero = SVector::zeros();
        Self {
            force: zero,
            power: 0.0,
            impact: zero,
            impact_power: 0.0,
            offset: zero,
            offset_power: 0.0,
        }
    }
}

impl<const D: usize> BoundarySum<D> {
    #[inline(always)]
    fn add<K: Kernel<D>>(
        &mut self,
        closure: &WallClosure<D, K>,
        a: &FluidSide<D>,
        points: &[WallSide<D>],
    ) {
        let support = closure.kernel.support();
        for p in points {
            let square = (a.position - p.position).norm_squared();
            if square < support * support {
                let pair = closure.force(a, p, square.sqrt());
                let area_power = pair.area.dot(&p.velocity);
                self.force += pair.force;
                self.power += pair.force.dot(&p.velocity);
                self.impact += pair.area * pair.impact;
                self.impact_power += area_power * pair.impact;
                self.offset += pair.area * pair.offset;
                self.offset_power += area_power * pair.offset;
            }
        }
    }

    fn impact_loss(&self, mean_velocity: &SVector<f64, D>) -> f64 {
        self.impact_power - self.impact.dot(mean_velocity)
    }

    fn offset_loss(&self, mean_velocity: &SVector<f64, D>) -> f64 {
        self.offset_power - self.offset.dot(mean_velocity)
    }
}
