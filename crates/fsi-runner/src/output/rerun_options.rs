//! How a run is shown in Rerun.

use std::path::PathBuf;

/// More points of one cloud than this are thinned, see [`RerunOptions::point_limit`].
pub const DEFAULT_POINT_LIMIT: usize = 2_000_000;

/// Where the log goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RerunTarget {
    /// Into an `.rrd` file.
    File(PathBuf),
    /// To a viewer that is started for it, listening on 127.0.0.1 only.
    Spawn,
    /// To a viewer that runs, e.g. `rerun+http://127.0.0.1:9876/proxy`.
    Connect(String),
}

/// What colours the fluid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FluidColour {
    /// Pressure.
    #[default]
    Pressure,
    /// Length of the velocity.
    Speed,
}

/// What colours the solids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "kebab-case")]
pub enum SolidColour {
    /// Von Mises equivalent stress.
    #[default]
    Stress,
    /// Equivalent plastic strain.
    PlasticStrain,
    /// Length of the displacement.
    Displacement,
}

/// A gauge's place in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Shown beside it.
    pub name: String,
    /// (m); z = 0 in two dimensions.
    pub position: [f64; 3],
}

/// Choices for a log.
#[derive(Clone, Debug, PartialEq)]
pub struct RerunOptions {
    /// Where the log goes.
    pub target: RerunTarget,
    /// What colours the fluid.
    pub fluid_colour: FluidColour,
    /// What colours the solids.
    pub solid_colour: SolidColour,
    /// Larger clouds are thinned to every n-th point (by identity, so that the
    /// same points stay), and the legend says so.
    pub point_limit: usize,
    /// Gauges to show in the scene.
    pub markers: Vec<Marker>,
}

impl RerunOptions {
    /// Pressure and stress, no markers.
    pub fn new(target: RerunTarget) -> Self {
        Self {
            target,
            fluid_colour: FluidColour::default(),
            solid_colour: SolidColour::default(),
            point_limit: DEFAULT_POINT_LIMIT,
            markers: Vec::new(),
        }
    }
}

impl std::fmt::Display for RerunTarget {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Spawn => write!(f, "a new viewer"),
            Self::Connect(address) => write!(f, "{address}"),
        }
    }
}
