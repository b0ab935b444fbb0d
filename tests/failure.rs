//! Runs that fail or are killed leave what they wrote readable.
#![allow(clippy::unwrap_used)]

use fsi_runner::output::run_reader::RunReader;
use seawall_tests::{run, runner, squeezed};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

fn rows(path: &Path) -> usize {
    std::fs::read_to_string(path).unwrap().lines().count() - 1
}

#[test]
fn failed_physics_ends_with_code_3_and_keeps_the_frames() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    // Water thrown at a wall at half its speed of sound is compressed beyond the limit.
    let output = run(&[
        "run",
        "cases/dam_break_2d",
        "--no-rrd",
        "--set",
        "fluid.sound_speed=Fixed(18.0)",
        "--set",
        "fluid.blocks.0.velocity=[9.0, 0.0]",
        "--set",
        "output.frame_interval=0.001",
        "--set",
        "walls.0.shape=Tank(lower: [0, 0], upper: [0.2190, 0.438], open: [\"y+\"])",
        "--out",
        out.to_str().unwrap(),
    ]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{message}");
    for part in ["fluid particle", "t = ", "sound speed", "readable in"] {
        assert!(
            squeezed(&message).contains(&squeezed(part)),
            "the message lacks `{part}`:\n{message}"
        );
    }
    let frames = RunReader::open(&out.join("dam_break_2d.h5")).unwrap().frames().unwrap();
    assert!(!frames.is_empty());
}

#[test]
fn a_killed_run_keeps_every_flushed_frame() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    let mut child = runner()
        .args(["run", "cases/dam_break_2d", "--no-rrd", "--set", "output.frame_interval=0.002"])
        .args(["--set", "end_time=4.0", "--out", out.to_str().unwrap()])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let file = out.join("dam_break_2d.h5");
    let frames = || {
        let run = RunReader::open(&file).ok()?;
        run.frames().ok().map(|frames| frames.len())
    };
    let begun = Instant::now();
    while frames().unwrap_or(0) < 20 {
        assert!(begun.elapsed() < Duration::from_secs(120), "no 20 frames after two minutes");
        assert!(child.try_wait().unwrap().is_none(), "the run ended before it could be killed");
        std::thread::sleep(Duration::from_millis(20));
    }
    let seen = frames().unwrap();
    // SIGKILL: the process has no chance to tidy up.
    child.kill().unwrap();
    child.wait().unwrap();
    let run = RunReader::open(&file).unwrap();
    let kept = run.frames().unwrap();
    assert!(kept.len() >= seen, "{} frames kept of {seen} seen", kept.len());
    let last = kept.last().unwrap();
    let place = fsi_runner::output::run_reader::Place::Frame(last.index);
    assert!(!run.position(place, "fluid").unwrap().is_empty());
    // CSV rows are flushed with each frame.
    assert!(rows(&out.join("gauges.csv")) >= kept.len() - 1);
    assert!(rows(&out.join("ledger.csv")) >= kept.len() - 1);
}
