//! Energy, momentum and the running sums of work and impulse.

use nalgebra::{SMatrix, SVector};

use crate::grid::VELOCITY;
use crate::material::{Material, MaterialState};
use crate::parameters::Frame;
use crate::reaction::moment_of;
use crate::solid::Solid;
use crate::stencil::PointStencil;
use crate::tensor::Tensor;
use crate::transfer::{PointTransfer, with_transfer};

/// Energy of the points (J; per metre of thickness in plane strain), G23.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolidEnergy {
    /// `Σ ½ m v²`. Velocities belong to the middle of the last step, stresses to
    /// its end, so the sum of energies wobbles by a relative `ω Δt/2`.
    pub kinetic: f64,
    /// Elastic energy `Σ ψ V0`.
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
    /// Impulse of the external nodal forces, surface loads included (N s).
    pub external_impulse: SVector<f64, D>,
    /// The part of it from surface loads (N s).
    pub surface_impulse: SVector<f64, D>,
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
            surface_impulse: zero,
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
    pub(crate) fn record_work(&mut self, dt: f64, surface_force: SVector<f64, D>) {
        let state = &mut self.state;
        let ledger = &mut state.ledger;
        for (reaction, velocity) in state.reactions.iter().zip(&state.constraint_velocity) {
            ledger.boundary_work += dt * reaction.force.dot(velocity);
            ledger.boundary_impulse += reaction.force * dt;
            accumulate(&mut ledger.boundary_angular_impulse, &reaction.moment, dt);
        }
        let gravity = self.parameters.gravity_at(state.time + 0.5 * dt);
        ledger.gravity_impulse += gravity * (self.total_mass * dt);
        ledger.surface_impulse += surface_force * dt;
        state.load = gravity * self.total_mass + surface_force;
        state.point_load = -surface_force;
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
                state.point_load[d] += total[1 + d];
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
        let material = &description.material;
        let gravity = self.parameters.gravity;
        let lattice = self.fields[description.field].lattice.as_ref();
        let [kinetic, strain, gravity_potential] = ordered_reduction::sum(range.len(), |k| {
            let p = range.start + k;
            let (deformation_gradient, stress) = match lattice {
                Some(lattice) => lattice.seen_by_law(points, p),
                None => (Tensor::from(&points.deformation_gradient[p]), points.stress[p]),
            };
            [
                0.5 * points.mass[p] * points.velocity[p].norm_squared(),
                points.reference_volume[p]
                    * material.stored_energy(
                        &deformation_gradient,
                        &MaterialState { stress, history: points.history[p] },
                    ),
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

    /// Angular momentum of all points about a position (N m s), with that of the affine
    /// part of their velocity; only z in plane strain. APIC conserves it to round-off in
    /// the updated frame, FLIP to the size of a point's box.
    pub fn angular_momentum(&self, about: SVector<f64, D>) -> [f64; 3] {
        let points = &self.state.points;
        ordered_reduction::sum(points.len(), |p| {
            let moment =
                moment_of(&(points.position[p] - about), &(points.velocity[p] * points.mass[p]));
            let spin = self.spin(p);
            std::array::from_fn(|k| moment[k] + spin[k])
        })
    }

    /// Angular momentum of the affine part of a point's velocity about the point
    /// (N m s): `m ε : Σ_v S_vp (G d) ⊗ (C d)`, d from the point to the node, G what
    /// takes d to the current configuration: F in the total frame.
    fn spin(&self, p: usize) -> [f64; 3] {
        let points = &self.state.points;
        let body = &self.bodies[usize::from(points.body[p])];
        if !body.discretisation.transfer.is_affine() {
            return [0.0; 3];
        }
        let geometry = &self.fields[body.field].grid.geometry;
        let frame = body.discretisation.frame;
        let f = &points.deformation_gradient[p];
        let mut stencil = PointStencil::default();
        stencil.evaluate(body, geometry, points.site(frame, p), f);
        let kept = &points.affine_velocity[p];
        let moments = with_transfer!(body, transfer => transfer.moments(kept, &stencil));
        let placed = match frame {
            Frame::Updated => moments,
            Frame::Total => moments * SMatrix::<f64, D, D>::from_fn(|i, j| f[(j, i)]),
        };
        let at = |i: usize, j: usize| if i < D && j < D { placed[(j, i)] } else { 0.0 };
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| points.mass[p] * (at(i, j) - at(j, i)))
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
