//! Errors of a run that cannot start or go on.

use crate::output::{CheckpointError, OutputError};
use proctor_scene::Problem;
use proctor_scene::simulation::{SetupError, SharingRefusal, StepError};
use thiserror::Error;

/// A run cannot start or go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene shows its fault at set-up. Bad input.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The checkpoint cannot be used. Bad input.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A restart changes what needs a stage of its own. Bad input.
    #[error("{0}")]
    Refused(Box<Problem>),
    /// A file cannot be written or continued.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// Ranks cannot share the scene. Bad input.
    #[error(transparent)]
    SharingRefusal(#[from] SharingRefusal),
    /// Another rank cannot start or go on; it has the error.
    #[error("rank {rank} cannot go on")]
    OtherRank {
        /// Its number, from 0.
        rank: usize,
        /// True if its input is at fault.
        bad_input: bool,
    },
}

impl RunError {
    /// True if the input is at fault (exit code 2) and not the run (exit code 1).
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Step(_) => false,
            Self::OtherRank { bad_input, .. } => *bad_input,
            _ => true,
        }
    }
}
