//! The same bits for any thread count, and after a restart.
#![allow(clippy::unwrap_used)]

use seawall_tests::{assert_same_bits, run_well};
use std::path::Path;

/// Coupled 2D from the first step on: the gate carries the water.
const GATE: [&str; 5] =
    ["run", "cases/elastic_gate", "--no-rrd", "--set", "output.frame_interval=0.002"];
/// Coupled 3D: the block of water stands at the wall.
const WALL: [&str; 9] = [
    "run",
    "cases/tsunami_wall",
    "--no-rrd",
    "--set",
    "output.frame_interval=0.01",
    "--set",
    "fluid.blocks.0.shape=Box(lower: [9.0, 0, 0], upper: [12, 1, 2])",
    "--set",
    "output.gauge_interval=0.002",
];

fn run(case: &[&str], folder: &Path, more: &[&str]) {
    let folder = folder.display().to_string();
    let mut arguments = case.to_vec();
    arguments.extend(["--out", &folder]);
    arguments.extend(more);
    run_well(&arguments);
}

#[test]
fn one_and_two_threads_give_the_same_bits_in_2d() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    run(&GATE, &one, &["--until", "0.01", "--threads", "1"]);
    run(&GATE, &two, &["--until", "0.01", "--threads", "2"]);
    assert_same_bits(&one.join("elastic_gate.h5"), &two.join("elastic_gate.h5"));
}

#[test]
fn one_and_two_threads_give_the_same_bits_in_3d() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    run(&WALL, &one, &["--until", "0.03", "--threads", "1"]);
    run(&WALL, &two, &["--until", "0.03", "--threads", "2"]);
    assert_same_bits(&one.join("tsunami_wall.h5"), &two.join("tsunami_wall.h5"));
}

#[test]
fn a_resumed_run_gives_the_same_bits_as_an_unbroken_one() {
    let folder = tempfile::tempdir().unwrap();
    let (unbroken, resumed) = (folder.path().join("unbroken"), folder.path().join("resumed"));
    // Checkpoints fall due in mid-run; the second run ends beyond one and is cut back to it.
    let checkpoints = ["--set", "output.checkpoint_interval=0.004"];
    let with = |more: &[&'static str]| [checkpoints.as_slice(), more].concat();
    run(&GATE, &unbroken, &with(&["--until", "0.01"]));
    run(&GATE, &resumed, &with(&["--until", "0.01"]));
    let checkpoint = resumed.join("checkpoint.h5");
    std::fs::remove_file(&checkpoint).unwrap();
    run(&GATE, &resumed, &with(&["--until", "0.0041", "--overwrite"]));
    run(&GATE, &resumed, &with(&["--until", "0.01", "--resume"]));
    let last = |path: &Path| {
        let mut sets = seawall_tests::all_bits(&path.join("elastic_gate.h5"));
        // The short run recorded its own end as a frame and a row of its own; what must agree
        // is the state at the common end, which is the last frame of both.
        let count = sets.iter().filter(|(name, _)| name.ends_with(" time")).count();
        let prefix = format!("{} ", count - 1);
        sets.retain(|(name, _)| name.starts_with(&prefix));
        sets.into_iter()
            .map(|(name, bits)| (name[prefix.len()..].to_owned(), bits))
            .collect::<Vec<_>>()
    };
    let (a, b) = (last(&unbroken), last(&resumed));
    assert!(a.len() > 8, "{}", a.len());
    for ((name, left), (other, right)) in a.iter().zip(&b) {
        assert_eq!(name, other);
        assert!(left == right, "`{name}` differs after the restart");
    }
}
