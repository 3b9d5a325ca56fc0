//! Errors of a scene at its start.

use crate::values::SceneError;
use proctor_kernel::simulation::SetupError;
use std::fmt;

/// Error of a scene that does not start.
#[derive(Debug)]
pub enum StartError {
    /// The scene is not sound.
    Scene(SceneError),
    /// It cannot be set up.
    Setup(SetupError),
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Setup(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StartError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scene(error) => Some(error),
            Self::Setup(error) => Some(error),
        }
    }
}
