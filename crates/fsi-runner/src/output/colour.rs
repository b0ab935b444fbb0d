//! Numbers to colours.

/// An sRGB colour.
pub type Rgb = [u8; 3];

/// The turbo colour map at `t` in 0..1 (blue, green, yellow, red); clamped outside.
///
/// Polynomial of degree five by R. Tanna to A. Mikhailov's map (Google, 2019).
pub fn turbo(t: f64) -> Rgb {
    const RED: [f64; 6] = [0.1357, 4.6154, -42.6603, 132.1311, -152.9424, 59.2864];
    const GREEN: [f64; 6] = [0.0914, 2.1942, 4.8430, -14.1850, 4.2773, 2.8296];
    const BLUE: [f64; 6] = [0.1067, 12.6419, -60.5820, 110.3628, -89.9031, 27.3482];
    let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
    let channel = |c: [f64; 6]| {
        let value = c.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient);
        (value.clamp(0.0, 1.0) * 255.0).round() as u8
    };
    [channel(RED), channel(GREEN), channel(BLUE)]
}

/// Colours from 0 to an upper bound that is a round number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourScale {
    /// The value that gets the last colour.
    pub upper: f64,
}

impl ColourScale {
    /// A scale that covers `value`.
    pub fn covering(value: f64) -> Self {
        Self { upper: round_up(value) }
    }

    /// The colour of `value`.
    pub fn colour(self, value: f64) -> Rgb {
        turbo(if self.upper > 0.0 { value / self.upper } else { 0.0 })
    }

    /// Grows to cover `value`; true when it did. Never shrinks, so that colours
    /// of one run can be compared.
    pub fn grow(&mut self, value: f64) -> bool {
        let upper = round_up(value);
        let grows = upper > self.upper;
        if grows {
            self.upper = upper;
        }
        grows
    }
}

/// The next of 1, 1.5, 2, 3, 5 or 7 times a power of ten; 0 stays 0.
fn round_up(value: f64) -> f64 {
    if !value.is_finite() || value <= 0.0 {
        return 0.0;
    }
    let power = 10f64.powf(value.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0];
    // Round-off must not push an exact step to the next one.
    let step = steps.into_iter().find(|step| step * power >= value * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

/// The value that a share of 1/200 of the finite `values` exceeds: the colour
/// scale should not follow a single point.
pub fn high_percentile(values: &[f64]) -> f64 {
    let mut finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    if finite.is_empty() {
        return 0.0;
    }
    let rank = (finite.len() - 1) * 199 / 200;
    *finite.select_nth_unstable_by(rank, f64::total_cmp).1
}

/// `1.5e4 Pa` as `15 kPa`.
pub fn engineering(value: f64, unit: &str) -> String {
    let prefixes = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ")];
    if value == 0.0 || unit == "1" {
        return format!("{value}");
    }
    let (factor, prefix) =
        prefixes.into_iter().find(|(f, _)| value.abs() >= *f).unwrap_or((1e-9, "n"));
    let scaled = (value / factor * 1000.0).round() / 1000.0;
    format!("{scaled} {prefix}{unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turbo_runs_from_blue_to_red() {
        let [red, _, blue] = turbo(0.1);
        assert!(blue > red);
        let [red, green, blue] = turbo(0.9);
        assert!(red > green && red > blue);
        assert_eq!(turbo(f64::NAN), turbo(-1.0));
    }

    #[test]
    fn scales_are_round_and_only_grow() {
        let mut scale = ColourScale::covering(19_620.0);
        assert_eq!(scale.upper, 20_000.0);
        assert!(!scale.grow(20_000.0));
        assert!(scale.grow(20_001.0));
        assert_eq!(scale.upper, 30_000.0);
        assert_eq!(ColourScale::covering(0.0).upper, 0.0);
        assert_eq!(engineering(30_000.0, "Pa"), "30 kPa");
        assert_eq!(engineering(0.0015, "m"), "1.5 mm");
    }

    #[test]
    fn one_point_does_not_set_the_scale() {
        let mut values = vec![1.0; 1000];
        values[17] = 1e9;
        values[18] = f64::NAN;
        assert_eq!(high_percentile(&values), 1.0);
    }
}
