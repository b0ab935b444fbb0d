//! Angular frequency of a vibration from its zero crossings.

use super::{Evidence, Measurement};
use crate::verify::{Signal, VerifyError, Window};
use serde::Deserialize;

/// `ω = π / (slope of crossing time over crossing number)` by least squares, in
/// rad/s; crossings of `level` are linear between samples.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frequency {
    /// The history.
    pub signal: Signal,
    /// The window; default all.
    #[serde(default)]
    pub window: Window,
    /// The value vibrated about, in the signal's unit; default 0.
    #[serde(default)]
    pub level: f64,
}

impl Frequency {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let series = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let crossings = self.crossings(&series.time, &series.value);
        let n = crossings.len();
        if n < 3 {
            return Err(VerifyError::Metric(format!(
                "`{}` crosses {} only {n} time(s) between {} s and {} s; 3 are needed",
                series.name,
                self.level,
                series.start(),
                series.end()
            )));
        }
        let middle = 0.5 * (n - 1) as f64;
        let (mut up, mut down) = (0.0, 0.0);
        for (i, time) in crossings.iter().enumerate() {
            let number = i as f64 - middle;
            up += number * time;
            down += number * number;
        }
        Ok(Measurement {
            value: std::f64::consts::PI * down / up,
            unit: "rad/s".into(),
            reference: None,
            detail: format!(
                "{n} crossings from {:.4} s to {:.4} s",
                crossings[0],
                crossings[n - 1]
            ),
        })
    }

    /// Times of the sign changes; a start on the level itself is none.
    fn crossings(&self, time: &[f64], value: &[f64]) -> Vec<f64> {
        let mut crossings = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for (t, v) in time.iter().zip(value) {
            let v = v - self.level;
            if v == 0.0 {
                // The next sample decides whether the level was crossed here.
                continue;
            }
            if let Some((t0, v0)) = before
                && v0.signum() != v.signum()
            {
                crossings.push(t0 + (t - t0) * v0 / (v0 - v));
            }
            before = Some((*t, v));
        }
        crossings
    }
}

#[cfg(test)]
mod tests {
    use super::{Evidence, Frequency, Window};
    use crate::verify::{NoPoints, Signal, histories::tests::histories};
    use std::fmt::Write as _;

    fn frequency(f: impl Fn(f64) -> f64, level: f64) -> Result<f64, String> {
        let mut gauges = String::from("time [s],tip.x [m]\n");
        for i in 0..=600 {
            let t = 0.05 * f64::from(i);
            writeln!(gauges, "{t},{}", f(t)).unwrap();
        }
        let histories = histories(&gauges, "time [s],a.b [J]\n0,1\n");
        let metric =
            Frequency { signal: Signal::parse("tip.x").unwrap(), window: Window::All, level };
        metric
            .measure(&Evidence { histories: &histories, points: &NoPoints, references: &[] })
            .map(|m| m.value)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn a_sine_gives_its_frequency() {
        for omega in [0.62831853, 0.7, 2.0] {
            let found = frequency(|t| 0.159 * (omega * t).sin(), 0.0).unwrap();
            assert!((found / omega - 1.0).abs() < 1e-5, "{found} for {omega}");
            let found = frequency(|t| 3.0 + (omega * t + 0.3).cos(), 3.0).unwrap();
            assert!((found / omega - 1.0).abs() < 1e-4, "{found} for {omega}");
        }
    }

    #[test]
    fn a_frequency_half_a_per_mille_off_is_seen() {
        let omega = std::f64::consts::TAU / 10.0;
        let found = frequency(|t| (1.0005 * omega * t).sin(), 0.0).unwrap();
        assert!((found / omega - 1.0005).abs() < 2e-5, "{found}");
    }

    #[test]
    fn no_vibration_is_an_error() {
        assert!(frequency(|t| t, 0.0).unwrap_err().contains("crosses"));
        assert!(frequency(|_| 0.0, 0.0).is_err());
    }
}
