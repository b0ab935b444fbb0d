//! Verification: what a finished run directory shows, measured against
//! reference data and judged by stated gates.
//!
//! A case folder holds a `check.ron` ([`CheckFile`]): a list of [`Check`]s, each
//! a [`Metric`] with its parameters, the reference files or the expected value,
//! the source of that reference and a [`Gate`]. The runner runs the case (with
//! the overrides of the [`Quick`] variant if asked to), reads the histories
//! ([`Histories`]) and asks [`CheckFile::evaluate`] for the rows of the table.
//!
//! The definitions of the metrics are in `docs/verification.md`; each lives in
//! its own file under `metric/`.
//!
//! ```no_run
//! # use std::path::Path;
//! # use fsi_runner::verify::{CheckFile, Histories, NoPoints, ResultTable, Variant, VerifyError};
//! # fn main() -> Result<(), VerifyError> {
//! let checks = CheckFile::read(Path::new("cases/dam_break_2d"))?;
//! let histories = Histories::read(Path::new("runs/dam_break_2d"))?;
//! let table = ResultTable(checks.evaluate(Variant::Full, &histories, &NoPoints)?);
//! print!("{table}");
//! assert!(table.passed());
//! # Ok(())
//! # }
//! ```

mod check_file;
mod error;
mod gate;
mod histories;
mod metric;
mod points;
mod reference;
mod result;
mod ron_file;
mod series;
mod signal;

pub use check_file::{Check, CheckFile, Quick, Variant};
pub use error::VerifyError;
pub use gate::Gate;
pub use histories::Histories;
pub use metric::{
    Acceleration, AmplitudeLoss, Arrival, Axis, CantileverCrest, Divisor, Frequency, FrontBand,
    HistoryAt, HistoryDeviation, LoadShape, Mask, Measurement, Metric, Norm, Peak, ProfileError,
    Quantity, Statistic, StressComponent, StressField, Take, Threshold,
};
pub use points::{FinalPoints, NoPoints, PointSource};
pub use reference::ReferenceTable;
pub use result::{CheckResult, Outcome, ResultTable};
pub use series::{Series, Window};
pub use signal::Signal;
