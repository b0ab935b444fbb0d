//! Choices of discretisation as written in a case file.

use serde::Deserialize;

/// Configuration in which a body is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename = "Frame")]
pub enum FrameForm {
    /// The reference one: nothing crosses cells, for bodies that do not break or collide.
    Total,
    /// The current one, on the background grid: for bodies that break, flow or collide.
    Updated,
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
    /// Contiguous-particle GIMP: boxes stretch along the axes.
    Cpgimp,
    /// Convected particle domain interpolation: boxes stretch and shear.
    Cpdi,
}

/// Transfer of velocity between grid and points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(deny_unknown_fields, rename = "Transfer")]
pub enum TransferForm {
    /// Points take accelerations (the founding paper).
    #[default]
    Flip,
    /// Affine particle in cell (Jiang et al. 2015).
    Apic,
    /// Taylor particle in cell (Nakamura, Matsumura and Mizutani 2023).
    Tpic,
    /// Full mass matrix PIC (Nairn and Hammerquist 2021).
    Fmpm {
        /// Terms of the inverse mass matrix, 1 (PIC) to 20.
        order: u32,
    },
}

/// When in a step the stress is updated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename = "StressUpdate")]
pub enum StressUpdateForm {
    /// Modified update stress last (the founding paper).
    #[default]
    Musl,
    /// Update stress first.
    Usf,
    /// Update stress last.
    Usl,
}

/// Contact between bodies.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Contact")]
pub struct ContactForm {
    /// Coulomb's friction coefficient μ, at least 0. Default 0: they slide freely.
    #[serde(default)]
    pub friction: f64,
}

/// Search for the static state.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "Relaxation")]
pub struct RelaxationForm {
    /// Unbalanced force over the larger of loads and reactions at which the solid is
    /// at rest, above 0, at most 0.1. Default 1e-6.
    #[serde(default = "relaxation_tolerance")]
    pub tolerance: f64,
}

fn relaxation_tolerance() -> f64 {
    1e-6
}
