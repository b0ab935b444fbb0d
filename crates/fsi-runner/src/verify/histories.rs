//! The histories of a run directory: `gauges.csv` and `ledger.csv`.

use super::{Series, Signal, VerifyError, error::suggestion, reference::ReferenceTable};
use std::path::Path;

/// The gauges and the ledger of a finished run; either may be missing.
#[derive(Debug, Clone, PartialEq)]
pub struct Histories {
    tables: Vec<ReferenceTable>,
}

impl Histories {
    /// Reads `gauges.csv` and `ledger.csv` in `directory`.
    ///
    /// Headers are `time [s],NAME.QUANTITY [UNIT],…`.
    ///
    /// # Errors
    /// [`VerifyError::Read`] if there is neither, [`VerifyError::Table`] if one
    /// is malformed.
    pub fn read(directory: &Path) -> Result<Self, VerifyError> {
        let mut tables = Vec::new();
        for name in ["gauges.csv", "ledger.csv"] {
            let path = directory.join(name);
            if path.exists() {
                tables.push(ReferenceTable::read(&path)?);
            }
        }
        if tables.is_empty() {
            return Err(VerifyError::Read {
                path: directory.into(),
                reason: "holds neither gauges.csv nor ledger.csv; is it a finished run?".into(),
            });
        }
        Ok(Self { tables })
    }

    /// Histories already in memory, first the gauges, then the ledger.
    #[must_use]
    pub fn from_tables(tables: Vec<ReferenceTable>) -> Self {
        Self { tables }
    }

    /// The sum that `signal` describes.
    ///
    /// # Errors
    /// [`VerifyError::Column`] names an unknown column and the nearest one;
    /// [`VerifyError::MixedTables`] if the terms are sampled at different times.
    pub fn signal(&self, signal: &Signal) -> Result<Series, VerifyError> {
        let mut sum: Option<(usize, String, Vec<f64>)> = None;
        for (sign, column) in signal.terms() {
            let (table, index) = self.find(column)?;
            let values = self.tables[table].column(index);
            let unit = self.tables[table].unit(index);
            match &mut sum {
                None => {
                    sum = Some((table, unit.into(), values.iter().map(|v| sign * v).collect()));
                }
                Some((first, _, _)) if *first != table => {
                    return Err(VerifyError::MixedTables(signal.text().into()));
                }
                Some((_, _, total)) => {
                    for (t, v) in total.iter_mut().zip(values) {
                        *t += sign * v;
                    }
                }
            }
        }
        let (table, unit, value) = sum.ok_or_else(|| VerifyError::Signal(signal.text().into()))?;
        Series::new(signal.text(), &unit, self.tables[table].column(0).to_vec(), value)
    }

    /// Table and column index of `name`, in the gauges before the ledger.
    fn find(&self, name: &str) -> Result<(usize, usize), VerifyError> {
        for (table, content) in self.tables.iter().enumerate() {
            if let Some(index) = content.position(name) {
                return Ok((table, index));
            }
        }
        let names: Vec<&str> = self.tables.iter().flat_map(|t| t.names().skip(1)).collect();
        Err(VerifyError::Column {
            name: name.into(),
            tables: self
                .tables
                .iter()
                .map(|t| t.path().display().to_string())
                .collect::<Vec<_>>()
                .join(" or "),
            suggestion: suggestion(name, names),
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::{Histories, ReferenceTable, Signal, VerifyError};
    use std::path::Path;

    /// Histories from the text of the two files.
    pub(in crate::verify) fn histories(gauges: &str, ledger: &str) -> Histories {
        Histories::from_tables(vec![
            ReferenceTable::parse(Path::new("gauges.csv"), gauges).unwrap(),
            ReferenceTable::parse(Path::new("ledger.csv"), ledger).unwrap(),
        ])
    }

    fn sample() -> Histories {
        histories(
            "time [s],P1.pressure [Pa],base load.force_x [N]\n0,1,10\n0.1,2,20\n",
            "time [s],solid.kinetic [J],solid.strain [J]\n0,5,0\n0.5,3,2\n",
        )
    }

    #[test]
    fn sums_columns_of_one_table_and_keeps_the_unit() {
        let s = sample().signal(&Signal::parse("solid.kinetic + solid.strain").unwrap()).unwrap();
        assert_eq!((s.value, s.unit.as_str()), (vec![5.0, 5.0], "J"));
        let s = sample().signal(&Signal::parse("-base load.force_x").unwrap()).unwrap();
        assert_eq!(s.value, [-10.0, -20.0]);
    }

    #[test]
    fn unknown_and_mixed_columns_are_named() {
        let error = sample().signal(&Signal::parse("P1.presure").unwrap()).unwrap_err();
        assert!(error.to_string().contains("did you mean `P1.pressure`"), "{error}");
        let mixed = Signal::parse("P1.pressure + solid.strain").unwrap();
        assert!(matches!(sample().signal(&mixed), Err(VerifyError::MixedTables(_))));
    }

    #[test]
    fn an_empty_directory_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        assert!(Histories::read(directory.path()).is_err());
    }
}
