//! Appended columns of numbers over time inside a run's HDF5 file.

use super::error::{At, OutputError};
use super::frame::Column;
use super::layout::{self, Table};
use hdf5::{Dataset, DatasetBuilder, File, MaxExtent, StagedGroup};
use std::path::Path;

/// Rows in a chunk. An append rewrites the last one, so long chunks cost space.
const CHUNK: u64 = 128;

/// A table of a run file under construction; rows wait in memory until [`flush`](Self::flush).
pub(super) struct HistoryTable {
    table: Table,
    /// Time first.
    data_sets: Vec<Dataset>,
    waiting: Vec<Vec<f64>>,
}

impl HistoryTable {
    /// Opens the table written by [`stage`].
    pub(super) fn open(
        file: &File,
        path: &Path,
        table: Table,
        columns: &[Column],
    ) -> Result<Self, OutputError> {
        let group = table.group();
        let data_sets = with_time(columns)
            .iter()
            .map(|column| file.dataset(&format!("{group}/{}", column.name)))
            .collect::<Result<Vec<_>, _>>()
            .at("open the histories of", path)?;
        let waiting = vec![Vec::new(); data_sets.len()];
        Ok(Self { table, data_sets, waiting })
    }

    /// Takes one row.
    pub(super) fn push(&mut self, time: f64, values: &[f64]) -> Result<(), OutputError> {
        if values.len() + 1 != self.waiting.len() {
            return Err(OutputError::InvalidData {
                what: format!("row of table `{}`", self.table.name()),
                reason: format!("{} values for {} columns", values.len(), self.waiting.len() - 1),
            });
        }
        let row = std::iter::once(time).chain(values.iter().copied());
        self.waiting.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        Ok(())
    }

    /// Appends the waiting rows. A kill between two columns leaves them of
    /// unequal length; readers take the shortest.
    pub(super) fn flush(&mut self, path: &Path) -> Result<(), OutputError> {
        if self.waiting[0].is_empty() {
            return Ok(());
        }
        for (data_set, rows) in self.data_sets.iter_mut().zip(&mut self.waiting) {
            data_set.append(rows).at("append a history to", path)?;
            rows.clear();
        }
        Ok(())
    }
}

/// Adds a table with `rows` (time first) to a group that is about to be created.
pub(super) fn stage(group: &mut StagedGroup<'_>, columns: &[Column], rows: &[Vec<f64>]) {
    group.set_attr("columns", layout::texts(columns.iter().map(|column| column.name.as_str())));
    for (i, column) in with_time(columns).iter().enumerate() {
        let values = rows.get(i).map_or(&[][..], Vec::as_slice);
        group.create_dataset(&column.name, |set| describe(set, column, values));
    }
}

/// Checks that the names can be data sets beside each other.
pub(super) fn validate(table: Table, columns: &[Column]) -> Result<(), OutputError> {
    let fail = |name: &str, reason: &str| {
        Err(OutputError::InvalidData {
            what: format!("column `{name}` of table `{}`", table.name()),
            reason: reason.into(),
        })
    };
    for (i, column) in columns.iter().enumerate() {
        if column.name.is_empty() || column.name.contains('/') || column.name == "." {
            return fail(&column.name, "a name must not be empty and not contain `/`");
        }
        if column.name == "time" || columns[..i].iter().any(|other| other.name == column.name) {
            return fail(&column.name, "names must differ from each other and from `time`");
        }
    }
    Ok(())
}

fn with_time(columns: &[Column]) -> Vec<Column> {
    std::iter::once(layout::time_column()).chain(columns.iter().cloned()).collect()
}

fn describe(set: &mut DatasetBuilder, column: &Column, values: &[f64]) {
    set.with_f64_data(values)
        .with_shape(&[values.len() as u64])
        .with_maxshape(&[MaxExtent::Unlimited])
        .with_chunks(&[CHUNK])
        .with_shuffle()
        .with_deflate(1)
        .set_attr("units", layout::text(&column.unit));
}
