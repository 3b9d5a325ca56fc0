//! The phases of a step, as seen by whoever watches it.

/// A part of [`Simulation::step`](super::Simulation::step). The kernel reads no clock: a watcher of
/// [`Simulation::step_watched`](super::Simulation::step_watched) is told when a phase has ended and may read its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// Contact: of boundaries (weights, gaps and forces, motion of vertices), of rigid surfaces, and on the grid. The last
    /// acts slab by slab amid the equation of motion and the second mapping, and is told apart where there is one slab, as
    /// with one thread; of several slabs at once no clock says when their contact ended, and it is a part of those phases.
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

/// Who is told of each phase when it has ended.
pub(super) type Watcher<'a> = &'a mut (dyn FnMut(Phase) + Send);

/// Who is told of the phases within a visit of slabs: somebody where the visit is of one slab.
pub(super) type SlabWatcher<'a> = Option<Watcher<'a>>;

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
