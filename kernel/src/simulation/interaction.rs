//! What acts between velocity fields, or between them and what is no material: contact on the grid, mortar contact, rigid
//! surfaces. The only place that knows which of them there are.
//!
//! A step calls them in this order: [`Simulation::sorted`] after a sort; [`Simulation::find`] between the mapping and the
//! choice of the time step; forces to nodes and, slab by slab ([`OnSlab`]), corrections of the trial velocities within
//! the equation of motion; what needs all slabs at once in [`Simulation::settle`]; [`Simulation::advance`] once it is
//! known how far positions move.

use super::Simulation;
use super::conditions::{Acting, Condition};
use super::error::StepError;
use super::fields::{Grid, Slab};
use super::mapping::BodiesOnto;
use super::phase::Phase;
use super::step::Watcher;
use crate::contact::State;
use crate::scene::Vector;
use crate::stage::solve::{PlaneSums, Wall};
use std::borrow::Cow;
use std::sync::Arc;

/// What a visit of all slabs knows beside the fields.
pub(super) struct Now<'a> {
    pub(super) mapping: BodiesOnto<'a>,
    pub(super) acting: &'a Acting,
    pub(super) conditions: &'a [Arc<dyn Condition>],
    /// Lower corner of the mesh in the coordinates of the scene \[m\].
    pub(super) origin: Vector,
    /// Walls, with the velocities of this visit.
    pub(super) walls: Cow<'a, [Wall]>,
    /// Velocities half a step before and after of bodies whose motion is prescribed \[m/s\].
    pub(super) prescribed: Vec<Option<[Vector; 2]>>,
    /// Whether kinetic energy and residual are measured.
    pub(super) measure: bool,
    /// Whether velocities still change when all slabs are done, and sums are taken after that.
    pub(super) settles: bool,
}

/// What an interaction does to the fields of one slab.
pub(super) trait OnSlab: Send {
    /// The masses of all fields are there.
    fn mapped(&mut self, slab: &mut Slab<'_>, now: &Now<'_>);
    /// Corrects the trial velocities and their increments; adds power to the sums of the planes.
    fn correct(&mut self, slab: &mut Slab<'_>, now: &Now<'_>, sums: &mut [PlaneSums]);
    /// Corrects velocities that were mapped again, from which strain is taken.
    fn correct_again(&mut self, slab: &mut Slab<'_>, now: &Now<'_>);
}

/// For each slab what acts there.
pub(super) type Parts<'a> = Vec<Vec<Box<dyn OnSlab + 'a>>>;

/// Which velocities a visit is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Visit {
    /// Those of the equation of motion.
    Trial,
    /// Those that were mapped a second time.
    Again(Again),
}

/// From where velocities are mapped a second time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Again {
    /// From the positions of the first mapping, to the upper lanes of the nodes (MUSL).
    OldPositions,
    /// From the positions at the end of the step, to the lower lanes (USF).
    NewPositions,
}

impl Again {
    /// The lane of a node where its velocity begins.
    pub(super) fn lane(self) -> usize {
        match self {
            Self::OldPositions => 4,
            Self::NewPositions => 1,
        }
    }
}

/// What acts on the slabs of a visit.
pub(super) fn on_slabs<'a>(contact: &'a mut State, grid: &Grid, visit: Visit) -> Parts<'a> {
    if contact.faces.list.is_empty() {
        return grid.slabs.iter().map(|_| vec![]).collect();
    }
    contact.on_slabs(grid, visit)
}

impl Simulation {
    /// After a sort: which bodies need a field of their own.
    pub(super) fn sorted(&mut self) {
        self.find_near_pairs();
        self.set_fields();
        if let Some(surfaces) = &mut self.surfaces {
            surfaces.forget();
        }
    }

    /// Gives each body that needs one its velocity field.
    pub(crate) fn set_fields(&mut self) {
        let near = self.contact.near_bodies();
        let with_boundary: Vec<usize> = self.mortar.bodies().collect();
        let mut owners: Vec<usize> = near.iter().chain(&with_boundary).copied().collect();
        owners.sort_by_key(|&i| self.bodies[i].id);
        owners.dedup();
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.in_layer = owners.contains(&index);
            body.apart = with_boundary.contains(&index);
        }
        self.grid.set_owners(&owners, &self.sets, self.stencil);
        owners.retain(|body| near.contains(body));
        self.contact
            .set_faces(&owners, &self.sets, &self.grid, self.stencil);
    }

    /// Whether gaps and forces are sought between the mapping and the choice of the time step.
    pub(super) fn finds(&self) -> bool {
        self.mortar.acts()
    }

    /// Gaps, forces, and the time steps that they allow.
    pub(super) fn find(&mut self, ended: Watcher<'_>) -> Result<(), StepError> {
        if self.finds() {
            ended(Phase::NodesFromParticles);
            self.meet_boundaries()?;
            ended(Phase::Contact);
        }
        Ok(())
    }

    /// Refuses a time step in which something would pass through something else unseen.
    pub(super) fn refuse_leaps(&self, dt: f64) -> Result<(), StepError> {
        self.refuse_leaps_of_pairs(dt)?;
        self.refuse_fast_closing(dt)
    }

    /// Adds contact forces to those at the nodes.
    pub(super) fn load_nodes(&mut self) {
        self.mortar.load_nodes(&mut self.grid);
    }

    /// What is done with the velocities of all slabs together; the number of nodes or vertices where a contact force acts.
    pub(super) fn settle(&mut self, acting: &Acting) -> Result<usize, StepError> {
        let touching = self.gather_contact()?;
        self.ledger.sums.power += self.mortar.power_of_prescribed(acting.half_steps[1]);
        self.touch_surfaces(acting)?;
        Ok(touching + self.mortar.vertices_under_pressure())
    }

    /// The same for velocities that were mapped a second time.
    pub(super) fn settle_again(&mut self, acting: &Acting, again: Again) -> Result<(), StepError> {
        self.hold_at_surfaces(acting, again.lane())
    }

    /// Positions move by `drift` \[s\].
    pub(super) fn advance(&mut self, acting: &Acting, drift: f64, ended: Watcher<'_>) {
        if self.mortar.acts() {
            self.move_vertices(drift, acting.half_steps[1]);
            ended(Phase::Contact);
        }
    }
}
