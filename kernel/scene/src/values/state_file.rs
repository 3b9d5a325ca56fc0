//! The file with the state of another run, from which a scene begins.

use std::path::PathBuf;

/// The file with the state of another run, from which the bodies of a scene begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateFile {
    /// A checkpoint, or the folder of a run that has one.
    pub file: PathBuf,
    /// True if bodies keep their velocities; they begin at rest otherwise.
    pub keeps_velocity: bool,
}
