//! What can go wrong in a solid, each with its values, limit and remedy.

use crate::material::MaterialError;

/// An error of the solid solver.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// The solver exists in plane strain and in three dimensions.
    #[error("dimension is {0}; the solid solver works in 2 (plane strain) or 3")]
    Dimension(usize),
    /// A parameter is outside its range.
    #[error("solid parameter {name} is {value}; it must be {allowed}")]
    Parameter {
        /// Name of the field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The allowed range.
        allowed: &'static str,
    },
    /// A body's material constant is outside its range.
    #[error("body '{body}': {source}")]
    Material {
        /// Name of the body.
        body: String,
        /// The constant and its range.
        source: MaterialError,
    },
    /// A body's seed is inconsistent.
    #[error("body '{body}': {problem}")]
    Body {
        /// Name of the body.
        body: String,
        /// What is wrong and what is needed.
        problem: String,
    },
    /// A node constraint is inconsistent or selects nothing.
    #[error("constraint '{constraint}': {problem}")]
    Constraint {
        /// Name of the constraint.
        constraint: String,
        /// What is wrong and what is needed.
        problem: String,
    },
    /// A surface load is inconsistent or finds no face.
    #[error("load '{load}': {problem}")]
    Load {
        /// Name of the load.
        load: String,
        /// What is wrong and what is needed.
        problem: String,
    },
    /// A material point lies outside the background grid.
    #[error(
        "material point {point} is at {position:?} m at t = {time} s, outside the grid {lower:?} to {upper:?}; enlarge grid_cells or move grid_origin"
    )]
    OutsideGrid {
        /// Identity of the point.
        point: u32,
        /// Its position (m).
        position: Vec<f64>,
        /// Time (s).
        time: f64,
        /// Lower corner of the grid (m).
        lower: Vec<f64>,
        /// Upper corner of the grid (m).
        upper: Vec<f64>,
    },
    /// A point drifted too far from the cell it was sorted into.
    #[error(
        "material point {point} drifted more than half a cell since the last sort (t = {time} s); call sort_points when needs_sort() says so"
    )]
    NotSorted {
        /// Identity of the point.
        point: u32,
        /// Time (s).
        time: f64,
    },
    /// A quantity is NaN or infinite.
    #[error(
        "material point {point}: {quantity} is not finite at t = {time} s; reduce the time step (courant_number) or check the loads"
    )]
    NonFinite {
        /// Identity of the point.
        point: u32,
        /// Which quantity.
        quantity: &'static str,
        /// Time (s).
        time: f64,
    },
    /// A material point is turned inside out.
    #[error(
        "material point {point} is inverted at t = {time} s: det F = {determinant}; it must stay above 0: reduce the load or the time step, or refine the grid"
    )]
    Inverted {
        /// Identity of the point.
        point: u32,
        /// Determinant of the deformation gradient.
        determinant: f64,
        /// Time (s).
        time: f64,
    },
    /// The step exceeds what the grid can resolve.
    #[error(
        "time step {time_step} s exceeds the stability limit {limit} s ({term}) at t = {time} s; use stable_time_step()"
    )]
    TimeStepTooLarge {
        /// The step asked for (s).
        time_step: f64,
        /// The largest allowed step, Courant number 1 (s).
        limit: f64,
        /// What limits it.
        term: &'static str,
        /// Time (s).
        time: f64,
    },
    /// A step is zero, negative or not a number.
    #[error("time step is {0} s; it must be finite and above 0")]
    TimeStep(f64),
    /// A state handed back does not belong to this solid.
    #[error(
        "restored state has {found} {what}, this solid has {expected}; restore it into the case that wrote it"
    )]
    StateMismatch {
        /// Which count differs.
        what: &'static str,
        /// Count in the state.
        found: usize,
        /// Count in the solid.
        expected: usize,
    },
}
