//! A particle where it is stored.

use super::{Particle, UNDEFORMED};
use crate::layout::Layout;
use crate::particles::ParticleSet;

/// View of a stored particle, for evaluating its law.
#[derive(Clone, Copy, Debug)]
pub struct StoredParticle<'a> {
    /// The set.
    pub set: &'a ParticleSet,
    /// Initial density of its material \[kg/m³\].
    pub density: f64,
    /// Its place in the set.
    pub p: usize,
}

impl StoredParticle<'_> {
    /// Asks of the particle: what is not asked for need not be read where the question is known to the compiler.
    #[inline(always)]
    pub fn ask<T>(&self, question: impl FnOnce(&Particle<'_>) -> T) -> T {
        let &Self { set, density, p } = self;
        let kept;
        let mut variables: &[f64] = &[];
        if !set.layout.law.is_empty() {
            kept = set.variables(p);
            variables = &kept;
        }
        question(&Particle {
            mass: set.columns[Layout::MASS][p],
            volume: set.columns[Layout::VOLUME][p],
            density,
            stress: set.stress(p),
            deformation: set.deformation(p).unwrap_or(UNDEFORMED),
            variables,
        })
    }
}
