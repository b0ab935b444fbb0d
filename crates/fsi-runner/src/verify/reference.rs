//! Tables in CSV: reference data and the histories of a run.

use super::{Series, VerifyError, error::suggestion};
use std::path::{Path, PathBuf};

/// A CSV table of numbers: `#` comment lines, one header row, number rows.
///
/// A header `NAME [UNIT]` is split into name and unit; reference files may
/// leave the unit out. The first column of a history is time (s).
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceTable {
    path: PathBuf,
    header: Vec<(String, String)>,
    columns: Vec<Vec<f64>>,
}

impl ReferenceTable {
    /// Reads a file.
    ///
    /// # Errors
    /// [`VerifyError::Read`] or [`VerifyError::Table`] with file and line.
    pub fn read(path: &Path) -> Result<Self, VerifyError> {
        let text = std::fs::read_to_string(path)
            .map_err(|e| VerifyError::Read { path: path.into(), reason: e.to_string() })?;
        Self::parse(path, &text)
    }

    /// Parses the text of a file; `path` is named in errors.
    ///
    /// # Errors
    /// [`VerifyError::Table`] with file and line.
    pub fn parse(path: &Path, text: &str) -> Result<Self, VerifyError> {
        let fault =
            |row: u64, message: String| VerifyError::Table { path: path.into(), row, message };
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let header: Vec<(String, String)> =
            reader.headers().map_err(|e| fault(1, e.to_string()))?.iter().map(split_unit).collect();
        if header.iter().all(|(name, _)| name.parse::<f64>().is_ok()) {
            return Err(fault(1, "the first row must name the columns".into()));
        }
        let mut columns = vec![Vec::new(); header.len()];
        for record in reader.records() {
            let record = record
                .map_err(|e| fault(e.position().map_or(0, csv::Position::line), e.to_string()))?;
            let row = record.position().map_or(0, csv::Position::line);
            for (column, field) in columns.iter_mut().zip(&record) {
                column.push(
                    field.parse().map_err(|_| fault(row, format!("`{field}` is not a number")))?,
                );
            }
        }
        if columns.iter().all(Vec::is_empty) {
            return Err(fault(2, "there are no rows under the header".into()));
        }
        Ok(Self { path: path.into(), header, columns })
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Column names without units, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.header.iter().map(|(name, _)| name.as_str())
    }

    /// Index of the column called `name` (without unit).
    #[must_use]
    pub fn position(&self, name: &str) -> Option<usize> {
        self.names().position(|n| n == name)
    }

    /// Values of a column.
    #[must_use]
    pub fn column(&self, index: usize) -> &[f64] {
        &self.columns[index]
    }

    /// Unit of a column, or empty.
    #[must_use]
    pub fn unit(&self, index: usize) -> &str {
        &self.header[index].1
    }

    /// Values of the column called `name`.
    ///
    /// # Errors
    /// [`VerifyError::Column`] with the nearest name.
    pub fn named(&self, name: &str) -> Result<&[f64], VerifyError> {
        let index = self.position(name).ok_or_else(|| VerifyError::Column {
            name: name.into(),
            tables: self.path.display().to_string(),
            suggestion: suggestion(name, self.names()),
        })?;
        Ok(self.column(index))
    }

    /// A column as a history over the first column; `None` takes the second.
    ///
    /// # Errors
    /// [`VerifyError::Column`] if it is not there; see also [`Series::new`].
    pub fn series(&self, name: Option<&str>) -> Result<Series, VerifyError> {
        let second = self.names().nth(1).unwrap_or("second column");
        let name = name.unwrap_or(second).to_owned();
        let values = self.named(&name)?.to_vec();
        let unit = self.position(&name).map_or("", |i| self.unit(i));
        Series::new(
            &format!("{} of {}", name, self.path.display()),
            unit,
            self.columns[0].clone(),
            values,
        )
    }
}

/// `"P1.pressure [Pa]"` to `("P1.pressure", "Pa")`.
fn split_unit(header: &str) -> (String, String) {
    match header.rsplit_once(" [") {
        Some((name, unit)) if unit.ends_with(']') => {
            (name.trim().into(), unit.trim_end_matches(']').into())
        }
        _ => (header.into(), String::new()),
    }
}

#[cfg(test)]
mod tests {
    use super::ReferenceTable;
    use std::path::Path;

    fn parse(text: &str) -> Result<ReferenceTable, super::VerifyError> {
        ReferenceTable::parse(Path::new("r.csv"), text)
    }

    #[test]
    fn comments_units_and_columns() {
        let table = parse("# Source: a paper\nt [s],p one [Pa]\n0,1\n1,2\n").unwrap();
        assert_eq!(table.names().collect::<Vec<_>>(), ["t", "p one"]);
        assert_eq!(table.unit(1), "Pa");
        assert_eq!(table.series(Some("p one")).unwrap().value, [1.0, 2.0]);
        assert_eq!(table.series(None).unwrap().value, [1.0, 2.0]);
    }

    #[test]
    fn faults_name_the_line() {
        let error = parse("# c\nt,p\n0,1\n1,oops\n").unwrap_err().to_string();
        assert!(error.starts_with("r.csv:4:") && error.contains("oops"), "{error}");
        let error = parse("t,p\n0,1\n1\n").unwrap_err().to_string();
        assert!(error.starts_with("r.csv:3:"), "{error}");
        assert!(parse("0,1\n1,2\n").is_err(), "a missing header must not eat a row");
        assert!(parse("t,p\n").is_err());
        assert!(parse("t,p\n0,1\n").unwrap().named("q").is_err());
    }
}
