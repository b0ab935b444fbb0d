//! Equations (3) and (4): acceleration and velocity of the nodes.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::field::Field;
use crate::grid::{ACCELERATION, VELOCITY};
use crate::solid::Solid;

/// Nodes handled by one task.
pub(crate) const NODES_PER_TASK: usize = 2048;

/// A node whose mass is below this fraction of the lightest point's mass is
/// left out. A weight that small, S = ε, comes from a point's box reaching past
/// a node plane by ~2√ε of its width, and the force on the node, which goes
/// with √ε, is then below the round-off of its neighbours' (√1e-30 = 1e-15).
/// Everything above is kept: acceleration and velocity act on points only
/// multiplied by the weight again, so small masses do no harm.
pub(crate) const RELATIVE_MASS_CUT: f64 = 1e-30;

/// Nodes left out in the last step because their mass is negligible (G26).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SmallMassReport {
    /// How many.
    pub nodes: usize,
    /// Their mass in all (kg).
    pub mass: f64,
}

/// What one task of the node loop saw.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct NodeTally {
    cut_nodes: usize,
    cut_mass: f64,
    damping_force: [f64; 3],
    damping_power: f64,
}

impl<const D: usize> Solid<D> {
    /// `a_v = (f_v^int + f_v^ext)/m_v + g` (G7) and `v_v^L = v_v + a_v Δt` (G8),
    /// with `v_v = (mv)_v/m_v`; local damping (G25) if asked for. Records change
    /// from mass, momentum, force to mass, velocity, acceleration in place.
    pub(crate) fn update_grid_momentum(&mut self, dt: f64) {
        let gravity = self.parameters.gravity_at(self.state.time + 0.5 * dt);
        let forces =
            NodeForces { gravity, damping: self.parameters.damping, mass_cut: self.mass_cut };
        self.small_mass = SmallMassReport::default();
        for field in &mut self.fields {
            forces.accelerate(field, dt);
            let ledger = &mut self.state.ledger;
            for tally in &field.tallies {
                self.small_mass.nodes += tally.cut_nodes;
                self.small_mass.mass += tally.cut_mass;
                for d in 0..D {
                    ledger.damping_impulse[d] += dt * tally.damping_force[d];
                }
                ledger.damping_work += dt * tally.damping_power;
            }
        }
    }

    /// Nodes left out in the last step.
    pub fn small_mass_nodes(&self) -> SmallMassReport {
        self.small_mass
    }
}

/// What acts on nodes beside internal and external forces.
struct NodeForces<const D: usize> {
    gravity: SVector<f64, D>,
    damping: f64,
    mass_cut: f64,
}

impl<const D: usize> NodeForces<D> {
    fn accelerate(&self, field: &mut Field<D>, dt: f64) {
        let Self { gravity, damping, mass_cut } = *self;
        let Field { grid, tallies, held, .. } = field;
        let external = grid.has_external_force.then_some(&grid.external_force);
        grid.nodes.par_chunks_mut(NODES_PER_TASK).zip(tallies.par_iter_mut()).enumerate().for_each(
            |(task, (records, tally))| {
                *tally = NodeTally::default();
                for (k, record) in records.iter_mut().enumerate() {
                    let mass = record[0];
                    if mass <= mass_cut {
                        tally.cut_nodes += usize::from(mass > 0.0);
                        tally.cut_mass += mass;
                        record[1..].fill(0.0);
                        continue;
                    }
                    let applied =
                        external.map_or(SVector::zeros(), |force| force[task * NODES_PER_TASK + k]);
                    let inverse_mass = 1.0 / mass;
                    for d in 0..D {
                        let velocity = record[VELOCITY + d] * inverse_mass;
                        let mut force = record[ACCELERATION + d] + applied[d] + mass * gravity[d];
                        if damping > 0.0 && held[task * NODES_PER_TASK + k] >> d & 1 == 0 {
                            let opposing = -damping * force.abs() * sign(velocity);
                            force += opposing;
                            tally.damping_force[d] += opposing;
                            tally.damping_power +=
                                opposing * (velocity + dt * force * inverse_mass);
                        }
                        let acceleration = force * inverse_mass;
                        record[VELOCITY + d] = velocity + dt * acceleration;
                        record[ACCELERATION + d] = acceleration;
                    }
                }
            },
        );
    }
}

/// Sign with `sign(0) = 0`.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}
