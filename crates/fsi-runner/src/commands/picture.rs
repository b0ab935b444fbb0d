//! `fsi-runner picture`.

use std::path::Path;

use crate::failure::Failure;
use crate::folder::RunFolder;
use crate::output::picture::{self, PictureOptions};
use crate::output::run_reader::RunReader;

/// Draws frame `frame` (the last by default) of the run in `run` to `out`.
///
/// # Errors
/// There is no run or no such frame, or the file cannot be written.
pub fn execute(run: &Path, frame: Option<u64>, out: &Path) -> Result<(), Failure> {
    let folder = RunFolder::find(run)?;
    let reader = RunReader::open(&folder.hdf5())?;
    picture::draw(&reader, frame, out)?;
    println!("{}", out.display());
    Ok(())
}
