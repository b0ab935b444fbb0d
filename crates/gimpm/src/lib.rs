//! Explicit dynamics of solids by the generalized interpolation material point
//! method (GIMPM), in plane strain (`D = 2`) and in three dimensions (`D = 3`).
//!
//! Material points carry mass, velocity, stress and deformation; a fixed
//! background grid carries the equation of motion. One [`Solid::step`] is the
//! modified-update-stress-last sequence of the founding paper with the weights
//! of Bardenhagen and Kober (2004); every formula is numbered G1, G2, … in
//! `docs/method.md`, and each phase of the step lives in its own file.
//!
//! SI units. Coordinates are (x, y) with y up or (x, y, z) with z up. Stress is
//! the symmetric Cauchy tensor in both, `[xx, yy, zz, xy, yz, xz]`, tension
//! positive.
//!
//! A bar of four cells, clamped at its left end, is pulled at the other:
//!
//! ```
//! use gimpm::{BodySeed, Discretisation, Hold, InitialVelocity, LinearElastic, Loops,
//!     NodeConstraint, Solid, SolidParameters, StressUpdate};
//! use motion::Motion;
//! use nalgebra::SVector;
//!
//! let parameters = SolidParameters {
//!     gravity: SVector::from([0.0, 0.0]),
//!     gravity_ramp: 0.0,
//!     stress_update: StressUpdate::ModifiedLast,
//!     loops: Loops::Fast,
//!     contact: None,
//!     relaxation: None,
//!     courant_number: 0.5,
//!     grid_spacing: 0.25,
//!     grid_origin: SVector::from([-0.25, -0.25]),
//!     grid_cells: [7, 3],
//!     damping: 0.0,
//! };
//! let bar = BodySeed {
//!     name: "bar".into(),
//!     material: LinearElastic { density: 1.0, young_modulus: 100.0, poisson_ratio: 0.0 }.into(),
//!     points: (0..16)
//!         .map(|k| SVector::from([0.0625 + 0.125 * f64::from(k / 2), 0.0625 + 0.125 * f64::from(k % 2)]))
//!         .collect(),
//!     velocity: InitialVelocity::Uniform(SVector::from([0.0, 0.0])),
//!     point_spacing: 0.125,
//!     discretisation: Discretisation::default(),
//! };
//! let inf = f64::INFINITY;
//! let clamp = NodeConstraint {
//!     name: "clamp".into(),
//!     body: 0,
//!     lower: SVector::from([-inf, -inf]),
//!     upper: SVector::from([0.0, inf]),
//!     hold: Hold::Components([Some(Motion::Fixed), Some(Motion::Fixed)]),
//! };
//! let pull = NodeConstraint {
//!     name: "pull".into(),
//!     body: 0,
//!     lower: SVector::from([1.0, -inf]),
//!     upper: SVector::from([inf, inf]),
//!     hold: Hold::Components([Some(Motion::SmoothStart { velocity: 0.01, duration: 0.5 }), None]),
//! };
//! let mut solid = Solid::new(parameters, vec![bar], vec![clamp, pull])?;
//! while solid.time() < 1.0 {
//!     let dt = solid.stable_time_step()?.value;
//!     solid.step(dt)?;
//! }
//! let (force, _moment) = solid.reaction(1, SVector::from([1.0, 0.0]));
//! assert!(force[0] > 0.0, "the clamp at the pulled end pulls to the right");
//! # Ok::<(), gimpm::SolidError>(())
//! ```
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

mod constitutive;
mod constraints;
mod contact;
mod energy;
mod error;
mod external_force;
mod fastest;
mod field;
mod freedom;
mod grid;
mod grid_momentum;
mod grid_to_points;
mod kernel;
mod lanes;
mod lattice;
mod layout_check;
mod material;
mod objective;
mod parameters;
mod plain;
mod points;
mod points_to_grid;
mod reaction;
mod real;
mod records;
mod relaxation;
mod remap;
mod reorder;
mod separable;
mod shape;
mod slabs;
mod solid;
mod sort;
mod state;
mod stencil;
mod step;
mod stress_order;
mod stress_update;
mod surface_load;
pub mod symmetric;
mod tensor;
mod time_step;
mod transfer;

pub use constraints::SupportNode;
pub use energy::{SolidEnergy, SolidLedger};
pub use error::SolidError;
pub use grid_momentum::SmallMassReport;
pub use material::{
    DruckerPrager, LinearElastic, Material, MaterialError, MaterialModel, MaterialState,
    MooneyRivlin, NeoHookean, StVenantKirchhoff, StepMotion, VonMises, conformance, path,
};
pub use objective::IncrementalMotion;
pub use parameters::{
    BodySeed, Contact, Discretisation, Frame, Hold, InitialVelocity, LoadKind, Loops,
    NodeConstraint, Relaxation, Shape, SolidParameters, StressUpdate, SurfaceLoad, Transfer,
};
pub use points::Points;
pub use reaction::Reaction;
pub use real::Real;
pub use shape::{
    AxisWeights, Cpdi, Cpgimp, LaneWeights, Linear, NodeWeight, PointDomain, ShapeFunction, Ugimp,
};

pub use solid::{Body, Solid};
pub use state::SolidState;
pub use tensor::Tensor;
pub use time_step::TimeStepLimit;
