//! Tension that a method does not hold: the report of a run that stopped before a body was torn.

use super::particle_at::ParticleAt;
use crate::model::StressScheme;
use crate::plan::scheme_word;
use std::fmt;

/// Share of the energy in motion that no node sees above which a run is stopped. Sound bars have 0.01 when they swing, those
/// that are torn 0.1 to 0.4.
pub(crate) const MOST_UNSEEN: f64 = 0.04;

/// A body in tension that FLIP with MUSL or USF is about to tear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tension {
    /// The particle whose way has grown most.
    pub particle: ParticleAt,
    /// Scheme.
    pub scheme: StressScheme,
    /// Largest principal stress of the particle \[Pa\].
    pub stress: f64,
    /// Growth in this step of the way that no strain sees, over that way.
    pub growth: f64,
    /// Share of the energy in motion that no node sees.
    pub unseen: f64,
    /// Energy from nowhere, over the energy that there was to turn over.
    pub created: f64,
}

impl fmt::Display for Tension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = scheme_word(self.scheme);
        write!(
            f,
            "{} is in tension, {:.4e} Pa, and FLIP with {scheme} does not hold that: particles go a way that no strain sees, \
             which grows by {:.2} % per step, and a smaller step only delays it; {:.1} % of the energy is in such motion, \
             {:.1} % came from nowhere; accepted: the scheme \"USL\" or the transfer \"APIC\"",
            self.particle,
            self.stress,
            100.0 * self.growth,
            100.0 * self.unseen,
            100.0 * self.created
        )
    }
}
