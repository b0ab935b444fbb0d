//! Writes a small made-up run with every output, for trying the tools:
//! `cargo run --release --example synthetic_run -- DIR [FRAMES] [CELLS]`.
//! Prints what each writer costs.

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use fsi_runner::output::csv_table::CsvTable;
use fsi_runner::output::layout::Table;
use fsi_runner::output::rerun_log::RerunLog;
use fsi_runner::output::rerun_options::{Marker, RerunOptions, RerunTarget};
use fsi_runner::output::run_file::RunFile;
use fsi_runner::output::run_reader::RunReader;
use fsi_runner::output::vtkhdf::export_vtkhdf;
use fsi_runner::output::xdmf::XdmfSidecar;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use synthetic::Scene;

/// History rows between two frames.
const ROWS: u64 = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("a folder is needed")?);
    let frames: u64 = arguments.next().map_or(Ok(5), |text| text.parse())?;
    let cells: usize = arguments.next().map_or(Ok(16), |text| text.parse())?;
    let with_rerun = arguments.next().is_none();
    std::fs::create_dir_all(&folder)?;
    let scene = Scene::new(cells);
    let header = Scene::header();
    let walls = [scene.walls()];
    let (gauges, ledger) = (Scene::gauge_columns(), Scene::ledger_columns());

    let path = folder.join("sloshing.h5");
    let mut file = RunFile::create(&path, &header, &walls, &gauges, &ledger)?;
    let mut csv = CsvTable::create(&folder.join("gauges.csv"), &gauges)?;
    let mut xdmf = XdmfSidecar::new(&folder.join("sloshing.xdmf"), "sloshing.h5", &walls);
    let first = scene.frame(0);
    let points: usize = first.clouds.iter().map(|cloud| cloud.position.len()).sum();
    let mut rerun = if with_rerun {
        let mut options = RerunOptions::new(RerunTarget::File(folder.join("sloshing.rrd")));
        options.markers = vec![
            Marker { name: "P1".into(), position: [1.2, 0.3, 0.1] },
            Marker { name: "crest".into(), position: [1.23, 0.3, 0.75] },
        ];
        Some(RerunLog::start(options, &header, &walls, &first, &gauges, &ledger)?)
    } else {
        None
    };

    let mut spent = [Duration::ZERO; 3];
    let mut last = [Duration::ZERO; 3];
    for index in 0..frames {
        let frame = scene.frame(index);
        for row in 0..ROWS {
            let time = frame.time + 0.005 * row as f64;
            let values = Scene::gauge_row(time);
            file.push_row(Table::Gauges, time, &values)?;
            file.push_row(Table::Ledger, time, &Scene::ledger_row(time))?;
            csv.push_row(time, &values)?;
            if let Some(rerun) = &mut rerun {
                rerun.log_row(Table::Gauges, frame.step + row, time, &values);
                rerun.log_row(Table::Ledger, frame.step + row, time, &Scene::ledger_row(time));
            }
        }
        csv.flush()?;
        last = [
            timed(|| file.write_frame(&frame))?,
            timed(|| xdmf.add_frame(&frame))?,
            timed(|| {
                if let Some(rerun) = &mut rerun {
                    rerun.log_frame(&frame);
                }
                Ok(())
            })?,
        ];
        spent.iter_mut().zip(last).for_each(|(total, one)| *total += one);
    }
    if let Some(rerun) = rerun {
        rerun.finish();
    }
    file.close()?;
    xdmf.write()?;
    let per_point = |path: &str| -> std::io::Result<f64> {
        Ok(std::fs::metadata(folder.join(path))?.len() as f64 / (points as u64 * frames) as f64)
    };
    println!("{points} moving points, {} fixed ones, {frames} frames", walls[0].position.len());
    for (i, name) in ["HDF5", "XDMF", "Rerun"].into_iter().enumerate() {
        let mean = spent[i].as_secs_f64() / frames as f64;
        println!("{name}: {mean:.4} s a frame on average, {:.4} s the last", last[i].as_secs_f64());
    }
    println!("HDF5: {:.1} bytes a point and frame", per_point("sloshing.h5")?);
    if with_rerun {
        println!("Rerun: {:.1} bytes a point and frame", per_point("sloshing.rrd")?);
        for path in export_vtkhdf(&RunReader::open(&path)?, &folder.join("vtkhdf"), 1)? {
            println!("{}", path.display());
        }
    }
    Ok(())
}

fn timed(
    work: impl FnOnce() -> Result<(), fsi_runner::output::OutputError>,
) -> Result<Duration, fsi_runner::output::OutputError> {
    let start = Instant::now();
    work()?;
    Ok(start.elapsed())
}
