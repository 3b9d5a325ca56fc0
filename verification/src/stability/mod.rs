//! Where each method is stable: the largest time step, predicted and measured.
//!
//! *Predicted*: the step of the kernel itself, taken as a linear map. A body at rest is given velocities and stresses so
//! small that no position changes by a bit; then one step of the kernel is linear in them to the last digit, and the
//! largest stable step follows from an eigenvalue of that map ([`predicted`]). No formula of the kernel stands here twice.
//!
//! *Measured*: runs of the same body with noise, at steps that close in on the limit from both sides ([`measured`]). The
//! two share the scene and nothing else.
//!
//! A Courant number is c dt / min(h), c the speed of the fastest wave at rest.

pub mod arnoldi;
pub mod block;
pub mod extreme;
pub mod frozen;
pub mod map;
pub mod measured;
pub mod nonlinear;
pub mod predicted;
pub mod round;
pub mod scene;
pub mod table;
pub mod tension;

use std::fmt;

use proctor_scene::SceneError;
use proctor_scene::simulation::{RestoreError, SetupError, StartError, StepError};

/// Why a limit cannot be had.
#[derive(Debug)]
pub enum StabilityError {
    /// The scene is not sound.
    Scene(SceneError),
    /// It cannot be set up.
    Setup(SetupError),
    /// A step failed where none may: particles do not move.
    Step(StepError),
    /// A state was not taken up again.
    Restore(RestoreError),
    /// An iteration did not come to an end.
    NoConvergence {
        /// What was sought.
        what: &'static str,
        /// What was left of it, relative.
        residual: f64,
    },
}

impl fmt::Display for StabilityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Setup(error) => error.fmt(f),
            Self::Step(error) => write!(f, "a step with frozen particles failed: {error}"),
            Self::Restore(error) => error.fmt(f),
            Self::NoConvergence { what, residual } => {
                write!(f, "{what} did not converge: {residual:e} of it is left")
            }
        }
    }
}

impl std::error::Error for StabilityError {}

impl From<StartError> for StabilityError {
    fn from(error: StartError) -> Self {
        match error {
            StartError::Scene(error) => Self::Scene(error),
            StartError::Setup(error) => Self::Setup(error),
        }
    }
}

impl From<StepError> for StabilityError {
    fn from(error: StepError) -> Self {
        Self::Step(error)
    }
}

impl From<RestoreError> for StabilityError {
    fn from(error: RestoreError) -> Self {
        Self::Restore(error)
    }
}
