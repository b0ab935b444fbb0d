//! From a case file to seeded particles and material points.
//!
//! A case is a RON file in SI units ([`mod@format`], `docs/case.md`). [`Case::load`]
//! reads and checks it; [`Case::build`] fills its shapes with fluid particles,
//! wall particles and material points and returns the inputs of the solvers.
//! Every error is a [`CaseError`]: file, line and column (or the `--set`
//! argument), field path, what is allowed, and the nearest valid name.
//!
//! ```
//! let text = r#"(
//!     name: "drop", dimension: 2, end_time: 0.1,
//!     fluid: (spacing: 0.1, sound_speed: Fixed(20.0), blocks: [
//!         (name: "water", shape: Box(lower: [0, 0], upper: [1, 0.5])),
//!     ]),
//!     output: (frame_interval: 0.05),
//! )"#;
//! let case = case::Case::parse("drop.ron", text, &[])?;
//! let model = case.build::<2>()?;
//! assert_eq!(model.fluid.map(|fluid| fluid.particles.len()), Some(50));
//!
//! let error = case::Case::parse("drop.ron", text, &["fluid.spacin=0.05".into()]).unwrap_err();
//! assert!(error.to_string().contains("did you mean `spacing`?"));
//! # Ok::<(), case::CaseError>(())
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

mod build;
mod case;
mod error;
mod estimate;
pub mod format;
mod geometry;
mod lattice;
mod memory;
mod model;
mod outline;
mod overrides;
mod plan;
mod source;
mod suggestion;
mod validate;

pub use case::Case;
pub use error::CaseError;
pub use estimate::{Estimate, StepEstimate};
pub use model::{FluidModel, ForceTarget, Gauge, GaugeKind, Model, OutputIntervals, SolidModel};
pub use suggestion::nearest_name;
