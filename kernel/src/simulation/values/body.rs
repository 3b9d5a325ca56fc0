//! A body in the cycle, beside its particles.

use crate::laws::AnyLaw;
use crate::model::{DomainUpdate, History, PoreWater, Shape, Vector};
use crate::stage::Mapping;

/// A body in the cycle, beside its particles.
#[derive(Clone, Debug)]
pub struct BodyRun {
    /// Name, for messages.
    pub name: String,
    /// Identifier.
    pub id: i64,
    /// Shape that was filled with its particles \[m\].
    pub shape: Shape,
    /// Identifier of its material.
    pub material_id: i64,
    /// Its law.
    pub law: AnyLaw,
    /// Initial density, of the grains alone where there is pore water \[kg/m³\].
    pub density: f64,
    /// Its weighting functions.
    pub mapping: Mapping,
    /// Update of its particle domains, where they follow the deformation.
    pub domain_update: Option<DomainUpdate>,
    /// Its prescribed velocity, where it has one.
    pub motion: Option<History>,
    /// True if its motion has been prescribed since the start, so that its shape has only moved.
    pub keeps_shape: bool,
    /// Rate of viscous damping \[1/s\].
    pub viscous_rate: f64,
    /// Half-lengths of its particles at the start \[m\], the mean where they differ.
    pub particle_half_length: Vector,
    /// Half-lengths of the particle domains \[m\] where all have the same; `None` where they differ or the weighting
    /// function has no domain.
    pub reach: Option<[f64; 3]>,
    /// Share of the largest stable step of the method that it bears.
    pub step_share: f64,
    /// Water in its pores.
    pub water: Option<PoreWater>,
}

impl BodyRun {
    /// Largest squared speed of its prescribed motion \[m²/s²\], 0 without one.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        self.motion.as_ref().map_or(0.0, |motion| {
            motion
                .values
                .iter()
                .map(|v| v.iter().map(|c| c * c).sum())
                .fold(0.0, f64::max)
        })
    }
}
