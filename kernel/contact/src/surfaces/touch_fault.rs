//! A fault of a particle at an obstacle, by which a step cannot go on.

use super::error::SurfaceContactError;
use super::obstacle::RigidObstacle;
use crate::pairs::Tunnelling;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{InteractionError, ParticleAt, StepView};

/// A particle that is behind an obstacle, or would go through it in this step.
pub(super) struct TouchFault {
    pub(super) particle: ParticleAt,
    /// The point of the obstacle that is nearest \[m\].
    pub(super) point: Vector,
    /// Approach in the step \[m\]; `None` for one that is behind it.
    pub(super) approach: Option<f64>,
    /// Distance behind the obstacle, or that at which the particle would touch \[m\].
    pub(super) distance: f64,
}

impl TouchFault {
    /// The error of the step.
    pub(super) fn error(self, rigid: &RigidObstacle, view: &StepView<'_>) -> InteractionError {
        let Self {
            particle,
            point,
            approach,
            distance,
        } = self;
        match (rigid, approach) {
            (RigidObstacle::Surface(surface), None) => SurfaceContactError::ThroughSurface {
                particle,
                surface: surface.given.name.clone(),
                depth: distance,
            }
            .into(),
            (RigidObstacle::Surface(surface), Some(approach)) => {
                SurfaceContactError::TooFastForSurface {
                    particle,
                    surface: surface.given.name.clone(),
                    approach,
                    threshold: distance,
                }
                .into()
            }
            (RigidObstacle::Driven(driven), approach) => Tunnelling {
                bodies: [driven.pair.master, driven.pair.slave].map(|b| view.bodies[b].id),
                position: Some(point),
                approach: approach.unwrap_or(0.0),
                distance,
            }
            .into(),
        }
    }
}
