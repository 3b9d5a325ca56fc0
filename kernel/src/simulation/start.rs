//! From a scene to a simulation.

use super::{Options, Simulation, conditions, interactions};
use crate::plan::{Plan, PlanOptions};
use crate::scene::{Scene, SceneError};
use crate::simulation::values::SetupError;
use std::fmt;

impl Scene {
    /// Checks the scene and sets it in motion.
    ///
    /// # Errors
    /// What is wrong with the scene, every problem with the path of its value, or why it cannot be set up.
    pub fn simulate(&self, options: &Options) -> Result<Simulation, StartError> {
        self.check().map_err(StartError::Scene)?;
        Simulation::new(self, options).map_err(StartError::Setup)
    }
}

/// What a scene needs, and nothing else.
#[must_use]
pub fn plan(scene: &Scene, demands: PlanOptions) -> Plan {
    Plan::of(
        scene,
        demands,
        &[conditions::describe, interactions::describe],
    )
}

/// Why a scene does not start.
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
