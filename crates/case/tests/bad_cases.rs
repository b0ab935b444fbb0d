//! Every kind of mistake gives its message at its place.
//!
//! `tests/input/bad/NAME.ron` is a case with one mistake; each line of
//! `NAME.expected` must occur in the error's text.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::{Case, CaseError};

fn folder() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/input/bad")
}

/// The error of reading, checking or building a case.
fn error(path: &std::path::Path) -> Option<CaseError> {
    match Case::load(path, &[]) {
        Err(error) => Some(error),
        Ok(case) if case.dimension() == 2 => case.build::<2>().err(),
        Ok(case) => case.build::<3>().err(),
    }
}

#[test]
fn every_bad_case_is_refused_as_expected() {
    let mut paths: Vec<_> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 20, "{}", paths.len());
    let mut failures = Vec::new();
    for path in &paths {
        let expected = std::fs::read_to_string(path.with_extension("expected")).unwrap();
        let Some(error) = error(path) else {
            failures.push(format!("{} was accepted", path.display()));
            continue;
        };
        let text = error.to_string();
        for line in expected.lines().filter(|line| !text.contains(line)) {
            failures.push(format!("{}: `{line}` is not in: {text}", path.display()));
        }
        for other in error.others() {
            failures.push(format!("{}: one mistake, but also: {other}", path.display()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn an_error_of_an_override_names_the_argument() {
    let path = folder().join("../../../cases/elastic_gate");
    for (argument, part) in [
        ("fluid.spacing=0.003", "is 33.33333 spacings of 0.003 m"),
        ("fluid.spacng=0.001", "did you mean `spacing`?"),
        ("solid.bodies.0.material.poisson_ratio=0.6", "above -1 and below 0.5"),
        ("solid.bodies.1.name=\"x\"", "entries 0 to 0 exist"),
        ("coupling.correctors=Fixed(9)", "9 correctors"),
        ("end_time=soon", "Expected float, found `soon`"),
    ] {
        let error = Case::load(&path, &[argument.to_owned()]).unwrap_err();
        // The size of a block stands in the file even if an override made it unfit.
        if !argument.starts_with("fluid.spacing=") {
            assert_eq!(error.place(), format!("--set {argument}"), "{error}");
        }
        assert!(error.to_string().contains(part), "{error}");
    }
}

#[test]
fn independent_mistakes_are_reported_together() {
    let path = folder().join("../../../cases/elastic_gate");
    let overrides = ["fluid.density=-1", "solid.damping=2", "end_time=-1"];
    let error = Case::load(path, &overrides.map(str::to_owned)).unwrap_err();
    assert_eq!(error.others().len(), 2, "{error}");
}

#[test]
fn an_unreadable_file_is_named() {
    let error = Case::load("no/such/case.ron", &[]).unwrap_err();
    assert!(error.to_string().starts_with("no/such/case.ron: cannot read"), "{error}");
}
