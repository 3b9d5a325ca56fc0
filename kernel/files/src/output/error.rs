//! Errors of writing output, and of taking up the output of an earlier run.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Error of output that could not be written or taken up again. Every variant names the file.
#[derive(Debug)]
#[non_exhaustive]
pub enum OutputError {
    /// The output folder cannot be made, or is not a folder.
    Folder {
        /// The folder asked for.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The output folder is there, but no file can be written into it.
    NotWritable {
        /// The folder asked for.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// Another run writes into the output folder.
    InUse {
        /// The folder asked for.
        path: PathBuf,
    },
    /// The output folder holds frames that the list of no earlier run names.
    Unlisted {
        /// The folder asked for.
        path: PathBuf,
        /// Name of the first of them.
        first: String,
        /// Number of them.
        count: usize,
    },
    /// A file could not be written; the file that was there before is untouched.
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file could not be read.
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// A file of an earlier run is not what this program writes.
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// The fault.
        reason: String,
    },
    /// An array of a frame, or a row of the history, has the wrong number of values.
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
    Name {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
        /// Reason of the refusal.
        reason: &'static str,
    },
    /// A time is not finite, or not later than the one before it.
    Time {
        /// The file.
        path: PathBuf,
        /// The time given \[s\].
        time: f64,
        /// The last time in the file \[s\], if there is one.
        last: Option<f64>,
    },
    /// The history to be continued has other columns than the run writes.
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

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Folder { path, source } => {
                write!(
                    f,
                    "cannot make the output folder {}: {source}",
                    path.display()
                )
            }
            Self::NotWritable { path, source } => {
                write!(
                    f,
                    "cannot write into the output folder {}: {source}",
                    path.display()
                )
            }
            Self::InUse { path } => write!(
                f,
                "the output folder {} is in use: another run writes into it; accepted: a folder of its own for each run",
                path.display()
            ),
            Self::Unlisted { path, first, count } => write!(
                f,
                "the output folder {} holds frames that the list of no earlier run names: found {count}, the first is \
                 {first}; a viewer would show them among those of this run. accepted: another folder, or this one without \
                 them",
                path.display()
            ),
            Self::Write { path, source } => write!(f, "cannot write {}: {source}", path.display()),
            Self::Read { path, source } => write!(f, "cannot read {}: {source}", path.display()),
            Self::Malformed { path, line, reason } => {
                write!(f, "{}:{line}: {reason}", path.display())
            }
            Self::Length {
                path,
                name,
                expected,
                found,
            } => {
                write!(
                    f,
                    "{}: '{name}' has {found} values, expected {expected}",
                    path.display()
                )
            }
            Self::Name { path, name, reason } => {
                write!(
                    f,
                    "{}: the name {name:?} cannot be used: {reason}",
                    path.display()
                )
            }
            Self::Time {
                path,
                time,
                last: Some(last),
            } if time.is_finite() => {
                write!(
                    f,
                    "{}: time {time:?} s is not later than {last:?} s, the last one there",
                    path.display()
                )
            }
            Self::Time { path, time, .. } => {
                write!(f, "{}: time {time:?} s is not finite", path.display())
            }
            Self::Columns {
                path,
                expected,
                found,
            } => write!(
                f,
                "{}: cannot be continued: it has the columns {}, the run writes {}",
                path.display(),
                found.join(","),
                expected.join(",")
            ),
        }
    }
}

impl std::error::Error for OutputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Folder { source, .. }
            | Self::NotWritable { source, .. }
            | Self::Write { source, .. }
            | Self::Read { source, .. } => Some(source),
            _ => None,
        }
    }
}
