//! A steady acceleration from a history of displacement.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError, Window};
use serde::Deserialize;

/// `a` of the least-squares parabola `s = s0 + v0 t + ½ a t²` through a history.
///
/// The fit uses every sample, so it is blind to vibration that the second
/// difference of samples would be full of. Of a velocity, take
/// `Statistic(take: Rate)` instead.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Acceleration {
    /// The history of a position or displacement.
    pub signal: Signal,
    /// The window; default all.
    #[serde(default)]
    pub window: Window,
}

impl Acceleration {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let series = evidence.histories.signal(&self.signal)?.window(self.window)?;
        if series.time.len() < 3 {
            return Err(VerifyError::Metric(format!(
                "`{}` has {} sample(s) between {} s and {} s; a parabola needs 3",
                series.name,
                series.time.len(),
                series.start(),
                series.end()
            )));
        }
        let (curvature, deviation) = parabola(&series);
        Ok(Measurement {
            value: 2.0 * curvature,
            unit: format!("{}/s^2", series.unit),
            reference: None,
            detail: format!(
                "over {:.4} to {:.4} s; largest distance from the parabola {deviation:.3e} {}",
                series.start(),
                series.end(),
                series.unit
            ),
        })
    }
}

/// Quadratic coefficient of the least-squares parabola, and the largest residual.
///
/// Polynomials orthogonal on the samples (Forsythe 1957), on times scaled to -1..1: no
/// ill-conditioned normal equations.
fn parabola(series: &Series) -> (f64, f64) {
    let middle = 0.5 * (series.start() + series.end());
    let half = 0.5 * (series.end() - series.start());
    let x: Vec<f64> = series.time.iter().map(|t| (t - middle) / half).collect();
    let y = &series.value;
    let n = x.len() as f64;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mean = x.iter().sum::<f64>() / n;
    let first: Vec<f64> = x.iter().map(|x| x - mean).collect();
    let norm = dot(&first, &first);
    let shift = dot(&x, &first.iter().map(|p| p * p).collect::<Vec<_>>()) / norm;
    let second: Vec<f64> = x.iter().zip(&first).map(|(x, p)| (x - shift) * p - norm / n).collect();
    let coefficients =
        [y.iter().sum::<f64>() / n, dot(y, &first) / norm, dot(y, &second) / dot(&second, &second)];
    let residual = (0..y.len())
        .map(|i| {
            let fit = coefficients[0] + coefficients[1] * first[i] + coefficients[2] * second[i];
            (y[i] - fit).abs()
        })
        .fold(0.0, f64::max);
    (coefficients[2] / (half * half), residual)
}

#[cfg(test)]
mod tests {
    use super::{Acceleration, Evidence, Window};
    use crate::verify::{NoPoints, Signal, histories::tests::histories};
    use std::fmt::Write as _;

    fn acceleration(f: impl Fn(f64) -> f64, window: Window) -> Result<f64, String> {
        let mut gauges = String::from("time [s],ball.displacement_x [m]\n");
        for i in 0..=400 {
            let t = 100.0 + 0.005 * f64::from(i);
            writeln!(gauges, "{t},{}", f(t)).unwrap();
        }
        let histories = histories(&gauges, "time [s],a.b [J]\n0,1\n");
        let metric = Acceleration { signal: Signal::parse("ball.displacement_x").unwrap(), window };
        let evidence = Evidence { histories: &histories, points: &NoPoints, references: &[] };
        metric.measure(&evidence).map(|m| m.value).map_err(|e| e.to_string())
    }

    #[test]
    fn a_parabola_gives_its_acceleration_far_from_the_origin_of_time() {
        let exact = |t: f64| 0.3 - 2.0 * (t - 100.0) + 0.5 * 7.0 * (t - 100.0).powi(2);
        let a = acceleration(exact, Window::All).unwrap();
        assert!((a - 7.0).abs() < 1e-9, "{a}");
        let a = acceleration(exact, Window::Between(100.5, 101.0)).unwrap();
        assert!((a - 7.0).abs() < 1e-7, "{a}");
    }

    #[test]
    fn vibration_on_top_hardly_matters_and_a_wrong_acceleration_is_seen() {
        let shaken = |t: f64| 0.5 * 7.07 * (t - 100.0).powi(2) + 1e-3 * (200.0 * t).sin();
        let a = acceleration(shaken, Window::All).unwrap();
        assert!((a - 7.07).abs() < 5e-4, "{a}");
    }

    #[test]
    fn too_few_samples_are_an_error() {
        let error = acceleration(|t| t, Window::Between(100.0, 100.005)).unwrap_err();
        assert!(error.contains("needs 3"), "{error}");
    }
}
