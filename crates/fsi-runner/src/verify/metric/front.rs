//! A dam-break front against the band that several experiments span.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError};
use serde::Deserialize;

/// Largest relative distance of the front outside the experiments' band.
///
/// With `Z = (front - origin)/width` and `T = t sqrt(2g/width)`, experiments are
/// files of rows `(T, Z)`, linear between rows. At every sample time of every
/// experiment whose sample has `Z ≤ up_to`, the band runs from the smallest to
/// the largest `Z` of all experiments that cover that time, and the distance is
/// `Z/max - 1` above it, `1 - Z/min` below it and 0 inside. A gate
/// `AtMost(0.05)` therefore means "within ±5 % of the band".
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrontBand {
    /// The front's position (m).
    pub signal: Signal,
    /// Position of the back wall of the column (m); default 0.
    #[serde(default)]
    pub origin: f64,
    /// Initial width a of the column (m).
    pub width: f64,
    /// Gravity g (m/s²).
    pub gravity: f64,
    /// Largest `Z` of the samples compared.
    pub up_to: f64,
}

impl FrontBand {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let run = evidence.histories.signal(&self.signal)?;
        let experiments = evidence
            .references
            .iter()
            .map(|table| table.series(None))
            .collect::<Result<Vec<Series>, _>>()?;
        let rate = (2.0 * self.gravity / self.width).sqrt();
        let mut worst: Option<(f64, String)> = None;
        let mut compared = 0;
        for experiment in &experiments {
            for (&scaled_time, &sample) in experiment.time.iter().zip(&experiment.value) {
                if sample > self.up_to {
                    continue;
                }
                let time = scaled_time / rate;
                let front = run.at(time).ok_or_else(|| VerifyError::Span {
                    what: format!("front at T = {scaled_time} of {}", experiment.name),
                    from: time,
                    to: time,
                    first: run.start(),
                    last: run.end(),
                })?;
                let z = (front - self.origin) / self.width;
                let (lower, upper) = band(&experiments, scaled_time);
                let distance = (z / upper - 1.0).max(1.0 - z / lower).max(0.0);
                compared += 1;
                if worst.as_ref().is_none_or(|(w, _)| distance > *w) {
                    worst = Some((
                        distance,
                        format!("Z {z:.3} at T {scaled_time:.3}, band {lower:.3} to {upper:.3}"),
                    ));
                }
            }
        }
        let (value, place) = worst.ok_or_else(|| {
            VerifyError::Metric(format!("no experiment has a sample with Z <= {}", self.up_to))
        })?;
        Ok(Measurement {
            value,
            unit: "1".into(),
            reference: None,
            detail: format!("worst of {compared} samples: {place}"),
        })
    }
}

/// Smallest and largest front of the experiments that cover `scaled_time`.
///
/// Extrapolation is ruled out: an experiment counts from its first to its last
/// sample only.
fn band(experiments: &[Series], scaled_time: f64) -> (f64, f64) {
    experiments
        .iter()
        .filter(|e| (e.start()..=e.end()).contains(&scaled_time))
        .filter_map(|e| e.at(scaled_time))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, u), z| (l.min(z), u.max(z)))
}

#[cfg(test)]
mod tests {
    use super::{Evidence, FrontBand};
    use crate::verify::{NoPoints, ReferenceTable, Signal, histories::tests::histories};
    use std::fmt::Write as _;
    use std::path::Path;

    /// The metric for a run with `Z(T)`, `a = 0.5`, `g = 4`, so that `T = 4t`.
    fn distance(z: impl Fn(f64) -> f64, end: f64) -> Result<f64, String> {
        let mut gauges = String::from("time [s],front.position [m]\n");
        for i in 0..=400 {
            let t = end * f64::from(i) / 400.0;
            writeln!(gauges, "{t},{}", 1.0 + 0.5 * z(4.0 * t)).unwrap();
        }
        let histories = histories(&gauges, "time [s],a.b [J]\n0,1\n");
        let slow = "T,Z\n0,1\n1,1.5\n2,2\n4,3\n5,3.5\n";
        let fast = "T,Z\n0.5,1.5\n1.5,2.5\n2.5,3.5\n";
        let references =
            [slow, fast].map(|text| ReferenceTable::parse(Path::new("e.csv"), text).unwrap());
        let metric = FrontBand {
            signal: Signal::parse("front.position").unwrap(),
            origin: 1.0,
            width: 0.5,
            gravity: 4.0,
            up_to: 3.0,
        };
        metric
            .measure(&Evidence {
                histories: &histories,
                points: &NoPoints,
                references: &references,
            })
            .map(|m| m.value)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn a_front_inside_the_band_has_no_distance() {
        // The slow experiment is the lower edge wherever both exist.
        assert!(distance(|t| 1.0 + 0.5 * t, 2.0).unwrap() < 1e-12);
        // Alone at T = 0 the slow experiment is the whole band, at Z = 1.
        let late = distance(|t| 1.1 + 0.5 * t, 2.0).unwrap();
        assert!((late - 0.1).abs() < 1e-9, "{late}");
    }

    #[test]
    fn a_slow_front_is_measured_from_the_lower_edge() {
        // Z = 1 forever: worst against the slow experiment's Z = 3 at T = 4.
        let d = distance(|_| 1.0, 2.0).unwrap();
        assert!((d - (1.0 - 1.0 / 3.0)).abs() < 1e-9, "{d}");
    }

    #[test]
    fn a_run_that_stops_early_is_an_error() {
        assert!(distance(|t| 1.0 + 0.5 * t, 0.8).unwrap_err().contains("T = 4"));
    }
}
