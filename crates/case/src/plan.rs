//! A case whose every field has been checked, before anything is seeded.

use gimpm::LinearElastic;
use motion::Motion;

use crate::Estimate;
use crate::format::{CorrectorsForm, DissipationForm, PressureForm, ShapeFunctionForm};
use crate::geometry::{Point, Region};
use crate::lattice::Lattice;
use crate::model::{ForceTarget, OutputIntervals};

/// The checked case with shapes resolved; vectors have three components.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    pub(crate) dimension: usize,
    pub(crate) gravity: Point,
    pub(crate) end_time: f64,
    pub(crate) domain: (Point, Point),
    pub(crate) fluid: Option<FluidPlan>,
    pub(crate) walls: Vec<WallPlan>,
    pub(crate) solid: Option<SolidPlan>,
    pub(crate) correctors: CorrectorsForm,
    pub(crate) gauges: Vec<GaugePlan>,
    pub(crate) output: OutputIntervals,
    pub(crate) estimate: Estimate,
    pub(crate) warnings: Vec<String>,
}

#[derive(Debug, Clone)]
pub(crate) struct FluidPlan {
    pub(crate) lattice: Lattice,
    pub(crate) density: f64,
    pub(crate) smoothing_length: f64,
    pub(crate) sound_speed: f64,
    /// Largest speed expected (m/s).
    pub(crate) maximum_speed: f64,
    pub(crate) density_diffusion: f64,
    pub(crate) dissipation: DissipationForm,
    pub(crate) courant_number: f64,
    pub(crate) blocks: Vec<BlockPlan>,
    /// Wall layers needed to fill the kernel.
    pub(crate) layers: i64,
}

impl FluidPlan {
    /// Particle spacing dx (m).
    pub(crate) fn spacing(&self) -> f64 {
        self.lattice.spacing
    }

    /// Reach of the kernel 2h (m).
    pub(crate) fn kernel_radius(&self) -> f64 {
        2.0 * self.smoothing_length
    }
}

#[derive(Debug, Clone)]
pub(crate) struct BlockPlan {
    pub(crate) name: String,
    pub(crate) region: Region,
    pub(crate) velocity: Point,
    pub(crate) pressure: PressureForm,
}

#[derive(Debug, Clone)]
pub(crate) struct WallPlan {
    pub(crate) name: String,
    pub(crate) shape: WallShape,
    /// Unit direction and law.
    pub(crate) motion: Option<(Point, Motion)>,
}

#[derive(Debug, Clone)]
pub(crate) enum WallShape {
    /// Walls outside the box on every axis and side that is `closed`.
    Tank { lower: Point, upper: Point, closed: [[bool; 2]; 3] },
    /// Filled with wall particles.
    Filled(Region),
}

#[derive(Debug, Clone)]
pub(crate) struct SolidPlan {
    /// Nodes are the corners of its cells.
    pub(crate) grid: Lattice,
    pub(crate) cells: [usize; 3],
    pub(crate) point_spacing: f64,
    pub(crate) shape_function: ShapeFunctionForm,
    pub(crate) courant_number: f64,
    pub(crate) damping: f64,
    pub(crate) bodies: Vec<BodyPlan>,
}

#[derive(Debug, Clone)]
pub(crate) struct BodyPlan {
    pub(crate) name: String,
    pub(crate) region: Region,
    pub(crate) material: LinearElastic,
    pub(crate) velocity: Point,
    pub(crate) mode: Option<ModePlan>,
    /// Lattice of the material points, a plane of it on every constrained face.
    pub(crate) lattice: Lattice,
    pub(crate) boundaries: Vec<BoundaryPlan>,
}

/// `v = amplitude sin(2π (x·axis - origin)/wavelength)`.
#[derive(Debug, Clone)]
pub(crate) struct ModePlan {
    pub(crate) amplitude: Point,
    pub(crate) axis: Point,
    pub(crate) origin: f64,
    pub(crate) wavelength: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct BoundaryPlan {
    pub(crate) name: String,
    pub(crate) lower: Point,
    pub(crate) upper: Point,
    pub(crate) components: [Option<Motion>; 3],
}

#[derive(Debug, Clone)]
pub(crate) struct GaugePlan {
    pub(crate) name: String,
    pub(crate) kind: GaugeKindPlan,
}

#[derive(Debug, Clone)]
pub(crate) enum GaugeKindPlan {
    Pressure(Point),
    Velocity(Point),
    WaterLevel(Point, Point),
    Front(Point),
    Displacement(usize, Point),
    Stress(usize, Point),
    Force(ForceTarget, Point),
}
