//! `fsi-runner picture`.

use std::path::Path;

use crate::failure::Failure;
use crate::folder::RunFolder;
use crate::output::run_reader::RunReader;
use crate::output::{OutputError, picture};

/// Draws frame `frame` (the last by default) of the run in `run` to `out`.
///
/// # Errors
/// There is no run or no such frame, or a file cannot be read or written.
pub fn execute(run: &Path, frame: Option<u64>, out: &Path) -> Result<(), Failure> {
    let folder = RunFolder::find(run)?;
    let reader = RunReader::open(&folder.hdf5())?;
    picture::draw(&reader, frame, out).map_err(|error| match error {
        OutputError::InvalidData { .. } => Failure::input(error),
        other => other.into(),
    })?;
    println!("{}", out.display());
    Ok(())
}
