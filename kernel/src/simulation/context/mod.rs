//! Context of a step at the nodes: its conditions, its mapping, and the fields that conditions and interactions change.

mod nodes;

pub use nodes::{FieldNodes, Node};

use super::mapping::ParticleToGrid;
use crate::fields::Owner;
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::simulation::step_view::StepView;
use crate::stage::solve::{DashpotNode, DrivenNode, EmptyNode, NodeForce, Planes, Wall};
use crate::stage::water::PressedPlane;
use crate::weights::Family;
use smallvec::SmallVec;
use std::ops::Range;
use std::sync::Arc;

/// Parts of a scene that ranks do not share, beside the interactions that say so
/// ([`Interaction::not_local`](super::Interaction::not_local)): a condition that does not say otherwise ([`Condition::not_local`]).
pub const NOT_LOCAL: [&str; 1] = ["conditions of a program's own"];

/// A condition on the nodes of velocity fields.
///
/// A step asks it in this order: [`Condition::prescribe`] once its length is known; then for each field, on each slab of
/// planes that a thread owns, [`Condition::before`] and [`Condition::after`] the acceleration, [`Condition::settled`] when
/// contact has acted, and [`Condition::remap`] on velocities that are mapped a second time. Slabs and fields are visited at
/// once by several threads, and their number must not change a result: what is done at a node may depend on that node
/// alone. A body whose motion is prescribed has no equation of motion, and no condition is asked about its field.
pub trait Condition: Send + Sync {
    /// True if [`Condition::prescribe`] looks at the masses of the nodes: mapping and equation of motion take two visits of the
    /// slabs then.
    fn reads_masses(&self) -> bool {
        false
    }

    /// The part of a scene that this is, for a refusal, where ranks cannot share it; `None` where they can.
    ///
    /// Ranks can share a condition whose action at a node follows from that node, its place and the time. Anything else that it
    /// finds must be the same on all ranks: it joins that through [`StepView::ranks`] in [`Condition::prescribe`], which all
    /// ranks call at the same time, while the other calls come from slab to slab.
    fn not_local(&self) -> Option<&'static str> {
        Some(NOT_LOCAL[0])
    }

    /// Adds what it prescribes in a step to what others do.
    fn prescribe(&self, _view: &StepView<'_>, _nodal: &mut NodalConditions) {}

    /// Adds forces at the nodes; mass, velocity and force of the particles are there.
    ///
    /// # Errors
    /// A node that a force acts on has no mass.
    fn before(&self, _field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        Ok(())
    }

    /// True if it acts on the pore water too, which has a velocity of its own.
    fn acts_on_water(&self) -> bool {
        false
    }

    /// Changes velocities after the acceleration, before contact.
    fn after(&self, _field: &mut FieldNodes<'_, '_>) {}

    /// Adds the power of its forces \[W\], with the velocities after contact.
    fn settled(&self, _field: &mut FieldNodes<'_, '_>) {}

    /// Changes velocities that were mapped a second time, from which strain is taken (MUSL, USF). What was done to the
    /// velocities before is in the particles, and so in these; what must hold exactly is prescribed once more.
    fn remap(&self, _field: &mut FieldNodes<'_, '_>) {}
}

/// The nodal conditions of one step: walls, prescribed velocities, loads, gravity and times.
#[derive(Clone, Debug, Default)]
pub struct NodalConditions {
    /// Boundary planes with a condition, by axis and side, with their velocities.
    pub walls: Walls,
    /// The same for the pore water. None of these moves.
    pub water_walls: Walls,
    /// Boundary planes at which the pressure of the pore water is given.
    pub water_pressures: SmallVec<[PressedPlane; 6]>,
    /// Velocities half a step before and after of each body whose motion is prescribed \[m/s\], by its place in the scene.
    pub prescribed: Vec<Option<[Vector; 2]>>,
    /// Forces of loads on nodes that change with time, with those that do not, in order of the nodes \[N\].
    pub loads: Vec<NodeForce>,
    /// True if those are all that act in this step, in place of those that stay what they are.
    pub(super) spread: bool,
    /// Forces of standing water on the nodes of each field, by its number among those of the grid.
    pub(super) standing: Vec<FieldForces>,
    /// Nodes of the common field that move with driven bodies, each once, increasing; none that is held.
    pub driven: Vec<DrivenNode>,
    /// Nodes of absorbing planes, each once, increasing.
    pub absorbing: Vec<DashpotNode>,
    /// Nodes while they are sought.
    pub(super) nodes: Vec<usize>,
    /// Nodes of all fields that stand still, each once, increasing.
    pub held: Arc<[DrivenNode]>,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Factor of local damping.
    pub local_damping: Option<f64>,
    /// Time over which velocities change \[s\].
    pub kick: f64,
    /// Times of the velocities before and after \[s\], half a step before and half a step after the positions.
    pub half_steps: [f64; 2],
    /// Time over which positions move \[s\].
    pub drift: f64,
}

/// Forces on the nodes of one field; none where it is not pressed.
#[derive(Clone, Debug, Default)]
pub(super) struct FieldForces {
    /// Place of the first node of each row, plane by plane, and behind the last row that of the end.
    pub(super) starts: Vec<usize>,
    /// Forces on the nodes in use, row by row \[N\]; with pore water those on both phases together.
    pub(super) forces: Vec<Vector>,
}

impl FieldForces {
    /// Nothing presses on the field; its memory stays.
    pub(super) fn clear(&mut self) {
        self.starts.clear();
        self.forces.clear();
    }
}

impl NodalConditions {
    /// Nothing acts yet in a step of these times.
    pub(super) fn begin(&mut self, kick: f64, half_steps: [f64; 2], drift: f64) {
        let Self {
            mut prescribed,
            mut loads,
            mut driven,
            mut absorbing,
            mut standing,
            nodes,
            ..
        } = std::mem::take(self);
        prescribed.clear();
        loads.clear();
        driven.clear();
        absorbing.clear();
        standing.iter_mut().for_each(FieldForces::clear);
        *self = Self {
            prescribed,
            loads,
            standing,
            driven,
            absorbing,
            nodes,
            kick,
            half_steps,
            drift,
            ..Self::default()
        };
    }
}

/// Boundary planes: six at most.
pub(crate) type Walls = SmallVec<[Wall; 6]>;

/// The context of a visit of all slabs, beside the fields.
pub struct StepContext<'a> {
    pub(super) mapping: ParticleToGrid<'a>,
    pub(super) nodal: &'a NodalConditions,
    pub(super) conditions: &'a [Arc<dyn Condition>],
    /// Lower corner of the mesh in the coordinates of the scene \[m\].
    pub(super) origin: Vector,
    /// Walls, with the velocities of this visit.
    pub walls: Walls,
    /// Velocities half a step before and after of bodies whose motion is prescribed \[m/s\].
    pub prescribed: &'a [Option<[Vector; 2]>],
    /// The second mapping that the velocities are of, if they are of one.
    pub remap: Option<Remap>,
    /// True if kinetic energy and residual are measured.
    pub(super) measure: bool,
    /// True if velocities still change when all slabs are done, and sums are taken after that.
    pub(super) settles: bool,
}

impl<'a> StepContext<'a> {
    /// The nodal conditions of this step.
    #[must_use]
    pub fn nodal(&self) -> &'a NodalConditions {
        self.nodal
    }

    /// Planes for the water, or those for the skeleton.
    #[must_use]
    #[inline]
    pub(super) fn walls_of(&self, owner: Owner) -> &[Wall] {
        match owner {
            Owner::Water => &self.nodal.water_walls,
            Owner::Phase | Owner::Body(_) => &self.walls,
        }
    }

    /// Conditions that act on a field.
    pub(super) fn conditions_of(
        &self,
        owner: Owner,
    ) -> impl Iterator<Item = &'a Arc<dyn Condition>> + use<'a> {
        let water = owner == Owner::Water;
        (self.conditions.iter()).filter(move |condition| !water || condition.acts_on_water())
    }

    /// Particle sets, one per body.
    #[must_use]
    #[inline]
    pub fn particles(&self) -> &'a [ParticleSet] {
        self.mapping.sets
    }

    /// Nodes per axis of the stencil.
    #[must_use]
    #[inline]
    pub fn stencil(&self) -> usize {
        self.mapping.stencil
    }

    /// Weighting functions.
    #[must_use]
    #[inline]
    pub fn family(&self) -> Family {
        self.mapping.family
    }

    /// Maps the mass gradient of some particles of a body, by its place, to lines of nodes; `runs` gives them for layers of
    /// particles.
    pub fn map_gradient<I: Iterator<Item = Range<usize>>>(
        &self,
        body: usize,
        runs: impl FnOnce(Range<usize>) -> I,
        planes: &mut Planes<'_>,
    ) {
        let mut runs = runs(self.mapping.layers_onto(planes));
        self.mapping.map_gradient(body, &mut runs, planes);
    }

    /// Offset of the velocity in the node record.
    pub(super) fn lane(&self) -> usize {
        self.remap.map_or(1, Remap::lane)
    }
}

/// The mapping whose velocities a visit changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VelocityMapping {
    /// Velocities of the equation of motion.
    Trial,
    /// Velocities that were mapped a second time.
    Remap(Remap),
}

/// The second mapping of velocities (remap), by the positions that it maps from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remap {
    /// Mapped from the positions of the first mapping, to the upper lanes of the nodes (MUSL).
    OldPositions,
    /// Mapped from the positions at the end of the step, to the lower lanes (USF).
    NewPositions,
}

impl Remap {
    /// The lane of a node where its velocity begins.
    #[must_use]
    pub fn lane(self) -> usize {
        match self {
            Self::OldPositions => 4,
            Self::NewPositions => 1,
        }
    }
}

/// Walls for a mapping of the velocities after the kick: both half-steps are the later one.
#[must_use]
pub fn at_half_step_after(walls: &[Wall]) -> Walls {
    walls
        .iter()
        .map(|wall| Wall {
            before: wall.after,
            ..*wall
        })
        .collect()
}
