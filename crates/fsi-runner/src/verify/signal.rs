//! Signals: sums and differences of history columns, written as text.

use super::VerifyError;
use serde::Deserialize;

/// A sum of history columns, such as `"solid.kinetic + solid.strain"` or
/// `"-base load.force_x"`.
///
/// Columns are named `NAME.QUANTITY` without the unit; `+` and `-` stand
/// between spaces (a name may hold either without spaces around it).
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Signal {
    text: String,
    terms: Vec<(f64, String)>,
}

impl Signal {
    /// Reads the expression.
    ///
    /// # Errors
    /// [`VerifyError::Signal`] if a term is missing.
    pub fn parse(text: &str) -> Result<Self, VerifyError> {
        let broken = || VerifyError::Signal(text.into());
        let mut terms = Vec::new();
        let mut rest = text.trim();
        let mut sign = 1.0;
        if let Some(stripped) = rest.strip_prefix('-') {
            (sign, rest) = (-1.0, stripped.trim_start());
        }
        loop {
            let plus = rest.find(" + ");
            let minus = rest.find(" - ");
            let cut = plus.into_iter().chain(minus).min();
            let column = rest[..cut.unwrap_or(rest.len())].trim();
            if column.is_empty() || column.ends_with(['+', '-']) {
                return Err(broken());
            }
            terms.push((sign, column.to_owned()));
            let Some(cut) = cut else { break };
            sign = if plus == Some(cut) { 1.0 } else { -1.0 };
            rest = &rest[cut + 3..];
        }
        Ok(Self { text: text.into(), terms })
    }

    /// Terms `(sign, column)`.
    #[must_use]
    pub fn terms(&self) -> &[(f64, String)] {
        &self.terms
    }

    /// The expression as written.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

impl TryFrom<String> for Signal {
    type Error = VerifyError;
    fn try_from(text: String) -> Result<Self, VerifyError> {
        Self::parse(&text)
    }
}

#[cfg(test)]
mod tests {
    use super::Signal;

    #[test]
    fn sums_differences_and_names_with_spaces() {
        let s = Signal::parse("-base load.force_x + a.x - b-c.x").unwrap();
        let expected =
            [(-1.0, "base load.force_x".to_owned()), (1.0, "a.x".into()), (-1.0, "b-c.x".into())];
        assert_eq!(s.terms(), expected);
    }

    #[test]
    fn missing_terms_are_refused() {
        for text in ["", "-", "a.x + ", "a.x +  + b.x"] {
            assert!(Signal::parse(text).is_err(), "{text:?}");
        }
    }
}
