//! The deformable bodies as written in a case file.

use serde::Deserialize;

use super::{LawForm, ShapeForm, VectorForm};

/// The solid: GIMPM bodies on one background grid.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Solid")]
pub struct SolidForm {
    /// Grid spacing H (m).
    pub grid_spacing: f64,
    /// Material points per cell and direction, 1 to 4. Default 2.
    #[serde(default = "points_per_cell")]
    pub points_per_cell: u32,
    /// Grid shape function. Default `Ugimp`.
    #[serde(default)]
    pub shape_function: ShapeFunctionForm,
    /// Factor of the time step, above 0, at most 1. Default 0.5.
    #[serde(default = "solid_courant_number")]
    pub courant_number: f64,
    /// Local damping, 0 (none, the default) to below 1.
    #[serde(default)]
    pub damping: f64,
    /// Free space around the bodies that the grid covers (m).
    /// Default: three cells or a quarter of the bodies' largest extent, whichever is more.
    #[serde(default)]
    pub grid_margin: Option<f64>,
    /// The bodies; at least one.
    pub bodies: Vec<BodyForm>,
}

/// Grid shape function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename = "ShapeFunction")]
pub enum ShapeFunctionForm {
    /// Uniform GIMP (Bardenhagen and Kober 2004).
    #[default]
    Ugimp,
    /// Linear (the original MPM).
    Linear,
}

/// One body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Body")]
pub struct BodyForm {
    /// Name, unique among walls, bodies and boundaries.
    pub name: String,
    /// Where it is.
    pub shape: ShapeForm,
    /// What it is made of.
    pub material: MaterialForm,
    /// Initial velocity (m/s). Default 0.
    #[serde(default)]
    pub velocity: Option<VectorForm>,
    /// A vibration mode added to the initial velocity. Default none.
    #[serde(default)]
    pub velocity_mode: Option<VelocityModeForm>,
    /// Where it is held or driven. Default nowhere.
    #[serde(default)]
    pub boundaries: Vec<BoundaryForm>,
}

/// Constitutive law and its constants.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Material")]
pub enum MaterialForm {
    /// Isotropic linear elasticity with an objective stress rate.
    LinearElastic {
        /// Density (kg/m³), above 0.
        density: f64,
        /// Young's modulus E (Pa), above 0.
        young_modulus: f64,
        /// Poisson's ratio ν, above -1 and below 0.5.
        poisson_ratio: f64,
    },
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

/// A part of a body that is held or driven.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Boundary")]
pub struct BoundaryForm {
    /// Name, unique among walls, bodies and boundaries.
    pub name: String,
    /// Which grid nodes it holds.
    #[serde(rename = "where")]
    pub location: LocationForm,
    /// How they move.
    pub motion: BoundaryMotionForm,
}

/// Which grid nodes a boundary holds.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Location")]
pub enum LocationForm {
    /// All nodes at and beyond a face of the body's bounding box:
    /// one of `x- x+ y- y+ z- z+`. The face must lie on a grid plane.
    Face(String),
    /// All nodes in a closed box.
    Region {
        /// Lower corner (m).
        lower: VectorForm,
        /// Upper corner (m).
        upper: VectorForm,
    },
}

/// Motion of the nodes of a boundary.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "BoundaryMotion")]
pub enum BoundaryMotionForm {
    /// No component moves.
    Fixed,
    /// Component by component; a component left out is free.
    Driven {
        /// Law along x.
        #[serde(default)]
        x: Option<LawForm>,
        /// Law along y.
        #[serde(default)]
        y: Option<LawForm>,
        /// Law along z (3D).
        #[serde(default)]
        z: Option<LawForm>,
    },
}

fn points_per_cell() -> u32 {
    2
}
fn solid_courant_number() -> f64 {
    0.5
}
