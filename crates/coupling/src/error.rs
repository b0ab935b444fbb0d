use gimpm::SolidError;
use sph::FluidError;

/// Why a coupled step could not be taken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CouplingError {
    /// The fluid refused its step.
    #[error(transparent)]
    Fluid(#[from] FluidError),
    /// The solid refused one of its sub-steps.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// The stiff solid would need more sub-steps than allowed.
    #[error(
        "the solid needs {needed} sub-steps in one fluid step of {time_step:.3e} s, more than the allowed {allowed}; \
         use a coarser solid grid, a softer or denser material, or raise `coupling.largest_substep_count`"
    )]
    TooManySubsteps {
        /// Sub-steps that stability asks for.
        needed: u64,
        /// `CouplingParameters::largest_substep_count`.
        allowed: u32,
        /// The fluid's time step (s).
        time_step: f64,
    },
    /// A coupling parameter is out of range.
    #[error("coupling parameter `{name}` is {value}; it must be {allowed}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
}
