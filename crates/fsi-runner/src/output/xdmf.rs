//! The XDMF sidecar that lets ParaView and VTK open the HDF5 file as a time series.

use super::error::OutputError;
use super::frame::{CloudInfo, FieldInfo, Frame, PointCloud};
use super::replace_file::{Durability, replace_file};
use super::run_reader::{Place, RunReader};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Up to this size the sidecar is rewritten with every frame.
const ALWAYS_REWRITTEN: usize = 4 << 20;

/// Beyond it, when it has grown by this fraction: total writing stays
/// proportional to the final size instead of its square.
const GROWTH: usize = 64;

const HEAD: &str = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\
<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
const TAIL: &str = "</Grid></Domain></Xdmf>\n";

/// An XDMF file under construction: a temporal collection of spatial collections.
pub struct XdmfSidecar {
    path: PathBuf,
    /// The HDF5 file's name, relative to the sidecar.
    data_file: String,
    /// Clouds that never move, repeated in each frame by reference.
    static_grids: String,
    body: String,
    written: usize,
}

impl XdmfSidecar {
    /// Starts a sidecar at `path` for the run file `data_file` in the same folder.
    pub fn new(path: &Path, data_file: &str, statics: &[PointCloud]) -> Self {
        let statics: Vec<_> = statics.iter().map(PointCloud::info).collect();
        Self::with_statics(path, data_file, &statics)
    }

    /// Builds the sidecar of an existing run file beside it, e.g. to resume.
    ///
    /// # Errors
    /// [`OutputError`] when the run file cannot be read.
    pub fn of_run(path: &Path, run: &RunReader) -> Result<Self, OutputError> {
        let names = run.static_clouds()?;
        let clouds = |names: &[String], place| {
            names.iter().map(|name| run.cloud(place, name)).collect::<Result<Vec<_>, _>>()
        };
        let data_file = run.path().file_name().unwrap_or_default().to_string_lossy();
        let mut sidecar = Self::with_statics(path, &data_file, &clouds(&names, Place::Static)?);
        for frame in run.frames()? {
            sidecar.push(
                frame.index,
                frame.time,
                &clouds(&frame.clouds, Place::Frame(frame.index))?,
            );
        }
        Ok(sidecar)
    }

    fn with_statics(path: &Path, data_file: &str, statics: &[CloudInfo]) -> Self {
        let mut static_grids = String::new();
        for cloud in statics {
            write_grid(&mut static_grids, &escape(data_file), Place::Static, cloud);
        }
        Self {
            path: path.into(),
            data_file: escape(data_file),
            static_grids,
            body: String::new(),
            written: 0,
        }
    }

    /// Adds a frame that the run file has committed.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn add_frame(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let clouds: Vec<_> = frame.clouds.iter().map(PointCloud::info).collect();
        self.push(frame.index, frame.time, &clouds);
        let size = self.body.len();
        if size <= ALWAYS_REWRITTEN || size - self.written >= size / GROWTH {
            self.write()?;
        }
        Ok(())
    }

    /// Replaces the file on the disk with all frames so far.
    ///
    /// # Errors
    /// [`OutputError::Io`].
    pub fn write(&mut self) -> Result<(), OutputError> {
        let parts = [HEAD.as_bytes(), self.body.as_bytes(), TAIL.as_bytes()];
        replace_file(&self.path, Durability::Process, &parts)?;
        self.written = self.body.len();
        Ok(())
    }

    fn push(&mut self, index: u64, time: f64, clouds: &[CloudInfo]) {
        append(
            &mut self.body,
            format_args!(
                "<Grid Name=\"frame {index}\" GridType=\"Collection\" \
                 CollectionType=\"Spatial\"><Time Value=\"{time:?}\"/>\n"
            ),
        );
        for cloud in clouds {
            write_grid(&mut self.body, &self.data_file, Place::Frame(index), cloud);
        }
        self.body += &self.static_grids;
        self.body += "</Grid>\n";
    }
}

fn write_grid(out: &mut String, file: &str, place: Place, cloud: &CloudInfo) {
    if cloud.count == 0 {
        return;
    }
    let count = cloud.count;
    let group = format!("{file}:/{}/{}", place.group(), escape(&cloud.name));
    append(
        out,
        format_args!(
            "<Grid Name=\"{}\" GridType=\"Uniform\">\
             <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{count}\" \
             NodesPerElement=\"1\"/><Geometry GeometryType=\"XYZ\">\
             <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" \
             Dimensions=\"{count} 3\">{group}/position</DataItem></Geometry>\n\
             <Attribute Name=\"id\" AttributeType=\"Scalar\" Center=\"Node\">\
             <DataItem Format=\"HDF\" NumberType=\"UInt\" Precision=\"4\" \
             Dimensions=\"{count}\">{group}/id</DataItem></Attribute>\n",
            escape(&cloud.name)
        ),
    );
    for field in &cloud.fields {
        let path = format!("{group}/{}", escape(&field.name));
        write_field(out, field, count, &path);
    }
    let kind = cloud.kind.word();
    append(out, format_args!("<Information Name=\"kind\" Value=\"{kind}\"/></Grid>\n"));
}

fn write_field(out: &mut String, field: &FieldInfo, count: usize, path: &str) {
    let (name, width) = (escape(&field.name), field.components);
    let precision = if field.double { 8 } else { 4 };
    let numbers = format!("NumberType=\"Float\" Precision=\"{precision}\"");
    if let Some(components) = tensor_components(width) {
        // XDMF's own tensor has another order of components, and readers differ
        // in what they make of it: six scalars are read alike by all.
        for (i, component) in components.iter().enumerate() {
            append(
                out,
                format_args!(
                    "<Attribute Name=\"{name}_{component}\" AttributeType=\"Scalar\" \
                     Center=\"Node\"><DataItem ItemType=\"HyperSlab\" \
                     Dimensions=\"{count} 1\"><DataItem Format=\"XML\" Dimensions=\"3 2\">\
                     0 {i} 1 1 {count} 1</DataItem><DataItem Format=\"HDF\" {numbers} \
                     Dimensions=\"{count} {width}\">{path}</DataItem></DataItem></Attribute>\n"
                ),
            );
        }
        return;
    }
    let (kind, dimensions) = match width {
        1 => ("Scalar", format!("{count}")),
        _ => ("Vector", format!("{count} {width}")),
    };
    append(
        out,
        format_args!(
            "<Attribute Name=\"{name}\" AttributeType=\"{kind}\" Center=\"Node\">\
             <DataItem Format=\"HDF\" {numbers} Dimensions=\"{dimensions}\">{path}</DataItem>\
             </Attribute>\n"
        ),
    );
}

fn tensor_components(width: usize) -> Option<[&'static str; 6]> {
    (width == 6).then_some(["xx", "yy", "zz", "xy", "yz", "xz"])
}

fn append(out: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    out.write_fmt(text).ok();
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
