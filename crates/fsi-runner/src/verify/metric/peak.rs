//! Impact peaks: how large, and when the impact arrives.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError, Window};
use serde::Deserialize;

/// The largest value of a history in a window, beside the reference's.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Peak {
    /// The history.
    pub signal: Signal,
    /// The window, the same for the reference; default all.
    #[serde(default)]
    pub window: Window,
    /// Column of the reference file; default the second.
    pub column: Option<String>,
}

impl Peak {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let run = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let (value, time) = run.maximum();
        let mut detail = format!("at {time:.4} s");
        let mut reference = None;
        if let Some(table) = evidence.references.first() {
            let series = table.series(self.column.as_deref())?.window(self.window)?;
            let (peak, at) = series.maximum();
            reference = Some(peak);
            detail += &format!(", reference at {at:.4} s");
        }
        Ok(Measurement { value, unit: run.unit, reference, detail })
    }
}

/// The level whose first exceedance counts as arrival.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Threshold {
    /// This value, in the signal's unit.
    Value(f64),
    /// This fraction of the history's own largest value in the window.
    OfPeak(f64),
}

/// The time (s) at which a history first exceeds a threshold, linear between
/// samples, beside the reference's by the same definition.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arrival {
    /// The history.
    pub signal: Signal,
    /// The threshold.
    pub threshold: Threshold,
    /// The window, the same for the reference; default all.
    #[serde(default)]
    pub window: Window,
    /// Column of the reference file; default the second.
    pub column: Option<String>,
}

impl Arrival {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let run = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let (value, level) = self.first_exceedance(&run)?;
        let mut reference = None;
        if let Some(table) = evidence.references.first() {
            let series = table.series(self.column.as_deref())?.window(self.window)?;
            reference = Some(self.first_exceedance(&series)?.0);
        }
        let detail = format!("`{}` above {level:.4} {}", run.name, run.unit);
        Ok(Measurement { value, unit: "s".into(), reference, detail })
    }

    /// Time of the first exceedance and the level.
    fn first_exceedance(&self, series: &Series) -> Result<(f64, f64), VerifyError> {
        let level = match self.threshold {
            Threshold::Value(level) => level,
            Threshold::OfPeak(fraction) => fraction * series.maximum().0,
        };
        let after = series.value.iter().position(|v| *v > level).ok_or_else(|| {
            VerifyError::Metric(format!(
                "`{}` never exceeds {level} between {} s and {} s",
                series.name,
                series.start(),
                series.end()
            ))
        })?;
        if after == 0 {
            return Ok((series.time[0], level));
        }
        let (t0, t1) = (series.time[after - 1], series.time[after]);
        let (v0, v1) = (series.value[after - 1], series.value[after]);
        Ok((t0 + (t1 - t0) * (level - v0) / (v1 - v0), level))
    }
}

#[cfg(test)]
mod tests {
    use super::{Arrival, Evidence, Peak, Threshold, Window};
    use crate::verify::{Histories, NoPoints, ReferenceTable, Signal, histories::tests::histories};
    use std::path::Path;

    fn run() -> Histories {
        histories(
            "time [s],P1.pressure [Pa]\n0,0\n0.1,0\n0.2,80\n0.3,100\n0.4,20\n0.5,300\n",
            "time [s],a.b [J]\n0,1\n",
        )
    }

    fn reference() -> [ReferenceTable; 1] {
        [ReferenceTable::parse(Path::new("r.csv"), "t,p\n0,-5\n0.2,0\n0.25,90\n0.6,10\n").unwrap()]
    }

    #[test]
    fn peak_inside_the_window_beside_the_reference() {
        let (histories, references) = (run(), reference());
        let evidence =
            Evidence { histories: &histories, points: &NoPoints, references: &references };
        let metric = Peak {
            signal: Signal::parse("P1.pressure").unwrap(),
            window: Window::Between(0.0, 0.45),
            column: None,
        };
        let m = metric.measure(&evidence).unwrap();
        assert_eq!((m.value, m.reference), (100.0, Some(90.0)));
        let m = Peak { window: Window::All, ..metric }.measure(&evidence).unwrap();
        assert_eq!(m.value, 300.0);
    }

    #[test]
    fn arrival_at_half_the_peak_is_interpolated() {
        let (histories, references) = (run(), reference());
        let evidence =
            Evidence { histories: &histories, points: &NoPoints, references: &references };
        let metric = Arrival {
            signal: Signal::parse("P1.pressure").unwrap(),
            threshold: Threshold::OfPeak(0.5),
            window: Window::Between(0.0, 0.45),
            column: Some("p".into()),
        };
        let m = metric.measure(&evidence).unwrap();
        // Half of 100 between (0.1, 0) and (0.2, 80); half of 90 between (0.2, 0) and (0.25, 90).
        assert!((m.value - 0.1625).abs() < 1e-12);
        assert!((m.reference.unwrap() - 0.225).abs() < 1e-12);
        let never = Arrival { threshold: Threshold::Value(1e4), ..metric };
        assert!(never.measure(&evidence).unwrap_err().to_string().contains("never exceeds"));
    }
}
