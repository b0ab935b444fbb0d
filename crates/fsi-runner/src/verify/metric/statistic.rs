//! One number from one history: reactions, ledger limits, energy drift, still water.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError, Window};
use serde::Deserialize;

/// How a history is reduced to one number.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Take {
    /// The last value.
    Final,
    /// The largest value.
    Maximum,
    /// The smallest value.
    Minimum,
    /// The largest absolute value.
    MaximumAbsolute,
    /// The mean over time (trapezoidal rule).
    Mean,
    /// `max |s - from|`.
    MaximumDeviation {
        /// The value deviated from, in the signal's unit.
        from: f64,
    },
    /// `max |s - s(first sample)|`: how far a conserved quantity drifts.
    Drift,
    /// `max s - s(first sample)`: how far a quantity grows that must not.
    Rise,
    /// Slope over time by least squares, per second: the stiffness of a body
    /// that is deformed at a constant rate, whatever the time at which the
    /// window ends.
    Rate,
}

impl Take {
    /// The number and the time (s) it belongs to.
    fn of(self, series: &Series) -> (f64, f64) {
        let first = series.value[0];
        match self {
            Self::Final => (series.value[series.value.len() - 1], series.end()),
            Self::Maximum => series.maximum(),
            Self::Minimum => {
                let (value, time) = series.map(|v| -v).maximum();
                (-value, time)
            }
            Self::MaximumAbsolute => series.map(f64::abs).maximum(),
            Self::Mean => (series.mean(), series.end()),
            Self::MaximumDeviation { from } => series.map(|v| (v - from).abs()).maximum(),
            Self::Drift => series.map(|v| (v - first).abs()).maximum(),
            Self::Rise => series.map(|v| v - first).maximum(),
            Self::Rate => (slope(series), series.end()),
        }
    }
}

/// Least-squares slope over time (1/s); NaN for a single sample.
fn slope(series: &Series) -> f64 {
    let n = series.time.len() as f64;
    let time = series.time.iter().sum::<f64>() / n;
    let value = series.value.iter().sum::<f64>() / n;
    let (mut up, mut down) = (0.0, 0.0);
    for (t, v) in series.time.iter().zip(&series.value) {
        up += (t - time) * (v - value);
        down += (t - time).powi(2);
    }
    up / down
}

/// What the number is divided by.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Divisor {
    /// Not divided; the result keeps the signal's unit.
    #[default]
    Nothing,
    /// A scale in the signal's unit, such as `E A ε₀` of a reaction.
    Scale(f64),
    /// The same statistic of another signal: a ratio of two gauges.
    Same(Signal),
    /// The first value of another signal: a drift relative to the start.
    First(Signal),
}

/// `take(signal in window) / divisor`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statistic {
    /// The history, or a sum of several.
    pub signal: Signal,
    /// The reduction.
    pub take: Take,
    /// The part of the history that is looked at; default all of it.
    #[serde(default)]
    pub window: Window,
    /// The scale; default none.
    #[serde(default)]
    pub divide_by: Divisor,
}

impl Statistic {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let series = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let (value, time) = self.take.of(&series);
        let divisor = match &self.divide_by {
            Divisor::Nothing => None,
            Divisor::Scale(scale) => Some(*scale),
            Divisor::Same(other) => {
                let other = evidence.histories.signal(other)?.window(self.window)?;
                Some(self.take.of(&other).0)
            }
            Divisor::First(other) => Some(evidence.histories.signal(other)?.value[0]),
        };
        if divisor.is_some_and(|d| d == 0.0 || !d.is_finite()) {
            return Err(VerifyError::Metric(format!(
                "`{}` is divided by {:?}, which is zero or not finite in this run",
                self.signal.text(),
                self.divide_by
            )));
        }
        let detail = match self.take {
            Take::Mean | Take::Rate => {
                format!("over {:.4} to {:.4} s", series.start(), series.end())
            }
            _ => format!("at {time:.4} s"),
        };
        Ok(Measurement {
            value: value / divisor.unwrap_or(1.0),
            unit: match (divisor, self.take) {
                (Some(_), _) => "1".into(),
                (None, Take::Rate) => format!("{}/s", series.unit),
                (None, _) => series.unit,
            },
            reference: None,
            detail,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Divisor, Statistic, Take, Window};
    use crate::verify::metric::Evidence;
    use crate::verify::{NoPoints, Signal, histories::tests::histories};

    fn measure(
        take: Take,
        window: Window,
        divide_by: Divisor,
        signal: &str,
    ) -> Result<f64, String> {
        let histories = histories(
            "time [s],top.force_z [N],base.force_z [N]\n0,0,0\n1,-4,2\n2,-10,10.01\n",
            "time [s],a.e [J],b.e [J],zero.e [J]\n0,3,1,0\n1,2,1.5,0\n3,1,3.5,0\n",
        );
        let statistic =
            Statistic { signal: Signal::parse(signal).unwrap(), take, window, divide_by };
        statistic
            .measure(&Evidence { histories: &histories, points: &NoPoints, references: &[] })
            .map(|m| m.value)
            .map_err(|e| e.to_string())
    }

    fn close(a: Result<f64, String>, b: f64) {
        let a = a.unwrap();
        assert!((a - b).abs() < 1e-12, "{a} is not {b}");
    }

    #[test]
    fn reductions_of_known_histories() {
        let none = || Divisor::Nothing;
        close(measure(Take::Final, Window::All, none(), "base.force_z"), 10.01);
        close(measure(Take::Minimum, Window::All, none(), "top.force_z"), -10.0);
        close(measure(Take::MaximumAbsolute, Window::All, none(), "top.force_z"), 10.0);
        // Trapezoids of a.e: (3+2)/2·1 + (2+1)/2·2 = 5.5 over 3 s.
        close(measure(Take::Mean, Window::All, none(), "a.e"), 5.5 / 3.0);
        close(measure(Take::MaximumDeviation { from: 2.5 }, Window::All, none(), "a.e"), 1.5);
        close(measure(Take::Final, Window::Last(1.0), none(), "top.force_z"), -10.0);
        // Slope of (0, 3), (1, 2), (3, 1): Σ(t - 4/3)(v - 2) / Σ(t - 4/3)² = -3 / (42/9).
        close(measure(Take::Rate, Window::All, none(), "a.e"), -3.0 * 9.0 / 42.0);
    }

    #[test]
    fn reaction_ratio_and_energy_drift() {
        let same = Divisor::Same(Signal::parse("-top.force_z").unwrap());
        close(measure(Take::Final, Window::All, same, "base.force_z"), 1.001);
        // The total goes 4, 3.5, 4.5: it drifts by 0.5 both ways and rises by 0.5.
        let first = || Divisor::First(Signal::parse("a.e + b.e").unwrap());
        close(measure(Take::Drift, Window::All, first(), "a.e + b.e"), 0.125);
        close(measure(Take::Rise, Window::Between(0.0, 1.0), first(), "a.e + b.e"), 0.0);
        close(measure(Take::Final, Window::All, Divisor::Scale(2.0), "a.e"), 0.5);
    }

    #[test]
    fn a_zero_scale_or_a_window_past_the_end_is_an_error() {
        let zero = Divisor::First(Signal::parse("zero.e").unwrap());
        assert!(measure(Take::Final, Window::All, zero, "a.e").is_err());
        assert!(measure(Take::Mean, Window::Between(2.0, 9.0), Divisor::Nothing, "a.e").is_err());
    }
}
