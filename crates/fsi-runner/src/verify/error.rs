//! What can be wrong with a check file, its references or the histories of a run.

use std::path::PathBuf;

/// Why a check file could not be read or a check not be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VerifyError {
    /// A file could not be read.
    #[error("{}: cannot read: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A RON file does not have the expected form.
    #[error("{}:{line}:{column}: at `{field}`: {message}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Path of the field, such as `checks[2].gate`.
        field: String,
        /// What is wrong, what is allowed, and the nearest valid name.
        message: String,
    },
    /// A check file is well-formed but contradicts itself.
    #[error("{}: at `{field}`: {message}", path.display())]
    Check {
        /// The file.
        path: PathBuf,
        /// Path of the field.
        field: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A CSV table is malformed.
    #[error("{}:{row}: {message}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// Line of the file, from 1.
        row: u64,
        /// What is wrong.
        message: String,
    },
    /// A column is not in the tables.
    #[error("no column `{name}` in {tables}{suggestion}")]
    Column {
        /// The name asked for.
        name: String,
        /// Where it was looked for.
        tables: String,
        /// `; nearest is …`, or empty.
        suggestion: String,
    },
    /// A signal adds columns of tables that are sampled at different times.
    #[error("signal `{0}` mixes gauge and ledger columns, which are sampled at different times")]
    MixedTables(String),
    /// A signal expression cannot be read.
    #[error("signal `{0}` is not of the form `a.x + b.y - c.z` (spaces around + and -)")]
    Signal(String),
    /// The run has no samples where a metric needs them.
    #[error(
        "{what} needs samples from {from} s to {to} s; the history spans {first} s to {last} s"
    )]
    Span {
        /// The metric or signal.
        what: String,
        /// Start of the window (s).
        from: f64,
        /// End of the window (s).
        to: f64,
        /// First sample (s).
        first: f64,
        /// Last sample (s).
        last: f64,
    },
    /// The points of a body could not be supplied.
    #[error("final points of body `{body}`: {reason}")]
    Points {
        /// The body.
        body: String,
        /// Why.
        reason: String,
    },
    /// A metric cannot be formed from this run.
    #[error("{0}")]
    Metric(String),
}

/// `; did you mean …?`, or nothing where no candidate is near.
pub(super) fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    case::nearest_name(name, candidates)
        .map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}
