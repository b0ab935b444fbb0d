//! The one implementation of [`Simulation`].

use case::Gauge;
use coupling::{Coupled, CouplingError, FluidSide, SolidSide, TimeStepLimit};
use gimpm::Reaction;

use super::gauges::GaugeBoard;
use super::sides::{ObservedFluid, ObservedSolid};
use super::{Counts, RelaxationProgress, Simulation, Totals, clouds, ledger, state};
use crate::failure::Failure;
use crate::output::checkpoint::Checkpoint;
use crate::output::frame::{Column, Frame, PointCloud};

/// A coupled pair with its gauges.
pub struct Assembled<const D: usize, F, S> {
    coupled: Coupled<D, F, S>,
    gauges: GaugeBoard<D>,
}

impl<const D: usize, F, S> Assembled<D, F, S>
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    /// Puts gauges on a coupled pair.
    pub fn new(coupled: Coupled<D, F, S>, gauges: Vec<Gauge<D>>) -> Self {
        let gauges = GaugeBoard::new(gauges, coupled.solid().observed());
        Self { coupled, gauges }
    }

    /// Reactions of the solid's boundaries: of the present state for a solid alone, of
    /// the last sub-step in water, whose load acts on the nodes only during a step. The
    /// two differ by what the load changes in one sub-step.
    fn reactions(&mut self) -> Vec<Reaction<D>> {
        let alone = self.coupled.fluid().observed().is_none();
        let Some(solid) = self.coupled.solid_mut().observed_mut() else { return Vec::new() };
        let present = alone
            .then(|| solid.stable_time_step().and_then(|dt| solid.current_reactions(dt.value)));
        match present {
            Some(Ok(reactions)) => reactions,
            // A state that cannot take a step is reported by that step.
            Some(Err(_)) | None => solid.state().reactions.clone(),
        }
    }
}

impl<const D: usize, F, S> Simulation for Assembled<D, F, S>
where
    F: FluidSide<D> + ObservedFluid<D> + Send,
    S: SolidSide<D> + ObservedSolid<D> + Send,
{
    fn counts(&self) -> Counts {
        let fluid = self.coupled.fluid().observed();
        let solid = self.coupled.solid().observed();
        Counts {
            fluid: fluid.map_or(0, |fluid| fluid.particles().position.len()),
            wall: fluid.map_or(0, |fluid| fluid.walls().position.len()),
            material: solid.map_or(0, |solid| solid.points().position.len()),
        }
    }

    fn time(&self) -> f64 {
        self.coupled.time()
    }

    fn steps(&self) -> u64 {
        self.coupled.steps()
    }

    fn substeps(&self) -> u32 {
        self.coupled.substeps()
    }

    fn time_step(&self) -> Result<TimeStepLimit, CouplingError> {
        let unlimited = TimeStepLimit { value: f64::INFINITY, term: "nothing" };
        Ok(self.coupled.stable_time_step()?.unwrap_or(unlimited))
    }

    fn step(&mut self, dt: f64) -> Result<(), CouplingError> {
        self.coupled.step(dt)
    }

    fn gauge_columns(&self) -> Vec<Column> {
        self.gauges.columns()
    }

    fn gauge_row(&mut self) -> Vec<f64> {
        let reactions = self.reactions();
        self.gauges.row(&self.coupled, &reactions)
    }

    fn ledger_columns(&self) -> Vec<Column> {
        ledger::columns()
    }

    fn ledger_row(&mut self) -> Vec<f64> {
        let row = ledger::row(&self.coupled);
        self.coupled.ledger_mut().start_row();
        row
    }

    fn is_relaxed(&self) -> bool {
        self.coupled.solid().observed().is_some_and(gimpm::Solid::is_relaxed)
    }

    fn relaxation(&self) -> Option<RelaxationProgress> {
        let solid = self.coupled.solid().observed()?;
        let tolerance = solid.parameters().relaxation?.tolerance;
        let (out_of_balance, relaxed) = (solid.out_of_balance(), solid.is_relaxed());
        Some(RelaxationProgress { out_of_balance, tolerance, relaxed })
    }

    fn totals(&self) -> Totals {
        ledger::totals(&self.coupled)
    }

    fn static_clouds(&self) -> Vec<PointCloud> {
        self.coupled.fluid().observed().and_then(clouds::fixed_walls).into_iter().collect()
    }

    fn frame(&self, index: u64) -> Frame {
        let mut clouds = Vec::new();
        if let Some(fluid) = self.coupled.fluid().observed() {
            clouds.push(clouds::fluid(fluid));
            clouds.extend(clouds::moving_walls(fluid));
        }
        if let Some(solid) = self.coupled.solid().observed() {
            clouds.extend(clouds::bodies(solid));
        }
        Frame { index, step: self.steps(), time: self.time(), clouds }
    }

    fn markers(&self) -> Vec<(String, [f64; 3])> {
        self.gauges.markers()
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        state::save(&self.coupled, checkpoint);
    }

    fn load(&mut self, checkpoint: &Checkpoint) -> Result<(), Failure> {
        state::load(&mut self.coupled, checkpoint)
    }
}
