//! Gates: the condition a measured value has to meet.

use serde::Deserialize;
use std::fmt;

/// The condition on a measured value `m` with reference `r`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Gate {
    /// `m ≤ limit`.
    AtMost(f64),
    /// `|m - r| ≤ tolerance · |r|`.
    Within(f64),
    /// `|m - r| ≤ tolerance`, in the unit of `m`.
    WithinAbsolute(f64),
    /// `lower ≤ m ≤ upper`.
    Between(f64, f64),
    /// No gate: the value is printed beside the reference, for the reason given.
    Report(String),
}

impl Gate {
    /// Whether the gate compares with a reference value.
    #[must_use]
    pub fn needs_reference(&self) -> bool {
        matches!(self, Self::Within(_) | Self::WithinAbsolute(_))
    }

    /// `Some(met)`, or `None` where nothing is to be judged ([`Gate::Report`]).
    ///
    /// A value that is not finite meets no gate; neither does a comparison
    /// without a reference.
    #[must_use]
    pub fn judge(&self, measured: f64, reference: Option<f64>) -> Option<bool> {
        let off = reference.map(|r| (measured - r).abs());
        let met = match self {
            Self::AtMost(limit) => measured <= *limit,
            Self::Within(tolerance) => {
                off.zip(reference).is_some_and(|(off, r)| off <= tolerance * r.abs())
            }
            Self::WithinAbsolute(tolerance) => off.is_some_and(|off| off <= *tolerance),
            Self::Between(lower, upper) => (*lower..=*upper).contains(&measured),
            Self::Report(_) => return None,
        };
        Some(met && measured.is_finite())
    }

    /// What is wrong with the numbers of the gate, if anything.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        match self {
            Self::AtMost(limit) if limit.is_nan() => Some("the limit is NaN".into()),
            Self::Within(t) | Self::WithinAbsolute(t) if !(t.is_finite() && *t >= 0.0) => {
                Some(format!("the tolerance is {t}; it must be finite and not negative"))
            }
            Self::Between(lower, upper) if lower.is_nan() || upper.is_nan() || lower > upper => {
                Some(format!("the interval {lower} to {upper} is empty"))
            }
            Self::Report(reason) if reason.trim().is_empty() => {
                Some("a reported value needs the reason why it has no gate".into())
            }
            _ => None,
        }
    }
}

impl fmt::Display for Gate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(limit) if *limit != 0.0 && limit.abs() < 1e-3 => write!(f, "<= {limit:e}"),
            Self::AtMost(limit) => write!(f, "<= {limit}"),
            Self::Within(tolerance) => {
                // Rounded so that 0.003 prints as 0.3 and not 0.30000000000000004.
                write!(f, "within {} %", (tolerance * 1e8).round() / 1e6)
            }
            Self::WithinAbsolute(tolerance) => write!(f, "within +-{tolerance}"),
            Self::Between(lower, upper) => write!(f, "{lower} to {upper}"),
            Self::Report(_) => write!(f, "(reported)"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Gate;

    #[test]
    fn gates_meet_and_miss() {
        assert_eq!(Gate::AtMost(0.1).judge(0.1, None), Some(true));
        assert_eq!(Gate::AtMost(0.1).judge(0.1001, None), Some(false));
        assert_eq!(Gate::Within(0.01).judge(-1.009, Some(-1.0)), Some(true));
        assert_eq!(Gate::Within(0.01).judge(-1.011, Some(-1.0)), Some(false));
        assert_eq!(Gate::WithinAbsolute(0.5).judge(0.4, Some(0.0)), Some(true));
        assert_eq!(Gate::Between(-1.0, 2.0).judge(2.1, None), Some(false));
        assert_eq!(Gate::Report("no agreed tolerance".into()).judge(7.0, None), None);
    }

    #[test]
    fn nothing_passes_without_a_number_or_a_reference() {
        assert_eq!(Gate::AtMost(1.0).judge(f64::NAN, None), Some(false));
        assert_eq!(Gate::AtMost(1.0).judge(f64::NEG_INFINITY, None), Some(false));
        assert_eq!(Gate::Within(1.0).judge(1.0, None), Some(false));
    }

    #[test]
    fn gates_print_shortly() {
        assert_eq!(Gate::AtMost(1e-12).to_string(), "<= 1e-12");
        assert_eq!(Gate::AtMost(0.05).to_string(), "<= 0.05");
        assert_eq!(Gate::Within(0.003).to_string(), "within 0.3 %");
    }

    #[test]
    fn senseless_gates_are_named() {
        assert!(Gate::Between(2.0, 1.0).fault().is_some());
        assert!(Gate::Within(-0.1).fault().is_some());
        assert!(Gate::Report(" ".into()).fault().is_some());
        assert!(Gate::Between(0.0, f64::INFINITY).fault().is_none());
    }
}
