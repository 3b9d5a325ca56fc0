//! Errors of writing output, and of taking up the output of an earlier run.

use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of output that could not be written or taken up again. Every variant names the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The output folder cannot be made, or is not a folder.
    #[error("cannot make the output folder {}: {source}", path.display())]
    Folder {
        /// The folder asked for.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The output folder is there, but no file can be written into it.
    #[error("cannot write into the output folder {}: {source}", path.display())]
    NotWritable {
        /// The folder asked for.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// Another run writes into the output folder.
    #[error("the output folder {} is in use: another run writes into it; accepted: a folder of its own for each run", path.display())]
    InUse {
        /// The folder asked for.
        path: PathBuf,
    },
    /// The output folder holds frames that the list of no earlier run names.
    #[error("the output folder {} holds frames that the list of no earlier run names: found {count}, the first is {first}; \
         a viewer would show them among those of this run. accepted: another folder, or this one without them", path.display())]
    Unlisted {
        /// The folder asked for.
        path: PathBuf,
        /// Name of the first of them.
        first: String,
        /// Number of them.
        count: usize,
    },
    /// A file could not be written; the file that was there before is untouched.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file of an earlier run is not what this program writes.
    #[error("{}:{line}: {reason}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// The fault.
        reason: String,
    },
    /// An array of a frame, or a row of the history, has the wrong number of values.
    #[error("{}: '{name}' has {found} values, expected {expected}", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Name of the array, or `row`.
        name: String,
        /// Number of points, or of columns.
        expected: usize,
        /// Number of values given.
        found: usize,
    },
    /// A name of an array or column cannot be used.
    #[error("{}: the name {name:?} cannot be used: {reason}", path.display())]
    Name {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
        /// Reason of the refusal.
        reason: &'static str,
    },
    /// A time is not finite, or not later than the one before it.
    #[error("{}: time {time:?} s {}", path.display(), unfit(*time, *last))]
    Time {
        /// The file.
        path: PathBuf,
        /// The time given \[s\].
        time: f64,
        /// The last time in the file \[s\], if there is one.
        last: Option<f64>,
    },
    /// The history to be continued has other columns than the run writes.
    #[error("{}: cannot be continued: it has the columns {}, the run writes {}", path.display(), found.join(","), expected.join(","))]
    Columns {
        /// The file.
        path: PathBuf,
        /// Columns that the run writes.
        expected: Vec<String>,
        /// Columns that the file has.
        found: Vec<String>,
    },
}

impl OutputError {
    pub(super) fn write(path: &Path, source: io::Error) -> Self {
        Self::Write {
            path: path.to_path_buf(),
            source,
        }
    }

    pub(super) fn read(path: &Path, source: io::Error) -> Self {
        Self::Read {
            path: path.to_path_buf(),
            source,
        }
    }

    pub(super) fn malformed(path: &Path, line: usize, reason: impl Into<String>) -> Self {
        Self::Malformed {
            path: path.to_path_buf(),
            line,
            reason: reason.into(),
        }
    }
}

/// The fault of a time \[s\] behind the last one.
fn unfit(time: f64, last: Option<f64>) -> String {
    match last {
        Some(last) if time.is_finite() => {
            format!("is not later than {last:?} s, the last one there")
        }
        _ => "is not finite".to_owned(),
    }
}
