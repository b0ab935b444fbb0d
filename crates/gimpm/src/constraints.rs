//! Prescribed velocities on grid nodes.

use motion::Motion;
use nalgebra::SVector;

use crate::error::SolidError;
use crate::grid::{ACCELERATION, GridGeometry, VELOCITY};
use crate::parameters::NodeConstraint;
use crate::reaction::{Reaction, moment_of};
use crate::solid::Solid;

/// Width of a constraint box's closed boundary, in cells: node positions carry
/// round-off.
const BOX_TOLERANCE: f64 = 1e-9;

/// A node with the constraint that holds each of its components.
#[derive(Debug, Clone)]
pub(crate) struct ConstrainedNode<const D: usize> {
    pub node: usize,
    pub owner: [Option<u16>; D],
}

/// All constraints, resolved to nodes.
#[derive(Debug, Clone)]
pub(crate) struct Constraints<const D: usize> {
    pub names: Vec<String>,
    pub components: Vec<[Option<Motion>; D]>,
    pub nodes: Vec<ConstrainedNode<D>>,
}

impl<const D: usize> Constraints<D> {
    /// Finds the nodes of each box.
    pub fn new(
        constraints: Vec<NodeConstraint<D>>,
        geometry: &GridGeometry<D>,
    ) -> Result<Self, SolidError> {
        let mut used = vec![false; constraints.len()];
        let mut nodes = Vec::new();
        for constraint in &constraints {
            validate(constraint)?;
        }
        let tolerance = BOX_TOLERANCE * geometry.spacing;
        for node in 0..geometry.node_count() {
            let position = geometry.node_position(node);
            let mut owner = [None; D];
            for (k, constraint) in constraints.iter().enumerate() {
                let inside = (0..D).all(|d| {
                    position[d] >= constraint.lower[d] - tolerance
                        && position[d] <= constraint.upper[d] + tolerance
                });
                if !inside {
                    continue;
                }
                used[k] = true;
                for d in 0..D {
                    if constraint.components[d].is_some() {
                        owner[d] = Some(k as u16);
                    }
                }
            }
            if owner.iter().any(Option::is_some) {
                nodes.push(ConstrainedNode { node, owner });
            }
        }
        if let Some(k) = used.iter().position(|used| !used) {
            return Err(SolidError::Constraint {
                constraint: constraints[k].name.clone(),
                problem: format!(
                    "its box {:?} to {:?} m contains no grid node; make it reach a node plane (every {} m from grid_origin)",
                    constraints[k].lower.as_slice(),
                    constraints[k].upper.as_slice(),
                    geometry.spacing
                ),
            });
        }
        let (names, components) = constraints.into_iter().map(|c| (c.name, c.components)).unzip();
        Ok(Self { names, components, nodes })
    }
}

fn validate<const D: usize>(constraint: &NodeConstraint<D>) -> Result<(), SolidError> {
    let fail =
        |problem| Err(SolidError::Constraint { constraint: constraint.name.clone(), problem });
    for d in 0..D {
        let (lower, upper) = (constraint.lower[d], constraint.upper[d]);
        if lower.is_nan() || upper.is_nan() || lower > upper {
            return fail(format!(
                "its box runs from {lower} to {upper} m along axis {d}; lower must not exceed upper"
            ));
        }
    }
    if constraint.components.iter().all(Option::is_none) {
        return fail("it holds no component; give at least one a motion".into());
    }
    for motion in constraint.components.iter().flatten() {
        if let Err(error) = motion.validate() {
            return fail(error.to_string());
        }
    }
    Ok(())
}

/// Velocity that carries a node through a step (G9).
///
/// The step moves points with it and takes accelerations from its change, as a
/// leapfrog does with mid-step velocities. A table jumps between rows, so its
/// mean is the exact difference of displacements; the other laws are smooth and
/// their mid-step value is free of cancellation.
fn velocity_through_step(motion: &Motion, time: f64, dt: f64) -> f64 {
    match motion {
        Motion::Table { .. } => (motion.displacement(time + dt) - motion.displacement(time)) / dt,
        _ => motion.velocity(time + 0.5 * dt),
    }
}

impl<const D: usize> Solid<D> {
    /// Boundary conditions on a_v and v_v^L (G9), and reactions (G10):
    /// `R_v = m_v a_bc - (f_int + f_ext + m_v g)`.
    ///
    /// The node's velocity before the step is the boundary's own one, not the
    /// mass average of the points around it, so holding a node still costs
    /// neither energy nor stiffness. At the very start a boundary that is already
    /// moving takes hold of what it finds: the average then is the velocity before.
    pub(crate) fn constrain_acceleration(&mut self, dt: f64) {
        let state = &mut self.state;
        let (time, starting) = (state.time, state.steps == 0);
        self.previous_velocity.clone_from(&state.constraint_velocity);
        for (velocity, motions) in
            state.constraint_velocity.iter_mut().zip(&self.constraints.components)
        {
            *velocity = SVector::from_fn(|d, _| {
                motions[d].as_ref().map_or(0.0, |m| velocity_through_step(m, time, dt))
            });
        }
        state.reactions.fill(Reaction::default());
        for held in &self.constraints.nodes {
            let record = &mut self.grid.nodes[held.node];
            let mass = record[0];
            if mass <= self.mass_cut {
                continue;
            }
            let position = self.grid.geometry.node_position(held.node);
            for d in 0..D {
                let Some(owner) = held.owner[d].map(usize::from) else { continue };
                let velocity = state.constraint_velocity[owner][d];
                let free = record[ACCELERATION + d];
                let moving_at_start = starting
                    && self.constraints.components[owner][d]
                        .as_ref()
                        .is_some_and(|motion| motion.velocity(0.0) != 0.0);
                let before = if moving_at_start {
                    record[VELOCITY + d] - dt * free
                } else {
                    self.previous_velocity[owner][d]
                };
                let acceleration = (velocity - before) / dt;
                let mut force = SVector::zeros();
                force[d] = mass * (acceleration - free);
                record[VELOCITY + d] = velocity;
                record[ACCELERATION + d] = acceleration;
                let reaction = &mut state.reactions[owner];
                reaction.force[d] += force[d];
                let moment = moment_of(&position, &force);
                for (total, part) in reaction.moment.iter_mut().zip(moment) {
                    *total += part;
                }
            }
        }
    }

    /// Boundary conditions again, on the re-mapped velocity (G14).
    pub(crate) fn constrain_remapped_velocity(&mut self) {
        for held in &self.constraints.nodes {
            for d in 0..D {
                if let Some(owner) = held.owner[d] {
                    let velocity = self.state.constraint_velocity[usize::from(owner)][d];
                    self.grid.remapped[held.node][d] = velocity;
                }
            }
        }
    }

    /// Names of the constraints, in order.
    pub fn constraint_names(&self) -> &[String] {
        &self.constraints.names
    }
}
