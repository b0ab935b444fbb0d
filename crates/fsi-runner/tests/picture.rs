//! A frame of a run as PNG.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod synthetic;

use fsi_runner::output::OutputError;
use fsi_runner::output::layout::Table;
use fsi_runner::output::picture::{self, HEIGHTS, WIDTH};
use fsi_runner::output::run_file::RunFile;
use fsi_runner::output::run_reader::RunReader;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use synthetic::Scene;

const FRAMES: u64 = 3;

fn run_in(folder: &Path) -> PathBuf {
    let path = folder.join("run.h5");
    let scene = Scene::new(6);
    let (gauges, ledger) = (Scene::gauge_columns(), Scene::ledger_columns());
    let mut file =
        RunFile::create(&path, &Scene::header(), &[scene.walls()], &gauges, &ledger).unwrap();
    for index in 0..FRAMES {
        let frame = scene.frame(index);
        file.push_row(Table::Gauges, frame.time, &Scene::gauge_row(frame.time)).unwrap();
        file.push_row(Table::Ledger, frame.time, &Scene::ledger_row(frame.time)).unwrap();
        file.write_frame(&frame).unwrap();
    }
    file.close().unwrap();
    path
}

/// Width, height and pixels.
fn decode(path: &Path) -> (usize, usize, Vec<[u8; 3]>) {
    let mut reader =
        png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    let pixels = bytes.as_chunks::<3>().0.to_vec();
    (info.width as usize, info.height as usize, pixels)
}

#[test]
fn the_picture_shows_water_and_solid_on_white() {
    let folder = tempfile::tempdir().unwrap();
    let run = RunReader::open(&run_in(folder.path())).unwrap();
    let out = folder.path().join("picture.png");
    picture::draw(&run, Some(1), &out).unwrap();

    let (width, height, pixels) = decode(&out);
    assert_eq!(width, WIDTH);
    assert!((HEIGHTS.0..=HEIGHTS.1).contains(&height), "{height}");
    assert_eq!(pixels.len(), width * height);
    assert_eq!(pixels[0], [255; 3], "the corner is background");
    let share = |is: fn(&[u8; 3]) -> bool| {
        pixels.iter().filter(|pixel| is(pixel)).count() as f64 / pixels.len() as f64
    };
    let water = share(|&[red, _, blue]| blue > 90 && blue > red.saturating_add(40));
    let solid = share(|&[red, _, blue]| red > 90 && red > blue.saturating_add(40));
    assert!(water > 0.05, "only {water} of the picture is blue");
    assert!(solid > 0.005, "only {solid} of the picture is orange or red");
    // The solid stands on the right of the water.
    let middle = |is: fn(&[u8; 3]) -> bool| {
        let columns = (0..pixels.len()).filter(|&i| i / width > 110 && is(&pixels[i]));
        let (sum, count) = columns.fold((0, 0), |(sum, count), i| (sum + i % width, count + 1));
        sum / count
    };
    let water = middle(|&[red, _, blue]| blue > 90 && blue > red.saturating_add(40));
    let solid = middle(|&[red, _, blue]| red > 90 && red > blue.saturating_add(40));
    assert!(water + 100 < solid, "water at column {water}, solid at {solid}");
}

#[test]
fn the_last_frame_is_the_default() {
    let folder = tempfile::tempdir().unwrap();
    let run = RunReader::open(&run_in(folder.path())).unwrap();
    let [default, last, first] = ["default", "last", "first"].map(|name| folder.path().join(name));
    picture::draw(&run, None, &default).unwrap();
    picture::draw(&run, Some(FRAMES - 1), &last).unwrap();
    picture::draw(&run, Some(0), &first).unwrap();
    assert_eq!(decode(&default), decode(&last));
    assert_ne!(decode(&default), decode(&first));
}

#[test]
fn a_frame_that_is_not_there_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let run = RunReader::open(&run_in(folder.path())).unwrap();
    let out = folder.path().join("picture.png");
    let error = picture::draw(&run, Some(FRAMES), &out).unwrap_err();
    assert!(matches!(error, OutputError::InvalidData { .. }), "{error:?}");
    assert_eq!(error.to_string(), "frame 3: there is no such frame; the run has 3, 0 to 2");
    assert!(!out.exists());
}
