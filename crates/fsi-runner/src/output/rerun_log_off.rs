//! What stands in for the Rerun log when the program is built without it.

use super::error::OutputError;
use super::frame::{Column, Frame, PointCloud, RunHeader};
use super::layout::Table;
use super::rerun_options::RerunOptions;

/// Logs nothing; same functions as the real one.
pub struct RerunLog;

impl RerunLog {
    /// Warns that the program was built without the feature `rerun`.
    ///
    /// # Errors
    /// None.
    pub fn start(
        options: RerunOptions,
        _header: &RunHeader,
        _statics: &[PointCloud],
        _first: &Frame,
        _gauges: &[Column],
        _ledger: &[Column],
    ) -> Result<Self, OutputError> {
        let target = options.target.to_string();
        tracing::warn!(target, "nothing is logged to Rerun: built without the feature `rerun`");
        Ok(Self)
    }

    /// Does nothing.
    pub fn log_frame(&mut self, _frame: &Frame) {}

    /// Does nothing.
    pub fn log_row(&mut self, _table: Table, _step: u64, _time: f64, _values: &[f64]) {}

    /// Does nothing.
    pub fn finish(self) {}
}
