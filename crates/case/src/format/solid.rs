//! The deformable bodies as written in a case file.

use serde::Deserialize;

use super::{
    BoundaryForm, ContactForm, FrameForm, LoadForm, MaterialForm, RelaxationForm, ShapeForm,
    ShapeFunctionForm, StressUpdateForm, TransferForm, VectorForm,
};

/// The solid: GIMPM bodies on one background grid.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Solid")]
pub struct SolidForm {
    /// Grid spacing H (m).
    pub grid_spacing: f64,
    /// Material points per cell and direction, 1 to 4. Default 2.
    #[serde(default = "points_per_cell")]
    pub points_per_cell: u32,
    /// Configuration of all bodies. Default `Total`; `Updated` with `contact`.
    #[serde(default)]
    pub frame: Option<FrameForm>,
    /// Grid shape function of all bodies. Default `Ugimp`.
    #[serde(default)]
    pub shape_function: Option<ShapeFunctionForm>,
    /// Transfer of velocity of all bodies. Default `Flip`.
    #[serde(default)]
    pub transfer: TransferForm,
    /// When in a step the stress is updated. Default `Musl`.
    #[serde(default)]
    pub stress_update: StressUpdateForm,
    /// Contact between bodies. Default none: where they meet in the updated frame, they stick.
    #[serde(default)]
    pub contact: Option<ContactForm>,
    /// Search for the static state. Default none: the motion is dynamic.
    #[serde(default)]
    pub relaxation: Option<RelaxationForm>,
    /// Factor of the time step, above 0, at most 1. Default 0.5.
    #[serde(default = "solid_courant_number")]
    pub courant_number: f64,
    /// Local damping, 0 (none) to below 1. Default 0, with `relaxation` 0.8.
    #[serde(default)]
    pub damping: Option<f64>,
    /// Time over which gravity rises smoothly from nothing in the solid (s).
    /// Default 0: at once.
    #[serde(default)]
    pub gravity_ramp: f64,
    /// Free space around the bodies that the grid covers (m).
    /// Default: three cells or a quarter of the bodies' largest extent, whichever is more.
    #[serde(default)]
    pub grid_margin: Option<f64>,
    /// The bodies; at least one.
    pub bodies: Vec<BodyForm>,
}

/// One body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Body")]
pub struct BodyForm {
    /// Name, unique among walls, bodies, boundaries and loads.
    pub name: String,
    /// Where it is.
    pub shape: ShapeForm,
    /// What it is made of.
    pub material: MaterialForm,
    /// Configuration of this body. Default that of the solid.
    #[serde(default)]
    pub frame: Option<FrameForm>,
    /// Grid shape function of this body. Default that of the solid.
    #[serde(default)]
    pub shape_function: Option<ShapeFunctionForm>,
    /// Transfer of velocity of this body. Default that of the solid.
    #[serde(default)]
    pub transfer: Option<TransferForm>,
    /// Whether the volume change is averaged over each cell (J-bar), against locking of
    /// nearly incompressible bodies. Default no.
    #[serde(default)]
    pub mean_dilatation: bool,
    /// Initial velocity (m/s). Default 0.
    #[serde(default)]
    pub velocity: Option<VectorForm>,
    /// A vibration mode added to the initial velocity. Default none.
    #[serde(default)]
    pub velocity_mode: Option<VelocityModeForm>,
    /// Where it is held or driven. Default nowhere.
    #[serde(default)]
    pub boundaries: Vec<BoundaryForm>,
    /// Loads on its surface. Default none.
    #[serde(default)]
    pub loads: Vec<LoadForm>,
}

/// Initial velocity that varies over a body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "VelocityMode")]
pub enum VelocityModeForm {
    /// `v = amplitude · direction · sin(2π (x·axis - origin)/wavelength)`.
    Sine {
        /// Direction of the velocity; its length is ignored.
        direction: VectorForm,
        /// Direction along which it varies; its length is ignored.
        axis: VectorForm,
        /// Coordinate of a node of the wave along `axis` (m). Default 0.
        #[serde(default)]
        origin: f64,
        /// Amplitude (m/s).
        amplitude: f64,
        /// Wavelength (m), above 0. A bar clamped at one end has 4 L in mode 1.
        wavelength: f64,
    },
}

fn points_per_cell() -> u32 {
    2
}
fn solid_courant_number() -> f64 {
    0.5
}
