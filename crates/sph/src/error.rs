//! What can go wrong, each with its place, limit and remedy.

use motion::MotionError;

/// Why the fluid refuses its input or stops.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FluidError {
    /// A parameter is outside its allowed range.
    #[error("{name} is {value}; allowed: {allowed}. {remedy}")]
    Parameter {
        /// Name of the field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Allowed range in words.
        allowed: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A fluid seed cannot be used.
    #[error("fluid particle {id}: {quantity} is {value}; {remedy}")]
    Seed {
        /// Index of the seed.
        id: usize,
        /// The offending quantity.
        quantity: &'static str,
        /// Its value in words.
        value: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A wall cannot be used.
    #[error("wall \"{name}\": {problem}")]
    Wall {
        /// Name of the wall.
        name: String,
        /// What is wrong and what is allowed.
        problem: String,
    },
    /// A wall's motion has a bad parameter.
    #[error("wall \"{name}\": {source}")]
    WallMotion {
        /// Name of the wall.
        name: String,
        /// The problem.
        source: MotionError,
    },
    /// The cell table would not fit.
    #[error(
        "the domain needs {cells:.3e} search cells (limit {limit:.3e}); make the domain smaller or the spacing larger"
    )]
    TooManyCells {
        /// Cells needed.
        cells: f64,
        /// Largest number supported.
        limit: f64,
    },
    /// Too many particles for 32-bit indices.
    #[error("{count} {what}; at most {limit} are supported. Use a larger spacing")]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// How many.
        count: usize,
        /// Largest number supported.
        limit: usize,
    },
    /// Arrays that belong together differ in length.
    #[error("{array} has {found} entries; expected {expected}")]
    Length {
        /// Which array.
        array: &'static str,
        /// Required length.
        expected: usize,
        /// Length found.
        found: usize,
    },
    /// The state became NaN or infinite.
    #[error(
        "{quantity} of fluid particle {id} became non-finite near {position:?} m at t = {time} s; reduce the Courant number, or raise the sound speed or the dissipation"
    )]
    NonFinite {
        /// Particle id.
        id: u32,
        /// Which quantity.
        quantity: &'static str,
        /// Position (m); may itself be non-finite.
        position: Vec<f64>,
        /// Time (s).
        time: f64,
    },
    /// A density left the range in which the weakly compressible model holds.
    #[error(
        "fluid particle {id} at {position:?} m has density deviation {relative:+.3} rho0 at t = {time} s (limit ±{limit}); raise the sound speed (10 to 20 times the largest velocity), or reduce the Courant number"
    )]
    DensityOutOfRange {
        /// Particle id.
        id: u32,
        /// `ρ/ρ0 - 1`.
        relative: f64,
        /// Largest magnitude accepted.
        limit: f64,
        /// Position (m).
        position: Vec<f64>,
        /// Time (s).
        time: f64,
    },
    /// A time step is unusable: not positive, or so small that the run has failed.
    #[error("time step {value} s at t = {time} s (limited by {term}) is unusable: {remedy}")]
    TimeStep {
        /// The step (s).
        value: f64,
        /// The limiting term.
        term: &'static str,
        /// Time (s).
        time: f64,
        /// What to do.
        remedy: &'static str,
    },
}
