//! A built case, ready to step, with its dimension and its sides hidden.
//!
//! The run loop sees [`Simulation`]; behind it stand the six combinations of
//! dimension and present sides, each compiled to its own code.

mod assembled;
mod clouds;
mod gauges;
mod ledger;
mod sides;
mod state;

use case::{Case, Model};
use coupling::{Coupled, CouplingError, NoFluid, NoSolid, TimeStepLimit};
use gimpm::Solid;
use sph::Fluid;

use crate::failure::Failure;
use crate::output::checkpoint::Checkpoint;
use crate::output::frame::{Column, Frame, PointCloud};
use assembled::Assembled;
pub use ledger::Totals;

/// How many of each kind of point a simulation has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Fluid particles.
    pub fluid: usize,
    /// Wall particles.
    pub wall: usize,
    /// Material points.
    pub material: usize,
}

impl std::fmt::Display for Counts {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} fluid, {} wall, {} solid", self.fluid, self.wall, self.material)
    }
}

/// How near a solid that is relaxed is to its static state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationProgress {
    /// Unbalanced force over the larger of loads and reactions.
    pub out_of_balance: f64,
    /// At or below this the state counts as static.
    pub tolerance: f64,
    /// Whether the solid has found it.
    pub relaxed: bool,
}

/// What the run loop needs of a built case.
pub trait Simulation: Send {
    /// Numbers of particles and points now.
    fn counts(&self) -> Counts;

    /// Simulated time (s).
    fn time(&self) -> f64;

    /// Completed steps.
    fn steps(&self) -> u64;

    /// Solid sub-steps of the last step.
    fn substeps(&self) -> u32;

    /// Stable time step and what limits it.
    ///
    /// # Errors
    /// The state is not finite.
    fn time_step(&self) -> Result<TimeStepLimit, CouplingError>;

    /// One coupled step of `dt` (s).
    ///
    /// # Errors
    /// A side refuses its part.
    fn step(&mut self, dt: f64) -> Result<(), CouplingError>;

    /// Names and units of the gauge row.
    fn gauge_columns(&self) -> Vec<Column>;

    /// Gauge values now.
    fn gauge_row(&mut self) -> Vec<f64>;

    /// Names and units of the ledger row.
    fn ledger_columns(&self) -> Vec<Column>;

    /// Ledger values now; starts a new row.
    fn ledger_row(&mut self) -> Vec<f64>;

    /// Whether the solid was to be relaxed and has found its static state.
    fn is_relaxed(&self) -> bool;

    /// How far the search for a static state is, if there is one.
    fn relaxation(&self) -> Option<RelaxationProgress>;

    /// Conservation figures of the whole run for the summary.
    fn totals(&self) -> Totals;

    /// Points that never move.
    fn static_clouds(&self) -> Vec<PointCloud>;

    /// Everything that moves, as frame number `index`.
    fn frame(&self, index: u64) -> Frame;

    /// Gauge names with their places, for the viewer.
    fn markers(&self) -> Vec<(String, [f64; 3])>;

    /// Adds the complete state to a checkpoint.
    fn save(&self, checkpoint: &mut Checkpoint);

    /// Continues from a checkpoint, bit for bit.
    ///
    /// # Errors
    /// An entry is missing or has another length than this case needs.
    fn load(&mut self, checkpoint: &Checkpoint) -> Result<(), Failure>;
}

/// Builds the solvers of a checked case.
///
/// # Errors
/// The case cannot be seeded, or a solver refuses its input.
pub fn assemble(case: &Case) -> Result<Box<dyn Simulation>, Failure> {
    assemble_with_notes(case).map(|(simulation, _)| simulation)
}

/// The same, with what was built: one line a block, wall and body.
///
/// # Errors
/// See [`assemble`].
pub fn assemble_with_notes(case: &Case) -> Result<(Box<dyn Simulation>, Vec<String>), Failure> {
    fn join<const D: usize>(
        mut model: Model<D>,
    ) -> Result<(Box<dyn Simulation>, Vec<String>), Failure> {
        let notes = std::mem::take(&mut model.notes);
        Ok((assemble_dimension(model)?, notes))
    }
    match case.dimension() {
        2 => join(case.build::<2>()?),
        _ => join(case.build::<3>()?),
    }
}

fn assemble_dimension<const D: usize>(model: Model<D>) -> Result<Box<dyn Simulation>, Failure>
where
    Fluid<D>: Send,
{
    let fluid = match model.fluid {
        Some(fluid) => Some(
            Fluid::new(fluid.parameters, fluid.particles, fluid.walls).map_err(Failure::input)?,
        ),
        None => None,
    };
    let solid = match model.solid {
        Some(model) => {
            let mut solid = Solid::new(model.parameters, model.bodies, model.constraints)
                .map_err(Failure::input)?;
            solid.set_surface_loads(model.loads).map_err(Failure::input)?;
            Some(solid)
        }
        None => None,
    };
    let parameters = model.coupling;
    let gauges = model.gauges;
    Ok(match (fluid, solid) {
        (Some(fluid), Some(solid)) => {
            let coupled = Coupled::new(fluid, solid, parameters).map_err(Failure::input)?;
            Box::new(Assembled::<D, _, _>::new(coupled, gauges))
        }
        (Some(fluid), None) => {
            let coupled = Coupled::new(fluid, NoSolid, parameters).map_err(Failure::input)?;
            Box::new(Assembled::<D, _, _>::new(coupled, gauges))
        }
        (None, Some(solid)) => {
            let coupled = Coupled::new(NoFluid, solid, parameters).map_err(Failure::input)?;
            Box::new(Assembled::<D, _, _>::new(coupled, gauges))
        }
        (None, None) => {
            return Err(Failure::input(
                "the case has neither `fluid` nor `solid`; give at least one",
            ));
        }
    })
}
