//! The start of a simulation: from a model and its particles to time zero.

use super::Cycle;
use super::clock::length;
use super::interactions::Interactions;
use super::tension::TensionWatch;
use crate::fields::Grid;
use crate::grid::GridShape;
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::ranks::Ranks;
use crate::simulation::model::Model;
use crate::simulation::values::{MOST_VOLUME_RATIO, SetupError, SharingRefusal, State};
use crate::simulation::work_state::WorkState;
use crate::stage::g2p::ParticleMaxima;
use crate::team::Team;
use std::sync::Arc;

/// The start of a simulation: particles, interactions and threads.
pub struct Start {
    /// Particle sets, one per body of the model.
    pub sets: Vec<ParticleSet>,
    /// Maxima over the particles of each body, on which the first time step depends.
    pub maxima: Vec<ParticleMaxima>,
    /// Interactions, in the order in which they act; those of the user come last.
    pub interactions: Interactions,
    /// The threads.
    pub team: Arc<Team>,
    /// Fewest particles that are worth a second thread in a step, where there are several; else 2048. No bit depends on it.
    pub least_share: Option<usize>,
    /// True where no volume has changed yet.
    pub is_undeformed: bool,
    /// Ranks that share the simulation from the start. The particle sets then are the part of this one: those of all ranks, one after
    /// the other, are the whole in order of the position.
    pub ranks: Option<Arc<dyn Ranks>>,
}

impl Cycle {
    /// A simulation at time zero: particles sorted, fields given, the first time step chosen.
    ///
    /// # Errors
    /// Input that shows its fault only here: see [`SetupError`].
    pub fn new(model: Model, start: Start) -> Result<Self, SetupError> {
        let shape = GridShape::new(&model.settings.mesh, model.settings.dimension);
        let mut work = WorkState::new(
            Grid::new(shape, start.team, start.least_share),
            start.interactions,
            model.bodies.len(),
        );
        work.grid.has_water = model.bodies.iter().any(|body| body.water.is_some());
        let accelerations = start.sets.iter().map(largest_acceleration);
        work.load_acceleration = accelerations.fold(0.0, f64::max);
        let mut simulation = Self {
            state: State::new(start.sets, start.maxima),
            work,
            model,
        };
        for set in &mut simulation.state.sets {
            set.sort_by_position(&simulation.work.grid.team);
        }
        if let Some(ranks) = start.ranks {
            simulation.begin_shared(ranks).map_err(SetupError::Ranks)?;
        }
        let sets = simulation.state.sets.iter();
        let identifiers: Vec<[u64; 2]> = sets.map(|set| simulation.identifiers(&set.id)).collect();
        simulation.work.tension = TensionWatch::new(&simulation.model.settings, &identifiers);
        simulation.sort_if_stale();
        let started = simulation.start_interactions();
        let failed = simulation
            .ranks()
            .and_then(|ranks| ranks.first_with(started.is_err()));
        started?;
        if let Some(rank) = failed {
            return Err(SetupError::Ranks(SharingRefusal::OtherRank { rank }));
        }
        simulation.open_ledger();
        if start.is_undeformed {
            simulation.state.invariants.volume_left = libm::log(MOST_VOLUME_RATIO);
        }
        simulation.propose().map_err(SetupError::UnstableTimeStep)?;
        simulation.start_absorbing();
        let imbalance = simulation.initial_imbalance();
        simulation.model.plan.warnings.extend(imbalance);
        Ok(simulation)
    }

    fn start_interactions(&self) -> Result<(), SetupError> {
        let view = self.view();
        let mut interactions = self.interactions();
        interactions.try_for_each(|one| one.start(&view))
    }
}

/// Largest acceleration of a particle of a set by its own force \[m/s²\].
fn largest_acceleration(set: &ParticleSet) -> f64 {
    let Some(first) = set.layout.force else {
        return 0.0;
    };
    let mass = set.columns[Layout::MASS].iter().enumerate();
    mass.map(|(p, m)| length(&set.vector(first, p)) / m)
        .fold(0.0, f64::max)
}
