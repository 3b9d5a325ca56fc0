//! The phases of a step, as seen by whoever watches it.

/// A part of [`Simulation::step`](super::Simulation::step). The kernel reads no clock: a watcher of
/// [`Simulation::step_watched`](super::Simulation::step_watched) is told when a phase has ended and may read its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// Vertices of boundaries: weights, gaps and forces of mortar contact, motion; only in scenes with boundaries.
    Contact,
    /// Choice of the time step.
    TimeStep,
    /// Sorting of the particles, in steps that sort.
    Sort,
    /// Particles to nodes and the equation of motion, slab by slab in one visit, with what is prescribed at the nodes.
    NodesFromParticles,
    /// The second mapping of momentum (MUSL, USF).
    Remap,
    /// Nodes to particles: velocity, position, strain and stress.
    ParticlesFromNodes,
    /// Driven bodies, clock and books.
    Finish,
}

impl Phase {
    /// All phases, in the order of a step.
    pub const ALL: [Self; 7] = [
        Self::Contact,
        Self::TimeStep,
        Self::Sort,
        Self::NodesFromParticles,
        Self::Remap,
        Self::ParticlesFromNodes,
        Self::Finish,
    ];

    /// Name for tables and records: lower case, words joined by `_`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::TimeStep => "time_step",
            Self::Sort => "sort",
            Self::NodesFromParticles => "p2g_solve",
            Self::Remap => "remap",
            Self::ParticlesFromNodes => "g2p",
            Self::Finish => "finish",
        }
    }
}
