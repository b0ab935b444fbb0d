//! `fsi-runner export`.

use std::path::Path;

use crate::failure::Failure;
use crate::folder::RunFolder;
use crate::output::run_reader::RunReader;
use crate::output::vtkhdf::export_vtkhdf;

/// Writes VTKHDF files beside the run's HDF5 file and prints their names.
///
/// # Errors
/// There is no run in the folder, or a file cannot be read or written.
pub fn execute(run: &Path) -> Result<(), Failure> {
    let folder = RunFolder::find(run)?;
    for file in export_vtkhdf(&RunReader::open(&folder.hdf5())?, &folder.path, 1)? {
        println!("{}", file.display());
    }
    Ok(())
}
