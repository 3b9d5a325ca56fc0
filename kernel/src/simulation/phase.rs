//! Phases of a step, and the timer that reports the end of each to an observer.

use std::fmt;

/// A part of [`Cycle::step`](super::Cycle::step). The kernel reads no clock: an observer
/// ([`Cycle::observe_phases`](super::Cycle::observe_phases)) gets each phase when it has ended and may read its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Phase {
    /// Contact: of boundaries (weights, gaps and forces, motion of vertices), and at the nodes. The last
    /// acts slab by slab amid the equation of motion and the second mapping, and is told apart where there is one slab, as
    /// with one thread; of several slabs at once no clock says when their contact ended, and it is a part of those phases.
    Contact,
    /// Choice of the time step.
    TimeStep,
    /// Sorting of the particles, in steps that sort.
    Sort,
    /// Particles to nodes and the equation of motion, slab by slab in one visit, with what is prescribed at the nodes.
    P2gAndSolve,
    /// The second mapping of momentum (MUSL, USF).
    Remap,
    /// Nodes to particles: velocity, position, strain and stress.
    G2p,
    /// Driven bodies, clock and books.
    Finish,
}

/// Called with each phase when it has ended.
pub(crate) type PhaseObserver = Box<dyn FnMut(Phase) + Send + Sync>;

/// The timer of the phases: reports the end of each to an observer, where there is one.
#[derive(Default)]
pub(crate) struct PhaseTimer {
    observer: Option<PhaseObserver>,
}

impl PhaseTimer {
    /// Reports to an observer, or to none.
    pub(super) fn new(observer: Option<PhaseObserver>) -> Self {
        Self { observer }
    }

    /// Reports that a phase has ended.
    pub(super) fn end(&mut self, phase: Phase) {
        if let Some(observer) = &mut self.observer {
            observer(phase);
        }
    }

    /// The timer within a visit of so many slabs, slab by slab: of several slabs at once no clock tells when a phase ended.
    pub(super) fn of_slabs(
        &mut self,
        slabs: usize,
    ) -> impl Iterator<Item = Option<&mut PhaseTimer>> + Send {
        let mut timer = (slabs == 1).then_some(self);
        std::iter::repeat_with(move || timer.take())
    }
}

impl fmt::Debug for PhaseTimer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let observed = self.observer.is_some();
        f.debug_struct("PhaseTimer")
            .field("observed", &observed)
            .finish()
    }
}

impl Phase {
    /// All phases, in the order of a step.
    pub const ALL: [Self; 7] = [
        Self::Contact,
        Self::TimeStep,
        Self::Sort,
        Self::P2gAndSolve,
        Self::Remap,
        Self::G2p,
        Self::Finish,
    ];

    /// Name for tables and records: lower case, words joined by `_`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Contact => "contact",
            Self::TimeStep => "time_step",
            Self::Sort => "sort",
            Self::P2gAndSolve => "p2g_solve",
            Self::Remap => "remap",
            Self::G2p => "g2p",
            Self::Finish => "finish",
        }
    }
}
