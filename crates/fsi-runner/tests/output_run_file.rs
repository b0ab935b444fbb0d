//! The run's HDF5 file: written, appended, resumed, read again.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod synthetic;

use fsi_runner::output::frame::{CloudKind, PointCloud};
use fsi_runner::output::layout::Table;
use fsi_runner::output::run_file::{ResumePoint, RunFile};
use fsi_runner::output::run_reader::{Place, RunReader};
use fsi_runner::output::vtkhdf::export_vtkhdf;
use fsi_runner::output::xdmf::XdmfSidecar;
use std::path::{Path, PathBuf};
use synthetic::Scene;

const CELLS: usize = 6;

fn create(path: &Path) -> RunFile {
    let walls = [Scene::new(CELLS).walls()];
    let (gauges, ledger) = (Scene::gauge_columns(), Scene::ledger_columns());
    RunFile::create(path, &Scene::header(), &walls, &gauges, &ledger).unwrap()
}

fn write_frames(file: &mut RunFile, frames: std::ops::Range<u64>) {
    let scene = Scene::new(CELLS);
    for index in frames {
        let frame = scene.frame(index);
        for row in 0..3 {
            let time = frame.time + 0.01 * f64::from(row);
            file.push_row(Table::Gauges, time, &Scene::gauge_row(time)).unwrap();
        }
        file.push_row(Table::Ledger, frame.time, &Scene::ledger_row(frame.time)).unwrap();
        file.write_frame(&frame).unwrap();
    }
}

fn in_folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.h5");
    (folder, path)
}

fn assert_cloud_equal(reader: &RunReader, place: Place, written: &PointCloud) {
    let info = reader.cloud(place, &written.name).unwrap();
    assert_eq!(info, written.info());
    assert_eq!(reader.id(place, &written.name).unwrap(), written.id);
    assert_eq!(reader.position(place, &written.name).unwrap(), written.position);
    for field in &written.fields {
        let read = reader.field(place, &written.name, field.name).unwrap();
        let stored: Vec<f64> = field
            .values
            .iter()
            .map(|&value| if field.stored_double() { value } else { f64::from(value as f32) })
            .collect();
        assert_eq!(read, stored, "{}", field.name);
    }
}

#[test]
fn what_was_written_is_read() {
    let (_folder, path) = in_folder();
    let mut file = create(&path);
    write_frames(&mut file, 0..3);
    file.close().unwrap();

    let reader = RunReader::open(&path).unwrap();
    let header = reader.header().unwrap();
    let expected = Scene::header();
    assert_eq!((&header.case_text, &header.overrides), (&expected.case_text, &expected.overrides));
    assert_eq!((header.dimension, header.gravity), (3, [0.0, 0.0, -9.81]));
    assert_eq!(reader.static_clouds().unwrap(), ["walls"]);
    assert_cloud_equal(&reader, Place::Static, &Scene::new(CELLS).walls());
    let frames = reader.frames().unwrap();
    assert_eq!(frames.len(), 3);
    for info in frames {
        let written = Scene::new(CELLS).frame(info.index);
        assert_eq!((info.step, info.time), (written.step, written.time));
        assert_eq!(info.clouds, ["fluid", "solid/seawall"]);
        for cloud in &written.clouds {
            assert_cloud_equal(&reader, Place::Frame(info.index), cloud);
        }
    }
    let history = reader.history(Table::Gauges).unwrap();
    assert_eq!(history.columns, Scene::gauge_columns());
    assert_eq!(history.time.len(), 9);
    let crest: Vec<f64> = history.time.iter().map(|&time| Scene::gauge_row(time)[3]).collect();
    assert_eq!(history.column("crest.x").unwrap(), crest);
    assert_eq!(reader.history(Table::Ledger).unwrap().time.len(), 3);
}

#[test]
fn a_live_file_can_be_read() {
    let (_folder, path) = in_folder();
    let mut file = create(&path);
    assert_eq!(RunReader::open(&path).unwrap().frames().unwrap(), []);
    write_frames(&mut file, 0..2);
    assert_eq!(RunReader::open(&path).unwrap().frames().unwrap().len(), 2);
    write_frames(&mut file, 2..3);
    assert_eq!(RunReader::open(&path).unwrap().frames().unwrap().len(), 3);
}

#[test]
fn a_resumed_file_equals_an_uninterrupted_one() {
    let (_folder, path) = in_folder();
    let mut file = create(&path);
    write_frames(&mut file, 0..5);
    drop(file);
    let kept = Scene::new(CELLS).frame(2);
    let point = ResumePoint { step: kept.step, time: kept.time + 0.02 };
    let mut file = RunFile::open_to_append(&path, point).unwrap();
    assert_eq!(RunReader::open(&path).unwrap().frames().unwrap().len(), 3);
    write_frames(&mut file, 3..5);
    file.close().unwrap();

    let (_other, straight) = in_folder();
    let mut file = create(&straight);
    write_frames(&mut file, 0..5);
    file.close().unwrap();

    let (resumed, straight) =
        (RunReader::open(&path).unwrap(), RunReader::open(&straight).unwrap());
    assert_eq!(resumed.frames().unwrap(), straight.frames().unwrap());
    for table in [Table::Gauges, Table::Ledger] {
        assert_eq!(resumed.history(table).unwrap(), straight.history(table).unwrap());
    }
    for cloud in &Scene::new(CELLS).frame(4).clouds {
        assert_cloud_equal(&resumed, Place::Frame(4), cloud);
    }
}

#[test]
fn many_frames_cross_the_bucket_boundary() {
    let (_folder, path) = in_folder();
    let mut file = create(&path);
    let mut frame = Scene::new(3).frame(0);
    for index in 996..1004 {
        frame.index = index;
        file.write_frame(&frame).unwrap();
    }
    file.close().unwrap();
    let frames = RunReader::open(&path).unwrap().frames().unwrap();
    assert_eq!(frames.iter().map(|f| f.index).collect::<Vec<_>>(), (996..1004).collect::<Vec<_>>());
}

#[test]
fn a_frame_without_water_is_no_error() {
    let (_folder, path) = in_folder();
    let mut file = create(&path);
    let mut frame = Scene::new(3).frame(0);
    let fluid = &mut frame.clouds[0];
    fluid.id.clear();
    fluid.position.clear();
    fluid.fields.iter_mut().for_each(|field| field.values.clear());
    file.write_frame(&frame).unwrap();
    file.close().unwrap();
    let reader = RunReader::open(&path).unwrap();
    assert_eq!(reader.cloud(Place::Frame(0), "fluid").unwrap().count, 0);
    assert_eq!(reader.cloud(Place::Frame(0), "fluid").unwrap().kind, CloudKind::Fluid);
    assert_eq!(reader.position(Place::Frame(0), "fluid").unwrap(), Vec::<[f64; 3]>::new());
}

#[test]
fn names_that_cannot_be_paths_are_refused() {
    let (_folder, path) = in_folder();
    let mut gauges = Scene::gauge_columns();
    gauges[1].name = "a/b".into();
    let error = RunFile::create(&path, &Scene::header(), &[], &gauges, &[]).err().unwrap();
    assert_eq!(
        error.to_string(),
        "column `a/b` of table `gauges`: a name must not be empty and not contain `/`"
    );
    assert!(!path.exists());
}

#[test]
fn another_hdf5_file_is_named_as_such() {
    let (_folder, path) = in_folder();
    hdf5::FileBuilder::new().write(&path).unwrap();
    let message = RunReader::open(&path).err().unwrap().to_string();
    assert!(message.contains("is not a usable run file: attribute `format`"), "{message}");
}

#[test]
fn the_sidecar_is_well_formed_and_the_same_when_built_from_the_file() {
    let (folder, path) = in_folder();
    let walls = [Scene::new(CELLS).walls()];
    let mut file = create(&path);
    let sidecar = folder.path().join("run.xdmf");
    let mut xdmf = XdmfSidecar::new(&sidecar, "run.h5", &walls);
    for index in 0..3 {
        write_frames(&mut file, index..index + 1);
        xdmf.add_frame(&Scene::new(CELLS).frame(index)).unwrap();
    }
    file.close().unwrap();
    let live = std::fs::read_to_string(&sidecar).unwrap();
    assert_tags_balance(&live);
    assert_eq!(live.matches("<Time ").count(), 3);
    assert!(live.contains("run.h5:/frames/000/000002/solid/seawall/stress<"));

    XdmfSidecar::of_run(&sidecar, &RunReader::open(&path).unwrap()).unwrap().write().unwrap();
    assert_eq!(std::fs::read_to_string(&sidecar).unwrap(), live);
}

/// Every opened element is closed in order; attributes are quoted.
fn assert_tags_balance(xml: &str) {
    let mut open: Vec<&str> = Vec::new();
    for tag in xml.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').unwrap();
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.starts_with('?') && !tag.ends_with('/') {
            open.push(name);
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
    }
    assert_eq!(open, Vec::<&str>::new());
}

#[test]
fn vtkhdf_holds_every_frame_of_each_cloud() {
    let (folder, path) = in_folder();
    let mut file = create(&path);
    write_frames(&mut file, 0..4);
    file.close().unwrap();
    let out = folder.path().join("vtk");
    let written = export_vtkhdf(&RunReader::open(&path).unwrap(), &out, 2).unwrap();
    let names: Vec<_> = written.iter().map(|p| p.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["fluid.vtkhdf", "solid_seawall.vtkhdf", "walls.vtkhdf"]);
    let fluid = hdf5::File::open(&written[0]).unwrap();
    let count = Scene::new(CELLS).frame(0).clouds[0].position.len() as u64;
    assert_eq!(fluid.dataset("VTKHDF/Points").unwrap().shape().unwrap(), [2 * count, 3]);
    assert_eq!(fluid.dataset("VTKHDF/Steps/Values").unwrap().read_f64().unwrap(), [0.0, 0.1]);
}
