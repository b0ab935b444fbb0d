//! Reading a run's HDF5 file, finished or still being written.

use super::error::{At, OutputError};
use super::frame::{CloudInfo, CloudKind, Column, FieldInfo, RunHeader};
use super::layout::{self, Table};
use hdf5::{AttrValue, DType, File, FileAccessProperties, FileLocking};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A run's HDF5 file, open for reading. Data are fetched as they are asked for.
pub struct RunReader {
    path: PathBuf,
    file: File,
}

/// A frame without its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameInfo {
    /// See [`Frame::index`](super::frame::Frame::index).
    pub index: u64,
    /// Coupled steps done.
    pub step: u64,
    /// Simulated time (s).
    pub time: f64,
    /// Names of the clouds in this frame.
    pub clouds: Vec<String>,
}

/// A table of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Names and units, without time.
    pub columns: Vec<Column>,
    /// Time of each row (s).
    pub time: Vec<f64>,
    /// For each column, one value a row.
    pub values: Vec<Vec<f64>>,
}

impl History {
    /// The values of the column called `name`.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let i = self.columns.iter().position(|column| column.name == name)?;
        Some(&self.values[i])
    }
}

/// Where a cloud's data sets are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the frame of this index.
    Frame(u64),
    /// Among the clouds that never move.
    Static,
}

impl Place {
    /// The group inside the file, e.g. `frames/000/000123`.
    pub fn group(self) -> String {
        match self {
            Self::Frame(index) => layout::frame_group(index),
            Self::Static => "static".into(),
        }
    }
}

impl RunReader {
    /// Opens the file without a lock, so that a running writer is not disturbed:
    /// what it committed before this call is seen.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`] when it cannot be opened, [`OutputError::Malformed`]
    /// when it is not a run file of this format.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let access = FileAccessProperties::new().with_locking(FileLocking::Disabled);
        let file = File::open_streaming_with_options(path, access).at("open", path)?;
        let reader = Self { path: path.into(), file };
        let format = reader.attributes("")?.text("format")?;
        if format != layout::FORMAT {
            return Err(reader.malformed(format!(
                "its format is `{format}`, this program reads `{}`",
                layout::FORMAT
            )));
        }
        Ok(reader)
    }

    /// Where the file is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What identifies the run.
    ///
    /// # Errors
    /// [`OutputError::Malformed`] when an attribute is missing.
    pub fn header(&self) -> Result<RunHeader, OutputError> {
        let root = self.attributes("")?;
        let gravity = root.get("gravity")?.to_f64s().unwrap_or_default();
        Ok(RunHeader {
            case_name: root.text("case_name")?,
            case_text: root.text("case_text")?,
            overrides: root.texts("overrides")?,
            program_version: root.text("program_version")?,
            dimension: root.number("dimension")? as usize,
            gravity: gravity.try_into().map_err(|_| self.malformed("`gravity` is not a vector"))?,
            run_id: root.text("run_id")?,
        })
    }

    /// All committed frames in order of their index.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`] or [`OutputError::Malformed`].
    pub fn frames(&self) -> Result<Vec<FrameInfo>, OutputError> {
        let mut frames = Vec::new();
        for (_, bucket) in
            self.file.group("frames").and_then(|g| g.iter_groups()).at("list", &self.path)?
        {
            for (name, group) in bucket.iter_groups().at("list", &self.path)? {
                let place = format!("frame {name}");
                let attributes =
                    Attributes { reader: self, place, map: group.attrs().at("read", &self.path)? };
                frames.push(FrameInfo {
                    index: attributes.number("index")?,
                    step: attributes.number("step")?,
                    time: attributes.real("time")?,
                    clouds: attributes.texts("clouds")?,
                });
            }
        }
        frames.sort_by_key(|frame| frame.index);
        Ok(frames)
    }

    /// Names of the clouds that never move.
    ///
    /// # Errors
    /// [`OutputError::Malformed`].
    pub fn static_clouds(&self) -> Result<Vec<String>, OutputError> {
        self.attributes("static")?.texts("clouds")
    }

    /// Shape of a cloud and of its fields.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`] when there is no such cloud.
    pub fn cloud(&self, place: Place, cloud: &str) -> Result<CloudInfo, OutputError> {
        let group = format!("{}/{cloud}", place.group());
        let attributes = self.attributes(&group)?;
        let kind = attributes.text("kind")?;
        let mut fields = Vec::new();
        for name in attributes.texts("fields")? {
            let set = self.data_set(&format!("{group}/{name}"))?;
            let shape = set.shape().at("read", &self.path)?;
            let map = set.attrs().at("read", &self.path)?;
            let unit =
                Attributes { reader: self, place: format!("{group}/{name}"), map }.text("units")?;
            let components = shape.get(1).map_or(1, |&c| c as usize);
            let double = set.dtype().at("read", &self.path)? == DType::F64;
            fields.push(FieldInfo { name, unit, components, double });
        }
        let shape = self.data_set(&format!("{group}/position"))?.shape().at("read", &self.path)?;
        Ok(CloudInfo {
            name: cloud.into(),
            kind: CloudKind::from_word(&kind)
                .ok_or_else(|| self.malformed(format!("`{group}` has unknown kind `{kind}`")))?,
            spacing: attributes.real("spacing")?,
            count: shape.first().map_or(0, |&n| n as usize),
            fields,
        })
    }

    /// Positions (m) of a cloud.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`].
    pub fn position(&self, place: Place, cloud: &str) -> Result<Vec<[f64; 3]>, OutputError> {
        let flat = self.field(place, cloud, "position")?;
        Ok(flat.as_chunks::<3>().0.to_vec())
    }

    /// Identities of a cloud's points, in stored order.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`].
    pub fn id(&self, place: Place, cloud: &str) -> Result<Vec<u32>, OutputError> {
        let set = self.data_set(&format!("{}/{cloud}/id", place.group()))?;
        set.read_u32().at("read", &self.path)
    }

    /// A field of a cloud, point after point.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`].
    pub fn field(&self, place: Place, cloud: &str, name: &str) -> Result<Vec<f64>, OutputError> {
        let set = self.data_set(&format!("{}/{cloud}/{name}", place.group()))?;
        set.read_f64().at("read", &self.path)
    }

    /// A whole table. Rows that a kill left incomplete are left out.
    ///
    /// # Errors
    /// [`OutputError::Hdf5`] or [`OutputError::Malformed`].
    pub fn history(&self, table: Table) -> Result<History, OutputError> {
        let group = table.group();
        let mut columns = Vec::new();
        let mut values = Vec::new();
        for name in self.attributes(&group)?.texts("columns")? {
            let set = self.data_set(&format!("{group}/{name}"))?;
            let map = set.attrs().at("read", &self.path)?;
            let unit =
                Attributes { reader: self, place: format!("{group}/{name}"), map }.text("units")?;
            columns.push(Column { name, unit });
            values.push(set.read_f64().at("read", &self.path)?);
        }
        let mut time =
            self.data_set(&format!("{group}/time"))?.read_f64().at("read", &self.path)?;
        let rows = values.iter().map(Vec::len).fold(time.len(), usize::min);
        time.truncate(rows);
        values.iter_mut().for_each(|column| column.truncate(rows));
        Ok(History { columns, time, values })
    }

    fn data_set(&self, name: &str) -> Result<hdf5::Dataset, OutputError> {
        self.file.dataset(name).at(&format!("find `{name}` in"), &self.path)
    }

    fn attributes(&self, group: &str) -> Result<Attributes<'_>, OutputError> {
        let opened = if group.is_empty() { Ok(self.file.root()) } else { self.file.group(group) };
        let map = opened.and_then(|g| g.attrs()).at(&format!("read `/{group}` of"), &self.path)?;
        Ok(Attributes { reader: self, place: format!("/{group}"), map })
    }

    fn malformed(&self, reason: impl Into<String>) -> OutputError {
        OutputError::Malformed {
            path: self.path.clone(),
            expected: "run file",
            reason: reason.into(),
        }
    }
}

/// The attributes of one object, with errors that say where one is missing.
struct Attributes<'a> {
    reader: &'a RunReader,
    place: String,
    map: HashMap<String, AttrValue>,
}

impl Attributes<'_> {
    fn get(&self, name: &str) -> Result<&AttrValue, OutputError> {
        self.map.get(name).ok_or_else(|| {
            self.reader.malformed(format!("attribute `{name}` of `{}` is missing", self.place))
        })
    }

    fn typed<'s, T>(
        &'s self,
        name: &str,
        convert: impl FnOnce(&'s AttrValue) -> Option<T>,
    ) -> Result<T, OutputError> {
        convert(self.get(name)?).ok_or_else(|| {
            self.reader
                .malformed(format!("attribute `{name}` of `{}` has another type", self.place))
        })
    }

    fn text(&self, name: &str) -> Result<String, OutputError> {
        self.typed(name, |value| value.as_str().map(String::from))
    }

    fn texts(&self, name: &str) -> Result<Vec<String>, OutputError> {
        self.typed(name, |value| value.as_strings().map(<[String]>::to_vec))
    }

    fn number(&self, name: &str) -> Result<u64, OutputError> {
        self.typed(name, AttrValue::as_u64)
    }

    fn real(&self, name: &str) -> Result<f64, OutputError> {
        self.typed(name, AttrValue::as_f64)
    }
}
