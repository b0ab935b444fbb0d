//! The same bits for any thread count, and after a restart.
#![allow(clippy::unwrap_used)]

use fsi_runner::output::run_reader::RunReader;
use seawall_tests::{assert_same_bits, run_well, runner};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

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

/// Runs `case` to `until` with one and with two threads and compares their `file`s.
fn assert_threads_agree(case: &[&str], until: &str, file: &str) {
    let folder = tempfile::tempdir().unwrap();
    let files = ["1", "2"].map(|threads| {
        let out = folder.path().join(threads);
        run(case, &out, &["--until", until, "--threads", threads]);
        out.join(file)
    });
    assert_same_bits(&files[0], &files[1]);
}

#[test]
fn one_and_two_threads_give_the_same_bits_in_2d() {
    assert_threads_agree(&GATE, "0.01", "elastic_gate.h5");
}

#[test]
fn one_and_two_threads_give_the_same_bits_in_3d() {
    assert_threads_agree(&WALL, "0.03", "tsunami_wall.h5");
}

#[test]
fn a_run_interrupted_by_ctrl_c_and_resumed_gives_the_same_bits_as_an_unbroken_one() {
    let folder = tempfile::tempdir().unwrap();
    let (unbroken, resumed) = (folder.path().join("unbroken"), folder.path().join("resumed"));
    let end = ["--until", "0.03"];
    run(&GATE, &unbroken, &end);
    let mut child = runner()
        .args(GATE)
        .args(["--out", resumed.to_str().unwrap()])
        .args(end)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let file = resumed.join("elastic_gate.h5");
    let frames =
        || RunReader::open(&file).and_then(|run| run.frames()).map_or(0, |frames| frames.len());
    let begun = Instant::now();
    while frames() < 4 {
        assert!(begun.elapsed() < Duration::from_secs(120), "no 4 frames after two minutes");
        assert!(child.try_wait().unwrap().is_none(), "the run ended before the interruption");
        std::thread::sleep(Duration::from_millis(10));
    }
    let signalled = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(signalled.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(resumed.join("checkpoint.h5").is_file());
    run(&GATE, &resumed, &[&end[..], &["--resume"]].concat());
    assert_same_bits(&unbroken.join("elastic_gate.h5"), &file);
    let rows = |folder: &Path| std::fs::read_to_string(folder.join("gauges.csv")).unwrap();
    assert_eq!(rows(&unbroken), rows(&resumed));
}
