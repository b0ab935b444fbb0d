//! Prescribed velocities on grid nodes.

use motion::Motion;
use nalgebra::SVector;

use crate::error::SolidError;
use crate::field::Field;
use crate::grid::{ACCELERATION, RemapRecord, VELOCITY};
use crate::parameters::{Hold, NodeConstraint};
use crate::reaction::{Reaction, add_reaction};
use crate::solid::Solid;

/// Width of a constraint box's closed boundary, in cells: node positions carry
/// round-off.
const BOX_TOLERANCE: f64 = 1e-9;

/// A node with the constraint that holds each of its components.
#[derive(Debug, Clone)]
pub(crate) struct ComponentNode<const D: usize> {
    pub field: usize,
    pub node: usize,
    pub owner: [Option<u16>; D],
}

/// A node that is held along one direction.
#[derive(Debug, Clone)]
pub(crate) struct NormalNode {
    pub field: usize,
    pub node: usize,
    pub owner: u16,
}

/// What a node on a one-sided support remembers (G9b).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SupportNode {
    /// Distance that the node has moved away since it was let go (m).
    pub gap: f64,
    /// Whether the support pushed it in the last step.
    pub held: bool,
}

/// All constraints, resolved to nodes.
#[derive(Debug, Clone)]
pub(crate) struct Constraints<const D: usize> {
    pub names: Vec<String>,
    pub holds: Vec<Hold<D>>,
    /// By field, then by node.
    pub components: Vec<ComponentNode<D>>,
    /// By field, then by node; several at one node in the constraints' order.
    pub normals: Vec<NormalNode>,
}

impl<const D: usize> Constraints<D> {
    /// Finds the nodes of each box; `field_of` is the field of each body.
    pub fn new(
        mut constraints: Vec<NodeConstraint<D>>,
        fields: &[Field<D>],
        field_of: &[usize],
    ) -> Result<Self, SolidError> {
        for constraint in &mut constraints {
            validate(constraint, field_of.len())?;
            if let Hold::Normal { direction, .. } = &mut constraint.hold {
                *direction /= direction.norm();
            }
        }
        let mut used = vec![false; constraints.len()];
        let (mut components, mut normals) = (Vec::new(), Vec::new());
        for (field, Field { grid, .. }) in fields.iter().enumerate() {
            let geometry = &grid.geometry;
            let tolerance = BOX_TOLERANCE * geometry.spacing;
            let here = || constraints.iter().enumerate().filter(|(_, c)| field_of[c.body] == field);
            for node in 0..geometry.node_count() {
                let position = geometry.node_position(node);
                let mut owner = [None; D];
                for (k, constraint) in here() {
                    let inside = (0..D).all(|d| {
                        position[d] >= constraint.lower[d] - tolerance
                            && position[d] <= constraint.upper[d] + tolerance
                    });
                    if !inside {
                        continue;
                    }
                    used[k] = true;
                    match &constraint.hold {
                        Hold::Components(motions) => {
                            for d in (0..D).filter(|&d| motions[d].is_some()) {
                                owner[d] = Some(k as u16);
                            }
                        }
                        Hold::Normal { .. } => {
                            normals.push(NormalNode { field, node, owner: k as u16 });
                        }
                    }
                }
                if owner.iter().any(Option::is_some) {
                    components.push(ComponentNode { field, node, owner });
                }
            }
        }
        if let Some(k) = used.iter().position(|used| !used) {
            return Err(SolidError::Constraint {
                constraint: constraints[k].name.clone(),
                problem: format!(
                    "its box {:?} to {:?} m contains no grid node of its body; make it reach a node plane (every {} m)",
                    constraints[k].lower.as_slice(),
                    constraints[k].upper.as_slice(),
                    fields[field_of[constraints[k].body]].grid.geometry.spacing
                ),
            });
        }
        let (names, holds) = constraints.into_iter().map(|c| (c.name, c.hold)).unzip();
        Ok(Self { names, holds, components, normals })
    }

    /// Tells the fields which components local damping must leave alone: what acts on
    /// a held one is the reaction, not a damped force. A node held along a direction is
    /// left alone altogether.
    pub fn mark_held(&self, fields: &mut [Field<D>]) {
        for field in fields.iter_mut() {
            field.held = vec![0; field.grid.geometry.node_count()];
        }
        for held in &self.components {
            for d in (0..D).filter(|&d| held.owner[d].is_some()) {
                fields[held.field].held[held.node] |= 1 << d;
            }
        }
        for held in &self.normals {
            fields[held.field].held[held.node] = u8::MAX;
        }
    }

    /// Nodes held along a direction: each has a [`SupportNode`] in the state.
    pub fn support_count(&self) -> usize {
        self.normals.len()
    }
}

fn validate<const D: usize>(
    constraint: &NodeConstraint<D>,
    bodies: usize,
) -> Result<(), SolidError> {
    let fail =
        |problem| Err(SolidError::Constraint { constraint: constraint.name.clone(), problem });
    if constraint.body >= bodies {
        return fail(format!(
            "its body has index {}; there are {bodies} bodies, counted from 0",
            constraint.body
        ));
    }
    for d in 0..D {
        let (lower, upper) = (constraint.lower[d], constraint.upper[d]);
        if lower.is_nan() || upper.is_nan() || lower > upper {
            return fail(format!(
                "its box runs from {lower} to {upper} m along axis {d}; lower must not exceed upper"
            ));
        }
    }
    let motions: Vec<&Motion> = match &constraint.hold {
        Hold::Components(motions) => motions.iter().flatten().collect(),
        Hold::Normal { direction, motion, .. } => {
            let length = direction.norm();
            if !(length.is_finite() && length > 0.0) {
                return fail(format!(
                    "its direction {:?} has length {length}; it must be finite and above 0",
                    direction.as_slice()
                ));
            }
            vec![motion]
        }
    };
    if motions.is_empty() {
        return fail("it holds no component; give at least one a motion".into());
    }
    for motion in motions {
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

impl<const D: usize> Hold<D> {
    /// Velocity of the boundary through a step (m/s); zero where free.
    fn velocity(&self, time: f64, dt: f64) -> SVector<f64, D> {
        match self {
            Self::Components(motions) => SVector::from_fn(|d, _| {
                motions[d].as_ref().map_or(0.0, |m| velocity_through_step(m, time, dt))
            }),
            Self::Normal { direction, motion, .. } => {
                direction * velocity_through_step(motion, time, dt)
            }
        }
    }

    /// Whether component `d` moves at t = 0.
    fn starts_moving(&self, d: usize) -> bool {
        match self {
            Self::Components(motions) => {
                motions[d].as_ref().is_some_and(|motion| motion.velocity(0.0) != 0.0)
            }
            Self::Normal { motion, .. } => motion.velocity(0.0) != 0.0,
        }
    }
}

impl<const D: usize> Solid<D> {
    /// Boundary conditions on a_v and v_v^L (G9), and reactions (G10):
    /// `R_v = m_v a_bc - (f_int + f_ext + m_v g)`.
    ///
    /// The node's velocity before the step is the boundary's own one, not the
    /// mass average of the points around it, so holding a node still costs
    /// neither energy nor stiffness. At the very start a boundary that is already
    /// moving takes hold of what it finds: the average then is the velocity before. So
    /// it is at every step where points take the velocity of nodes: there the average
    /// is what they lose.
    pub(crate) fn constrain_acceleration(&mut self, dt: f64) {
        let time = self.state.time;
        self.previous_velocity.clone_from(&self.state.constraint_velocity);
        let velocities = self.state.constraint_velocity.iter_mut();
        for (velocity, hold) in velocities.zip(&self.constraints.holds) {
            *velocity = hold.velocity(time, dt);
        }
        self.state.reactions.fill(Reaction::default());
        self.hold_directions(dt);
        self.hold_components(dt);
    }

    fn hold_components(&mut self, dt: f64) {
        let state = &mut self.state;
        let starting = state.steps == 0;
        for held in &self.constraints.components {
            let field = &mut self.fields[held.field];
            let replaced = field.transfer.replaces_velocity();
            let grid = &mut field.grid;
            let record = &mut grid.nodes[held.node];
            let mass = record[0];
            if mass <= self.mass_cut {
                continue;
            }
            let position = grid.geometry.node_position(held.node);
            for d in 0..D {
                let Some(owner) = held.owner[d].map(usize::from) else { continue };
                let velocity = state.constraint_velocity[owner][d];
                let free = record[ACCELERATION + d];
                let takes_hold = starting && self.constraints.holds[owner].starts_moving(d);
                let before = if replaced || takes_hold {
                    record[VELOCITY + d] - dt * free
                } else {
                    self.previous_velocity[owner][d]
                };
                let acceleration = (velocity - before) / dt;
                let mut force = SVector::zeros();
                force[d] = mass * (acceleration - free);
                record[VELOCITY + d] = velocity;
                record[ACCELERATION + d] = acceleration;
                add_reaction(&mut state.reactions[owner], &position, &force);
            }
        }
    }

    /// The same along one direction, `R = R n`; on a one-sided support (G9b) only
    /// where the node has come back to it and would move through it.
    fn hold_directions(&mut self, dt: f64) {
        let state = &mut self.state;
        let starting = state.steps == 0;
        for (held, support) in self.constraints.normals.iter().zip(&mut state.supports) {
            let owner = usize::from(held.owner);
            let hold = &self.constraints.holds[owner];
            let Hold::Normal { direction, one_sided, .. } = hold else { continue };
            let field = &mut self.fields[held.field];
            let replaced = field.transfer.replaces_velocity();
            let grid = &mut field.grid;
            let record = &mut grid.nodes[held.node];
            let mass = record[0];
            if mass <= self.mass_cut {
                *support = SupportNode::default();
                continue;
            }
            let along = |first: usize, record: &[f64; 8]| -> f64 {
                (0..D).map(|d| direction[d] * record[first + d]).sum()
            };
            let target = state.constraint_velocity[owner].dot(direction);
            let (moving, free) = (along(VELOCITY, record), along(ACCELERATION, record));
            if *one_sided {
                let gap = support.gap + dt * (moving - target);
                let pushed = gap <= 0.0 && moving < target;
                *support = SupportNode {
                    gap: if pushed { 0.0 } else { gap.max(0.0) },
                    held: pushed && support.held,
                };
                if !pushed {
                    continue;
                }
            }
            let takes_hold =
                if *one_sided { !support.held } else { starting && hold.starts_moving(0) };
            let before = if replaced || takes_hold {
                moving - dt * free
            } else {
                self.previous_velocity[owner].dot(direction)
            };
            support.held = true;
            let acceleration = (target - before) / dt;
            for d in 0..D {
                record[VELOCITY + d] += direction[d] * (target - moving);
                record[ACCELERATION + d] += direction[d] * (acceleration - free);
            }
            let position = grid.geometry.node_position(held.node);
            let force = direction * (mass * (acceleration - free));
            add_reaction(&mut state.reactions[owner], &position, &force);
        }
    }

    /// Boundary conditions again, on the re-mapped velocity (G14).
    pub(crate) fn constrain_remapped_velocity(&mut self) {
        for (held, support) in self.constraints.normals.iter().zip(&self.state.supports) {
            let owner = usize::from(held.owner);
            let Hold::Normal { direction, .. } = &self.constraints.holds[owner] else { continue };
            if support.held {
                let record = &mut self.fields[held.field].grid.remapped[held.node];
                let moving: f64 = (0..D).map(|d| direction[d] * record[d]).sum();
                let excess = self.state.constraint_velocity[owner].dot(direction) - moving;
                (0..D).for_each(|d| record[d] += direction[d] * excess);
            }
        }
        for held in &self.constraints.components {
            for d in 0..D {
                if let Some(owner) = held.owner[d] {
                    let velocity = self.state.constraint_velocity[usize::from(owner)][d];
                    self.fields[held.field].grid.remapped[held.node][d] = velocity;
                }
            }
        }
    }

    /// Boundary conditions on an increment of the velocity of a field: none along
    /// what is held. With a step `dt` (s) what is taken away is a reaction.
    pub(crate) fn hold_increment(
        &mut self,
        field: usize,
        increment: &mut [RemapRecord],
        dt: Option<f64>,
    ) {
        let grid = &self.fields[field].grid;
        let state = &mut self.state;
        let reactions = &mut state.reactions;
        let mut react = |owner: usize, node: usize, taken: SVector<f64, D>| {
            if let Some(dt) = dt {
                let force = taken * (-grid.nodes[node][0] / dt);
                add_reaction(&mut reactions[owner], &grid.geometry.node_position(node), &force);
            }
        };
        for (held, support) in self.constraints.normals.iter().zip(&state.supports) {
            let owner = usize::from(held.owner);
            let Hold::Normal { direction, .. } = &self.constraints.holds[owner] else { continue };
            if held.field == field && support.held {
                let record = &mut increment[held.node];
                let along: f64 = (0..D).map(|d| direction[d] * record[d]).sum();
                (0..D).for_each(|d| record[d] -= direction[d] * along);
                react(owner, held.node, direction * along);
            }
        }
        for held in self.constraints.components.iter().filter(|held| held.field == field) {
            for d in 0..D {
                if let Some(owner) = held.owner[d] {
                    let mut taken = SVector::zeros();
                    taken[d] = std::mem::take(&mut increment[held.node][d]);
                    react(usize::from(owner), held.node, taken);
                }
            }
        }
    }

    /// Names of the constraints, in order.
    pub fn constraint_names(&self) -> &[String] {
        &self.constraints.names
    }
}
