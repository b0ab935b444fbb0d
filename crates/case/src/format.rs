//! The case file as written: RON, SI units, unknown fields refused.
//!
//! These types hold what the file says, before any check; [`crate::Case`] holds
//! a checked file. `docs/case.md` lists every field with unit, default and
//! allowed range.

mod boundary;
mod discretisation;
mod fluid;
mod gauge;
mod material;
mod motion;
mod shape;
mod solid;

use serde::Deserialize;

pub use boundary::{
    BoundaryForm, BoundaryMotionForm, LoadForm, LoadKindForm, LoadLocationForm, LocationForm,
};
pub use discretisation::{
    ContactForm, FrameForm, RelaxationForm, ShapeFunctionForm, StressUpdateForm, TransferForm,
};
pub use fluid::{
    BlockForm, DissipationForm, Fit, FluidForm, PressureForm, SoundSpeedForm, WallForm,
};
pub use gauge::GaugeForm;
pub use material::MaterialForm;
pub use motion::{LawForm, WallMotionForm};
pub use shape::{OperationForm, RotationForm, ShapeForm};
pub use solid::{BodyForm, SolidForm, VelocityModeForm};

/// A vector in metres (or m/s, m/s²): two components in 2D `[x, y]`, y up;
/// three in 3D `[x, y, z]`, z up.
pub type VectorForm = Vec<f64>;

/// A whole case file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Case")]
pub struct CaseForm {
    /// Name of the case: letters, digits, `_` and `-`; names the output folder.
    pub name: String,
    /// What the case shows, for people.
    #[serde(default)]
    pub description: String,
    /// 2: plane strain (x, y); 3: (x, y, z).
    pub dimension: usize,
    /// Acceleration of gravity (m/s²). Default `[0, 0, -9.81]` or `[0, -9.81]`.
    #[serde(default)]
    pub gravity: Option<VectorForm>,
    /// Simulated time (s).
    pub end_time: f64,
    /// Box outside which a fluid particle is removed and counted.
    /// Default: the geometry, widened by a quarter of its largest extent.
    #[serde(default)]
    pub domain: Option<DomainForm>,
    /// The water; leave out for a case with solids only.
    #[serde(default)]
    pub fluid: Option<FluidForm>,
    /// Rigid walls, fixed or moving; they need a fluid.
    #[serde(default)]
    pub walls: Vec<WallForm>,
    /// The deformable bodies; leave out for a case with fluid only.
    #[serde(default)]
    pub solid: Option<SolidForm>,
    /// How fluid and solid are coupled.
    #[serde(default)]
    pub coupling: CouplingForm,
    /// What is recorded over time.
    #[serde(default)]
    pub gauges: Vec<GaugeForm>,
    /// How often results are written.
    pub output: OutputForm,
}

/// An axis-aligned box.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Domain")]
pub struct DomainForm {
    /// Lower corner (m).
    pub lower: VectorForm,
    /// Upper corner (m).
    pub upper: VectorForm,
}

/// Coupling options.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename = "Coupling")]
pub struct CouplingForm {
    /// Corrector passes of the coupled step. Default `Auto`.
    pub correctors: CorrectorsForm,
}

/// Number of corrector passes in a coupled step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(deny_unknown_fields, rename = "Correctors")]
pub enum CorrectorsForm {
    /// One; three when the structure is light against the water (μ < 3).
    #[default]
    Auto,
    /// This many, 0 to 3.
    Fixed(u32),
}

/// Output intervals.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Output")]
pub struct OutputForm {
    /// Simulated time between frames of all particles (s).
    pub frame_interval: f64,
    /// Simulated time between gauge records (s). Default: a tenth of `frame_interval`.
    #[serde(default)]
    pub gauge_interval: Option<f64>,
    /// Simulated time between checkpoints (s). Default: only at the end and on Ctrl-C.
    #[serde(default)]
    pub checkpoint_interval: Option<f64>,
}
