//! The check file of a case, and its evaluation.

use super::{
    CheckResult, Gate, Histories, Metric, Outcome, PointSource, ReferenceTable, VerifyError,
    error::suggestion, metric::Evidence, ron_file,
};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// One row of the verification table: what is measured, against what, how near.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Check {
    /// Name, unique in the file.
    pub name: String,
    /// The metric and its parameters.
    pub metric: Metric,
    /// Reference files, relative to the case folder.
    #[serde(default)]
    pub reference: Vec<PathBuf>,
    /// Reference value, where no file gives it.
    pub expected: Option<f64>,
    /// The condition.
    pub gate: Gate,
    /// Where the reference and the limit come from: paper, formula, standard.
    pub source: String,
}

/// The coarsened variant that continuous integration runs.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quick {
    /// What the variant can and cannot show.
    pub description: String,
    /// Overrides of the case, as after `--set`: `path=value`.
    pub overrides: Vec<String>,
    /// Gates that replace those of the checks with these names.
    #[serde(default)]
    pub gates: BTreeMap<String, Gate>,
    /// Checks that the variant cannot evaluate, each with the reason.
    #[serde(default)]
    pub skip: BTreeMap<String, String>,
}

/// Which variant of the case was run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// As the case file says.
    Full,
    /// With the overrides of [`Quick`].
    Quick,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename = "CheckFile")]
struct Contents {
    checks: Vec<Check>,
    quick: Option<Quick>,
}

/// `check.ron` of a case folder, checked against itself.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckFile {
    directory: PathBuf,
    contents: Contents,
}

impl CheckFile {
    /// Name of the file in a case folder.
    pub const NAME: &'static str = "check.ron";

    /// Reads `check.ron` in `case_directory`.
    ///
    /// # Errors
    /// [`VerifyError::Format`] with line and column, or [`VerifyError::Check`]
    /// for a reference file that is missing, a gate without a reference, a name
    /// that is used twice, an override without `=` and the like.
    pub fn read(case_directory: &Path) -> Result<Self, VerifyError> {
        let contents = ron_file::read(&case_directory.join(Self::NAME))?;
        let file = Self { directory: case_directory.into(), contents };
        file.validate()?;
        Ok(file)
    }

    /// All checks, with their full gates.
    #[must_use]
    pub fn checks(&self) -> &[Check] {
        &self.contents.checks
    }

    /// The quick variant, if the case has one.
    #[must_use]
    pub fn quick(&self) -> Option<&Quick> {
        self.contents.quick.as_ref()
    }

    /// Overrides to run the case with; empty for [`Variant::Full`].
    #[must_use]
    pub fn overrides(&self, variant: Variant) -> &[String] {
        match (variant, self.quick()) {
            (Variant::Quick, Some(quick)) => &quick.overrides,
            _ => &[],
        }
    }

    /// The history columns that the checks read, so that a misspelt gauge is
    /// found before the run and not after it.
    #[must_use]
    pub fn columns(&self) -> Vec<&str> {
        let signals = self.checks().iter().flat_map(|check| check.metric.signals());
        signals.flat_map(|signal| signal.terms()).map(|(_, column)| column.as_str()).collect()
    }

    /// Evaluates the checks of `variant` on a finished run.
    ///
    /// A check that cannot be evaluated becomes a row with
    /// [`Outcome::Broken`], so that the others are still seen.
    ///
    /// # Errors
    /// [`VerifyError`] if a reference file cannot be read.
    pub fn evaluate(
        &self,
        variant: Variant,
        histories: &Histories,
        points: &dyn PointSource,
    ) -> Result<Vec<CheckResult>, VerifyError> {
        let quick = self.quick().filter(|_| variant == Variant::Quick);
        let mut results = Vec::new();
        for check in self.checks() {
            if quick.is_some_and(|q| q.skip.contains_key(&check.name)) {
                continue;
            }
            let gate = quick.and_then(|q| q.gates.get(&check.name)).unwrap_or(&check.gate);
            let references = check
                .reference
                .iter()
                .map(|path| ReferenceTable::read(&self.directory.join(path)))
                .collect::<Result<Vec<_>, _>>()?;
            let evidence = Evidence { histories, points, references: &references };
            results.push(check.judge(gate, &evidence));
        }
        Ok(results)
    }

    fn validate(&self) -> Result<(), VerifyError> {
        let checks = self.checks();
        let fault = |field: String, message: String| VerifyError::Check {
            path: self.directory.join(Self::NAME),
            field,
            message,
        };
        if checks.is_empty() {
            return Err(fault("checks".into(), "there must be at least one check".into()));
        }
        for (i, check) in checks.iter().enumerate() {
            let field = |name: &str| format!("checks[{i}].{name}");
            if checks[..i].iter().any(|other| other.name == check.name) {
                return Err(fault(field("name"), format!("`{}` is used twice", check.name)));
            }
            if check.source.trim().is_empty() {
                return Err(fault(field("source"), "name the paper, formula or standard".into()));
            }
            let allowed = check.metric.reference_count();
            if !allowed.contains(&check.reference.len()) {
                let message = format!(
                    "this metric takes {} reference file(s), not {}",
                    if allowed.end() == &usize::MAX {
                        format!("{} or more", allowed.start())
                    } else {
                        format!("{} to {}", allowed.start(), allowed.end())
                    },
                    check.reference.len()
                );
                return Err(fault(field("reference"), message));
            }
            for path in &check.reference {
                let full = self.directory.join(path);
                if !full.is_file() {
                    let message = format!("{} is not a file", full.display());
                    return Err(fault(field("reference"), message));
                }
            }
            self.validate_gate(check, &check.gate, field("gate"))?;
        }
        self.quick().map_or(Ok(()), |quick| self.validate_quick(quick))
    }

    fn validate_gate(&self, check: &Check, gate: &Gate, field: String) -> Result<(), VerifyError> {
        let message = match gate.fault() {
            Some(message) => message,
            None if gate.needs_reference()
                && check.expected.is_none()
                && !check.metric.gives_reference(check.reference.len()) =>
            {
                "this gate compares with a reference: give `expected` or a reference file".into()
            }
            None => return Ok(()),
        };
        Err(VerifyError::Check { path: self.directory.join(Self::NAME), field, message })
    }

    fn validate_quick(&self, quick: &Quick) -> Result<(), VerifyError> {
        let fault = |field: String, message: String| VerifyError::Check {
            path: self.directory.join(Self::NAME),
            field,
            message,
        };
        for (i, text) in quick.overrides.iter().enumerate() {
            if !text.contains('=') {
                let message = format!("`{text}` is not of the form path=value");
                return Err(fault(format!("quick.overrides[{i}]"), message));
            }
        }
        let names = || self.checks().iter().map(|c| c.name.as_str());
        for (map, name) in quick
            .gates
            .keys()
            .map(|name| ("gates", name))
            .chain(quick.skip.keys().map(|name| ("skip", name)))
        {
            let Some(check) = self.checks().iter().find(|c| c.name == *name) else {
                let message = format!("no check is called `{name}`{}", suggestion(name, names()));
                return Err(fault(format!("quick.{map}"), message));
            };
            if let Some(gate) = quick.gates.get(name) {
                self.validate_gate(check, gate, format!("quick.gates.{name}"))?;
            }
        }
        Ok(())
    }
}

impl Check {
    fn judge(&self, gate: &Gate, evidence: &Evidence) -> CheckResult {
        let mut result = CheckResult {
            name: self.name.clone(),
            measured: f64::NAN,
            unit: "1".into(),
            reference: self.expected,
            gate: gate.clone(),
            outcome: Outcome::Fail,
            detail: String::new(),
            source: self.source.clone(),
        };
        match self.metric.measure(evidence) {
            Ok(measurement) => {
                result.reference = self.expected.or(measurement.reference);
                result.outcome = match gate.judge(measurement.value, result.reference) {
                    Some(true) => Outcome::Pass,
                    Some(false) => Outcome::Fail,
                    None => Outcome::Reported,
                };
                result.measured = measurement.value;
                result.unit = measurement.unit;
                result.detail = measurement.detail;
            }
            Err(error) => result.outcome = Outcome::Broken(error.to_string()),
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::{CheckFile, Variant};
    use crate::verify::{NoPoints, Outcome, ResultTable, histories::tests::histories};

    fn file(text: &str) -> Result<CheckFile, String> {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(directory.path().join("check.ron"), text).unwrap();
        std::fs::write(directory.path().join("r.csv"), "t,u\n0,0\n1,2\n").unwrap();
        CheckFile::read(directory.path()).map_err(|e| e.to_string())
    }

    const GOOD: &str = r#"(
        checks: [
            (
                name: "residual",
                metric: Statistic(signal: "coupling.momentum_residual", take: Maximum),
                gate: AtMost(1e-12),
                source: "round-off",
            ),
            (
                name: "mean pressure",
                metric: Statistic(signal: "P1.pressure", take: Mean, window: Last(1.0)),
                expected: 5.0, gate: Within(0.01), source: "rho g h",
            ),
            (
                name: "missing",
                metric: Peak(signal: "P2.pressure"),
                gate: Report("no agreed tolerance"), source: "none",
            ),
        ],
        quick: (
            description: "half the resolution",
            overrides: ["fluid.spacing=0.05"],
            gates: {"mean pressure": Within(0.1)},
            skip: {"missing": "no such gauge"},
        ),
    )"#;

    #[test]
    fn full_and_quick_variants_are_judged_by_their_own_gates() {
        let file = file(GOOD).unwrap();
        let histories = histories(
            "time [s],P1.pressure [Pa]\n0,0\n1,5.2\n2,5.2\n",
            "time [s],coupling.momentum_residual [1]\n0,0\n2,3e-13\n",
        );
        let full = file.evaluate(Variant::Full, &histories, &NoPoints).unwrap();
        assert_eq!(full[0].outcome, Outcome::Pass);
        assert_eq!(full[1].outcome, Outcome::Fail, "4 % off must fail a 1 % gate");
        assert!(matches!(&full[2].outcome, Outcome::Broken(why) if why.contains("P1.pressure")));
        assert!(!ResultTable(full).passed());
        let quick = file.evaluate(Variant::Quick, &histories, &NoPoints).unwrap();
        assert_eq!(quick.len(), 2);
        assert!(ResultTable(quick).passed());
        assert_eq!(file.overrides(Variant::Quick), ["fluid.spacing=0.05"]);
        assert!(file.overrides(Variant::Full).is_empty());
    }

    #[test]
    fn columns_are_known_before_the_run() {
        let expected = ["coupling.momentum_residual", "P1.pressure", "P2.pressure"];
        assert_eq!(file(GOOD).unwrap().columns(), expected);
    }

    #[test]
    fn the_check_files_of_the_repository_are_valid() {
        let cases = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
        let mut read = 0;
        for entry in std::fs::read_dir(cases).unwrap() {
            let folder = entry.unwrap().path();
            if folder.join(CheckFile::NAME).is_file() {
                CheckFile::read(&folder).unwrap_or_else(|e| panic!("{e}"));
                read += 1;
            }
        }
        assert!(read >= 8, "only {read} check files");
    }

    #[test]
    fn form_errors_name_line_field_and_the_nearest_name() {
        let error = file(&GOOD.replace("take: Maximum", "take: Maximun")).unwrap_err();
        assert!(error.contains("check.ron:5:") && error.contains("`Maximum`"), "{error}");
        assert!(error.contains("checks[0].metric"), "{error}");
        let error = file(&GOOD.replace("expected:", "expcted:")).unwrap_err();
        assert!(error.contains("did you mean `expected`"), "{error}");
        let error = file(&GOOD.replace("source: \"rho g h\",", "")).unwrap_err();
        assert!(error.contains("source"), "{error}");
    }

    #[test]
    fn contradictions_are_refused() {
        for (from, to, expected) in [
            ("expected: 5.0,", "", "compares with a reference"),
            ("\"mean pressure\",", "\"residual\",", "used twice"),
            ("overrides: [\"fluid.spacing=0.05\"]", "overrides: [\"fluid.spacing\"]", "path=value"),
            ("{\"mean pressure\": W", "{\"mean presure\": W", "did you mean `mean pressure`"),
            ("skip: {\"missing\"", "skip: {\"mising\"", "did you mean `missing`"),
            ("Report(\"no agreed tolerance\")", "Report(\"\")", "reason"),
            ("expected: 5.0,", "expected: 5.0, reference: [\"r.csv\"],", "takes 0 to 0"),
            (
                "Peak(signal: \"P2.pressure\"),",
                "Peak(signal: \"P2.pressure\"), reference: [\"x.csv\"],",
                "is not a file",
            ),
        ] {
            let changed = GOOD.replace(from, to);
            assert_ne!(changed, GOOD, "{from}");
            let error = file(&changed).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
