//! A history table as comma-separated values: `time [s],P1.pressure [Pa],…`.

use super::error::{At, OutputError};
use super::frame::Column;
use super::replace_file::{Durability, replace_file};
use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A CSV file open for appending.
pub struct CsvTable {
    path: PathBuf,
    writer: BufWriter<File>,
    columns: usize,
}

impl CsvTable {
    /// Creates (or replaces) the file with its header line.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn create(path: &Path, columns: &[Column]) -> Result<Self, OutputError> {
        replace_file(path, Durability::Process, &[header(columns).as_bytes()])?;
        Self::append_to(path, columns)
    }

    /// Opens the file of an interrupted run; rows later than `time` (s) and a
    /// last line that a kill cut off are removed.
    ///
    /// # Errors
    /// [`OutputError::Io`], or [`OutputError::Malformed`] when the header line
    /// is not that of `columns`.
    pub fn open_to_append(path: &Path, columns: &[Column], time: f64) -> Result<Self, OutputError> {
        let text = fs::read_to_string(path).at("read", path)?;
        let head = header(columns);
        let Some(rows) = text.strip_prefix(&head) else {
            return Err(OutputError::Malformed {
                path: path.into(),
                expected: "CSV table",
                reason: format!("its header is not `{}`", head.trim_end()),
            });
        };
        let kept: String = rows
            .split_inclusive('\n')
            .take_while(|line| line.ends_with('\n') && row_time(line).is_some_and(|t| t <= time))
            .collect();
        replace_file(path, Durability::Process, &[head.as_bytes(), kept.as_bytes()])?;
        Self::append_to(path, columns)
    }

    fn append_to(path: &Path, columns: &[Column]) -> Result<Self, OutputError> {
        let file = OpenOptions::new().append(true).open(path).at("open", path)?;
        Ok(Self { path: path.into(), writer: BufWriter::new(file), columns: columns.len() })
    }

    /// Takes a row; it reaches the file with the next [`flush`](Self::flush).
    ///
    /// Numbers are written with as many digits as it takes to read back the same.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] when the number of values is not that of the
    /// columns, [`OutputError::Io`].
    pub fn push_row(&mut self, time: f64, values: &[f64]) -> Result<(), OutputError> {
        if values.len() != self.columns {
            return Err(OutputError::InvalidData {
                what: format!("row of {}", self.path.display()),
                reason: format!("{} values for {} columns", values.len(), self.columns),
            });
        }
        let mut line = format!("{time:?}");
        for value in values {
            line += &format!(",{value:?}");
        }
        line.push('\n');
        self.writer.write_all(line.as_bytes()).at("write", &self.path)
    }

    /// Hands the rows to the operating system.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.writer.flush().at("write", &self.path)
    }
}

fn header(columns: &[Column]) -> String {
    let cell = |column: &Column| {
        let text = format!("{} [{}]", column.name, column.unit);
        // RFC 4180: quote what would split the cell.
        if text.contains([',', '"', '\n']) {
            format!(",\"{}\"", text.replace('"', "\"\""))
        } else {
            format!(",{text}")
        }
    };
    let cells: String = columns.iter().map(cell).collect();
    format!("time [s]{cells}\n")
}

fn row_time(line: &str) -> Option<f64> {
    line.split(',').next()?.trim_end().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<Column> {
        let column = |name: &str, unit: &str| Column { name: name.into(), unit: unit.into() };
        vec![column("P1.pressure", "Pa"), column("crest.x", "m")]
    }

    #[test]
    fn resume_drops_later_rows_and_a_torn_last_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gauges.csv");
        let mut table = CsvTable::create(&path, &columns()).unwrap();
        for i in 0..5 {
            table.push_row(f64::from(i) * 0.1, &[f64::from(i), 1e-9]).unwrap();
        }
        table.flush().unwrap();
        drop(table);
        let torn = fs::read_to_string(&path).unwrap() + "0.5,7";
        fs::write(&path, torn).unwrap();

        let mut table = CsvTable::open_to_append(&path, &columns(), 0.2).unwrap();
        table.push_row(0.25, &[f64::NAN, -0.0]).unwrap();
        table.flush().unwrap();
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            "time [s],P1.pressure [Pa],crest.x [m]\n\
             0.0,0.0,1e-9\n0.1,1.0,1e-9\n0.2,2.0,1e-9\n0.25,NaN,-0.0\n"
        );
    }

    #[test]
    fn resume_drops_a_last_line_cut_inside_a_number() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gauges.csv");
        drop(CsvTable::create(&path, &columns()).unwrap());
        fs::write(&path, header(&columns()) + "0.1,1.0,2.0\n0.15,1.0,2").unwrap();
        CsvTable::open_to_append(&path, &columns(), 1.0).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), header(&columns()) + "0.1,1.0,2.0\n");
    }

    #[test]
    fn resume_refuses_other_columns() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("gauges.csv");
        drop(CsvTable::create(&path, &columns()).unwrap());
        let error = CsvTable::open_to_append(&path, &columns()[..1], 1.0).err().unwrap();
        assert!(error.to_string().contains("its header is not `time [s],P1.pressure [Pa]`"));
    }
}
