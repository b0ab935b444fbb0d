//! Everything that changes from step to step, and copies of it.

use nalgebra::SVector;

use crate::constraints::SupportNode;
use crate::energy::SolidLedger;
use crate::error::SolidError;
use crate::points::Points;
use crate::reaction::Reaction;
use crate::solid::Solid;

/// The complete state: restoring it continues a run bit for bit.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidState<const D: usize> {
    /// Time (s).
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// The material points in storage order.
    pub points: Points<D>,
    /// For each body, the first point of each grid slab, and the end. Part of the
    /// state because it dates from the last sort, not from the positions.
    pub slab_offsets: Vec<Vec<usize>>,
    /// Upper bound of the distance any point moved since the last sort (m).
    pub drift: f64,
    /// Largest speed of a point (m/s).
    pub maximum_speed: f64,
    /// Velocity of each constraint over the last step (m/s); zero where free.
    pub constraint_velocity: Vec<SVector<f64, D>>,
    /// Reaction of each constraint in the last step.
    pub reactions: Vec<Reaction<D>>,
    /// Nodes held along a direction.
    pub supports: Vec<SupportNode>,
    /// Gravity and surface loads in the last step (N).
    pub load: SVector<f64, D>,
    /// The forces on points scattered for it (N).
    pub point_load: SVector<f64, D>,
    /// Sums of work and impulse since the start.
    pub ledger: SolidLedger<D>,
}

impl<const D: usize> Default for SolidState<D> {
    fn default() -> Self {
        Self {
            time: 0.0,
            steps: 0,
            points: Points::default(),
            slab_offsets: Vec::new(),
            drift: 0.0,
            maximum_speed: 0.0,
            constraint_velocity: Vec::new(),
            reactions: Vec::new(),
            supports: Vec::new(),
            load: SVector::zeros(),
            point_load: SVector::zeros(),
            ledger: SolidLedger::default(),
        }
    }
}

impl<const D: usize> SolidState<D> {
    /// Copies `source`, reusing this state's buffers.
    pub(crate) fn copy_from(&mut self, source: &Self) {
        self.time = source.time;
        self.steps = source.steps;
        self.points.copy_from(&source.points);
        self.slab_offsets.clone_from(&source.slab_offsets);
        self.drift = source.drift;
        self.maximum_speed = source.maximum_speed;
        self.constraint_velocity.clone_from(&source.constraint_velocity);
        self.reactions.clone_from(&source.reactions);
        self.supports.clone_from(&source.supports);
        self.load = source.load;
        self.point_load = source.point_load;
        self.ledger = source.ledger.clone();
    }
}

impl<const D: usize> Solid<D> {
    /// The complete state, for a checkpoint.
    pub fn state(&self) -> &SolidState<D> {
        &self.state
    }

    /// Replaces the state by one that [`Self::state`] returned for the same
    /// parameters, bodies and constraints. External forces are forgotten.
    ///
    /// # Errors
    /// [`SolidError::StateMismatch`] when counts differ, or what
    /// [`Self::step`] reports for points outside the grid; the solid then keeps
    /// its old state.
    pub fn restore_state(&mut self, state: SolidState<D>) -> Result<(), SolidError> {
        self.check_state(&state)?;
        let replaced = std::mem::replace(&mut self.state, state);
        if let Err(error) = self.check_layout().and_then(|()| self.build_lattices()) {
            self.state = replaced;
            self.build_lattices()?;
            return Err(error);
        }
        self.clear_external_force();
        self.index_points();
        self.failure = None;
        Ok(())
    }

    /// Keeps one copy of the state in memory, in buffers that are reused: from the first
    /// call on, the points take twice their memory.
    pub fn save(&mut self) {
        self.saved.get_or_insert_default().copy_from(&self.state);
    }

    /// Returns to the state of the last [`Self::save`] and forgets external forces;
    /// without one it does nothing.
    pub fn restore(&mut self) {
        let Some(saved) = &self.saved else { return };
        self.state.copy_from(saved);
        self.forget_carried();
        self.clear_external_force();
        self.index_points();
        self.failure = None;
    }

    fn check_state(&self, state: &SolidState<D>) -> Result<(), SolidError> {
        let points = &state.points;
        let last = state.slab_offsets.last().and_then(|o| o.last()).copied().unwrap_or(0);
        let counts = [
            ("material points", points.len(), self.state.points.len()),
            ("points in slabs", last, self.state.points.len()),
            (
                "affine velocities",
                points.affine_velocity.len(),
                self.state.points.affine_velocity.len(),
            ),
            ("bodies", state.slab_offsets.len(), self.bodies.len()),
            ("constraints", state.constraint_velocity.len(), self.constraints.names.len()),
            ("reactions", state.reactions.len(), self.constraints.names.len()),
            ("supported nodes", state.supports.len(), self.constraints.support_count()),
        ];
        for (what, found, expected) in counts {
            if found != expected {
                return Err(SolidError::StateMismatch { what, found, expected });
            }
        }
        let mut end = 0;
        for (offsets, expected) in state.slab_offsets.iter().zip(&self.state.slab_offsets) {
            let slabs = expected.len();
            if offsets.len() != slabs || !offsets.is_sorted() || offsets[0] != end {
                let (what, found) = ("ordered slab offsets", offsets.len());
                return Err(SolidError::StateMismatch { what, found, expected: slabs });
            }
            end = offsets[slabs - 1];
        }
        let known = points.id.iter().all(|&id| (id as usize) < points.len());
        if !points.is_consistent() || !known {
            let (what, expected) = ("consistent point arrays", points.len());
            return Err(SolidError::StateMismatch { what, found: 0, expected });
        }
        Ok(())
    }
}
