//! Replacing a file so that a reader sees the old or the new one, never a mix.

use super::error::{At, OutputError};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Whether the new content must outlive a power failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Durability {
    /// It survives the death of this process.
    Process,
    /// It is forced to the disk before the old file goes.
    Machine,
}

/// Writes `path` by way of a neighbour file that is renamed over it.
///
/// `write` fills the neighbour, whose path it is given.
///
/// # Errors
/// Whatever `write` returns, or [`OutputError::Io`]. The old file is then untouched.
pub fn replace_file_with(
    path: &Path,
    durability: Durability,
    write: impl FnOnce(&Path) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    let temporary = temporary_beside(path);
    let result = write(&temporary).and_then(|()| publish(&temporary, path, durability));
    if result.is_err() {
        // The neighbour may not exist; the first error is the one to report.
        fs::remove_file(&temporary).ok();
    }
    result
}

/// Writes `bytes` to `path`, see [`replace_file_with`].
///
/// # Errors
/// [`OutputError::Io`].
pub fn replace_file(
    path: &Path,
    durability: Durability,
    bytes: &[&[u8]],
) -> Result<(), OutputError> {
    replace_file_with(path, durability, |temporary| {
        let mut file = fs::File::create(temporary).at("create", temporary)?;
        bytes.iter().try_for_each(|part| file.write_all(part)).at("write", temporary)
    })
}

fn publish(temporary: &Path, path: &Path, durability: Durability) -> Result<(), OutputError> {
    if durability == Durability::Machine {
        let file = fs::File::open(temporary).at("open", temporary)?;
        file.sync_all().at("sync", temporary)?;
    }
    fs::rename(temporary, path).at("replace", path)?;
    if durability == Durability::Machine
        && let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty())
    {
        // Not every file system can sync a folder; the rename itself has happened.
        if let Ok(folder) = fs::File::open(folder) {
            folder.sync_all().ok();
        }
    }
    Ok(())
}

fn temporary_beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(".tmp");
    path.with_file_name(name)
}
