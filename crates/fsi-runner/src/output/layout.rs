//! Where things are inside a run's HDF5 file.
//!
//! ```text
//! /                        format, program_version, case_name, case_text, overrides,
//!                          dimension, gravity, run_id
//! /static/<cloud>/         what never moves, written once
//! /frames/000/000123/      index, step, time, clouds
//! /frames/000/000123/<cloud>/   kind, spacing; position (N, 3), id (N), <field> (N[, C])
//! /history/gauges/time     (rows) and one data set a column, all appended
//! /history/ledger/time     likewise
//! ```
//!
//! Every data set carries `units`. Frames sit in buckets of 1000 because a
//! commit rewrites the directory of each group it adds to.

use super::frame::Column;
use hdf5::AttrValue;

/// Written to the attribute `format`; the number changes when old readers would misread.
pub const FORMAT: &str = "seawall run 1 (SI units)";

/// Frames in one bucket.
const BUCKET: u64 = 1000;

/// Longest chunk: larger ones cannot be opened by HDF5 2.x.
const LONGEST_CHUNK: u64 = 32_768;

/// A history table of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// What the case asked to measure.
    Gauges,
    /// Energies, momenta, volumes and losses.
    Ledger,
}

impl Table {
    /// The name of its group and of its CSV file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gauges => "gauges",
            Self::Ledger => "ledger",
        }
    }

    pub(crate) fn group(self) -> String {
        format!("history/{}", self.name())
    }
}

/// The group of frame `index`, e.g. `frames/000/000123`.
pub fn frame_group(index: u64) -> String {
    format!("{}/{index:06}", bucket_group(index))
}

pub(crate) fn bucket_group(index: u64) -> String {
    format!("frames/{:03}", index / BUCKET)
}

/// The group of a cloud that never moves, e.g. `static/walls`.
pub fn static_group(cloud: &str) -> String {
    format!("static/{cloud}")
}

pub(crate) fn chunk_rows(rows: usize) -> u64 {
    (rows as u64).clamp(1, LONGEST_CHUNK)
}

pub(crate) fn text(value: &str) -> AttrValue {
    AttrValue::VarLenString(value.into())
}

pub(crate) fn texts<'a>(values: impl IntoIterator<Item = &'a str>) -> AttrValue {
    AttrValue::VarLenStringArray(values.into_iter().map(String::from).collect())
}

/// The column every table starts with.
pub(crate) fn time_column() -> Column {
    Column { name: "time".into(), unit: "s".into() }
}
