//! The table of results.

use super::Gate;
use std::fmt;

/// What became of a check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The gate is met.
    Pass,
    /// The gate is missed.
    Fail,
    /// No gate; the value is reported.
    Reported,
    /// The value could not be formed, for this reason; counts as a failure.
    Broken(String),
}

/// One row of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckResult {
    /// Name of the check.
    pub name: String,
    /// The measured value; NaN if it could not be formed.
    pub measured: f64,
    /// Its unit; `1` for a ratio.
    pub unit: String,
    /// The reference value, where there is one.
    pub reference: Option<f64>,
    /// The gate.
    pub gate: Gate,
    /// Pass, fail, reported or broken.
    pub outcome: Outcome,
    /// Where and when, or why.
    pub detail: String,
    /// Where the reference and the limit come from.
    pub source: String,
}

impl CheckResult {
    /// False if the check failed or could not be evaluated.
    #[must_use]
    pub fn passed(&self) -> bool {
        matches!(self.outcome, Outcome::Pass | Outcome::Reported)
    }
}

/// The rows of one case, printed as an aligned table.
#[derive(Debug, Clone, PartialEq)]
pub struct ResultTable(pub Vec<CheckResult>);

impl ResultTable {
    /// Whether no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.0.iter().all(CheckResult::passed)
    }
}

/// Five significant digits, without a tail of zeros.
fn number(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-3..1e5).contains(&magnitude) {
        let decimals = if value == 0.0 { 0 } else { (4 - magnitude.log10().floor() as i32).max(0) };
        let text = format!("{value:.*}", decimals as usize);
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').into();
        }
        return text;
    }
    format!("{value:.3e}")
}

fn with_unit(value: f64, unit: &str) -> String {
    if unit == "1" || unit.is_empty() { number(value) } else { format!("{} {unit}", number(value)) }
}

impl fmt::Display for ResultTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rows = vec![
            ["check", "measured", "reference", "gate", "result", "detail"]
                .map(String::from)
                .to_vec(),
        ];
        for check in &self.0 {
            let (result, detail) = match &check.outcome {
                Outcome::Pass => ("pass", check.detail.clone()),
                Outcome::Fail => ("FAIL", check.detail.clone()),
                Outcome::Reported => ("report", check.detail.clone()),
                Outcome::Broken(reason) => ("BROKEN", reason.clone()),
            };
            rows.push(vec![
                check.name.clone(),
                if check.measured.is_nan() {
                    "-".into()
                } else {
                    with_unit(check.measured, &check.unit)
                },
                check.reference.map_or("-".into(), number),
                check.gate.to_string(),
                result.into(),
                detail,
            ]);
        }
        let width: Vec<usize> = (0..rows[0].len())
            .map(|c| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0))
            .collect();
        for row in rows {
            let line: Vec<String> =
                row.iter().zip(&width).map(|(cell, w)| format!("{cell:<w$}")).collect();
            writeln!(f, "{}", line.join("  ").trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{CheckResult, Gate, Outcome, ResultTable, number};

    fn row(name: &str, measured: f64, outcome: Outcome) -> CheckResult {
        CheckResult {
            name: name.into(),
            measured,
            unit: "Pa".into(),
            reference: Some(11239.4),
            gate: Gate::Within(0.003),
            outcome,
            detail: "at 0.4150 s".into(),
            source: "a paper".into(),
        }
    }

    #[test]
    fn numbers_keep_five_digits() {
        assert_eq!(number(11239.44), "11239");
        assert_eq!(number(1.0127638), "1.0128");
        assert_eq!(number(-0.05), "-0.05");
        assert_eq!(number(100.0), "100");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(3.25e-13), "3.250e-13");
    }

    #[test]
    fn the_table_lines_up_and_a_broken_check_is_not_passed() {
        let good = row("P1 peak", 11_250.0, Outcome::Pass);
        let broken = row("P2 peak", f64::NAN, Outcome::Broken("no column `P2.x`".into()));
        let table = ResultTable(vec![good.clone(), broken]);
        assert!(!table.passed());
        assert!(ResultTable(vec![good]).passed());
        let text = table.to_string();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[1].find("pass"), lines[0].find("result"));
        assert!(lines[1].contains("11250 Pa") && lines[1].contains("within 0.3 %"), "{text}");
        assert!(lines[2].contains("BROKEN") && lines[2].contains("no column"), "{text}");
    }
}
