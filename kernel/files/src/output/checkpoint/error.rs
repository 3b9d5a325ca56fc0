//! Errors of a checkpoint that cannot be used.

use std::fmt;
use std::io;
use std::path::PathBuf;

use super::super::OutputError;
use super::VERSION;

/// Error of a checkpoint that could not be written, read or used.
#[derive(Debug)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be written; the checkpoint that was there before is untouched.
    Write(OutputError),
    /// The file could not be read.
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file does not start as a checkpoint does.
    NotACheckpoint {
        /// The file.
        path: PathBuf,
    },
    /// The checkpoint was written in another version of the format.
    OtherVersion {
        /// The file.
        path: PathBuf,
        /// Version of the file; this program reads [`VERSION`].
        found: u32,
    },
    /// The file ends too early.
    Truncated {
        /// The file.
        path: PathBuf,
        /// Bytes that it should have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// The file has more bytes than were written.
    TooLong {
        /// The file.
        path: PathBuf,
        /// Bytes that it should have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// The bytes are not those that were written.
    Checksum {
        /// The file.
        path: PathBuf,
        /// Checksum that was written.
        expected: u32,
        /// Checksum of the bytes found.
        found: u32,
    },
    /// The bytes are as written, but make no sense: the writer was wrong.
    Malformed {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// The checkpoint belongs to another scene.
    OtherScene {
        /// Fingerprint of the scene that is run.
        expected: u64,
        /// Fingerprint in the checkpoint.
        found: u64,
    },
    /// There is no section of this name.
    MissingSection {
        /// The section.
        name: String,
    },
    /// A section holds numbers of another type.
    WrongType {
        /// The section.
        name: String,
        /// Type asked for.
        expected: &'static str,
        /// Type that the section has.
        found: &'static str,
    },
    /// A section holds more or fewer numbers than it should.
    WrongLength {
        /// The section.
        name: String,
        /// Count asked for.
        expected: usize,
        /// Count that the section has.
        found: usize,
    },
    /// Two sections have the same name.
    RepeatedSection {
        /// The section.
        name: String,
    },
}

impl fmt::Display for CheckpointError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Write(error) => error.fmt(f),
            Self::Read { path, source } => {
                write!(f, "cannot read the checkpoint {}: {source}", path.display())
            }
            Self::NotACheckpoint { path } => write!(f, "{} is not a checkpoint", path.display()),
            Self::OtherVersion { path, found } => write!(
                f,
                "{} is a checkpoint of format version {found}; this program reads version {VERSION}",
                path.display()
            ),
            Self::Truncated {
                path,
                expected,
                found,
            } => {
                write!(
                    f,
                    "the checkpoint {} is cut off: {found} of {expected} bytes",
                    path.display()
                )
            }
            Self::TooLong {
                path,
                expected,
                found,
            } => {
                write!(
                    f,
                    "the checkpoint {} is damaged: {found} bytes instead of {expected}",
                    path.display()
                )
            }
            Self::Checksum {
                path,
                expected,
                found,
            } => write!(
                f,
                "the checkpoint {} is damaged: checksum {found:08x} instead of {expected:08x}",
                path.display()
            ),
            Self::Malformed { path, reason } => {
                write!(
                    f,
                    "the checkpoint {} cannot be understood: {reason}",
                    path.display()
                )
            }
            Self::OtherScene { expected, found } => {
                write!(
                    f,
                    "checkpoint of another scene: fingerprint {found:016x}, this scene has {expected:016x}. A restart may change `time`, \
                     `until`, outputs, probes and threads; a scene with other changes begins from a checkpoint by `initial_state`"
                )
            }
            Self::MissingSection { name } => write!(f, "the checkpoint has no section '{name}'"),
            Self::WrongType {
                name,
                expected,
                found,
            } => {
                write!(
                    f,
                    "section '{name}' of the checkpoint holds {found}, expected {expected}"
                )
            }
            Self::WrongLength {
                name,
                expected,
                found,
            } => {
                write!(
                    f,
                    "section '{name}' of the checkpoint has {found} values, expected {expected}"
                )
            }
            Self::RepeatedSection { name } => write!(f, "the checkpoint has two sections '{name}'"),
        }
    }
}

impl std::error::Error for CheckpointError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            // The message is that of the inner error, so its source is the next in the chain.
            Self::Write(error) => error.source(),
            Self::Read { source, .. } => Some(source),
            _ => None,
        }
    }
}
