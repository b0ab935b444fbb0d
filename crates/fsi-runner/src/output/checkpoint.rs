//! The complete state of a run at one step, bit for bit.

use super::error::{At, OutputError};
use super::layout;
use super::replace_file::{Durability, replace_file_with};
use hdf5::{AttrValue, File, FileAccessProperties, FileBuilder, FileLocking, Group};
use std::collections::BTreeMap;
use std::path::Path;

/// Changes when an older checkpoint can no longer be continued.
const FORMAT: &str = "seawall checkpoint 1";

/// Named numbers; what they mean is the business of the run loop.
///
/// Names must not contain `/`. Floating-point values keep every bit: the sign
/// of zero and the payload of NaN included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// From [`case_fingerprint`]: a checkpoint continues the case it was written by.
    pub case_hash: u64,
    /// Single floating-point values.
    pub scalars: BTreeMap<String, f64>,
    /// Single counts.
    pub integers: BTreeMap<String, u64>,
    /// State of particles and points.
    pub reals: BTreeMap<String, Vec<f64>>,
    /// Identities, orders, groups.
    pub indices: BTreeMap<String, Vec<u32>>,
}

/// 64-bit FNV-1a hash of the case text and the overrides.
///
/// ```
/// use fsi_runner::output::checkpoint::case_fingerprint;
/// let plain = case_fingerprint("(name: \"a\")", &[]);
/// assert_ne!(plain, case_fingerprint("(name: \"a\")", &["end_time=2".into()]));
/// ```
pub fn case_fingerprint(case_text: &str, overrides: &[String]) -> u64 {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    // A byte that UTF-8 never contains keeps `a` + `b` apart from `ab`.
    let parts = std::iter::once(case_text).chain(overrides.iter().map(String::as_str));
    parts
        .flat_map(|part| part.bytes().chain(std::iter::once(0xff)))
        .fold(OFFSET, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

impl Checkpoint {
    /// Replaces the checkpoint at `path`; it is on the disk when this returns,
    /// and a kill or power failure meanwhile leaves the previous one.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] for a name with `/`, [`OutputError::Io`],
    /// [`OutputError::Hdf5`].
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let names = self.scalars.keys().chain(self.integers.keys());
        let names = names.chain(self.reals.keys()).chain(self.indices.keys());
        for name in names {
            if name.is_empty() || name.contains('/') {
                return Err(OutputError::InvalidData {
                    what: format!("checkpoint entry `{name}`"),
                    reason: "a name must not be empty and not contain `/`".into(),
                });
            }
        }
        replace_file_with(path, Durability::Machine, |temporary| {
            self.build().write(temporary).at("write checkpoint", temporary)
        })
    }

    fn build(&self) -> FileBuilder {
        let mut file = FileBuilder::new();
        file.set_attr("format", layout::text(FORMAT));
        file.set_attr("case_hash", AttrValue::U64(self.case_hash));
        let mut group = file.create_group("scalars");
        for (name, value) in &self.scalars {
            group.create_dataset(name).with_f64_data(&[*value]).with_shape(&[1]);
        }
        file.add_group(group.finish());
        let mut group = file.create_group("integers");
        for (name, value) in &self.integers {
            group.create_dataset(name).with_u64_data(&[*value]).with_shape(&[1]);
        }
        file.add_group(group.finish());
        let mut group = file.create_group("reals");
        for (name, values) in &self.reals {
            group.create_dataset(name).with_f64_data(values).with_shape(&[values.len() as u64]);
        }
        file.add_group(group.finish());
        let mut group = file.create_group("indices");
        for (name, values) in &self.indices {
            group.create_dataset(name).with_u32_data(values).with_shape(&[values.len() as u64]);
        }
        file.add_group(group.finish());
        file
    }

    /// Reads the checkpoint at `path`, which must belong to the case of `case_hash`.
    ///
    /// # Errors
    /// [`OutputError::CheckpointMismatch`] for another case or format,
    /// [`OutputError::Hdf5`] when it cannot be read.
    pub fn read(path: &Path, case_hash: u64) -> Result<Self, OutputError> {
        let access = FileAccessProperties::new().with_locking(FileLocking::Disabled);
        let file = File::open_with_options(path, access).at("open checkpoint", path)?;
        let attributes = file.root().attrs().at("read checkpoint", path)?;
        let mismatch = |reason| OutputError::CheckpointMismatch { path: path.into(), reason };
        let format = attributes.get("format").and_then(AttrValue::as_str).unwrap_or("unknown");
        if format != FORMAT {
            return Err(mismatch(format!(
                "its format is `{format}`, this program continues `{FORMAT}`; start the run anew"
            )));
        }
        let stored = attributes.get("case_hash").and_then(AttrValue::as_u64).unwrap_or(0);
        if stored != case_hash {
            return Err(mismatch(format!(
                "the case or its overrides have changed since it was written (fingerprint \
                 {stored:016x}, now {case_hash:016x}); restore them or start the run anew \
                 without --resume"
            )));
        }
        Self::read_groups(&file, stored).at("read checkpoint", path)
    }

    fn read_groups(file: &File, case_hash: u64) -> Result<Self, hdf5::Error> {
        let scalars = each(&file.group("scalars")?, |set| set.read_f64())?;
        let integers = each(&file.group("integers")?, |set| set.read_u64())?;
        Ok(Self {
            case_hash,
            scalars: scalars
                .into_iter()
                .filter_map(|(name, v)| Some((name, *v.first()?)))
                .collect(),
            integers: integers
                .into_iter()
                .filter_map(|(name, v)| Some((name, *v.first()?)))
                .collect(),
            reals: each(&file.group("reals")?, |set| set.read_f64())?,
            indices: each(&file.group("indices")?, |set| set.read_u32())?,
        })
    }
}

fn each<T>(
    group: &Group,
    read: impl Fn(&hdf5::Dataset) -> Result<T, hdf5::Error>,
) -> Result<BTreeMap<String, T>, hdf5::Error> {
    group.iter_datasets()?.map(|(name, set)| Ok((name, read(&set)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Checkpoint {
        let odd = [f64::from_bits(0x7ff8_0000_dead_beef), -0.0, f64::MIN_POSITIVE / 8.0, 1.0 / 3.0];
        Checkpoint {
            case_hash: case_fingerprint("case", &[]),
            scalars: BTreeMap::from([("time".into(), 0.1 + 0.2), ("nan".into(), odd[0])]),
            integers: BTreeMap::from([("step".into(), u64::MAX)]),
            reals: BTreeMap::from([
                ("fluid.position".into(), odd.to_vec()),
                ("empty".into(), vec![]),
            ]),
            indices: BTreeMap::from([("fluid.id".into(), vec![3, 0, u32::MAX])]),
        }
    }

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|value| value.to_bits()).collect()
    }

    #[test]
    fn every_bit_returns() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.h5");
        let written = sample();
        written.write(&path).unwrap();
        written.write(&path).unwrap();
        let read = Checkpoint::read(&path, written.case_hash).unwrap();
        for (name, values) in &written.reals {
            assert_eq!(bits(values), bits(&read.reals[name]), "{name}");
        }
        for (name, value) in &written.scalars {
            assert_eq!(value.to_bits(), read.scalars[name].to_bits(), "{name}");
        }
        assert_eq!(
            (written.reals.len(), written.scalars.len()),
            (read.reals.len(), read.scalars.len())
        );
        assert_eq!(written.indices, read.indices);
        assert_eq!(written.integers, read.integers);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    }

    #[test]
    fn a_changed_case_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.h5");
        sample().write(&path).unwrap();
        let other = case_fingerprint("case", &["fluid.spacing=0.1".into()]);
        let message = Checkpoint::read(&path, other).unwrap_err().to_string();
        assert!(message.contains("the case or its overrides have changed"), "{message}");
    }
}
