//! The state: all that a step leaves behind and the next one needs.
//!
//! It is one plain value. A checkpoint writes it, a rehearsal and a restart take it up again, a change between stages goes
//! on with it, all by `Cycle::save` and `Cycle::restore`. What can be had from the scene is not in it: neither
//! the grid, which is scratch between steps, nor laws, loads and surfaces. How it is written is not known here.

use super::absorbing::AbsorbingNode;
use super::clock::Clock;
use super::event::Event;
use super::extremes::Extremes;
use super::free_ground::FreeGroundNode;
use super::invariants::InvariantMonitor;
use super::spin::Spin;
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::stage::g2p::ParticleMaxima;
use std::fmt;

/// The state of a simulation after a step, but for the saved arrays of interactions: see [`SavedState`].
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Particle sets, one per body, in the order of the scene. The order of particles in a set decides in which order sums
    /// are formed.
    pub sets: Vec<ParticleSet>,
    /// Maxima over each set in the last step: the next time step is chosen by it.
    pub found: Vec<ParticleMaxima>,
    /// Step counter, time, and the time steps so far.
    pub clock: Clock,
    /// Nodes per axis of the stencil, 3 or 4.
    pub stencil: usize,
    /// Largest travel of a particle since the last sort, in cells.
    pub travel: f64,
    /// Groups of particles that share a base node: their number decides when to sort.
    pub groups: Groups,
    /// Displacement of the mesh since the start \[m\].
    pub mesh_shift: Vector,
    /// Kinetic energies one and two half-steps ago, with kinetic damping \[J\].
    pub kinetic: [f64; 2],
    /// The energy balance.
    pub ledger: EnergyLedger,
    /// Events so far.
    pub events: Vec<Event>,
    /// Extremes of the balances so far.
    pub invariants: InvariantMonitor,
    /// Largest deformations so far.
    pub extremes: Extremes,
    /// Angular momentum at the start, where nothing outside can turn the bodies.
    pub start_spin: Option<Spin>,
    /// Nodes of absorbing planes, increasing.
    pub absorbing: Vec<AbsorbingNode>,
    /// Nodes of free ground beside absorbing sides, column by column.
    pub free_ground: Vec<FreeGroundNode>,
}

/// Running sums of the energy balance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Work of nodal loads and of what has a prescribed velocity so far, less that of dead loads on it \[J\].
    pub external_work: f64,
    /// Sum of force times position over particles with dead loads at the start, less those removed \[J\].
    pub dead_load_origin: f64,
    /// Kinetic and strain energy at the start, and from the first step on that which interactions store \[J\].
    pub initial_energy: f64,
    /// Energy taken by damping so far \[J\].
    pub damping: f64,
    /// Energy taken by friction of contact so far \[J\].
    pub friction: f64,
    /// Energy that contact took along its normal so far \[J\].
    pub impact: f64,
    /// Energy that left with removed particles so far \[J\].
    pub removed: f64,
    /// Energy that left through absorbing planes so far \[J\].
    pub absorbed: f64,
    /// Energy that the drag between pore water and skeleton took so far \[J\].
    pub drag: f64,
}

/// Saved arrays: lists of numbers with their names.
pub type SavedArrays = Vec<(String, Vec<f64>)>;

/// The whole state of a simulation: see [`Cycle::save`](crate::simulation::Cycle::save).
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState {
    /// The state.
    pub state: State,
    /// Saved arrays of each interaction, in the order in which they act.
    pub interactions: Vec<SavedArrays>,
}

/// A saved state that is not one of the scene of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub enum RestoreError {
    /// A list is longer or shorter than the scene makes it.
    Length {
        /// Its name or place.
        what: String,
        /// Values that the simulation has there.
        expected: usize,
        /// Values that were saved.
        found: usize,
    },
    /// Particles of a body lie outside the mesh, or its layers are not those of so many particles.
    Places {
        /// Place of the body in the scene.
        body: usize,
        /// Particles that were saved.
        particles: usize,
        /// Particles that its layers hold.
        in_layers: usize,
    },
}

impl fmt::Display for RestoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length {
                what,
                expected,
                found,
            } => write!(f, "the saved state has {found} {what}, expected {expected}"),
            Self::Places {
                body,
                particles,
                in_layers,
            } => write!(
                f,
                "body {body} of the saved state has {particles} particles, {in_layers} of them in its layers, not all in the mesh"
            ),
        }
    }
}

impl std::error::Error for RestoreError {}

impl State {
    /// The state at time zero of sets that were just filled; what each body was found to be.
    pub(in crate::simulation) fn new(sets: Vec<ParticleSet>, found: Vec<ParticleMaxima>) -> Self {
        let mut state = Self {
            sets,
            found,
            clock: Clock::default(),
            stencil: 0,
            // Nothing is sorted yet.
            travel: f64::INFINITY,
            groups: Groups::default(),
            mesh_shift: [0.0; 3],
            kinetic: [0.0; 2],
            ledger: EnergyLedger::default(),
            events: vec![],
            invariants: InvariantMonitor::default(),
            extremes: Extremes::default(),
            start_spin: None,
            absorbing: vec![],
            free_ground: vec![],
        };
        state.set_stencil();
        state
    }

    /// Sets the stencil of the start: the nodes along an axis that the widest particle reaches.
    pub(in crate::simulation) fn set_stencil(&mut self) {
        let widest = self.found.iter().map(|f| f.half_length).fold(0.0, f64::max);
        self.stencil = if widest > 0.5 { 4 } else { 3 };
    }
}

/// Counts of the groups of particles with the same base node that the mapping meets. The number depends on the scene alone, not
/// on threads or lanes, and so do the sorts that follow from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Groups {
    /// Groups in the first mapping after the last sort; 0 before it.
    pub sorted: usize,
    /// Groups beyond that number, summed over the mappings since the last sort.
    pub superfluous: usize,
}

impl Groups {
    pub(in crate::simulation) fn count(&mut self, groups: usize) {
        if self.sorted == 0 {
            self.sorted = groups;
        }
        self.superfluous += groups.saturating_sub(self.sorted);
    }
}
