//! Contact with friction between bodies that have velocity fields of their own.
//!
//! Bodies meet on the nodes that both give mass to (Bardenhagen et al. 2001). A
//! node decides by the points around it: a plane that separates the two clouds
//! gives the normal, and their gap along it says whether they touch, so bodies do
//! not feel each other a cell early. Where the gap would close within the step,
//! the two nodes exchange an impulse that lets it close exactly.

mod impulse;
mod nearby;
mod separation;

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid::{ACCELERATION, VELOCITY};
use crate::reaction::add_reaction;
use crate::solid::Solid;
use impulse::{Impulse, coulomb};
use nearby::{Marks, shared_nodes};

/// Distance from a node, across the normal, up to which points count for its
/// gap, in cells. With two points a cell and axis there is always one. A wider
/// look would find a round body closed where it is not yet.
const GAP_WIDTH: f64 = 0.75;

/// A node where two bodies are near each other.
#[derive(Debug, Clone)]
pub(crate) struct ContactNode<const D: usize> {
    /// Velocity fields of the two.
    fields: [usize; 2],
    node: usize,
    /// Unit normal from the first to the second.
    normal: SVector<f64, D>,
    /// Distance that may still close (m), 0 where they overlap.
    gap: f64,
    /// Whether friction holds them together in this step.
    sticks: bool,
}

/// The contact nodes of a step, found anew in each.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactNodes<const D: usize> {
    nodes: Vec<ContactNode<D>>,
    marks: Marks,
}

impl<const D: usize> Solid<D> {
    /// Finds the nodes where bodies are near each other, with normal and gap, from
    /// the masses on the nodes. Pairs of bodies in order, nodes in order.
    pub(crate) fn find_contact(&mut self) {
        self.contact.nodes.clear();
        if self.parameters.contact.is_none() {
            return;
        }
        for second in 1..self.bodies.len() {
            for first in 0..second {
                self.find_contact_of(first, second);
            }
        }
    }

    fn find_contact_of(&mut self, first: usize, second: usize) {
        let pair = [first, second];
        let fields = pair.map(|body| self.bodies[body].field);
        let geometry = &self.fields[fields[0]].grid.geometry;
        let offsets = pair.map(|body| self.state.slab_offsets[body].as_slice());
        let records = fields.map(|field| &*self.fields[field].grid.nodes);
        let shared = shared_nodes(
            geometry,
            pair.map(|body| (self.bodies[body].slabs, self.state.slab_offsets[body].as_slice())),
            records,
            self.mass_cut,
        );
        if shared.is_empty() {
            return;
        }
        let points = &self.state.points;
        let near = self.contact.marks.with(geometry.node_count(), &shared, |marks| {
            offsets.map(|offsets| marks.gather(&shared, geometry, offsets, points))
        });
        let half_edges =
            pair.map(|body| 0.5 * self.bodies[body].point_spacing * geometry.inverse_spacing);
        let clouds = || [Vec::new(), Vec::new()];
        let judge = |clouds: &mut [Vec<_>; 2], (place, &node): (usize, &usize)| {
            let position = geometry.node_position(node);
            for (side, cloud) in clouds.iter_mut().enumerate() {
                near[side].cloud(place, &position, geometry, half_edges[side], points, cloud);
            }
            let normal = separation::normal(&clouds[0], &clouds[1])?;
            let gap = separation::gap(&clouds[0], &clouds[1], &normal, GAP_WIDTH);
            let gap = gap.is_finite().then(|| gap.max(0.0) * geometry.spacing)?;
            Some(ContactNode { fields, node, normal, gap, sticks: false })
        };
        let judged = shared.par_iter().enumerate().map_init(clouds, judge);
        let judged: Vec<Option<ContactNode<D>>> = judged.collect();
        self.contact.nodes.extend(judged.into_iter().flatten());
    }

    /// Contact impulses (G33) on a_v and v_v^L: `±J/m_v` on v_v^L, the same
    /// over Δt on a_v. Where a boundary holds a component of a node, the boundary
    /// takes its part of the impulse: it counts to the reaction.
    pub(crate) fn exchange_contact_impulses(&mut self, dt: f64) {
        let Some(contact) = self.parameters.contact else { return };
        for contact_node in &mut self.contact.nodes {
            let node = contact_node.node;
            let view = |field: usize| {
                let record = &self.fields[field].grid.nodes[node];
                let velocity = SVector::from_fn(|d, _| record[VELOCITY + d]);
                let freedom = self.constraints.freedom(&self.state.supports, field, node);
                (record[0], velocity, freedom)
            };
            let [(first_mass, first, first_freedom), (second_mass, second, second_freedom)] =
                contact_node.fields.map(view);
            let inverse_mass =
                first_freedom.matrix() / first_mass + second_freedom.matrix() / second_mass;
            let closing = contact_node.gap / dt;
            let relative = second - first;
            let normal = &contact_node.normal;
            let found = coulomb(&relative, &inverse_mass, normal, closing, contact.friction);
            let Some(Impulse { on_second, sticks }) = found else { continue };
            contact_node.sticks = sticks;
            let sides =
                [(first_mass, first_freedom, -on_second), (second_mass, second_freedom, on_second)];
            for (&field, (mass, freedom, impulse)) in contact_node.fields.iter().zip(sides) {
                let grid = &mut self.fields[field].grid;
                let position = grid.geometry.node_position(node);
                let reactions = &mut self.state.reactions;
                let free = freedom.split(impulse, |owner, part| {
                    add_reaction(&mut reactions[owner], &position, &(-part / dt));
                });
                let record = &mut grid.nodes[node];
                for d in 0..D {
                    record[VELOCITY + d] += free[d] / mass;
                    record[ACCELERATION + d] += free[d] / (mass * dt);
                }
            }
        }
    }

    /// Contact again, on the re-mapped velocity (G34): the approach is stopped as
    /// before, and where friction held the nodes together the sliding as well.
    pub(crate) fn separate_remapped_velocity(&mut self, dt: f64) {
        for contact_node in &self.contact.nodes {
            let node = contact_node.node;
            let view = |field: usize| {
                let grid = &self.fields[field].grid;
                let velocity = SVector::from_fn(|d, _| grid.remapped[node][d]);
                let freedom = self.constraints.freedom(&self.state.supports, field, node);
                (freedom.matrix() / grid.nodes[node][0], velocity)
            };
            let [(first_inverse, first), (second_inverse, second)] = contact_node.fields.map(view);
            let inverse_mass = first_inverse + second_inverse;
            let friction = if contact_node.sticks { f64::MAX } else { 0.0 };
            let (normal, closing) = (&contact_node.normal, contact_node.gap / dt);
            let relative = second - first;
            let Some(impulse) = coulomb(&relative, &inverse_mass, normal, closing, friction) else {
                continue;
            };
            let changes = [first_inverse * -impulse.on_second, second_inverse * impulse.on_second];
            for (&field, change) in contact_node.fields.iter().zip(changes) {
                let record = &mut self.fields[field].grid.remapped[node];
                (0..D).for_each(|d| record[d] += change[d]);
            }
        }
    }
}
