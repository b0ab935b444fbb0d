//! A quantity sampled in time.

use super::VerifyError;
use serde::Deserialize;

/// The part of a history that a metric looks at.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Window {
    /// The whole history.
    #[default]
    All,
    /// From this time (s) to the end.
    From(f64),
    /// The last so many seconds.
    Last(f64),
    /// Between two times (s), both included.
    Between(f64, f64),
}

/// Samples `(time s, value)`, times strictly increasing, at least one.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What it is, for messages.
    pub name: String,
    /// Unit of the values, such as `Pa`.
    pub unit: String,
    /// Times (s).
    pub time: Vec<f64>,
    /// Values.
    pub value: Vec<f64>,
}

impl Series {
    /// The series, if it has samples, all finite, at increasing times.
    ///
    /// # Errors
    /// [`VerifyError::Metric`] names the first sample at fault.
    pub fn new(
        name: &str,
        unit: &str,
        time: Vec<f64>,
        value: Vec<f64>,
    ) -> Result<Self, VerifyError> {
        if time.is_empty() || time.len() != value.len() {
            return Err(VerifyError::Metric(format!(
                "`{name}` has {} times and {} values; at least one sample is needed",
                time.len(),
                value.len()
            )));
        }
        let mut before = f64::NEG_INFINITY;
        for (i, (t, v)) in time.iter().zip(&value).enumerate() {
            if !(t.is_finite() && v.is_finite() && *t > before) {
                return Err(VerifyError::Metric(format!(
                    "`{name}` sample {i}: (time {t} s, value {v}) is not finite or not later than the sample before"
                )));
            }
            before = *t;
        }
        Ok(Self { name: name.into(), unit: unit.into(), time, value })
    }

    /// Time of the first sample (s).
    #[must_use]
    pub fn start(&self) -> f64 {
        self.time[0]
    }

    /// Time of the last sample (s).
    #[must_use]
    pub fn end(&self) -> f64 {
        self.time[self.time.len() - 1]
    }

    /// Value at `time`, linear between samples; `None` outside the history.
    ///
    /// A time past an end by less than half the neighbouring sample interval
    /// takes the value there: a run ends at its last step, not on the dot.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<f64> {
        let n = self.time.len();
        let after = self.time.partition_point(|t| *t < time);
        if after == 0 {
            let slack = if n > 1 { 0.5 * (self.time[1] - self.time[0]) } else { 0.0 };
            return (self.time[0] - time <= slack).then_some(self.value[0]);
        }
        if after == n {
            let slack = if n > 1 { 0.5 * (self.time[n - 1] - self.time[n - 2]) } else { 0.0 };
            return (time - self.time[n - 1] <= slack).then_some(self.value[n - 1]);
        }
        let (t0, t1) = (self.time[after - 1], self.time[after]);
        let (v0, v1) = (self.value[after - 1], self.value[after]);
        Some(v0 + (v1 - v0) * (time - t0) / (t1 - t0))
    }

    /// The samples inside `window`.
    ///
    /// # Errors
    /// [`VerifyError::Span`] if the window holds no sample or reaches past the
    /// history (a run that stopped early must not pass on what it did not do).
    pub fn window(&self, window: Window) -> Result<Self, VerifyError> {
        let (from, to) = match window {
            Window::All => return Ok(self.clone()),
            Window::From(from) => (from, self.end()),
            Window::Last(duration) => (self.end() - duration, self.end()),
            Window::Between(from, to) => (from, to),
        };
        let reached = self.at(from).is_some() && self.at(to).is_some();
        // Sample times are sums of steps: 4.0 may be stored as 3.9999999999.
        let slack = 1e-9 * self.end().abs();
        let keep: Vec<usize> = (0..self.time.len())
            .filter(|&i| (from - slack..=to + slack).contains(&self.time[i]))
            .collect();
        if keep.is_empty() || !reached {
            return Err(VerifyError::Span {
                what: format!("`{}`", self.name),
                from,
                to,
                first: self.start(),
                last: self.end(),
            });
        }
        Ok(Self {
            name: self.name.clone(),
            unit: self.unit.clone(),
            time: keep.iter().map(|&i| self.time[i]).collect(),
            value: keep.iter().map(|&i| self.value[i]).collect(),
        })
    }

    /// Largest value and its time (the first, if several are equal).
    #[must_use]
    pub fn maximum(&self) -> (f64, f64) {
        let mut best = (self.value[0], self.time[0]);
        for (v, t) in self.value.iter().zip(&self.time) {
            if *v > best.0 {
                best = (*v, *t);
            }
        }
        best
    }

    /// The series with `function` applied to every value.
    #[must_use]
    pub fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        Self { value: self.value.iter().map(|v| function(*v)).collect(), ..self.clone() }
    }

    /// Mean over time by the trapezoidal rule; of a single sample, its value.
    #[must_use]
    pub fn mean(&self) -> f64 {
        if self.time.len() < 2 {
            return self.value[0];
        }
        let area: f64 = self
            .time
            .windows(2)
            .zip(self.value.windows(2))
            .map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]))
            .sum();
        area / (self.end() - self.start())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::{Series, Window};

    /// `f` sampled `n + 1` times from 0 to `end`.
    pub(in crate::verify) fn sampled(end: f64, n: usize, f: impl Fn(f64) -> f64) -> Series {
        let time: Vec<f64> = (0..=n).map(|i| end * i as f64 / n as f64).collect();
        let value = time.iter().map(|t| f(*t)).collect();
        Series::new("s", "m", time, value).unwrap()
    }

    #[test]
    fn interpolates_and_forgives_half_an_interval() {
        let s = sampled(1.0, 10, |t| 3.0 * t);
        assert!((s.at(0.333).unwrap() - 0.999).abs() < 1e-12);
        assert_eq!(s.at(1.04), Some(3.0));
        assert_eq!(s.at(1.06), None);
        assert_eq!(s.at(-0.2), None);
    }

    #[test]
    fn windows() {
        let s = sampled(5.0, 50, |t| t);
        assert_eq!(s.window(Window::Last(1.0)).unwrap().time.len(), 11);
        assert_eq!(s.window(Window::From(4.5)).unwrap().start(), 4.5);
        assert!(s.window(Window::Between(4.0, 6.0)).is_err());
        assert!(s.window(Window::Last(9.0)).is_err());
    }

    #[test]
    fn mean_weighs_by_time_not_by_sample() {
        let s = Series::new("s", "m", vec![0.0, 0.1, 1.0], vec![0.0, 0.1, 1.0]).unwrap();
        assert!((s.mean() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn broken_histories_are_refused() {
        assert!(Series::new("s", "m", vec![], vec![]).is_err());
        assert!(Series::new("s", "m", vec![0.0, 0.0], vec![1.0, 1.0]).is_err());
        assert!(Series::new("s", "m", vec![0.0, 1.0], vec![1.0, f64::NAN]).is_err());
    }
}
