//! The HDF5 file of a run, written while it runs.
//!
//! One group and one commit a frame: new data go to the end of the file and the
//! superblock is repointed last, so that after a kill at any moment the file
//! opens and holds every committed frame. See [`layout`] for what is where.

use super::error::{At, OutputError};
use super::frame::{Column, Field, Frame, PointCloud, RunHeader};
use super::history::{self, HistoryTable};
use super::layout::{self, Table};
use super::run_reader::RunReader;
use hdf5::{
    AttrValue, DatasetBuilder, File, FileAccessProperties, FileCreateProperties, Group,
    MetadataCacheConfig, StagedGroup, SyncPolicy,
};
use std::path::{Path, PathBuf};

/// Bytes of object headers kept in memory.
const METADATA_CACHE: usize = 64 << 20;

/// A run's HDF5 file, open for appending.
pub struct RunFile {
    path: PathBuf,
    file: File,
    gauges: HistoryTable,
    ledger: HistoryTable,
    /// Buckets that exist already.
    buckets: Vec<String>,
}

/// The point of a run that a resumed one continues from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResumePoint {
    /// Coupled steps done.
    pub step: u64,
    /// Simulated time (s).
    pub time: f64,
}

impl RunFile {
    /// Creates (or replaces) the file with its header, the clouds that never
    /// move and empty histories.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] for names or lengths that do not fit,
    /// [`OutputError::Hdf5`] when the file cannot be written.
    pub fn create(
        path: &Path,
        header: &RunHeader,
        statics: &[PointCloud],
        gauges: &[Column],
        ledger: &[Column],
    ) -> Result<Self, OutputError> {
        statics.iter().try_for_each(PointCloud::validate)?;
        history::validate(Table::Gauges, gauges)?;
        history::validate(Table::Ledger, ledger)?;
        let file = File::create_with_options(path, FileCreateProperties::new(), access())
            .at("create", path)?;
        stage_header(&file.root(), header)
            .and_then(|()| {
                let root = file.root();
                root.create_group("frames")?;
                root.create_group("history")?;
                stage_table(&root, Table::Gauges, gauges, &[])?;
                stage_table(&root, Table::Ledger, ledger, &[])?;
                root.create_group_with("static", |group| stage_clouds(group, statics))?;
                file.commit()
            })
            .at("write the header of", path)?;
        Self::with_open_file(file, path, gauges, ledger, Vec::new())
    }

    /// Opens the file of an interrupted run to continue after `point`: frames
    /// of later steps and history rows of later times are removed in one commit.
    ///
    /// Flush before writing a checkpoint ([`flush`](Self::flush)); then the file
    /// holds everything up to it.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`] or [`OutputError::Malformed`]; the file is then unchanged.
    pub fn open_to_append(path: &Path, point: ResumePoint) -> Result<Self, OutputError> {
        // The reader's handle is gone before the writer takes the file's lock.
        let kept = Kept::read(&RunReader::open(path)?, point)?;
        let file = File::open_rw_with_options(path, access()).at("open for appending", path)?;
        let root = file.root();
        kept.stage(&root).and_then(|()| file.commit()).at("remove later frames from", path)?;
        Self::with_open_file(file, path, &kept.gauges.0, &kept.ledger.0, kept.buckets)
    }

    fn with_open_file(
        file: File,
        path: &Path,
        gauges: &[Column],
        ledger: &[Column],
        buckets: Vec<String>,
    ) -> Result<Self, OutputError> {
        Ok(Self {
            path: path.into(),
            gauges: HistoryTable::open(&file, path, Table::Gauges, gauges)?,
            ledger: HistoryTable::open(&file, path, Table::Ledger, ledger)?,
            buckets,
            file,
        })
    }

    /// Appends a frame and the history rows that wait, and commits.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] or [`OutputError::Hdf5`]; committed frames stay readable.
    pub fn write_frame(&mut self, frame: &Frame) -> Result<(), OutputError> {
        frame.clouds.iter().try_for_each(PointCloud::validate)?;
        let root = self.file.root();
        let bucket = layout::bucket_group(frame.index);
        let new_bucket = !self.buckets.contains(&bucket);
        let staged = if new_bucket { root.create_group(&bucket).map(drop) } else { Ok(()) };
        staged
            .and_then(|()| {
                root.create_group_with(&layout::frame_group(frame.index), |group| {
                    group.set_attr("index", AttrValue::U64(frame.index));
                    group.set_attr("step", AttrValue::U64(frame.step));
                    group.set_attr("time", AttrValue::F64(frame.time));
                    stage_clouds(group, &frame.clouds);
                })
            })
            .and_then(|_| self.file.commit())
            .at(&format!("write frame {} to", frame.index), &self.path)?;
        if new_bucket {
            self.buckets.push(bucket);
        }
        self.append_waiting_rows()
    }

    /// Takes a row of a table; it reaches the file with the next frame or flush.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] when the number of values is not that of the columns.
    pub fn push_row(&mut self, table: Table, time: f64, values: &[f64]) -> Result<(), OutputError> {
        match table {
            Table::Gauges => self.gauges.push(time, values),
            Table::Ledger => self.ledger.push(time, values),
        }
    }

    /// Appends the waiting rows and forces everything to the disk.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`].
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.append_waiting_rows()?;
        self.file.sync().at("sync", &self.path)
    }

    /// Flushes and closes.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`].
    pub fn close(mut self) -> Result<(), OutputError> {
        self.append_waiting_rows()?;
        let Self { path, file, gauges, ledger, .. } = self;
        drop((gauges, ledger));
        file.close().at("close", &path)
    }

    /// Where the file is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn append_waiting_rows(&mut self) -> Result<(), OutputError> {
        self.gauges.flush(&self.path)?;
        self.ledger.flush(&self.path)
    }
}

/// What survives the removal of everything after a [`ResumePoint`].
struct Kept {
    later_frames: Vec<u64>,
    buckets: Vec<String>,
    gauges: (Vec<Column>, Vec<Vec<f64>>),
    ledger: (Vec<Column>, Vec<Vec<f64>>),
}

impl Kept {
    fn read(reader: &RunReader, point: ResumePoint) -> Result<Self, OutputError> {
        let frames = reader.frames()?;
        let later = frames.iter().filter(|frame| frame.step > point.step);
        let table = |table| -> Result<_, OutputError> {
            let history = reader.history(table)?;
            let rows = history.time.iter().take_while(|&&time| time <= point.time).count();
            let mut columns = vec![history.time];
            columns.extend(history.values);
            columns.iter_mut().for_each(|column| column.truncate(rows));
            Ok((history.columns, columns))
        };
        let mut buckets: Vec<_> = frames.iter().map(|f| layout::bucket_group(f.index)).collect();
        buckets.dedup();
        Ok(Self {
            later_frames: later.map(|frame| frame.index).collect(),
            buckets,
            gauges: table(Table::Gauges)?,
            ledger: table(Table::Ledger)?,
        })
    }

    /// The tables are replaced even when no row is late: a kill may have left
    /// columns of unequal length.
    fn stage(&self, root: &Group) -> Result<(), hdf5::Error> {
        for &index in &self.later_frames {
            root.delete(&layout::frame_group(index))?;
        }
        for (table, (columns, rows)) in
            [(Table::Gauges, &self.gauges), (Table::Ledger, &self.ledger)]
        {
            root.delete(&table.group())?;
            stage_table(root, table, columns, rows)?;
        }
        Ok(())
    }
}

/// Writes reach the system at once; only `flush` and `close` wait for the disk.
///
/// Every commit walks the headers of all objects in the file; the cache keeps
/// them (about 10 kB a frame) in memory.
fn access() -> FileAccessProperties {
    FileAccessProperties::new()
        .with_sync_policy(SyncPolicy::OnClose)
        .with_metadata_cache(MetadataCacheConfig::new(METADATA_CACHE))
}

/// Eight attributes at most: more would move to a heap that fewer programs read.
fn stage_header(root: &Group, header: &RunHeader) -> Result<(), hdf5::Error> {
    root.set_attr("format", layout::text(layout::FORMAT))?;
    root.set_attr("program_version", layout::text(&header.program_version))?;
    root.set_attr("case_name", layout::text(&header.case_name))?;
    root.set_attr("case_text", layout::text(&header.case_text))?;
    root.set_attr("overrides", layout::texts(header.overrides.iter().map(String::as_str)))?;
    root.set_attr("dimension", AttrValue::U64(header.dimension as u64))?;
    root.set_attr("gravity", AttrValue::F64Array(header.gravity.to_vec()))?;
    root.set_attr("run_id", layout::text(&header.run_id))
}

fn stage_table(
    root: &Group,
    table: Table,
    columns: &[Column],
    rows: &[Vec<f64>],
) -> Result<(), hdf5::Error> {
    root.create_group_with(&table.group(), |group| history::stage(group, columns, rows)).map(drop)
}

fn stage_clouds(parent: &mut StagedGroup<'_>, clouds: &[PointCloud]) {
    parent.set_attr("clouds", layout::texts(clouds.iter().map(|cloud| cloud.name.as_str())));
    let mut folders: Vec<&str> = Vec::new();
    for cloud in clouds {
        // `solid/<body>`: the first body brings the group `solid`.
        for (end, _) in cloud.name.match_indices('/') {
            let folder = &cloud.name[..end];
            if !folders.contains(&folder) {
                parent.create_group(folder);
                folders.push(folder);
            }
        }
        stage_cloud(parent, cloud);
    }
}

fn stage_cloud(parent: &mut StagedGroup<'_>, cloud: &PointCloud) {
    parent.create_group_with(&cloud.name, |group| {
        group.set_attr("kind", layout::text(cloud.kind.word()));
        group.set_attr("spacing", AttrValue::F64(cloud.spacing));
        group.set_attr("fields", layout::texts(cloud.fields.iter().map(|field| field.name)));
        group.create_dataset("position", |set| {
            set.with_f64_data(cloud.position.as_flattened());
            shape(set, cloud.position.len(), 3, "m");
        });
        group.create_dataset("id", |set| {
            set.with_u32_data(&cloud.id);
            shape(set, cloud.id.len(), 1, "1");
        });
        for field in &cloud.fields {
            group.create_dataset(field.name, |set| stage_field(set, field));
        }
    });
}

fn stage_field(set: &mut DatasetBuilder, field: &Field) {
    if field.stored_double() {
        set.with_f64_data(&field.values);
    } else {
        let values: Vec<f32> = field.values.iter().map(|&value| value as f32).collect();
        set.with_f32_data(&values);
    }
    shape(set, field.values.len() / field.components, field.components, field.unit);
}

fn shape(set: &mut DatasetBuilder, rows: usize, components: usize, unit: &str) {
    let (rows, components) = (rows as u64, components as u64);
    set.set_attr("units", layout::text(unit));
    let chunk = layout::chunk_rows(rows as usize);
    if components == 1 {
        set.with_shape(&[rows]).with_chunks(&[chunk]);
    } else {
        set.with_shape(&[rows, components]).with_chunks(&[chunk, components]);
    }
    set.with_shuffle().with_deflate(1);
}
