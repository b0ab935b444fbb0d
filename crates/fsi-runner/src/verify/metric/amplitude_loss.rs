//! How much a vibration loses in amplitude over a number of periods.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError, Window};
use serde::Deserialize;

/// `1 - A_n/A_0`: the swing of period n after that of the first period; a growing
/// vibration gives a negative loss.
///
/// Periods run from one upward crossing of `level` to the next; the swing of a
/// period is half the distance from its lowest to its highest value, each the
/// vertex of the parabola through the sample and its neighbours.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AmplitudeLoss {
    /// The history.
    pub signal: Signal,
    /// Periods between the two swings, at least 1.
    pub periods: usize,
    /// The window; default all.
    #[serde(default)]
    pub window: Window,
    /// The value vibrated about, in the signal's unit; default 0.
    #[serde(default)]
    pub level: f64,
}

impl AmplitudeLoss {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let series = evidence.histories.signal(&self.signal)?.window(self.window)?;
        let starts = self.starts(&series);
        let whole = starts.len().saturating_sub(1);
        if self.periods == 0 || whole < self.periods + 1 {
            return Err(VerifyError::Metric(format!(
                "`{}` has {whole} whole period(s) between {} s and {} s; a loss over {} (at least 1) needs {}",
                series.name,
                series.start(),
                series.end(),
                self.periods,
                self.periods + 1
            )));
        }
        let swing = |period: usize| swing(&series, starts[period], starts[period + 1]);
        let (first, last) = (swing(0), swing(self.periods));
        Ok(Measurement {
            value: 1.0 - last / first,
            unit: "1".into(),
            reference: None,
            detail: format!(
                "amplitude {first:.4e} to {last:.4e} {} over {} periods from {:.4} s",
                series.unit, self.periods, series.time[starts[0]]
            ),
        })
    }

    /// First sample at or above the level after one below it, of each period.
    fn starts(&self, series: &Series) -> Vec<usize> {
        let value = &series.value;
        (1..value.len()).filter(|&i| value[i - 1] < self.level && value[i] >= self.level).collect()
    }
}

/// Half the distance from the lowest to the highest value of samples `from..to`.
fn swing(series: &Series, from: usize, to: usize) -> f64 {
    let value = &series.value;
    let extreme = |sign: f64| {
        let best = (from..to).max_by(|&a, &b| (sign * value[a]).total_cmp(&(sign * value[b])));
        best.map_or(0.0, |i| vertex(series, i))
    };
    0.5 * (extreme(1.0) - extreme(-1.0))
}

/// Value at the vertex of the parabola through sample `i` and its neighbours.
fn vertex(series: &Series, i: usize) -> f64 {
    let (time, value) = (&series.time, &series.value);
    if i == 0 || i + 1 == value.len() {
        return value[i];
    }
    let (before, after) = (time[i] - time[i - 1], time[i + 1] - time[i]);
    let (down, up) = ((value[i] - value[i - 1]) / before, (value[i + 1] - value[i]) / after);
    let curvature = (up - down) / (before + after);
    let slope = (down * after + up * before) / (before + after);
    if curvature == 0.0 { value[i] } else { value[i] - slope * slope / (4.0 * curvature) }
}

#[cfg(test)]
mod tests {
    use super::{AmplitudeLoss, Evidence, Window};
    use crate::verify::{NoPoints, Signal, histories::tests::histories};
    use std::fmt::Write as _;

    /// Loss of a vibration of period 1 s sampled 40 times a period for 12.3 s.
    fn loss(periods: usize, level: f64, f: impl Fn(f64) -> f64) -> Result<f64, String> {
        let mut gauges = String::from("time [s],tip.y [m]\n");
        for i in 0..=492 {
            let t = 0.025 * f64::from(i);
            writeln!(gauges, "{t},{}", f(t)).unwrap();
        }
        let histories = histories(&gauges, "time [s],a.b [J]\n0,1\n");
        let signal = Signal::parse("tip.y").unwrap();
        let metric = AmplitudeLoss { signal, periods, window: Window::All, level };
        let evidence = Evidence { histories: &histories, points: &NoPoints, references: &[] };
        metric.measure(&evidence).map(|m| m.value).map_err(|e| e.to_string())
    }

    fn wave(t: f64) -> f64 {
        (std::f64::consts::TAU * t + 0.4).sin()
    }

    #[test]
    fn an_undamped_vibration_loses_nothing_whatever_the_sampling() {
        let found = loss(10, 0.0, |t| 0.02 * wave(t)).unwrap();
        assert!(found.abs() < 1e-12, "{found}");
        // A period of 1.013 s puts the samples elsewhere in every period.
        let found = loss(10, 0.0, |t| 0.02 * wave(t / 1.013)).unwrap();
        assert!(found.abs() < 2e-5, "{found}");
    }

    #[test]
    fn damping_gives_its_logarithmic_decrement_and_growth_is_negative() {
        for rate in [-0.05_f64, 0.01, 0.1] {
            let found = loss(8, 3.0, |t| 3.0 + 0.5 * (-rate * t).exp() * wave(t)).unwrap();
            let exact = 1.0 - (-rate * 8.0).exp();
            assert!((found - exact).abs() < 1e-3, "{found} for {exact}");
        }
    }

    #[test]
    fn too_few_periods_are_an_error() {
        assert!(loss(12, 0.0, wave).unwrap_err().contains("needs 13"));
        assert!(loss(0, 0.0, wave).is_err());
        assert!(loss(1, 5.0, wave).is_err());
    }
}
