//! Motion laws as written in a case file.

use motion::Motion;
use serde::Deserialize;

use super::VectorForm;

/// Translation of a wall along one direction.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "WallMotion")]
pub struct WallMotionForm {
    /// Direction; its length is ignored.
    pub direction: VectorForm,
    /// Law of motion along it.
    pub law: LawForm,
}

/// Velocity of a driven wall or node set over time; see [`motion::Motion`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Law")]
pub enum LawForm {
    /// Held in place.
    Fixed,
    /// Constant velocity from the first instant.
    Constant {
        /// Velocity (m/s).
        velocity: f64,
    },
    /// Velocity grows linearly, then stays.
    Ramp {
        /// Final velocity (m/s).
        velocity: f64,
        /// Length of the ramp (s), above 0.
        duration: f64,
    },
    /// Quintic start without ringing, then constant velocity.
    SmoothStart {
        /// Final velocity (m/s).
        velocity: f64,
        /// Length of the start (s), above 0.
        duration: f64,
    },
    /// Displacement read off a table, linear between rows.
    Table {
        /// Rows `(time s, displacement m)`, times increasing; at least two.
        rows: Vec<(f64, f64)>,
    },
}

impl LawForm {
    /// The law as the solvers know it.
    pub fn motion(&self) -> Motion {
        match self {
            Self::Fixed => Motion::Fixed,
            Self::Constant { velocity } => Motion::Constant { velocity: *velocity },
            Self::Ramp { velocity, duration } => {
                Motion::Ramp { velocity: *velocity, duration: *duration }
            }
            Self::SmoothStart { velocity, duration } => {
                Motion::SmoothStart { velocity: *velocity, duration: *duration }
            }
            Self::Table { rows } => Motion::Table { rows: rows.clone() },
        }
    }
}
