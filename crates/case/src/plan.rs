//! A case whose every field has been checked, before anything is seeded.

use gimpm::{Contact, Discretisation, MaterialModel, Relaxation, StressUpdate};
use motion::Motion;

use crate::Estimate;
use crate::format::{CorrectorsForm, DissipationForm, PressureForm};
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
    pub(crate) stress_update: StressUpdate,
    pub(crate) contact: Option<Contact>,
    pub(crate) relaxation: Option<Relaxation>,
    pub(crate) courant_number: f64,
    pub(crate) damping: f64,
    pub(crate) gravity_ramp: f64,
    pub(crate) bodies: Vec<BodyPlan>,
}

#[derive(Debug, Clone)]
pub(crate) struct BodyPlan {
    pub(crate) name: String,
    pub(crate) region: Region,
    pub(crate) material: MaterialModel,
    /// Name of the law, as in the file.
    pub(crate) law: &'static str,
    pub(crate) discretisation: Discretisation,
    pub(crate) velocity: Point,
    pub(crate) mode: Option<ModePlan>,
    /// Lattice of the material points, a plane of it on every constrained face.
    pub(crate) lattice: Lattice,
    pub(crate) boundaries: Vec<BoundaryPlan>,
    pub(crate) loads: Vec<LoadPlan>,
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
    pub(crate) hold: HoldPlan,
}

/// What a boundary prescribes.
#[derive(Debug, Clone)]
pub(crate) enum HoldPlan {
    Components([Option<Motion>; 3]),
    /// Along a unit vector from the support into the body.
    Normal {
        direction: Point,
        motion: Motion,
        one_sided: bool,
    },
}

impl HoldPlan {
    /// All prescribed motions.
    pub(crate) fn motions(&self) -> impl Iterator<Item = &Motion> {
        let (components, normal) = match self {
            Self::Components(components) => (components.as_slice(), None),
            Self::Normal { motion, .. } => (&[][..], Some(motion)),
        };
        components.iter().flatten().chain(normal)
    }
}

#[derive(Debug, Clone)]
pub(crate) struct LoadPlan {
    pub(crate) name: String,
    pub(crate) axis: usize,
    pub(crate) upper_side: bool,
    /// Box around the centres of the loaded faces.
    pub(crate) lower: Point,
    pub(crate) upper: Point,
    pub(crate) kind: LoadKindPlan,
    /// (s).
    pub(crate) ramp: f64,
}

#[derive(Debug, Clone)]
pub(crate) enum LoadKindPlan {
    Traction(Point),
    Pressure(f64),
    Hydrostatic { level: f64, specific_weight: f64 },
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
    CenterOfMass(usize),
    Force(ForceTarget, Point),
}
