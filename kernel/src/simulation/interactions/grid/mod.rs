//! Contact on the grid in the cycle, and what it tells of itself; what it is made of is in [`contact`](crate::contact).
//!
//! - [`faces`]: what is known of the surface of a body at the nodes, and of the particles near it.
//! - [`meeting`]: the nodes of a slab where bodies meet, and what happens there.

mod bonds;
pub(crate) mod contact_nodes;
pub(crate) mod faces;
mod plan_entries;
mod slab_contact;

pub(super) use slab_contact::SlabContact;

use super::InteractionType;
use crate::contact::overlap::overlap;
use crate::contact::{Pair, Tunnelling, broad};
use crate::memory::Memory;
use crate::scene::{Contact, Scene, Shape, StressScheme, Vector};
use crate::simulation::Simulation;
use crate::simulation::context::{NodalConditions, VelocityMapping};
use crate::simulation::fields::Grid;
use crate::simulation::interactions::{
    BodyList, Interaction, InteractionResult, PairList, SlabPart,
};
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::values::{
    BodyRun, EventKind, InitialOverlap, InteractionError, SavedArrays, SetupError,
};
use contact_nodes::{
    ContactNodes, ContactResult, ContactStatuses, DEEP, NodeLists, NodeTunnelling, Overlapped,
};
use faces::Faces;
use std::any::Any;

/// Contact on the grid.
pub(super) const GRID: InteractionType = InteractionType {
    plan_entries: plan_entries::plan_entries,
    make: GridContact::of,
};

/// Contact on the grid: its pairs, and its state from step to step.
#[derive(Clone, Debug, Default)]
pub(crate) struct GridContact {
    /// All pairs, in order of the identifiers of their bodies.
    pub pairs: Vec<Pair>,
    /// Which of them are near, as of the last sort.
    pub near: Vec<bool>,
    /// Surfaces of the bodies of near pairs.
    pub faces: Faces,
    /// Where bodies met and what contact did there, per slab, as of the last equation of motion.
    pub met: Vec<SlabContactState>,
    /// What pairs did at the nodes of all slabs, where particles have moved since.
    pub states: ContactStatuses,
    /// Force on the slave of each pair in the last step \[N\].
    pub forces: Vec<Vector>,
    /// Depth of the last overlap of each pair that became an event \[m\].
    noted: Vec<f64>,
}

/// Contact on one slab: the contact nodes, and the result there.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlabContactState {
    /// The nodes.
    pub meetings: ContactNodes,
    /// Forces, power and warnings.
    pub done: ContactResult,
    /// The nodes once particles have moved (USF).
    moved: ContactNodes,
    /// What is done to velocities that are mapped a second time feels no force.
    unheeded: ContactResult,
    lists: NodeLists,
}

impl GridContact {
    /// Contact on the grid, where a scene has any.
    pub(super) fn of(
        scene: &Scene,
        bodies: &[BodyRun],
        _: &mut Memory,
    ) -> Option<InteractionResult> {
        let any = !scene.contacts.is_empty() || bonds::all(scene, bodies).next().is_some();
        any.then(|| Ok(Box::new(Self::new(scene, bodies)) as _))
    }

    fn new(scene: &Scene, bodies: &[BodyRun]) -> Self {
        let pairs = pairs_of(scene, bodies);
        let count = pairs.len();
        Self {
            pairs,
            near: vec![false; count],
            forces: vec![[0.0; 3]; count],
            noted: vec![0.0; count],
            ..Self::default()
        }
    }

    /// Makes an event of each pair that overlaps deeply, and another when the overlap has grown as much.
    fn note_overlaps(&mut self, update: &mut StepUpdate<'_>) {
        let shape = update.grid.shape.clone();
        let least = DEEP
            * (0..shape.axes)
                .map(|k| shape.cell[k])
                .fold(f64::INFINITY, f64::min);
        for (index, pair) in self.pairs.iter().enumerate() {
            let mut deepest: Option<Overlapped> = None;
            let of_slabs = self
                .met
                .iter()
                .filter_map(|met| met.done.overlaps.get(index));
            for found in of_slabs.copied().flatten() {
                if deepest.is_none_or(|deepest| found.depth > deepest.depth) {
                    deepest = Some(found);
                }
            }
            let Some(found) = deepest.filter(|found| found.depth > self.noted[index] + least)
            else {
                continue;
            };
            self.noted[index] = found.depth;
            let (local, origin) = (shape.position_of(found.at), update.view().origin());
            let bodies = update.view().bodies;
            update.note(EventKind::Overlap {
                bodies: [pair.master, pair.slave].map(|body| bodies[body].id),
                position: std::array::from_fn(|axis| local[axis] + origin[axis]),
                depth: found.depth,
            });
        }
    }

    fn tunnelling(&self, at: NodeTunnelling, view: &StepView<'_>) -> Tunnelling {
        let pair = &self.pairs[at.pair];
        let shape = &view.grid.shape;
        let (local, origin) = (shape.position(shape.index(at.at)), view.origin());
        Tunnelling {
            bodies: [pair.master, pair.slave].map(|body| view.bodies[body].id),
            position: Some(std::array::from_fn(|axis| local[axis] + origin[axis])),
            approach: at.approach,
            distance: at.distance,
        }
    }
}

impl Interaction for GridContact {
    fn boxed(&self) -> Box<dyn Interaction> {
        Box::new(self.clone())
    }

    /// Refuses bodies of a pair that overlap.
    fn start(&self, view: &StepView<'_>) -> Result<(), SetupError> {
        let bodies = view.bodies.iter();
        let half_lengths: Vec<Vector> = bodies.map(|b| b.particle_half_length).collect();
        let origin = view.origin();
        // What is bonded may overlap: no gap between them is a condition.
        let pairs = self.pairs.iter().zip(&self.near);
        let near = pairs.filter(|(pair, near)| **near && !pair.bonded);
        let overlapping = near.filter_map(|(pair, _)| {
            let found = overlap(pair, view.particles, &half_lengths)?;
            let mut contacts = view.scene.contacts.iter();
            let name = contacts.find(|c| c.id == pair.id);
            Some(InitialOverlap {
                contact: name.map_or_else(String::new, |c| c.name.clone()),
                bodies: [pair.master, pair.slave].map(|body| view.bodies[body].id),
                depth: found.depth,
                position: std::array::from_fn(|axis| found.at[axis] + origin[axis]),
            })
        });
        let all: Vec<InitialOverlap> = overlapping.collect();
        if all.is_empty() {
            Ok(())
        } else {
            Err(SetupError::Overlap(all))
        }
    }

    fn sorted(&mut self, view: &StepView<'_>) {
        let (shape, stencil) = (&view.grid.shape, view.stencil);
        let sets = &view.particles;
        broad::near(&self.pairs, sets, shape, stencil, &mut self.near);
    }

    /// Bodies of near pairs.
    fn owners(&self) -> BodyList {
        let near = self.pairs.iter().zip(&self.near).filter(|(_, near)| **near);
        near.flat_map(|(pair, _)| [pair.master, pair.slave])
            .collect()
    }

    /// Bodies without a pair share their velocity.
    fn apart(&self) -> BodyList {
        BodyList::new()
    }

    fn pairs(&self) -> PairList {
        let pairs = self.pairs.iter();
        pairs.map(|pair| [pair.master, pair.slave]).collect()
    }

    /// Has surfaces for the bodies of near pairs, in order of the identifier.
    fn fields_given(&mut self, view: &StepView<'_>) {
        let mut bodies = self.owners();
        bodies.sort_by_key(|&i| view.bodies[i].id);
        bodies.dedup();
        self.faces.set(
            &bodies,
            &self.pairs,
            &self.near,
            view.particles,
            view.grid,
            view.stencil,
        );
    }

    /// Pairs of two driven bodies do not act, so the pairs may be others now. No shape begins to act: where it was at the start is
    /// not known.
    fn motion_changed(&mut self, view: &StepView<'_>, _: usize) {
        let before = std::mem::take(&mut self.pairs);
        *self = Self::new(view.scene, view.bodies);
        for pair in &mut self.pairs {
            let same = |old: &&Pair| (old.master, old.slave) == (pair.master, pair.slave);
            pair.by_shape &= before.iter().find(same).is_some_and(|old| old.by_shape);
        }
        self.pairs.retain(|pair| pair.by_shape || !pair.bonded);
        self.near.resize(self.pairs.len(), false);
        self.forces.resize(self.pairs.len(), [0.0; 3]);
    }

    /// Refuses a step in which the bodies of a pair could approach by more than a cell: they could pass through each
    /// other without sharing a node. Only a scene that allows unstable steps gets there.
    fn check_time_step(&self, view: &StepView<'_>, dt: f64) -> Result<(), InteractionError> {
        let h = view.scene.mesh.cell[..view.grid.shape.axes]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        for pair in self.pairs.iter().filter(|pair| !pair.bonded) {
            let pair = [pair.master, pair.slave];
            let approach = pair
                .map(|body| view.maxima[body].speed_squared.sqrt() * dt)
                .iter()
                .sum::<f64>();
            if approach > h * (1.0 + 1e-9) {
                return Err(Tunnelling {
                    bodies: pair.map(|body| view.bodies[body].id),
                    position: None,
                    approach,
                    distance: h,
                }
                .into());
            }
        }
        Ok(())
    }

    fn friction_changed(&mut self, scene: &Scene, contact: i64) {
        let Some(entry) = scene.contacts.iter().find(|c| c.id == contact) else {
            return;
        };
        for pair in self.pairs.iter_mut().filter(|p| p.id == contact) {
            pair.friction = entry.friction;
        }
    }

    fn nodal_forces(&self, _: &Grid, give: &mut dyn FnMut(usize, usize, Vector, f64)) {
        for meetings in self.met.iter().map(|met| &met.meetings) {
            for meeting in &meetings.nodes {
                for touch in &meetings.touches[meeting.touches.clone()] {
                    let (pair, node) = (&self.pairs[touch.pair], meeting.node);
                    let reaction = touch.force.map(|f| -f);
                    give(pair.master, node, reaction, touch.gap);
                    give(pair.slave, node, touch.force, touch.gap);
                }
            }
        }
    }

    /// Surfaces of bodies, which are found anew in each visit.
    fn take_scratch(&mut self) -> Option<Box<dyn Any + Send + Sync>> {
        Some(Box::new(std::mem::take(&mut self.faces)))
    }

    fn give_scratch(&mut self, scratch: Box<dyn Any + Send + Sync>) {
        if let Ok(faces) = scratch.downcast() {
            self.faces = *faces;
        }
    }

    fn on_slabs<'a>(
        &'a mut self,
        grid: &Grid,
        visit: VelocityMapping,
        give: &mut dyn FnMut(SlabPart<'a>),
    ) {
        self.parts(grid, visit, give);
    }

    /// Adds up the forces of all slabs in order of their planes, and stops where bodies would pass through each other.
    fn settle(
        &mut self,
        update: &mut StepUpdate<'_>,
        _: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        if self.faces.list.is_empty() {
            self.met.clear();
        }
        self.forces.fill([0.0; 3]);
        let mut nodes = 0;
        let mut worst: Option<NodeTunnelling> = None;
        for met in &self.met {
            for of_plane in met.done.forces.chunks_exact(self.pairs.len()) {
                for (sum, force) in self.forces.iter_mut().zip(of_plane) {
                    for axis in 0..3 {
                        sum[axis] += force[axis];
                    }
                }
            }
            nodes += met.done.nodes;
            if let Some(at) = met.done.tunnelling {
                let worse =
                    worst.is_none_or(|w| at.approach * w.distance > w.approach * at.distance);
                worst = if worse { Some(at) } else { worst };
            }
        }
        self.note_overlaps(update);
        worst.map_or(Ok(nodes), |at| {
            Err(self.tunnelling(at, &update.view()).into())
        })
    }

    fn save(&self) -> SavedArrays {
        let near = self.near.iter().map(|&near| f64::from(u8::from(near)));
        vec![
            ("near pairs".into(), near.collect()),
            (
                "forces of pairs".into(),
                self.forces.as_flattened().to_vec(),
            ),
            (
                "depths of overlaps that became events".into(),
                self.noted.clone(),
            ),
        ]
    }

    fn restore(&mut self, saved: &SavedArrays) {
        self.near = saved[0].1.iter().map(|&near| near != 0.0).collect();
        self.forces = saved[1].1.as_chunks().0.to_vec();
        self.noted.clone_from(&saved[2].1);
    }
}

/// The pairs of a scene and its bonds, in order of the identifiers of their bodies. Two bodies whose motion is prescribed cannot
/// act on each other.
pub(super) fn pairs_of(scene: &Scene, bodies: &[BodyRun]) -> Vec<Pair> {
    let index = |id: i64| bodies.iter().position(|b| b.id == id);
    let mut pairs: Vec<Pair> = scene
        .contacts
        .iter()
        .filter_map(|contact| {
            let (master, slave) = (index(contact.master)?, index(contact.slave)?);
            let both = bodies[master].motion.is_some() && bodies[slave].motion.is_some();
            (!both).then(|| pair(scene, bodies, contact, master, slave))
        })
        .chain(bonds::all(scene, bodies))
        .collect();
    pairs.sort_by_key(|pair| {
        let (a, b) = (bodies[pair.master].id, bodies[pair.slave].id);
        (a.min(b), a.max(b))
    });
    pairs
}

fn pair(scene: &Scene, bodies: &[BodyRun], contact: &Contact, master: usize, slave: usize) -> Pair {
    let of_particles: Vector = std::array::from_fn(|axis| {
        bodies[master].particle_half_length[axis] + bodies[slave].particle_half_length[axis]
    });
    let distance = match scene.contact_distance {
        Some(lambda) if lambda > 0.0 => scene.mesh.cell.map(|h| lambda * h),
        _ => of_particles,
    };
    Pair {
        id: contact.id,
        master,
        slave,
        friction: contact.friction,
        normal: contact.normal,
        distance,
        corrects_distance: scene.contact_distance != Some(0.0),
        by_shape: acts_by_shape(scene, bodies, [master, slave])
            || acts_by_shape(scene, bodies, [slave, master]),
        bonded: false,
    }
}

/// True where the first body is driven and its shape acts on the second.
///
/// Nodes do as well where a body stands still and ends on lines of the mesh. With MUSL they do it better: what rests on such a line
/// has its end now before, now behind it, and the node behind comes and goes with each step. With USF, whose strain is that of
/// velocities at the new positions, a block that a shape moves loses energy.
pub(super) fn acts_by_shape(scene: &Scene, bodies: &[BodyRun], pair: [usize; 2]) -> bool {
    let driven = pair[0];
    let within = || bonds::ends_within_cells(scene, bodies, pair);
    bodies[driven].keeps_shape
        && !matches!(scene.bodies[driven].shape, Shape::Particles(_))
        && match scene.scheme {
            StressScheme::Usl => true,
            StressScheme::Musl => !bonds::stands(bodies, driven) || within(),
            StressScheme::Usf => bonds::stands(bodies, driven) && within(),
        }
}

impl Simulation {
    /// Contact force on a body in the last step \[N\]: the sum over its pairs, driven ones among them, and the rigid surfaces. On the two bodies
    /// of a pair that have no other it is the same number with opposite signs.
    #[must_use]
    pub fn contact_force(&self, set: usize) -> Vector {
        let mut sum = self
            .mortar_force(self.model.bodies[set].id)
            .unwrap_or_default();
        let of_shapes = self.shape_force_on(set);
        sum = std::array::from_fn(|axis| sum[axis] + of_shapes[axis]);
        for surface in 0..self.model.scene.surfaces.len() {
            let force = self.surface_force_on(surface, set);
            sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
        }
        if let Some(GridContact { pairs, forces, .. }) = self.interaction() {
            for (pair, force) in pairs.iter().zip(forces) {
                for axis in 0..3 {
                    if pair.slave == set {
                        sum[axis] += force[axis];
                    } else if pair.master == set {
                        sum[axis] -= force[axis];
                    }
                }
            }
        }
        sum
    }

    /// Whether a body is in a pair that can touch, or there are rigid surfaces.
    #[must_use]
    pub fn has_contact(&self, set: usize) -> bool {
        let in_pair = |state: &GridContact| {
            let mut pairs = state.pairs.iter();
            pairs.any(|p| p.master == set || p.slave == set)
        };
        !self.model.scene.surfaces.is_empty()
            || self.interaction().is_some_and(in_pair)
            || self.mortar_force(self.model.bodies[set].id).is_some()
    }

    /// Number of velocity fields beside that of the phase: bodies with a boundary, or near a partner of contact.
    #[must_use]
    pub fn contact_layers(&self) -> usize {
        self.work.grid.fields.len() - 1
    }
}
