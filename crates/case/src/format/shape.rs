//! Shapes as written in a case file.

use serde::Deserialize;

use super::VectorForm;

/// A region of space.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Shape")]
pub enum ShapeForm {
    /// The rigid walls around a box of free space; only as the shape of a wall.
    Tank {
        /// Lower corner of the inside (m).
        lower: VectorForm,
        /// Upper corner of the inside (m).
        upper: VectorForm,
        /// Faces without a wall: any of `x- x+ y- y+ z- z+`. Default none.
        #[serde(default)]
        open: Vec<String>,
    },
    /// An axis-aligned box (rectangle in 2D).
    Box {
        /// Lower corner (m).
        lower: VectorForm,
        /// Upper corner (m).
        upper: VectorForm,
    },
    /// A circular cylinder (3D).
    Cylinder {
        /// Centre of one end (m).
        base: VectorForm,
        /// Centre of the other end (m).
        top: VectorForm,
        /// Radius (m), above 0.
        radius: f64,
    },
    /// A sphere (disc in 2D).
    Sphere {
        /// Centre (m).
        center: VectorForm,
        /// Radius (m), above 0.
        radius: f64,
    },
    /// A simple polygon (2D), closed by itself, either way round.
    Polygon {
        /// Corners (m), at least three.
        points: Vec<VectorForm>,
    },
    /// A polygon in the (x, z) plane extruded along y (3D).
    Extrusion {
        /// Corners `[x, z]` (m), at least three.
        points: Vec<VectorForm>,
        /// Start along y (m).
        from: f64,
        /// End along y (m), above `from`.
        to: f64,
    },
    /// All of the shapes together.
    Union(Vec<ShapeForm>),
    /// Shapes added and taken away in the order written.
    Compose(Vec<OperationForm>),
    /// A shape rotated, then translated.
    Moved {
        /// The shape to move.
        shape: std::boxed::Box<ShapeForm>,
        /// Rotation. Default none.
        #[serde(default)]
        rotate: Option<RotationForm>,
        /// Translation (m). Default none.
        #[serde(default)]
        translate: Option<VectorForm>,
    },
}

/// One step of a composition.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Operation")]
pub enum OperationForm {
    /// Adds a shape to what is there.
    Add(ShapeForm),
    /// Takes a shape away from what is there.
    Subtract(ShapeForm),
}

/// A rotation by the right-hand rule.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Rotation")]
pub struct RotationForm {
    /// Axis (3D); left out in 2D, where it points at the reader.
    #[serde(default)]
    pub axis: Option<VectorForm>,
    /// Angle (degrees).
    pub degrees: f64,
    /// A point on the axis (m). Default the origin.
    #[serde(default)]
    pub about: Option<VectorForm>,
}
