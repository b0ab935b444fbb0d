//! Where a run is written.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Files of one run.
#[derive(Debug, Clone)]
pub struct RunFolder {
    /// The folder.
    pub path: PathBuf,
    name: String,
}

impl RunFolder {
    /// The folder `path` of a run of the case `name`.
    pub fn new(path: PathBuf, name: &str) -> Self {
        Self { path, name: name.to_owned() }
    }

    /// Finds a run in an existing folder by its HDF5 file.
    ///
    /// # Errors
    /// There is no run, or more than one.
    pub fn find(path: &Path) -> Result<Self, Failure> {
        let entries = std::fs::read_dir(path)
            .map_err(|error| Failure::input(format!("cannot read {}: {error}", path.display())))?;
        let mut names: Vec<String> = entries
            .filter_map(Result::ok)
            .map(|entry| entry.path())
            .filter(|file| file.extension().is_some_and(|ending| ending == "h5"))
            .filter_map(|file| Some(file.file_stem()?.to_string_lossy().into_owned()))
            .filter(|name| name != CHECKPOINT)
            .collect();
        names.sort();
        match names.as_slice() {
            [name] => Ok(Self::new(path.to_owned(), name)),
            [] => Err(Failure::input(format!("{} holds no run (no .h5 file)", path.display()))),
            several => Err(Failure::input(format!(
                "{} holds several runs: {}; keep one run a folder",
                path.display(),
                several.join(", ")
            ))),
        }
    }

    /// `NAME.h5`.
    pub fn hdf5(&self) -> PathBuf {
        self.path.join(format!("{}.h5", self.name))
    }

    /// `NAME.xdmf`.
    pub fn xdmf(&self) -> PathBuf {
        self.path.join(format!("{}.xdmf", self.name))
    }

    /// `NAME.rrd`.
    pub fn rerun(&self) -> PathBuf {
        self.path.join(format!("{}.rrd", self.name))
    }

    /// `NAME-from-STEP.rrd`: recordings cannot be appended to, so a resumed run writes its
    /// own, which the viewer shows as one with the first.
    pub fn resumed_rerun(&self, step: u64) -> PathBuf {
        self.path.join(format!("{}-from-{step}.rrd", self.name))
    }

    /// `gauges.csv`.
    pub fn gauges(&self) -> PathBuf {
        self.path.join("gauges.csv")
    }

    /// `ledger.csv`.
    pub fn ledger(&self) -> PathBuf {
        self.path.join("ledger.csv")
    }

    /// `checkpoint.h5`.
    pub fn checkpoint(&self) -> PathBuf {
        self.path.join(format!("{CHECKPOINT}.h5"))
    }
}

const CHECKPOINT: &str = "checkpoint";

/// The folder of a new run: `wanted`, or the first free one of `runs/NAME`,
/// `runs/NAME-2`, … Nothing is created yet.
///
/// # Errors
/// `wanted` holds a run already and `overwrite` is off.
pub fn choose(wanted: Option<&Path>, name: &str, overwrite: bool) -> Result<RunFolder, Failure> {
    let Some(wanted) = wanted else {
        let base = Path::new("runs").join(name);
        if overwrite {
            return Ok(RunFolder::new(base, name));
        }
        let numbered = (2..).map(|number| Path::new("runs").join(format!("{name}-{number}")));
        let free = std::iter::once(base).chain(numbered).find(|path| !path.exists());
        return free
            .map(|path| RunFolder::new(path, name))
            .ok_or_else(|| Failure::run("no free folder name in runs/"));
    };
    let folder = RunFolder::new(wanted.to_owned(), name);
    if folder.hdf5().exists() && !overwrite {
        return Err(Failure::input(format!(
            "{} already holds a run; add --overwrite to replace it, --resume to continue it, or \
             choose another --out",
            wanted.display()
        )));
    }
    Ok(folder)
}
