//! Boundaries and loads of a body as written in a case file.

use serde::Deserialize;

use super::{LawForm, VectorForm};

/// A part of a body that is held or driven.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Boundary")]
pub struct BoundaryForm {
    /// Name, unique among walls, bodies, boundaries and loads.
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
    /// A plane of symmetry: nothing moves across the face, everything along it.
    Symmetry,
    /// The motion along a normal is prescribed, that across it is free.
    Slip {
        /// From the support into the body; its length is ignored. Default: of the face.
        #[serde(default)]
        normal: Option<VectorForm>,
        /// Motion along the normal. Default `Fixed`.
        #[serde(default)]
        law: Option<LawForm>,
    },
    /// The same, but the support only pushes: the body may lift off and come back.
    Support {
        /// From the support into the body; its length is ignored. Default: of the face.
        #[serde(default)]
        normal: Option<VectorForm>,
        /// Motion along the normal. Default `Fixed`.
        #[serde(default)]
        law: Option<LawForm>,
    },
}

/// A load on a part of a body's surface.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Load")]
pub struct LoadForm {
    /// Name, unique among walls, bodies, boundaries and loads.
    pub name: String,
    /// Which part of the undeformed surface it acts on.
    #[serde(rename = "where")]
    pub location: LoadLocationForm,
    /// What acts.
    pub kind: LoadKindForm,
    /// Time over which it rises smoothly from nothing (s). Default 0: at once.
    #[serde(default)]
    pub ramp: f64,
}

/// Part of a body's undeformed surface.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "LoadLocation")]
pub enum LoadLocationForm {
    /// The surface on a face of the body's bounding box: one of `x- x+ y- y+ z- z+`.
    Face(String),
    /// The surface in a closed box that looks along one axis.
    Region {
        /// Where it looks: one of `x- x+ y- y+ z- z+`.
        face: String,
        /// Lower corner (m).
        lower: VectorForm,
        /// Upper corner (m).
        upper: VectorForm,
    },
}

/// What acts on a loaded surface.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "LoadKind")]
pub enum LoadKindForm {
    /// Force per undeformed area (Pa), of constant direction.
    Traction(VectorForm),
    /// Pressure against the current surface (Pa).
    Pressure(f64),
    /// Pressure of still water against the current surface.
    Hydrostatic {
        /// Height of its level (m).
        level: f64,
        /// Its density (kg/m³). Default that of the case's fluid, else 1000.
        #[serde(default)]
        density: Option<f64>,
    },
}
