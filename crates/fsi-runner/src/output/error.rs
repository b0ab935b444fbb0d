//! One error type for every output file.

use std::path::{Path, PathBuf};

/// Why an output could not be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The operating system refused.
    #[error("cannot {action} {path}: {source}")]
    Io {
        /// What was attempted, e.g. "create".
        action: String,
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The HDF5 library refused.
    #[error("cannot {action} HDF5 file {path}: {source}")]
    Hdf5 {
        /// What was attempted, e.g. "write frame 12".
        action: String,
        /// The file.
        path: PathBuf,
        /// The library's reason.
        source: Box<hdf5::Error>,
    },
    /// The file is readable but is not what it should be.
    #[error("{path} is not a usable {expected}: {reason}")]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The kind of file expected, e.g. "run file".
        expected: &'static str,
        /// What is wrong with it.
        reason: String,
    },
    /// The caller's data do not fit together (lengths, names).
    #[error("{what}: {reason}")]
    InvalidData {
        /// The frame, cloud, field or column.
        what: String,
        /// What is wrong, what is allowed.
        reason: String,
    },
    /// A checkpoint belongs to another case or another file format.
    #[error("cannot resume from {path}: {reason}")]
    CheckpointMismatch {
        /// The checkpoint.
        path: PathBuf,
        /// Which property differs, both values, and the remedy.
        reason: String,
    },
    /// The result would not fit into memory.
    #[error(
        "exporting {cloud} needs about {needed_mib} MiB, more than the limit of {limit_mib} MiB: export fewer frames"
    )]
    TooLarge {
        /// The point cloud.
        cloud: String,
        /// Estimated need.
        needed_mib: u64,
        /// The limit.
        limit_mib: u64,
    },
    /// The Rerun log could not be opened.
    #[error("cannot log to Rerun ({target}): {reason}")]
    Rerun {
        /// File or address.
        target: String,
        /// The SDK's reason and the remedy.
        reason: String,
    },
}

/// Attaches the path and the action to a foreign error.
pub(crate) trait At<T> {
    /// Names what was attempted on which file.
    fn at(self, action: &str, path: &Path) -> Result<T, OutputError>;
}

impl<T> At<T> for Result<T, hdf5::Error> {
    fn at(self, action: &str, path: &Path) -> Result<T, OutputError> {
        self.map_err(|source| OutputError::Hdf5 {
            action: action.into(),
            path: path.into(),
            source: Box::new(source),
        })
    }
}

impl<T> At<T> for Result<T, std::io::Error> {
    fn at(self, action: &str, path: &Path) -> Result<T, OutputError> {
        self.map_err(|source| OutputError::Io { action: action.into(), path: path.into(), source })
    }
}
