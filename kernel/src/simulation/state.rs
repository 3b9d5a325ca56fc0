//! The state: all that a step leaves behind and the next one needs.
//!
//! It is one plain value. A checkpoint writes it, a rehearsal and a restart take it up again, a change between stages goes
//! on with it, all by [`Simulation::save`] and [`Simulation::restore`]. What can be had from the scene is not in it: neither
//! the grid, which is scratch between steps, nor laws, loads and surfaces. How it is written is not known here.

use super::Simulation;
use super::clock::Clock;
use super::event::Event;
use super::extremes::Extremes;
use super::interactions::{Interaction, SavedArrays};
use super::invariants::InvariantMonitor;
use super::passes::Groups;
use super::spin::Spin;
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::scene::Vector;
use crate::stage::g2p::ParticleMaxima;
use std::fmt;

/// The state of a simulation after a step, but for the saved arrays of interactions: see [`Saved`].
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Particle sets, one per body, in the order of the scene. The order of particles in a set decides in which order sums
    /// are formed.
    pub sets: Vec<ParticleSet>,
    /// What the last step found in each set: the next time step is chosen by it.
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
    /// What happened so far.
    pub events: Vec<Event>,
    /// What the balances were seen to do so far.
    pub invariants: InvariantMonitor,
    /// Largest deformations so far.
    pub extremes: Extremes,
    /// Angular momentum at the start, where nothing outside can turn the bodies.
    pub start_spin: Option<Spin>,
}

/// Running sums of the energy balance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Work of nodal loads and of what has a prescribed velocity so far, less that of dead loads on it \[J\].
    pub external_work: f64,
    /// Sum of force times position over particles with dead loads at the start, less those removed \[J\].
    pub dead_load_origin: f64,
    /// Kinetic and strain energy at the start, and from the first step on that of mortar contact \[J\].
    pub initial_energy: f64,
    /// What damping took so far \[J\].
    pub damping: f64,
    /// What friction of contact took so far \[J\].
    pub friction: f64,
    /// What contact took along its normal so far \[J\].
    pub impact: f64,
    /// What removed particles took along so far \[J\].
    pub removed: f64,
}

/// The whole state of a simulation: see [`Simulation::save`].
#[derive(Clone, Debug, PartialEq)]
pub struct Saved {
    /// The state.
    pub state: State,
    /// What each interaction remembers, in the order in which they act.
    pub interactions: Vec<SavedArrays>,
}

/// A saved state that is not one of the scene of the simulation.
#[derive(Clone, Debug, PartialEq)]
pub enum RestoreError {
    /// A list is longer or shorter than the scene makes it.
    Length {
        /// Which one.
        what: String,
        /// Values that the simulation has there.
        expected: usize,
        /// Values that were saved.
        found: usize,
    },
    /// Particles of a body lie outside the mesh, or its layers are not those of so many particles.
    Places {
        /// Which body, by its place in the scene.
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
    pub(super) fn new(sets: Vec<ParticleSet>, found: Vec<ParticleMaxima>) -> Self {
        let widest = found.iter().map(|f| f.half_length).fold(0.0, f64::max);
        Self {
            sets,
            found,
            clock: Clock::default(),
            stencil: if widest > 0.5 { 4 } else { 3 },
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
        }
    }
}

impl Simulation {
    /// The state: a simulation of the same scene that takes it up goes on with the same bits.
    #[must_use]
    pub fn save(&self) -> Saved {
        Saved {
            state: self.state.clone(),
            interactions: self.interactions().map(Interaction::save).collect(),
        }
    }

    /// Takes up a state that was saved of a simulation of the same scene. That the scene is the same is for the caller
    /// to know. What the last step found on the way and the next one finds anew, such as gaps, pressures and energy of
    /// mortar contact, is known again after a step.
    ///
    /// # Errors
    /// A state that is not one of such a scene, by the lengths of its lists and the places of its particles. The
    /// simulation is then as it was.
    pub fn restore(&mut self, saved: Saved) -> Result<(), RestoreError> {
        self.fits(&saved)?;
        let layouts: Vec<Layout> = self.state.sets.iter().map(|set| set.layout).collect();
        self.state = saved.state;
        self.work.failed = None;
        for (set, layout) in self.state.sets.iter_mut().zip(layouts) {
            set.layout = layout;
        }
        self.work.grid.resume(&self.state.sets, self.state.stencil);
        let interactions = self.work.interactions.iter_mut();
        for (one, was) in interactions.zip(&saved.interactions) {
            one.restore(was);
        }
        self.set_fields();
        Ok(())
    }

    /// Whether a state can be one of this scene.
    fn fits(&self, saved: &Saved) -> Result<(), RestoreError> {
        let (own, was) = (&self.state, &saved.state);
        same("bodies", own.sets.len(), was.sets.len())?;
        same("bodies", own.sets.len(), was.found.len())?;
        for (body, (set, was)) in own.sets.iter().zip(&was.sets).enumerate() {
            self.particles_fit(body, set, was)?;
        }
        let interactions: Vec<SavedArrays> = self.interactions().map(Interaction::save).collect();
        let count = interactions.len();
        same("interactions", count, saved.interactions.len())?;
        for (own, was) in interactions.iter().zip(&saved.interactions) {
            same("lists of an interaction", own.len(), was.len())?;
            for ((name, own), (_, was)) in own.iter().zip(was) {
                same(name, own.len(), was.len())?;
            }
        }
        Ok(())
    }

    fn particles_fit(
        &self,
        body: usize,
        set: &ParticleSet,
        was: &ParticleSet,
    ) -> Result<(), RestoreError> {
        let columns = format!("columns of body {body}");
        same(columns, set.layout.columns, was.columns.len())?;
        for column in &was.columns {
            let values = format!("values in a column of body {body}");
            same(values, was.id.len(), column.len())?;
        }
        let layers = format!("layers of body {body}");
        same(layers, set.layers.len(), was.layers.len())?;
        let in_layers = was.layers.last().copied().unwrap_or(0);
        let ordered = was.layers.is_sorted() && in_layers == was.id.len();
        let mesh = &self.model.scene.mesh;
        let inside = (0..set.layout.axes).all(|axis| {
            let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
            let x = &was.columns[Layout::POSITION + axis];
            x.iter().all(|x| (0.0..=extent).contains(x))
        });
        if ordered && inside {
            Ok(())
        } else {
            Err(RestoreError::Places {
                body,
                particles: was.id.len(),
                in_layers,
            })
        }
    }
}

fn same(what: impl Into<String>, expected: usize, found: usize) -> Result<(), RestoreError> {
    if expected == found {
        Ok(())
    } else {
        Err(RestoreError::Length {
            what: what.into(),
            expected,
            found,
        })
    }
}
