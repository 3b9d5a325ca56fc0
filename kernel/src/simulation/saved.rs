//! The state of a simulation as one plain value, to be kept somewhere and gone on from, bit by bit.
//!
//! [`Saved`] holds what a step leaves behind and the next one needs, and nothing that can be had from the scene: neither
//! the grid, which is scratch between steps, nor laws, loads and surfaces. How it is written is not known here.

use super::Simulation;
use super::clock::Clock;
use super::error::Event;
use super::interactions::{Interaction, Remembered};
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::scene::Vector;
use crate::stage::g2p::Found;
use std::fmt;

/// The state of a simulation: see [`Simulation::save`].
#[derive(Clone, Debug, PartialEq)]
pub struct Saved {
    /// Step counter, time, and the time steps so far.
    pub clock: Clock,
    /// Nodes per axis of the stencil, 3 or 4.
    pub stencil: usize,
    /// Largest travel of a particle since the last sort, in cells.
    pub travel: f64,
    /// Groups of particles that share a base node, after the last sort.
    pub sorted_groups: usize,
    /// Groups met beyond those, summed over the steps since: their number decides when to sort.
    pub superfluous_groups: usize,
    /// Displacement of the mesh since the start \[m\].
    pub mesh_shift: Vector,
    /// Kinetic energies one and two half-steps ago, with kinetic damping \[J\].
    pub kinetic: [f64; 2],
    /// Work of nodal loads and of what has a prescribed velocity so far \[J\].
    pub external_work: f64,
    /// Sum of force times position over particles with dead loads at the start \[J\].
    pub dead_load_origin: f64,
    /// Energy at the start \[J\].
    pub initial_energy: f64,
    /// The bodies, in the order of the scene.
    pub bodies: Vec<SavedBody>,
    /// What each interaction remembers, in the order in which they act.
    pub interactions: Vec<Remembered>,
    /// What happened so far.
    pub events: Vec<Event>,
}

/// The particles of a body, in the order in which they are kept: it decides in which order sums are formed.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedBody {
    /// Identifiers.
    pub id: Vec<u64>,
    /// State, one list per column of the layout.
    pub columns: Vec<Vec<f64>>,
    /// First particle of each base layer along the slow axis, and the number of particles.
    pub layers: Vec<usize>,
    /// What the last step found: the next time step is chosen by it.
    pub found: Found,
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

impl Simulation {
    /// The state: a simulation of the same scene that takes it up goes on with the same bits.
    #[must_use]
    pub fn save(&self) -> Saved {
        Saved {
            clock: self.clock,
            stencil: self.stencil,
            travel: self.travel,
            sorted_groups: self.groups.sorted,
            superfluous_groups: self.groups.superfluous,
            mesh_shift: self.mesh_shift,
            kinetic: self.relaxation.last,
            external_work: self.ledger.external_work,
            dead_load_origin: self.ledger.dead_load_origin,
            initial_energy: self.ledger.initial_energy,
            bodies: (self.sets.iter().zip(&self.bodies))
                .map(|(set, body)| SavedBody {
                    id: set.id.clone(),
                    columns: set.columns.clone(),
                    layers: set.layers.clone(),
                    found: Found {
                        fault: None,
                        ..body.found
                    },
                })
                .collect(),
            interactions: self.interactions().map(Interaction::save).collect(),
            events: self.events.clone(),
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
        for ((set, body), was) in (self.sets.iter_mut())
            .zip(&mut self.bodies)
            .zip(saved.bodies)
        {
            set.id = was.id;
            set.columns = was.columns;
            set.layers = was.layers;
            body.found = was.found;
        }
        self.clock = saved.clock;
        self.stencil = saved.stencil;
        self.travel = saved.travel;
        self.groups.sorted = saved.sorted_groups;
        self.groups.superfluous = saved.superfluous_groups;
        self.mesh_shift = saved.mesh_shift;
        self.relaxation.last = saved.kinetic;
        self.ledger.external_work = saved.external_work;
        self.ledger.dead_load_origin = saved.dead_load_origin;
        self.ledger.initial_energy = saved.initial_energy;
        self.events = saved.events;
        self.grid.resume(&self.sets, self.stencil);
        let interactions = self.interactions.iter_mut().flatten();
        for (one, was) in interactions.zip(&saved.interactions) {
            one.restore(was);
        }
        self.set_fields();
        Ok(())
    }

    /// Whether a state can be one of this scene.
    fn fits(&self, saved: &Saved) -> Result<(), RestoreError> {
        same("bodies", self.sets.len(), saved.bodies.len())?;
        for (body, (set, was)) in self.sets.iter().zip(&saved.bodies).enumerate() {
            self.particles_fit(body, set, was)?;
        }
        let interactions: Vec<Remembered> = self.interactions().map(Interaction::save).collect();
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
        was: &SavedBody,
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
        let mesh = &self.scene.mesh;
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
