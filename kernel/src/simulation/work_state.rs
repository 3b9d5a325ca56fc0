//! The work state: memory of a step that holds nothing between two of them.

use super::interactions::Interactions;
use super::monitor::invariants::Momentum;
use super::phase::PhaseTimer;
use super::ranks::Share;
use super::tension::TensionWatch;
use crate::fields::Grid;
use crate::simulation::context::NodalConditions;
use crate::simulation::values::{NodalForce, StepError};
use crate::stage::g2p::ParticleMaxima;
use crate::stage::solve::{EmptyNode, ExactStepSums, StepSums};

/// The work state of a step: the grid, the interactions between its fields, and lists that keep their memory.
pub(crate) struct WorkState {
    pub(crate) grid: Grid,
    /// True for each body that has a velocity field of its own, as of the last sort.
    pub(crate) own_field: Vec<bool>,
    /// Interactions between velocity fields; those of the user come last. Their arrays are saved with the state.
    pub(crate) interactions: Interactions,
    /// Reports the end of each phase, where somebody observes them.
    pub(crate) phase_timer: PhaseTimer,
    /// Sums over the nodes of the last step.
    pub(crate) sums: StepSums,
    /// Largest acceleration of a particle by box loads \[m/s²\].
    pub(crate) load_acceleration: f64,
    /// Error of a step that left particles where no step can go on.
    pub(crate) failed: Option<StepError>,
    /// Conditions that acted in the last step: the lists are filled again in the next.
    pub(crate) nodal: NodalConditions,
    /// Result of the last visit of each slab.
    pub(crate) solved: Vec<SlabSolution>,
    /// Result of the last pass over each share of the particles.
    pub(crate) gathered: Vec<G2pShare>,
    /// Body forces on the particles of one body per mass, while they are found \[m/s²\].
    pub(crate) forces: Vec<[f64; 3]>,
    /// Momentum in the middle of a step, where it is looked at.
    pub(crate) momentum: Option<Momentum>,
    /// The growth of particles in tension, where the method may lose it.
    pub(crate) tension: Option<TensionWatch>,
    /// The part of this process, where ranks share the simulation.
    pub(crate) share: Option<Share>,
    /// The part of this process in the next step, where ranks share each step.
    pub(crate) between_steps: Option<Share>,
    /// Forces of contact at the nodes of all ranks, while the first rank has the whole simulation.
    pub(crate) forces_of_ranks: Option<Vec<NodalForce>>,
}

impl WorkState {
    /// An empty grid.
    pub(super) fn new(grid: Grid, interactions: Interactions, bodies: usize) -> Self {
        Self {
            grid,
            own_field: vec![false; bodies],
            interactions,
            phase_timer: PhaseTimer::default(),
            sums: StepSums::default(),
            load_acceleration: 0.0,
            failed: None,
            nodal: NodalConditions::default(),
            solved: vec![],
            gathered: vec![],
            forces: vec![],
            momentum: None,
            tension: None,
            share: None,
            between_steps: None,
            forces_of_ranks: None,
        }
    }
}

/// Result of the solve on one slab.
#[derive(Debug, Default)]
pub(crate) struct SlabSolution {
    pub(super) sums: ExactStepSums,
    /// Groups in the layers of particles that the slab owns.
    pub(super) groups: usize,
    /// A node without mass that a load acts on.
    pub(super) empty: Option<EmptyNode>,
}

/// Result of a G2P pass over a share of the particles of a body.
#[derive(Debug, Default)]
pub(crate) struct G2pShare {
    /// Index of the body.
    pub(super) body: usize,
    pub(super) found: ParticleMaxima,
    /// Excess of tr L over its mean over cells, where it is that mean.
    pub(super) excess: Vec<f64>,
}
