//! Gauges as written in a case file.

use serde::Deserialize;

use super::VectorForm;

/// A quantity recorded over time.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Gauge")]
pub enum GaugeForm {
    /// Fluid pressure at a fixed point (Pa).
    Pressure {
        /// Name, unique among gauges.
        name: String,
        /// Where (m), inside the domain.
        position: VectorForm,
    },
    /// Fluid velocity at a fixed point (m/s).
    Velocity {
        /// Name, unique among gauges.
        name: String,
        /// Where (m), inside the domain.
        position: VectorForm,
    },
    /// Water level along a line, as distance from its base (m).
    WaterLevel {
        /// Name, unique among gauges.
        name: String,
        /// Lower end of the line (m).
        base: VectorForm,
        /// Upper end of the line (m).
        top: VectorForm,
    },
    /// Position of the water's front along a direction (m).
    Front {
        /// Name, unique among gauges.
        name: String,
        /// Direction; its length is ignored.
        direction: VectorForm,
    },
    /// Displacement of the material point nearest to a place in the undeformed body (m).
    Displacement {
        /// Name, unique among gauges.
        name: String,
        /// Where in the undeformed body (m).
        position: VectorForm,
    },
    /// Stress at the material point nearest to a place in the undeformed body (Pa).
    Stress {
        /// Name, unique among gauges.
        name: String,
        /// Where in the undeformed body (m).
        position: VectorForm,
    },
    /// Displacement (m) and velocity (m/s) of a body's centre of mass.
    CenterOfMass {
        /// Name, unique among gauges.
        name: String,
        /// Name of the body.
        of: String,
    },
    /// Force (N, in 2D N/m) and moment (N m, in 2D N) on a wall or body, or the
    /// reaction of a boundary.
    Force {
        /// Name, unique among gauges.
        name: String,
        /// Name of a wall, body or boundary.
        on: String,
        /// Point about which the moment is taken (m). Default the origin.
        #[serde(default)]
        about: Option<VectorForm>,
    },
}

impl GaugeForm {
    /// Name of the gauge.
    pub fn name(&self) -> &str {
        match self {
            Self::Pressure { name, .. }
            | Self::Velocity { name, .. }
            | Self::WaterLevel { name, .. }
            | Self::Front { name, .. }
            | Self::Displacement { name, .. }
            | Self::Stress { name, .. }
            | Self::CenterOfMass { name, .. }
            | Self::Force { name, .. } => name,
        }
    }
}
