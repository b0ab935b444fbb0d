//! Energy, momentum and the running sums of work and impulse.

use nalgebra::SVector;

use crate::grid::VELOCITY;
use crate::reaction::moment_of;
use crate::solid::Solid;

/// Energy of the points (J; per metre of thickness in plane strain), G23.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolidEnergy {
    /// `Σ ½ m v²`. Velocities belong to the middle of the last step, stresses to
    /// its end, so the sum of energies wobbles by a relative `ω Δt/2`.
    pub kinetic: f64,
    /// `Σ ψ(σ) V`.
    pub strain: f64,
    /// `-Σ m g·x`, zero at the coordinate origin.
    pub gravity_potential: f64,
}

/// Work and impulse on the solid since the start.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidLedger<const D: usize> {
    /// Work of the reactions, `Σ R·v_bc Δt` (J).
    pub boundary_work: f64,
    /// Work of the external nodal forces, `Σ f·v^L Δt` (J): equal to
    /// `Σ_p f_p·Δx_p`.
    pub external_work: f64,
    /// Work of local damping (J), never positive in sum over a cycle.
    pub damping_work: f64,
    /// Impulse of the reactions (N s).
    pub boundary_impulse: SVector<f64, D>,
    /// Impulse of the external nodal forces (N s).
    pub external_impulse: SVector<f64, D>,
    /// Impulse of gravity (N s).
    pub gravity_impulse: SVector<f64, D>,
    /// Impulse of local damping (N s).
    pub damping_impulse: SVector<f64, D>,
    /// Angular impulse of the reactions about the origin (N m s).
    pub boundary_angular_impulse: [f64; 3],
    /// Angular impulse of the external nodal forces about the origin (N m s).
    pub external_angular_impulse: [f64; 3],
}

impl<const D: usize> Default for SolidLedger<D> {
    fn default() -> Self {
        let zero = SVector::zeros();
        Self {
            boundary_work: 0.0,
            external_work: 0.0,
            damping_work: 0.0,
            boundary_impulse: zero,
            external_impulse: zero,
            gravity_impulse: zero,
            damping_impulse: zero,
            boundary_angular_impulse: [0.0; 3],
            external_angular_impulse: [0.0; 3],
        }
    }
}

impl<const D: usize> Solid<D> {
    /// Adds the step just made to the ledger. Called after the boundary
    /// conditions, while nodes hold v^L and the external force is still there.
    pub(crate) fn record_work(&mut self, dt: f64) {
        let state = &mut self.state;
        let ledger = &mut state.ledger;
        for (reaction, velocity) in state.reactions.iter().zip(&state.constraint_velocity) {
            ledger.boundary_work += dt * reaction.force.dot(velocity);
            ledger.boundary_impulse += reaction.force * dt;
            accumulate(&mut ledger.boundary_angular_impulse, &reaction.moment, dt);
        }
        let gravity = self.parameters.gravity_at(state.time + 0.5 * dt);
        ledger.gravity_impulse += gravity * (self.total_mass * dt);
        for grid in self.fields.iter().map(|field| &field.grid) {
            if !grid.has_external_force {
                continue;
            }
            let total = ordered_reduction::sum(grid.nodes.len(), |v| {
                let force = &grid.external_force[v];
                if force.iter().all(|f| *f == 0.0) {
                    return [0.0; 7];
                }
                let moment = moment_of(&grid.geometry.node_position(v), force);
                let power: f64 = (0..D).map(|d| force[d] * grid.nodes[v][VELOCITY + d]).sum();
                let third = if D == 3 { force[2] } else { 0.0 };
                [power, force[0], force[1], third, moment[0], moment[1], moment[2]]
            });
            ledger.external_work += dt * total[0];
            for d in 0..D {
                ledger.external_impulse[d] += dt * total[1 + d];
            }
            accumulate(&mut ledger.external_angular_impulse, &total[4..], dt);
        }
    }

    /// Energy of all points.
    pub fn energy(&self) -> SolidEnergy {
        let mut energy = SolidEnergy::default();
        for body in 0..self.bodies.len() {
            let part = self.body_energy(body);
            energy.kinetic += part.kinetic;
            energy.strain += part.strain;
            energy.gravity_potential += part.gravity_potential;
        }
        energy
    }

    /// Energy of one body; zero for an index beyond the bodies.
    pub fn body_energy(&self, body: usize) -> SolidEnergy {
        let Some(description) = self.bodies.get(body) else { return SolidEnergy::default() };
        let (points, range) = (&self.state.points, self.body_range(body));
        let material = description.material.as_material();
        let gravity = self.parameters.gravity;
        let [kinetic, strain, gravity_potential] = ordered_reduction::sum(range.len(), |k| {
            let p = range.start + k;
            [
                0.5 * points.mass[p] * points.velocity[p].norm_squared(),
                points.volume[p] * material.strain_energy_density(&points.stress[p]),
                -points.mass[p] * gravity.dot(&points.position[p]),
            ]
        });
        SolidEnergy { kinetic, strain, gravity_potential }
    }

    /// Momentum of all points (N s).
    pub fn momentum(&self) -> SVector<f64, D> {
        let points = &self.state.points;
        let total = ordered_reduction::sum(points.len(), |p| {
            std::array::from_fn::<f64, 3, _>(|d| {
                if d < D { points.mass[p] * points.velocity[p][d] } else { 0.0 }
            })
        });
        SVector::from_fn(|d, _| total[d])
    }

    /// Angular momentum of all points about a position (N m s); only z in plane
    /// strain. FLIP conserves it to the size of a point's box, not to round-off.
    pub fn angular_momentum(&self, about: SVector<f64, D>) -> [f64; 3] {
        let points = &self.state.points;
        ordered_reduction::sum(points.len(), |p| {
            moment_of(&(points.position[p] - about), &(points.velocity[p] * points.mass[p]))
        })
    }

    /// Work and impulse since the start.
    pub fn ledger(&self) -> &SolidLedger<D> {
        &self.state.ledger
    }
}

fn accumulate(total: &mut [f64; 3], part: &[f64], dt: f64) {
    for (total, part) in total.iter_mut().zip(part) {
        *total += dt * part;
    }
}
