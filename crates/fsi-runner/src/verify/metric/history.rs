//! A history beside a reference history: at one time, and over a window.

use super::{Evidence, Measurement};
use crate::verify::{Signal, VerifyError, Window};
use serde::Deserialize;

/// The value at one time, linear between samples, beside the reference's.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryAt {
    /// The history.
    pub signal: Signal,
    /// The time (s).
    pub time: f64,
    /// Column of the reference file; default the second.
    pub column: Option<String>,
}

impl HistoryAt {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let span = |series: &crate::verify::Series| VerifyError::Span {
            what: format!("`{}`", series.name),
            from: self.time,
            to: self.time,
            first: series.start(),
            last: series.end(),
        };
        let run = evidence.histories.signal(&self.signal)?;
        let value = run.at(self.time).ok_or_else(|| span(&run))?;
        let mut reference = None;
        if let Some(table) = evidence.references.first() {
            let series = table.series(self.column.as_deref())?;
            reference = Some(series.at(self.time).ok_or_else(|| span(&series))?);
        }
        Ok(Measurement { value, unit: run.unit, reference, detail: format!("at {} s", self.time) })
    }
}

/// Root mean square difference from a reference history over a window:
/// `sqrt(1/T ∫ (s - r)² dt)`, trapezoidal over the run's samples, `r` linear
/// between the reference's samples.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryDeviation {
    /// The history.
    pub signal: Signal,
    /// The window.
    #[serde(default)]
    pub window: Window,
    /// Column of the reference file; default the second.
    pub column: Option<String>,
    /// Scale of the result, in the signal's unit; default none.
    pub divide_by: Option<f64>,
}

impl HistoryDeviation {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let run = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let reference = evidence.references[0].series(self.column.as_deref())?;
        let mut squared = run.clone();
        let mut mean_difference = run.clone();
        for (i, time) in run.time.iter().enumerate() {
            let r = reference.at(*time).ok_or_else(|| VerifyError::Span {
                what: format!("`{}`", reference.name),
                from: run.start(),
                to: run.end(),
                first: reference.start(),
                last: reference.end(),
            })?;
            mean_difference.value[i] = run.value[i] - r;
            squared.value[i] = mean_difference.value[i].powi(2);
        }
        let unit = if self.divide_by.is_some() { "1".into() } else { run.unit.clone() };
        Ok(Measurement {
            value: squared.mean().sqrt() / self.divide_by.unwrap_or(1.0),
            detail: format!(
                "over {:.3} to {:.3} s; mean difference {:.3} {}",
                run.start(),
                run.end(),
                mean_difference.mean(),
                run.unit
            ),
            unit,
            reference: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Evidence, HistoryAt, HistoryDeviation, Window};
    use crate::verify::{Histories, NoPoints, ReferenceTable, Signal, histories::tests::histories};
    use std::fmt::Write as _;
    use std::path::Path;

    fn run(f: impl Fn(f64) -> f64) -> Histories {
        let mut gauges = String::from("time [s],tip.x [m]\n");
        for i in 0..=1000 {
            let t = f64::from(i) * 1e-3;
            writeln!(gauges, "{t},{}", f(t)).unwrap();
        }
        histories(&gauges, "time [s],a.b [J]\n0,1\n")
    }

    fn reference() -> [ReferenceTable; 1] {
        [ReferenceTable::parse(Path::new("r.csv"), "t,other,u\n0,9,0\n0.5,9,1\n1.0,9,2\n").unwrap()]
    }

    #[test]
    fn value_at_a_time_beside_the_reference() {
        let metric = HistoryAt {
            signal: Signal::parse("tip.x").unwrap(),
            time: 0.25,
            column: Some("u".into()),
        };
        let (histories, references) = (run(|t| 2.2 * t), reference());
        let evidence =
            Evidence { histories: &histories, points: &NoPoints, references: &references };
        let m = metric.measure(&evidence).unwrap();
        assert!((m.value - 0.55).abs() < 1e-12);
        assert!((m.reference.unwrap() - 0.5).abs() < 1e-12);
        assert!(HistoryAt { time: 1.5, ..metric }.measure(&evidence).is_err());
    }

    #[test]
    fn root_mean_square_of_a_known_difference() {
        // The difference is sin(2 pi t), of root mean square 1/sqrt 2.
        let histories = run(|t| 2.0 * t + (std::f64::consts::TAU * t).sin());
        let references = reference();
        let evidence =
            Evidence { histories: &histories, points: &NoPoints, references: &references };
        let metric = HistoryDeviation {
            signal: Signal::parse("tip.x").unwrap(),
            window: Window::Between(0.0, 1.0),
            column: Some("u".into()),
            divide_by: Some(2.0),
        };
        let value = metric.measure(&evidence).unwrap().value;
        assert!((value - 0.5 / 2.0_f64.sqrt()).abs() < 1e-6, "{value}");
        let late = HistoryDeviation { window: Window::Between(0.5, 2.0), ..metric };
        assert!(late.measure(&evidence).is_err());
    }
}
