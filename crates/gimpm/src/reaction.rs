//! The forces that hold constrained nodes.

use nalgebra::SVector;

use crate::error::SolidError;
use crate::solid::Solid;

/// Force that a constraint exerts on the solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reaction<const D: usize> {
    /// Force (N).
    pub force: SVector<f64, D>,
    /// Moment about the coordinate origin (N m); only z in plane strain.
    pub moment: [f64; 3],
}

impl<const D: usize> Default for Reaction<D> {
    fn default() -> Self {
        Self { force: SVector::zeros(), moment: [0.0; 3] }
    }
}

impl<const D: usize> Reaction<D> {
    /// Moment (N m) about another position (m).
    pub fn moment_about(&self, about: &SVector<f64, D>) -> [f64; 3] {
        let shift = moment_of(about, &self.force);
        std::array::from_fn(|k| self.moment[k] - shift[k])
    }
}

/// Cross product of an arm and a force, in three dimensions whatever `D`.
pub(crate) fn moment_of<const D: usize>(
    arm: &SVector<f64, D>,
    force: &SVector<f64, D>,
) -> [f64; 3] {
    let z = |v: &SVector<f64, D>| if D == 3 { v[2] } else { 0.0 };
    [
        arm[1] * z(force) - z(arm) * force[1],
        z(arm) * force[0] - arm[0] * z(force),
        arm[0] * force[1] - arm[1] * force[0],
    ]
}

/// Adds a force at a position to a reaction.
pub(crate) fn add_reaction<const D: usize>(
    reaction: &mut Reaction<D>,
    position: &SVector<f64, D>,
    force: &SVector<f64, D>,
) {
    reaction.force += force;
    for (total, part) in reaction.moment.iter_mut().zip(moment_of(position, force)) {
        *total += part;
    }
}

impl<const D: usize> Solid<D> {
    /// Force (N) that a constraint exerted on the solid in the last step, and its
    /// moment (N m) about a position (only z in plane strain), G10.
    ///
    /// It is the force of the momentum balance over that step and belongs to the
    /// stress at the step's *start*; [`Self::current_reactions`] belongs to now.
    /// Zero for an index beyond the constraints.
    pub fn reaction(
        &self,
        constraint: usize,
        about: SVector<f64, D>,
    ) -> (SVector<f64, D>, [f64; 3]) {
        let reaction = self.state.reactions.get(constraint).copied().unwrap_or_default();
        (reaction.force, reaction.moment_about(&about))
    }

    /// Reactions of all constraints at the current time: those that a next step
    /// of `dt` (s) would report, with the external force scattered so far. The
    /// state does not change. Costs a third of a step.
    ///
    /// # Errors
    /// The error of an earlier step, or of the step `dt`.
    pub fn current_reactions(&mut self, dt: f64) -> Result<Vec<Reaction<D>>, SolidError> {
        self.check_time_step(dt)?;
        let velocity = self.state.constraint_velocity.clone();
        let last = self.state.reactions.clone();
        let supports = self.state.supports.clone();
        let (ledger, small_mass) = (self.state.ledger.clone(), self.small_mass);
        let waiting: Vec<_> = self
            .fields
            .iter()
            .map(|field| (field.grid.has_external_force, field.grid.external_force.clone()))
            .collect();
        self.apply_surface_loads(dt);
        self.points_to_grid();
        self.update_grid_momentum(dt);
        self.constrain_acceleration(dt);
        self.find_contact();
        self.exchange_contact_impulses(dt);
        self.expand_velocity(dt);
        for (field, (has_external_force, external_force)) in self.fields.iter_mut().zip(waiting) {
            field.grid.has_external_force = has_external_force;
            field.grid.external_force = external_force;
        }
        self.state.ledger = ledger;
        self.small_mass = small_mass;
        self.state.constraint_velocity = velocity;
        self.state.supports = supports;
        Ok(std::mem::replace(&mut self.state.reactions, last))
    }
}
