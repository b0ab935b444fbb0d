//! Weakly compressible smoothed particle hydrodynamics (SPH) of a free-surface fluid, 2D and 3D.
//!
//! The crate knows nothing of solids, files or cases. Equations S1… and C2–C4 are
//! in `docs/method.md`. One step reads as a list of phases in `step.rs`; each phase
//! has its own file:
//!
//! | phase | file | equations |
//! |---|---|---|
//! | half drifts, kick, prescribed walls, cell sort | `drift.rs` | S9 |
//! | acceleration | `momentum.rs`, `dissipation.rs`, `wall_closure.rs` | S4–S6, C2, C4 |
//! | density rate | `continuity.rs` | S3, C3 |
//! | load on walls and on the structure | `boundary_force.rs` | C5 |
//!
//! State is a structure of arrays sorted by cell ([`Particles`]); walls and the
//! externally driven structure are two separate [`Boundary`] sets. Every particle
//! gathers its own sums, so results have the same bits for any number of threads.
//!
//! ```
//! use nalgebra::SVector;
//! use sph::{Dissipation, Fluid, FluidParameters, FluidSeed};
//!
//! // A 2 x 2 drop in free fall.
//! let parameters = FluidParameters {
//!     domain: (SVector::from([-1.0, -2.0]), SVector::from([1.0, 1.0])),
//!     gravity: SVector::from([0.0, -9.81]),
//!     dissipation: Dissipation::Artificial { alpha: 0.02 },
//!     ..FluidParameters::water(0.1, 20.0)
//! };
//! let drop = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]]
//!     .map(|[x, y]| FluidSeed { position: SVector::from([x, y]), ..FluidSeed::default() });
//! let mut fluid: Fluid<2> = Fluid::new(parameters, drop.to_vec(), vec![])?;
//! while fluid.time() < 0.1 {
//!     let dt = fluid.stable_time_step()?.value;
//!     fluid.step(dt)?;
//! }
//! let fallen = fluid.momentum()[1] / fluid.total_mass();
//! assert!((fallen + 9.81 * fluid.time()).abs() < 1e-12);
//! # Ok::<(), sph::FluidError>(())
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

mod boundary;
mod boundary_force;
mod cell_lattice;
mod continuity;
mod dissipation;
mod drift;
mod equation_of_state;
mod error;
mod fluid;
mod gauges;
mod kernel;
mod ledger;
mod momentum;
mod parameters;
mod particles;
mod state;
mod step;
mod structure;
mod time_step;
mod wall_closure;

pub use boundary::Boundary;
pub use boundary_force::BoundarySet;
pub use dissipation::{ArtificialViscosity, Inviscid, PairDissipation, RiemannLimiter};
pub use equation_of_state::LinearEquationOfState;
pub use error::FluidError;
pub use fluid::Fluid;
pub use gauges::Sample;
pub use kernel::{Kernel, WendlandC2};
pub use ledger::{FluidEnergy, FluidLedger, Removed};
pub use parameters::{Dissipation, FluidParameters, FluidSeed, WallMotion, WallSeed};
pub use particles::Particles;
pub use state::FluidState;
pub use time_step::TimeStepLimit;
pub use wall_closure::{FluidSide, WallClosure, WallForce, WallSide};
