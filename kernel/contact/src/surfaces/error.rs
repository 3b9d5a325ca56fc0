//! Errors of contact with rigid surfaces in a step.

use proctor_kernel::simulation::{InteractionFault, ParticleAt};
use std::fmt;

/// An error of contact with rigid surfaces, by which a step cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceContactError {
    /// A particle's centre lies behind a rigid surface.
    ThroughSurface {
        /// The particle.
        particle: ParticleAt,
        /// Name of the surface.
        surface: String,
        /// Distance behind it \[m\].
        depth: f64,
    },
    /// A particle would come closer to a rigid surface in one step than its distance threshold, and reach it.
    TooFastForSurface {
        /// The particle.
        particle: ParticleAt,
        /// Name of the surface.
        surface: String,
        /// Approach within the step \[m\].
        approach: f64,
        /// Distance threshold of the surface \[m\].
        threshold: f64,
    },
}

impl InteractionFault for SurfaceContactError {}

impl std::error::Error for SurfaceContactError {}

impl fmt::Display for SurfaceContactError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ThroughSurface {
                particle,
                surface,
                depth,
            } => write!(f, "{particle} is {depth} m behind the surface {surface:?}"),
            Self::TooFastForSurface {
                particle,
                surface,
                approach,
                threshold,
            } => write!(
                f,
                "{particle} approaches the surface {surface:?} by {approach} m in one step, more than the distance \
                 threshold {threshold} m; accepted: a smaller time step or a larger distance_threshold"
            ),
        }
    }
}
