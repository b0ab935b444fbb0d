//! The fluid and the rigid walls as written in a case file.

use serde::Deserialize;

use super::{ShapeForm, VectorForm, WallMotionForm};

/// The water: weakly compressible SPH.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Fluid")]
pub struct FluidForm {
    /// Particle spacing dx (m).
    pub spacing: f64,
    /// Reference density ρ0 (kg/m³). Default 1000.
    #[serde(default = "water_density")]
    pub density: f64,
    /// Smoothing length over spacing, h/dx, 1.2 to 2.0. Default 1.5.
    #[serde(default = "smoothing_ratio")]
    pub smoothing_ratio: f64,
    /// Numerical speed of sound c0. Default `Factor(20)`.
    #[serde(default)]
    pub sound_speed: SoundSpeedForm,
    /// Largest speed expected (m/s), for the check c0 ≥ 10 U. Default 2√(gH)
    /// with H the height of the fluid.
    #[serde(default)]
    pub maximum_speed: Option<f64>,
    /// Density diffusion δ of Fourtakas et al. (2019), 0 to 0.2. Default 0.1.
    #[serde(default = "density_diffusion")]
    pub density_diffusion: f64,
    /// Numerical dissipation. Default `Artificial(alpha: 0.02)`.
    #[serde(default)]
    pub dissipation: DissipationForm,
    /// Factor of the acoustic time step, above 0, at most 1. Default 0.6.
    #[serde(default = "fluid_courant_number")]
    pub courant_number: f64,
    /// A corner of the particle lattice (m): particles sit at `lattice_origin + (i + ½) dx`.
    /// Default: the lower corner of the first block.
    #[serde(default)]
    pub lattice_origin: Option<VectorForm>,
    /// What to do with block faces that miss the lattice. Default `Exact`.
    #[serde(default)]
    pub fit: Fit,
    /// Where the water is at the start; at least one block.
    pub blocks: Vec<BlockForm>,
}

/// Treatment of fluid block faces that do not lie on the particle lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum Fit {
    /// Refuse them.
    #[default]
    Exact,
    /// Move them to the nearest lattice plane (at most dx/2) and say so.
    Nearest,
}

/// Numerical speed of sound.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "SoundSpeed")]
pub enum SoundSpeedForm {
    /// c0 = factor √(g H), H the height of the fluid at the start.
    Factor(f64),
    /// c0 itself (m/s).
    Fixed(f64),
}

impl Default for SoundSpeedForm {
    fn default() -> Self {
        Self::Factor(20.0)
    }
}

/// Numerical dissipation of the momentum equation.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Dissipation")]
pub enum DissipationForm {
    /// None.
    None,
    /// Artificial viscosity (Monaghan 1992).
    Artificial {
        /// Coefficient α, 0 to 1.
        alpha: f64,
    },
    /// Low-dissipation Riemann solver (Zhang, Hu, Adams 2017).
    Riemann {
        /// Limiter coefficient, above 0. Default 3.
        #[serde(default = "riemann_limiter")]
        limiter: f64,
    },
}

impl Default for DissipationForm {
    fn default() -> Self {
        Self::Artificial { alpha: 0.02 }
    }
}

/// A block of water at rest or moving as one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Block")]
pub struct BlockForm {
    /// Name, unique among all blocks.
    pub name: String,
    /// Where it is.
    pub shape: ShapeForm,
    /// Initial velocity (m/s). Default 0.
    #[serde(default)]
    pub velocity: Option<VectorForm>,
    /// Initial pressure. Default `Hydrostatic`.
    #[serde(default)]
    pub pressure: PressureForm,
}

/// Initial pressure of a block.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, rename = "Pressure")]
pub enum PressureForm {
    /// ρ0 g times the depth below the block's own highest point.
    #[default]
    Hydrostatic,
    /// The same everywhere (Pa).
    Uniform(f64),
}

/// A rigid wall made of dummy particles.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Wall")]
pub struct WallForm {
    /// Name, unique among walls, bodies and boundaries; a `Force` gauge refers to it.
    pub name: String,
    /// `Tank` (walls outside a box) or a shape filled with wall particles.
    pub shape: ShapeForm,
    /// Prescribed translation. Default: fixed.
    #[serde(default)]
    pub motion: Option<WallMotionForm>,
}

fn water_density() -> f64 {
    1000.0
}
fn smoothing_ratio() -> f64 {
    1.5
}
fn density_diffusion() -> f64 {
    0.1
}
fn fluid_courant_number() -> f64 {
    0.6
}
fn riemann_limiter() -> f64 {
    3.0
}
