//! Views of a simulation in a step, as interactions read and change it.

use super::BaseVelocity;
use crate::fields::Grid;
use crate::lanes::SelectedLanes;
use crate::layout::Layout;
use crate::model::{CycleSettings, Vector};
use crate::particles::{OwnParticles, ParticleSet};
use crate::ranks::Ranks;
use crate::simulation::values::{BodyRun, Clock, Event, EventKind, ParticleAt};
use crate::stage::g2p::ParticleMaxima;
use crate::stage::solve::StepSums;
use crate::team::Team;

/// A simulation in a step, as an interaction reads it.
#[derive(Clone, Copy)]
pub struct StepView<'a> {
    /// Settings of the cycle.
    pub settings: &'a CycleSettings,
    /// The bodies, in the order of the scene.
    pub bodies: &'a [BodyRun],
    /// Particle sets, one per body; positions are relative to the origin of the mesh.
    pub particles: &'a [ParticleSet],
    /// Maxima over the particles of each body, as of the last G2P pass.
    pub maxima: &'a [ParticleMaxima],
    /// Time and step counter.
    pub clock: &'a Clock,
    /// The grid with its velocity fields.
    pub grid: &'a Grid,
    /// Velocity of the base, where one moves.
    pub base: Option<&'a BaseVelocity>,
    /// Lanes in use.
    pub lanes: SelectedLanes,
    /// Nodes per axis of the stencil, 3 or 4.
    pub stencil: usize,
    /// Largest travel of a particle since the last sort \[cells\].
    pub travel: f64,
    /// Displacement of the mesh since the start \[m\].
    pub mesh_shift: Vector,
    /// Ranks that share the simulation, if any do: this one then has a part of the particles, and of the planes of nodes.
    pub ranks: Option<&'a dyn Ranks>,
}

impl<'a> StepView<'a> {
    /// The threads.
    #[must_use]
    #[inline]
    pub fn team(&self) -> &'a Team {
        &self.grid.team
    }

    /// Lower corner of the mesh now, in the coordinates of the scene \[m\].
    #[must_use]
    #[inline]
    pub fn origin(&self) -> Vector {
        let start = &self.settings.mesh.origin;
        std::array::from_fn(|axis| start[axis] + self.mesh_shift[axis])
    }

    /// The shortest side of a cell \[m\].
    #[must_use]
    #[inline]
    pub fn smallest_cell(&self) -> f64 {
        let cell = &self.settings.mesh.cell[..self.grid.shape.axes];
        cell.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Particles of a set that this process owns; all, where no ranks share them.
    #[must_use]
    pub fn own_particles(&self, set: usize) -> OwnParticles {
        let particles = &self.particles[set];
        match self.ranks {
            None => OwnParticles::all(particles.len()),
            Some(_) => particles.in_block(&self.grid.block(), &self.grid.shape),
        }
    }

    /// Position of a particle in the coordinates of the scene \[m\].
    #[must_use]
    #[inline]
    pub fn position(&self, set: usize, p: usize) -> Vector {
        let (x, origin) = (self.particles[set].position(p), self.origin());
        std::array::from_fn(|axis| x[axis] + origin[axis])
    }

    /// Mass of a particle \[kg\].
    #[must_use]
    #[inline]
    pub fn mass(&self, set: usize, p: usize) -> f64 {
        self.particles[set].columns[Layout::MASS][p]
    }

    /// A particle and where it is, for an error.
    #[must_use]
    #[inline]
    pub fn particle_at(&self, set: usize, p: usize) -> ParticleAt {
        let particles = &self.particles[set];
        ParticleAt {
            id: particles.id[p],
            body: self.bodies[set].id,
            position: self.position(set, p),
            volume: particles.columns[Layout::VOLUME][p],
            mass: particles.columns[Layout::MASS][p],
        }
    }
}

/// The velocities of all slabs together, as an interaction changes them after the equation of motion or a remap.
pub struct StepUpdate<'a> {
    /// The grid with its velocity fields.
    pub grid: &'a mut Grid,
    /// Sums over the nodes of this step.
    pub sums: &'a mut StepSums,
    pub(super) events: &'a mut Vec<Event>,
    pub(super) settings: &'a CycleSettings,
    pub(super) bodies: &'a [BodyRun],
    pub(super) particles: &'a [ParticleSet],
    pub(super) maxima: &'a [ParticleMaxima],
    pub(super) clock: &'a Clock,
    pub(super) base: Option<&'a BaseVelocity>,
    pub(super) lanes: SelectedLanes,
    pub(super) stencil: usize,
    pub(super) travel: f64,
    pub(super) mesh_shift: Vector,
    pub(super) ranks: Option<&'a dyn Ranks>,
}

impl StepUpdate<'_> {
    /// The simulation as it is now.
    #[must_use]
    pub fn view(&self) -> StepView<'_> {
        StepView {
            settings: self.settings,
            bodies: self.bodies,
            particles: self.particles,
            maxima: self.maxima,
            clock: self.clock,
            grid: self.grid,
            base: self.base,
            lanes: self.lanes,
            stencil: self.stencil,
            travel: self.travel,
            mesh_shift: self.mesh_shift,
            ranks: self.ranks,
        }
    }

    /// Notes an event of this step.
    #[inline]
    pub fn note(&mut self, kind: EventKind) {
        self.events.push(Event {
            step: self.clock.step + 1,
            time: self.clock.time,
            kind,
        });
    }
}
