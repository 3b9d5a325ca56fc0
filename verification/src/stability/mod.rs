//! Stability of each method: the largest time step, predicted and measured.
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

use proctor_scene::SceneError;
use proctor_scene::simulation::{RestoreError, SetupError, StartError, StepError};
use thiserror::Error;

/// Error of a limit that was not found.
#[derive(Debug, Error)]
pub enum StabilityError {
    /// The scene is not sound.
    #[error(transparent)]
    Scene(SceneError),
    /// It cannot be set up.
    #[error(transparent)]
    Setup(SetupError),
    /// A step failed where none may: particles do not move.
    #[error("a step with frozen particles failed: {0}")]
    Step(#[from] StepError),
    /// A state was not taken up again.
    #[error(transparent)]
    Restore(#[from] RestoreError),
    /// An iteration did not come to an end.
    #[error("{what} did not converge: {residual:e} of it is left")]
    NoConvergence {
        /// Quantity that was sought.
        what: &'static str,
        /// Residual, relative.
        residual: f64,
    },
}

impl From<StartError> for StabilityError {
    fn from(error: StartError) -> Self {
        match error {
            StartError::Scene(error) => Self::Scene(error),
            StartError::Setup(error) => Self::Setup(error),
        }
    }
}
