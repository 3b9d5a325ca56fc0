//! Errors of a run that cannot start or go on.

use crate::output::{CheckpointError, OutputError};
use proctor_scene::simulation::{SetupError, StepError};
use std::fmt;

/// A run cannot start or go on.
#[derive(Debug)]
pub enum RunError {
    /// The scene shows its fault at set-up. Bad input.
    Setup(SetupError),
    /// The checkpoint cannot be used. Bad input.
    Checkpoint(CheckpointError),
    /// A file cannot be written or continued.
    Output(OutputError),
    /// A step failed.
    Step(StepError),
}

impl RunError {
    /// True if the input is at fault (exit code 2) and not the run (exit code 1).
    #[must_use]
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Step(_))
    }
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Setup(e) => e.fmt(f),
            Self::Checkpoint(e) => e.fmt(f),
            Self::Output(e) => e.fmt(f),
            Self::Step(e) => e.fmt(f),
        }
    }
}

impl std::error::Error for RunError {}

macro_rules! from {
    ($variant:ident, $error:ty) => {
        impl From<$error> for RunError {
            fn from(error: $error) -> Self {
                Self::$variant(error)
            }
        }
    };
}
from!(Setup, SetupError);
from!(Checkpoint, CheckpointError);
from!(Output, OutputError);
from!(Step, StepError);
