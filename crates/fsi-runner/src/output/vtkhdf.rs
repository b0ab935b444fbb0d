//! Export as VTKHDF: one temporal PolyData file a cloud.
//!
//! Arrays of all frames are joined end to end and `Steps` says where each frame
//! begins (VTKHDF 2.0, <https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format>).

use super::error::{At, OutputError};
use super::frame::FieldInfo;
use super::replace_file::{Durability, replace_file_with};
use super::run_reader::{Place, RunReader};
use hdf5::{AttrValue, FileBuilder, FinishedGroup, GroupBuilder};
use std::path::{Path, PathBuf};

/// The export is assembled in memory: beyond this many MiB it is refused.
pub const MEMORY_LIMIT_MIB: u64 = 8192;

const CHUNK: u64 = 32_768;

/// Writes `<cloud>.vtkhdf` for every cloud of the run file into `folder` and
/// returns the paths. Only every `stride`-th frame is taken.
///
/// # Errors
/// [`OutputError::TooLarge`] with the estimate, or that the run file cannot be
/// read or the folder not be written.
pub fn export_vtkhdf(
    run: &RunReader,
    folder: &Path,
    stride: usize,
) -> Result<Vec<PathBuf>, OutputError> {
    std::fs::create_dir_all(folder).at("create", folder)?;
    let frames: Vec<_> = run.frames()?.into_iter().step_by(stride.max(1)).collect();
    let mut clouds: Vec<String> = Vec::new();
    for name in frames.iter().flat_map(|frame| &frame.clouds) {
        if !clouds.contains(name) {
            clouds.push(name.clone());
        }
    }
    let mut series: Vec<(String, Vec<Moment>)> = Vec::new();
    for name in clouds {
        let moments = frames.iter().filter(|frame| frame.clouds.contains(&name));
        let moments = moments.map(|f| Moment { time: f.time, place: Place::Frame(f.index) });
        let moments = moments.collect();
        series.push((name, moments));
    }
    for name in run.static_clouds()? {
        series.push((name, vec![Moment { time: 0.0, place: Place::Static }]));
    }
    let mut written = Vec::new();
    for (name, moments) in series {
        let path = folder.join(format!("{}.vtkhdf", name.replace('/', "_")));
        let series = Series::read(run, &name, &moments)?;
        replace_file_with(&path, Durability::Process, |temporary| {
            series.build().write(temporary).at("write VTKHDF", temporary)
        })?;
        written.push(path);
    }
    Ok(written)
}

#[derive(Clone, Copy)]
struct Moment {
    time: f64,
    place: Place,
}

/// One cloud over all frames.
struct Series {
    times: Vec<f64>,
    counts: Vec<i64>,
    points: Vec<f32>,
    fields: Vec<(FieldInfo, Vec<f32>)>,
}

impl Series {
    fn read(run: &RunReader, cloud: &str, moments: &[Moment]) -> Result<Self, OutputError> {
        let infos = moments.iter().map(|moment| run.cloud(moment.place, cloud));
        let infos = infos.collect::<Result<Vec<_>, _>>()?;
        let fields = infos.first().map_or_else(Vec::new, |info| info.fields.clone());
        refuse_too_large(cloud, infos.iter().map(|info| info.count as u64).sum(), &fields)?;
        let mut series = Self {
            times: moments.iter().map(|moment| moment.time).collect(),
            counts: infos.iter().map(|info| info.count as i64).collect(),
            points: Vec::new(),
            fields: fields.into_iter().map(|field| (field, Vec::new())).collect(),
        };
        for moment in moments {
            let position = run.position(moment.place, cloud)?;
            series.points.extend(position.as_flattened().iter().map(|&x| x as f32));
            for (field, values) in &mut series.fields {
                let read = run.field(moment.place, cloud, &field.name)?;
                values.extend(read.iter().map(|&x| x as f32));
            }
        }
        Ok(series)
    }

    fn build(&self) -> FileBuilder {
        let mut file = FileBuilder::new();
        let mut root = file.create_group("VTKHDF");
        root.set_attr("Version", AttrValue::I64Array(vec![2, 0]));
        root.set_attr("Type", AttrValue::AsciiString("PolyData".into()));
        reals(&mut root, "Points", &self.points, 3);
        integers(&mut root, "NumberOfPoints", &self.counts);
        // Each point is its own vertex cell.
        let none = vec![0; self.counts.len()];
        for (name, counts) in
            [("Vertices", &self.counts), ("Lines", &none), ("Polygons", &none), ("Strips", &none)]
        {
            let cells = cells(root.create_group(name), counts);
            root.add_group(cells);
        }
        let mut data = root.create_group("PointData");
        for (field, values) in &self.fields {
            reals(&mut data, &field.name, values, field.components as u64);
        }
        root.add_group(data.finish());
        let steps = self.steps(root.create_group("Steps"));
        root.add_group(steps);
        file.add_group(root.finish());
        file
    }

    fn steps(&self, mut steps: GroupBuilder) -> FinishedGroup {
        let count = self.times.len();
        let starts: Vec<i64> = self
            .counts
            .iter()
            .scan(0, |total, n| {
                let start = *total;
                *total += n;
                Some(start)
            })
            .collect();
        steps.set_attr("NSteps", AttrValue::I64(count as i64));
        steps.create_dataset("Values").with_f64_data(&self.times).with_shape(&[count as u64]);
        integers(&mut steps, "PointOffsets", &starts);
        integers(&mut steps, "PartOffsets", &(0..count as i64).collect::<Vec<_>>());
        integers(&mut steps, "NumberOfParts", &vec![1; count]);
        // Only the first of the four cell types has cells.
        let cell_starts: Vec<i64> = starts.iter().flat_map(|&start| [start, 0, 0, 0]).collect();
        for name in ["CellOffsets", "ConnectivityIdOffsets"] {
            let set = steps.create_dataset(name).with_i64_data(&cell_starts);
            set.with_shape(&[count as u64, 4]);
        }
        let mut offsets = steps.create_group("PointDataOffsets");
        for (field, _) in &self.fields {
            integers(&mut offsets, &field.name, &starts);
        }
        steps.add_group(offsets.finish());
        steps.finish()
    }
}

fn cells(mut group: GroupBuilder, counts: &[i64]) -> FinishedGroup {
    integers(&mut group, "NumberOfCells", counts);
    integers(&mut group, "NumberOfConnectivityIds", counts);
    let offsets: Vec<i64> = counts.iter().flat_map(|&n| 0..=n).collect();
    let connectivity: Vec<i64> = counts.iter().flat_map(|&n| 0..n).collect();
    integers(&mut group, "Offsets", &offsets);
    integers(&mut group, "Connectivity", &connectivity);
    group.finish()
}

fn integers(group: &mut GroupBuilder, name: &str, values: &[i64]) {
    let rows = values.len() as u64;
    let set = group.create_dataset(name).with_i64_data(values).with_shape(&[rows]);
    if rows > CHUNK {
        set.with_chunks(&[CHUNK]).with_shuffle().with_deflate(1);
    }
}

fn reals(group: &mut GroupBuilder, name: &str, values: &[f32], components: u64) {
    let rows = values.len() as u64 / components;
    let set = group.create_dataset(name).with_f32_data(values);
    if components == 1 {
        set.with_shape(&[rows]).with_chunks(&[rows.clamp(1, CHUNK)]);
    } else {
        set.with_shape(&[rows, components]).with_chunks(&[rows.clamp(1, CHUNK), components]);
    }
    set.with_shuffle().with_deflate(1);
}

fn refuse_too_large(cloud: &str, points: u64, fields: &[FieldInfo]) -> Result<(), OutputError> {
    let components: usize = fields.iter().map(|field| field.components).sum();
    // Read once, held by the builder once more, compressed once; two index arrays a point.
    let bytes = points * (3 * 4 * (3 + components as u64) + 4 * 8);
    let needed_mib = bytes >> 20;
    if needed_mib > MEMORY_LIMIT_MIB {
        return Err(OutputError::TooLarge {
            cloud: cloud.into(),
            needed_mib,
            limit_mib: MEMORY_LIMIT_MIB,
        });
    }
    Ok(())
}
