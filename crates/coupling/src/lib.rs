//! Two-way coupling of the SPH fluid and the GIMPM solid.
//!
//! The solid's material points are the wall particles that the fluid sees, and
//! the solid's background grid carries both exchanged quantities: its velocity
//! is gathered to the points (C1), and the pair forces of the fluid (C4) are
//! scattered back with the same weights (C5). Momentum is therefore exchanged
//! to round-off, and the power on both sides agrees once the wall velocity that
//! the fluid used is the one that the solid moved with; the corrector sees to
//! that. The equations C1 to C5 are listed in `docs/method.md`.
//!
//! [`Coupled`] is generic over its two sides, so that a run without fluid or
//! without solid ([`NoFluid`], [`NoSolid`]) is the same code, compiled to the
//! remaining half.
//!
//! ```
//! use coupling::{Coupled, CouplingParameters, FluidSide, NoFluid, NoSolid};
//! // Neither side limits the time step, so the caller chooses one.
//! let mut nothing = Coupled::<2, _, _>::new(NoFluid, NoSolid, CouplingParameters::default())?;
//! nothing.step(1.0e-3)?;
//! assert_eq!(nothing.time(), 1.0e-3);
//! # Ok::<(), coupling::CouplingError>(())
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

mod absent;
mod coupled;
mod error;
mod fluid;
mod leaks;
mod ledger;
mod parameters;
mod sides;
mod solid;
mod step;

pub use absent::{NoFluid, NoSolid};
pub use coupled::{Coupled, CoupledState};
pub use error::CouplingError;
pub use leaks::count_leaks;
pub use ledger::{CouplingLedger, StepBalance};
pub use parameters::{Correctors, CouplingParameters};
pub use sides::{FluidSide, SolidImpulse, SolidSide, StructurePoints, TimeStepLimit};
