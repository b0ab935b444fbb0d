//! A checked case turned into the inputs of the solvers.

use coupling::CouplingParameters;
use gimpm::{BodySeed, NodeConstraint, SolidParameters, SurfaceLoad};
use nalgebra::SVector;
use sph::{FluidParameters, FluidSeed, WallSeed};

use crate::Estimate;

/// Everything a run needs; made by [`crate::Case::build`].
#[derive(Debug, Clone)]
pub struct Model<const D: usize> {
    /// Name of the case.
    pub name: String,
    /// What the case shows.
    pub description: String,
    /// Text of the case with all overrides in place: running it gives this model.
    pub case_text: String,
    /// Acceleration of gravity (m/s²).
    pub gravity: SVector<f64, D>,
    /// Simulated time (s).
    pub end_time: f64,
    /// Lower and upper corner of the region where things may be (m).
    pub domain: (SVector<f64, D>, SVector<f64, D>),
    /// The water and its rigid walls.
    pub fluid: Option<FluidModel<D>>,
    /// The deformable bodies.
    pub solid: Option<SolidModel<D>>,
    /// Settings of the exchange between the two.
    pub coupling: CouplingParameters,
    /// What is recorded, in the order of the case file.
    pub gauges: Vec<Gauge<D>>,
    /// Output intervals.
    pub output: OutputIntervals,
    /// Counts, memory and time steps, with the counts as seeded.
    pub estimate: Estimate,
    /// What was built, one line a block, wall, body: sizes after rounding, counts.
    pub notes: Vec<String>,
    /// What may be wrong but does not forbid the run.
    pub warnings: Vec<String>,
}

/// Inputs of [`sph::Fluid::new`].
#[derive(Debug, Clone)]
pub struct FluidModel<const D: usize> {
    /// Numerical and physical parameters.
    pub parameters: FluidParameters<D>,
    /// Particles, block by block, x fastest.
    pub particles: Vec<FluidSeed<D>>,
    /// Walls in the order of the case file.
    pub walls: Vec<WallSeed<D>>,
}

/// Inputs of [`gimpm::Solid::new`].
#[derive(Debug, Clone)]
pub struct SolidModel<const D: usize> {
    /// Grid and numerical parameters.
    pub parameters: SolidParameters<D>,
    /// Bodies in the order of the case file.
    pub bodies: Vec<BodySeed<D>>,
    /// Boundaries, body by body, in the order of the case file.
    pub constraints: Vec<NodeConstraint<D>>,
    /// Surface loads, body by body, in the order of the case file.
    pub loads: Vec<SurfaceLoad<D>>,
}

/// A recorded quantity with its references resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge<const D: usize> {
    /// Name, unique in the case.
    pub name: String,
    /// What it records.
    pub kind: GaugeKind<D>,
}

/// What a gauge records.
#[derive(Debug, Clone, PartialEq)]
pub enum GaugeKind<const D: usize> {
    /// Fluid pressure at a fixed point (Pa).
    Pressure {
        /// Where (m).
        position: SVector<f64, D>,
    },
    /// Fluid velocity at a fixed point (m/s).
    Velocity {
        /// Where (m).
        position: SVector<f64, D>,
    },
    /// Distance from `base` to the water surface along the line to `top` (m).
    WaterLevel {
        /// Lower end (m).
        base: SVector<f64, D>,
        /// Upper end (m).
        top: SVector<f64, D>,
    },
    /// Position of the front along a unit vector (m).
    Front {
        /// Unit vector.
        direction: SVector<f64, D>,
    },
    /// Displacement of the material point of `body` nearest to `position` at the start (m).
    Displacement {
        /// Index into [`SolidModel::bodies`].
        body: usize,
        /// Where in the undeformed body (m).
        position: SVector<f64, D>,
    },
    /// Stress of the material point of `body` nearest to `position` at the start (Pa).
    Stress {
        /// Index into [`SolidModel::bodies`].
        body: usize,
        /// Where in the undeformed body (m).
        position: SVector<f64, D>,
    },
    /// Displacement (m) and velocity (m/s) of a body's centre of mass.
    CenterOfMass {
        /// Index into [`SolidModel::bodies`].
        body: usize,
    },
    /// Force and moment.
    Force {
        /// On what.
        target: ForceTarget,
        /// Point about which the moment is taken (m).
        about: SVector<f64, D>,
    },
}

/// What a force gauge refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceTarget {
    /// Fluid force on a rigid wall: index into [`FluidModel::walls`].
    Wall(usize),
    /// Fluid force on a body: index into [`SolidModel::bodies`].
    Body(usize),
    /// Reaction of a boundary: index into [`SolidModel::constraints`].
    Boundary(usize),
}

/// How often results are written, in simulated time (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputIntervals {
    /// Between frames of all particles.
    pub frame: f64,
    /// Between gauge records.
    pub gauge: f64,
    /// Between checkpoints; `None`: only at the end and on Ctrl-C.
    pub checkpoint: Option<f64>,
}
