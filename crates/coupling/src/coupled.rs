use nalgebra::SVector;

use crate::{
    CouplingError, CouplingLedger, CouplingParameters, FluidSide, SolidImpulse, SolidSide,
    StructurePoints, TimeStepLimit,
};

/// Fluid and solid with the exchange between them.
#[derive(Debug, Clone)]
pub struct Coupled<const D: usize, F, S> {
    pub(crate) fluid: F,
    pub(crate) solid: S,
    pub(crate) parameters: CouplingParameters,
    pub(crate) structure: StructurePoints<D>,
    /// Points' positions at the start of the step.
    start_position: Vec<SVector<f64, D>>,
    /// Points' positions at the end of the step.
    end_position: Vec<SVector<f64, D>>,
    /// f_p of (C5), in the order of `structure`.
    pub(crate) load: Vec<SVector<f64, D>>,
    /// v̄ that the fluid used in its last force evaluation.
    pub(crate) assumed_velocity: Vec<SVector<f64, D>>,
    /// v̄ of (C1), from the last sweep of the solid.
    pub(crate) mean_velocity: Vec<SVector<f64, D>>,
    /// v̄ of the last completed step by point id: the prediction of the next.
    mean_velocity_by_id: Vec<SVector<f64, D>>,
    pub(crate) ledger: CouplingLedger,
    time: f64,
    steps: u64,
    substeps: u32,
}

/// What a restart needs beyond the two sides' own states.
#[derive(Debug, Clone, PartialEq)]
pub struct CoupledState<const D: usize> {
    /// Simulated time (s).
    pub time: f64,
    /// Completed steps.
    pub steps: u64,
    /// Mean velocity of the last step by point id (m/s).
    pub mean_velocity_by_id: Vec<SVector<f64, D>>,
    /// The accumulated ledger.
    pub ledger: CouplingLedger,
}

impl<const D: usize, F: FluidSide<D>, S: SolidSide<D>> Coupled<D, F, S> {
    /// Joins a fluid and a solid; either may be absent.
    ///
    /// # Errors
    /// A parameter is out of range.
    pub fn new(
        fluid: F,
        mut solid: S,
        parameters: CouplingParameters,
    ) -> Result<Self, CouplingError> {
        parameters.validate()?;
        let mut structure = StructurePoints::default();
        solid.points(&mut structure);
        let count = structure.position.len();
        let mut mean_velocity_by_id = vec![SVector::zeros(); count];
        for (&id, velocity) in structure.id.iter().zip(&structure.velocity) {
            mean_velocity_by_id[id as usize] = *velocity;
        }
        Ok(Self {
            fluid,
            solid,
            parameters,
            structure,
            start_position: vec![SVector::zeros(); count],
            end_position: vec![SVector::zeros(); count],
            load: vec![SVector::zeros(); count],
            assumed_velocity: vec![SVector::zeros(); count],
            mean_velocity: vec![SVector::zeros(); count],
            mean_velocity_by_id,
            ledger: CouplingLedger::default(),
            time: 0.0,
            steps: 0,
            substeps: 1,
        })
    }

    /// The stable step of the pair: the fluid's where there is one, since the
    /// solid sub-steps below it; else the solid's.
    ///
    /// # Errors
    /// A side's state is not finite.
    pub fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
        match self.fluid.stable_time_step()? {
            Some(limit) => Ok(Some(limit)),
            None => self.solid.stable_time_step(),
        }
    }

    /// The fluid side.
    pub fn fluid(&self) -> &F {
        &self.fluid
    }

    /// The fluid side, for gauges that need scratch space and for restarts.
    pub fn fluid_mut(&mut self) -> &mut F {
        &mut self.fluid
    }

    /// The solid side.
    pub fn solid(&self) -> &S {
        &self.solid
    }

    /// The solid side, for restarts.
    pub fn solid_mut(&mut self) -> &mut S {
        &mut self.solid
    }

    /// Simulated time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Completed steps.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Solid sub-steps of the last step.
    pub fn substeps(&self) -> u32 {
        self.substeps
    }

    /// The accumulated ledger.
    pub fn ledger(&self) -> &CouplingLedger {
        &self.ledger
    }

    /// The accumulated ledger, to reset its per-row extremes.
    pub fn ledger_mut(&mut self) -> &mut CouplingLedger {
        &mut self.ledger
    }

    /// Load f_p (N) of the last step with the points that carried it.
    pub fn interface(&self) -> (&StructurePoints<D>, &[SVector<f64, D>]) {
        (&self.structure, &self.load)
    }

    /// State for a checkpoint, without the two sides.
    pub fn state(&self) -> CoupledState<D> {
        CoupledState {
            time: self.time,
            steps: self.steps,
            mean_velocity_by_id: self.mean_velocity_by_id.clone(),
            ledger: self.ledger.clone(),
        }
    }

    /// Continues from a checkpoint; the sides are restored by their own means.
    pub fn restore_state(&mut self, state: CoupledState<D>) {
        self.time = state.time;
        self.steps = state.steps;
        self.mean_velocity_by_id = state.mean_velocity_by_id;
        self.ledger = state.ledger;
    }

    pub(crate) fn corrector_count(&self) -> u32 {
        if self.structure.position.is_empty() { 0 } else { self.parameters.corrector_count() }
    }

    /// n_s = ⌈Δt / Δt_s⌉.
    pub(crate) fn substep_count(&self, dt: f64) -> Result<u32, CouplingError> {
        let Some(limit) = self.solid.stable_time_step()? else { return Ok(1) };
        // A step clipped to an output time may exceed the limit by round-off.
        let needed = (dt / limit.value * (1.0 - 1e-12)).ceil().max(1.0);
        let allowed = self.parameters.largest_substep_count;
        if needed > f64::from(allowed) {
            return Err(CouplingError::TooManySubsteps {
                needed: needed as u64,
                allowed,
                time_step: dt,
            });
        }
        Ok(needed as u32)
    }

    /// Phase 1: wall points at x + ½Δt v̄ⁿ, moving with v̄ⁿ.
    pub(crate) fn predict_structure(&mut self, dt: f64) {
        self.solid.points(&mut self.structure);
        self.start_position.copy_from_slice(&self.structure.position);
        for (index, &id) in self.structure.id.iter().enumerate() {
            let velocity = self.mean_velocity_by_id[id as usize];
            self.assumed_velocity[index] = velocity;
            self.structure.velocity[index] = velocity;
            self.structure.position[index] += 0.5 * dt * velocity;
        }
    }

    /// Phases 3 and 4.
    pub(crate) fn advance_solid(
        &mut self,
        dt: f64,
        substeps: u32,
    ) -> Result<SolidImpulse<D>, CouplingError> {
        self.substeps = substeps;
        let impulse = self.solid.advance(dt, substeps, &self.load, &mut self.end_position)?;
        for (index, velocity) in self.mean_velocity.iter_mut().enumerate() {
            *velocity = (self.end_position[index] - self.start_position[index]) / dt;
        }
        Ok(impulse)
    }

    /// Whether v̄ differs from the assumed one at any point that carries a load.
    ///
    /// There is no tolerance: 1e-3 c0, small for the fluid, is a pressure of 1e-3 ρ c0²,
    /// and a concrete wall whose corrector is skipped for it is rung up by the lag of one
    /// step.
    pub(crate) fn velocity_changed(&self) -> bool {
        let mut changes = self.mean_velocity.iter().zip(&self.assumed_velocity).zip(&self.load);
        changes.any(|((new, old), load)| new != old && load.iter().any(|&force| force != 0.0))
    }

    pub(crate) fn complete_step(&mut self, dt: f64) {
        for (index, &id) in self.structure.id.iter().enumerate() {
            self.mean_velocity_by_id[id as usize] = self.mean_velocity[index];
        }
        self.time += dt;
        self.steps += 1;
    }
}
