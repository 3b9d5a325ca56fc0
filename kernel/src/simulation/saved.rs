//! The state of a simulation as one plain value, to be kept somewhere and gone on from, bit by bit.
//!
//! [`Saved`] holds what a step leaves behind and the next one needs, and nothing that can be had from the scene: neither
//! the grid, which is scratch between steps, nor laws, loads and surfaces. How it is written is not known here.

use super::Simulation;
use super::clock::Clock;
use super::error::Event;
use super::mortar::Boundaries;
use crate::mortar::PointIn;
use crate::mortar::elements::Elements;
use crate::particles::{Layout, ParticleSet};
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
    /// Pairs of contact on the grid, in the order of the identifiers of their bodies.
    pub pairs: Vec<SavedPair>,
    /// Mortar contact of polylines, in two dimensions.
    pub plane: SavedMortar,
    /// Mortar contact of triangles, in three.
    pub space: SavedMortar,
    /// Contact with rigid surfaces, where the scene has any.
    pub surfaces: Option<SavedSurfaces>,
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

/// What contact of two bodies on the grid remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SavedPair {
    /// Whether the bodies were near as of the last sort.
    pub near: bool,
    /// Force on the slave in the last step \[N\].
    pub force: Vector,
}

/// What mortar contact of one dimension remembers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SavedMortar {
    /// Boundaries of bodies, rigid lines and rigid surfaces.
    pub boundaries: Vec<SavedBoundary>,
    /// Elastic slip of each pair, the components of all vertices of its slave one after the other \[m\].
    pub slips: Vec<Vec<f64>>,
}

/// The vertices of a boundary; the components of all of them one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedBoundary {
    /// Positions relative to the origin of the mesh \[m\].
    pub points: Vec<f64>,
    /// Displacements in the last step \[m\].
    pub moved: Vec<f64>,
}

/// Impulses of rigid surfaces on bodies, by surface and body.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedSurfaces {
    /// Time over which the last ones acted \[s\].
    pub kick: f64,
    /// Those of the last step \[N s\].
    pub last: Vec<Vec<Vector>>,
    /// All since the start \[N s\].
    pub total: Vec<Vec<Vector>>,
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
            pairs: (self.contact.near.iter().zip(&self.contact.forces))
                .map(|(&near, &force)| SavedPair { near, force })
                .collect(),
            plane: save_mortar(&self.mortar.plane),
            space: save_mortar(&self.mortar.space),
            surfaces: self.surfaces.as_ref().map(|surfaces| SavedSurfaces {
                kick: surfaces.last_kick,
                last: surfaces.last.clone(),
                total: surfaces.total.clone(),
            }),
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
        if let (Some(surfaces), Some(was)) = (&mut self.surfaces, saved.surfaces) {
            surfaces.last_kick = was.kick;
            surfaces.last = was.last;
            surfaces.total = was.total;
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
        if !saved.pairs.is_empty() {
            self.contact.near = saved.pairs.iter().map(|pair| pair.near).collect();
            self.contact.forces = saved.pairs.iter().map(|pair| pair.force).collect();
        }
        restore_mortar(&mut self.mortar.plane, &saved.plane);
        restore_mortar(&mut self.mortar.space, &saved.space);
        self.set_fields();
        Ok(())
    }

    /// Whether a state can be one of this scene.
    fn fits(&self, saved: &Saved) -> Result<(), RestoreError> {
        same("bodies", self.sets.len(), saved.bodies.len())?;
        for (body, (set, was)) in self.sets.iter().zip(&saved.bodies).enumerate() {
            self.particles_fit(body, set, was)?;
        }
        same("pairs", self.contact.pairs.len(), saved.pairs.len())?;
        mortar_fits(&self.mortar.plane, &saved.plane)?;
        mortar_fits(&self.mortar.space, &saved.space)?;
        let impulses = |by_surface: &[Vec<Vector>]| by_surface.iter().map(Vec::len).collect();
        let (mut expected, mut found): (Vec<usize>, Vec<usize>) = (vec![], vec![]);
        if let Some(surfaces) = &self.surfaces {
            expected = impulses(&surfaces.last);
        }
        if let Some(surfaces) = &saved.surfaces {
            found = impulses(&surfaces.last);
            let total: Vec<usize> = impulses(&surfaces.total);
            same("impulses", found.iter().sum(), total.iter().sum())?;
        }
        same("rigid surfaces", expected.len(), found.len())?;
        for (expected, found) in expected.into_iter().zip(found) {
            same("bodies of a rigid surface", expected, found)?;
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

fn save_mortar<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    boundaries: &Boundaries<B, D, N, T>,
) -> SavedMortar {
    let flat = |points: &[PointIn<D>]| points.iter().flatten().copied().collect();
    SavedMortar {
        boundaries: (boundaries.surfaces.iter())
            .map(|surface| SavedBoundary {
                points: flat(surface.boundary.points()),
                moved: flat(&surface.moved),
            })
            .collect(),
        slips: (boundaries.pairs.iter())
            .map(|pair| pair.slip.0.as_flattened().to_vec())
            .collect(),
    }
}

fn mortar_fits<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    boundaries: &Boundaries<B, D, N, T>,
    saved: &SavedMortar,
) -> Result<(), RestoreError> {
    let count = boundaries.surfaces.len();
    same("boundaries", count, saved.boundaries.len())?;
    for (surface, was) in boundaries.surfaces.iter().zip(&saved.boundaries) {
        let count = D * surface.boundary.points().len();
        same("coordinates of a boundary", count, was.points.len())?;
        same("displacements of a boundary", count, was.moved.len())?;
    }
    same("slips", boundaries.pairs.len(), saved.slips.len())?;
    for (pair, was) in boundaries.pairs.iter().zip(&saved.slips) {
        same("components of a slip", T * pair.slip.0.len(), was.len())?;
    }
    Ok(())
}

/// Takes up what was found to fit.
fn restore_mortar<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    boundaries: &mut Boundaries<B, D, N, T>,
    saved: &SavedMortar,
) {
    let fill = |points: &mut [PointIn<D>], values: &[f64]| {
        for (point, value) in points.iter_mut().zip(values.chunks_exact(D)) {
            *point = PointIn::from_column_slice(value);
        }
    };
    for (surface, was) in boundaries.surfaces.iter_mut().zip(&saved.boundaries) {
        fill(surface.boundary.points_mut(), &was.points);
        fill(&mut surface.moved, &was.moved);
    }
    for (pair, was) in boundaries.pairs.iter_mut().zip(&saved.slips) {
        pair.slip.0.copy_from_slice(was.as_chunks().0);
    }
}
