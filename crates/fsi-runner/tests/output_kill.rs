//! A run that is killed at any moment leaves files that open and hold every
//! frame it reported.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod synthetic;

use fsi_runner::output::csv_table::CsvTable;
use fsi_runner::output::layout::Table;
use fsi_runner::output::run_file::{ResumePoint, RunFile};
use fsi_runner::output::run_reader::{Place, RunReader};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;
use synthetic::Scene;

/// Tells the re-executed test binary to write until it is killed.
const FOLDER: &str = "SEAWALL_KILL_TEST_FOLDER";
const CELLS: usize = 6;
const KILLS: u64 = 20;

#[test]
fn every_reported_frame_survives_kill() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        write_for_ever(Path::new(&folder));
    }
    let mut longest = 0;
    for kill in 0..KILLS {
        let folder = tempfile::tempdir().unwrap();
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "every_reported_frame_survives_kill", "--nocapture"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let mut reported = None;
        let mut lines = lines.map_while(Result::ok);
        let report = |line: &str| line.strip_prefix("written ").and_then(|n| n.parse::<u64>().ok());
        // The kill falls at an odd moment after some frame.
        for line in lines.by_ref() {
            reported = report(&line).or(reported);
            if reported.is_some_and(|frame| frame > kill) {
                break;
            }
        }
        std::thread::sleep(Duration::from_micros(137 * kill));
        child.kill().unwrap();
        child.wait().unwrap();
        reported = lines.filter_map(|line| report(&line)).last().or(reported);
        let reported = reported.expect("the child wrote no frame");
        longest = longest.max(reported);
        check(folder.path(), reported);
    }
    assert!(longest >= KILLS);
}

fn write_for_ever(folder: &Path) -> ! {
    let scene = Scene::new(CELLS);
    let (gauges, ledger) = (Scene::gauge_columns(), Scene::ledger_columns());
    let walls = [scene.walls()];
    let path = folder.join("run.h5");
    let mut file = RunFile::create(&path, &Scene::header(), &walls, &gauges, &ledger).unwrap();
    let mut csv = CsvTable::create(&folder.join("gauges.csv"), &gauges).unwrap();
    let mut out = std::io::stdout();
    for index in 0.. {
        let frame = scene.frame(index);
        let row = Scene::gauge_row(frame.time);
        csv.push_row(frame.time, &row).unwrap();
        csv.flush().unwrap();
        file.push_row(Table::Gauges, frame.time, &row).unwrap();
        file.push_row(Table::Ledger, frame.time, &Scene::ledger_row(frame.time)).unwrap();
        file.write_frame(&frame).unwrap();
        writeln!(out, "written {index}").unwrap();
        out.flush().unwrap();
    }
    unreachable!("the parent kills this process")
}

fn check(folder: &Path, reported: u64) {
    let scene = Scene::new(CELLS);
    let path = folder.join("run.h5");
    let reader = RunReader::open(&path).unwrap();
    let frames = reader.frames().unwrap();
    assert!(frames.len() as u64 > reported, "{} frames, {reported} reported", frames.len());
    for info in &frames {
        for cloud in &scene.frame(info.index).clouds {
            let place = Place::Frame(info.index);
            assert_eq!(reader.position(place, &cloud.name).unwrap(), cloud.position);
            for field in &cloud.fields {
                let values = reader.field(place, &cloud.name, field.name).unwrap();
                assert_eq!(values.len(), field.values.len());
            }
        }
    }
    let history = reader.history(Table::Gauges).unwrap();
    assert!(history.time.len() as u64 > reported);
    for (i, &time) in history.time.iter().enumerate() {
        assert_eq!(time, scene.frame(i as u64).time);
        assert_eq!(history.values[0][i], Scene::gauge_row(time)[0]);
    }
    let csv = std::fs::read_to_string(folder.join("gauges.csv")).unwrap();
    assert!(csv.lines().count() as u64 > reported + 1, "header and rows");

    // And the run can go on.
    let last = scene.frame(reported);
    drop(reader);
    let point = ResumePoint { step: last.step, time: last.time };
    let mut file = RunFile::open_to_append(&path, point).unwrap();
    file.write_frame(&scene.frame(reported + 1)).unwrap();
    file.close().unwrap();
    let frames = RunReader::open(&path).unwrap().frames().unwrap();
    assert_eq!(frames.len() as u64, reported + 2);
}
