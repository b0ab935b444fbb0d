//! `fsi-runner material` as the user calls it, and a run that ends at rest.
#![allow(clippy::unwrap_used)]

use seawall_tests::{run, run_well, squeezed};

#[test]
fn a_law_is_driven_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("law.csv");
    let output = run_well(&[
        "material",
        "cases/uniaxial_compression",
        "--body",
        "block",
        "--path",
        "UniaxialStress",
        "--strain",
        "-0.001",
        "--steps",
        "50",
        "--csv",
        file.to_str().unwrap(),
    ]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("block: LinearElastic"), "{text}");
    let table = std::fs::read_to_string(&file).unwrap();
    let last = table.lines().last().unwrap();
    let values: Vec<f64> = last.split(',').map(|value| value.parse().unwrap()).collect();
    assert_eq!(table.lines().count(), 52);
    // E = 30 GPa, to the square of the strain.
    assert!((values[1] / -30.0e6 - 1.0).abs() < 1e-3, "{last}");
}

#[test]
fn wrong_arguments_are_refused_with_code_2() {
    for (arguments, part) in [
        (&["--strain", "0.1", "--body", "blok"][..], "did you mean `block`?"),
        (&["--strain", "-2"], "above -1"),
        (&["--strain", "0.1", "--path", "Torsion"], "UniaxialStress"),
        (&["--strain", "0.1", "--steps", "0"], "--steps"),
        (&[], "--strain"),
    ] {
        let output = run(&[&["material", "cases/uniaxial_compression"], arguments].concat());
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(squeezed(&message).contains(&squeezed(part)), "{arguments:?}: {message}");
    }
}

#[test]
fn a_relaxed_run_ends_early_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    let output = run_well(&[
        "run",
        "cases/bar_mode_1",
        "--no-rrd",
        "--set",
        "solid.frame=Total",
        "--set",
        "solid.relaxation=(tolerance: 1e-6)",
        "--set",
        "solid.courant_number=0.5",
        "--set",
        "solid.bodies.0.loads=[(name: \"pull\", where: Face(\"x+\"), kind: Traction([1.0, 0.0]))]",
        "--set",
        "end_time=1e4",
        "--set",
        "output.frame_interval=1.0",
        "--out",
        out.to_str().unwrap(),
    ]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("at rest at t = "), "{text}");
    let gauges = std::fs::read_to_string(out.join("gauges.csv")).unwrap();
    let last: Vec<f64> =
        gauges.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect();
    // t L/E = 1 Pa · 25 m/100 Pa, and long before the end time.
    assert!((last[1] / 0.25 - 1.0).abs() < 0.01 && last[0] < 1e3, "{last:?}");
}
