//! Errors of a record that cannot be read.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// A record that cannot be read: which file, where in it, and why.
#[derive(Debug)]
pub struct RecordError {
    /// The file.
    pub path: PathBuf,
    /// Line from 1, where the fault has one.
    pub line: Option<usize>,
    /// Fault that was found.
    pub reason: Reason,
}

/// Fault of a record.
#[derive(Debug)]
pub enum Reason {
    /// The file cannot be read.
    Unreadable(io::Error),
    /// There is nothing in it.
    Empty,
    /// It ends in the middle.
    Truncated,
    /// It is not JSON.
    NotJson(String),
    /// It is JSON of another shape: where, what was found, and what is accepted.
    Shape(String),
    /// It has the shape of another version.
    Version(String),
    /// There is not a single row in it.
    NoBenchmarks,
}

impl RecordError {
    /// An error about a file as a whole.
    pub(crate) fn new(path: &std::path::Path, reason: Reason) -> Self {
        Self {
            path: path.to_owned(),
            line: None,
            reason,
        }
    }
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        match &self.reason {
            Reason::Unreadable(error) => write!(f, ": cannot be read: {error}"),
            Reason::Empty => write!(f, ": the file is empty; a record was expected"),
            Reason::Truncated => write!(f, ": truncated: the record ends in the middle"),
            Reason::NotJson(what) => write!(f, ": not JSON: {what}"),
            Reason::Shape(what) => write!(f, ": {what}"),
            Reason::Version(found) => write!(
                f,
                ": found schema version {found}; this program reads version {}",
                super::context::SCHEMA_VERSION
            ),
            Reason::NoBenchmarks => write!(f, ": the record holds no benchmarks"),
        }
    }
}

impl std::error::Error for RecordError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.reason {
            Reason::Unreadable(error) => Some(error),
            _ => None,
        }
    }
}
