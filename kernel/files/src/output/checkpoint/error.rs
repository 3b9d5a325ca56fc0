//! Errors of a checkpoint that cannot be used.

use std::io;
use std::path::PathBuf;

use super::super::OutputError;
use super::VERSION;
use thiserror::Error;

/// Error of a checkpoint that could not be written, read or used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be written; the checkpoint that was there before is untouched.
    #[error(transparent)]
    Write(OutputError),
    /// The file could not be read.
    #[error("cannot read the checkpoint {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file does not start as a checkpoint does.
    #[error("{} is not a checkpoint", path.display())]
    NotACheckpoint {
        /// The file.
        path: PathBuf,
    },
    /// The checkpoint was written in another version of the format.
    #[error("{} is a checkpoint of format version {found}; this program reads version {VERSION}", path.display())]
    OtherVersion {
        /// The file.
        path: PathBuf,
        /// Version of the file; this program reads [`VERSION`].
        found: u32,
    },
    /// The file ends too early.
    #[error("the checkpoint {} is cut off: {found} of {expected} bytes", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Bytes that it should have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// The file has more bytes than were written.
    #[error("the checkpoint {} is damaged: {found} bytes instead of {expected}", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
        /// Bytes that it should have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// The bytes are not those that were written.
    #[error("the checkpoint {} is damaged: checksum {found:08x} instead of {expected:08x}", path.display())]
    Checksum {
        /// The file.
        path: PathBuf,
        /// Checksum that was written.
        expected: u32,
        /// Checksum of the bytes found.
        found: u32,
    },
    /// The bytes are as written, but make no sense: the writer was wrong.
    #[error("the checkpoint {} cannot be understood: {reason}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// The checkpoint belongs to another scene.
    #[error(
        "checkpoint of another scene: fingerprint {found:016x}, this scene has {expected:016x}. A restart may change `time`, \
         `until`, `gravity`, local damping, planes, `box_load`, outputs, probes and threads; a scene with other changes is a stage of its own, which \
         begins from a checkpoint by `initial_state`"
    )]
    OtherScene {
        /// Fingerprint of the scene that is run.
        expected: u64,
        /// Fingerprint in the checkpoint.
        found: u64,
    },
    /// There is no section of this name.
    #[error("the checkpoint has no section '{name}'")]
    MissingSection {
        /// The section.
        name: String,
    },
    /// A section holds numbers of another type.
    #[error("section '{name}' of the checkpoint holds {found}, expected {expected}")]
    WrongType {
        /// The section.
        name: String,
        /// Type asked for.
        expected: &'static str,
        /// Type that the section has.
        found: &'static str,
    },
    /// A section holds more or fewer numbers than it should.
    #[error("section '{name}' of the checkpoint has {found} values, expected {expected}")]
    WrongLength {
        /// The section.
        name: String,
        /// Count asked for.
        expected: usize,
        /// Count that the section has.
        found: usize,
    },
    /// Two sections have the same name.
    #[error("the checkpoint has two sections '{name}'")]
    RepeatedSection {
        /// The section.
        name: String,
    },
}
