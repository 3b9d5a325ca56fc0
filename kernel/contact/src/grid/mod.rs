//! Contact on the grid in the cycle; impulses, normals and gaps of its pairs at a node are in [`pairs`](crate::pairs).
//!
//! - [`faces`]: the surface of a body at the nodes, with the particles near it.
//! - [`contact_nodes`]: the nodes of a slab where bodies meet, and contact there.

mod bonds;
pub(crate) mod contact_nodes;
pub(crate) mod contact_sums;
pub(crate) mod faces;
mod plan_entries;
mod slab_contact;

use crate::kinds::{ContactType, InteractionResult};
use crate::pairs::broad::BodyReach;
use crate::pairs::overlap::overlap;
use crate::pairs::{Pair, Tunnelling, broad};
use crate::values::{Contact, ContactValues, PairValues};
use contact_nodes::{
    ContactNodes, ContactResult, ContactStatuses, DEEP, NodeLists, NodeTunnelling,
};
use contact_sums::{ContactSums, statuses_of_all};
use faces::Faces;
use proctor_geometry::memory::Memory;
use proctor_kernel::model::{CycleSettings, StressScheme, Vector};
use proctor_kernel::simulation::{
    BalanceTraits, BodyList, BodyRun, EventKind, Grid, InitialOverlap, Interaction,
    InteractionError, NodalConditions, NodalForce, PairList, SavedArrays, SetupError, SlabPart,
    StepUpdate, StepView, VelocityMapping,
};
use slab_contact::SharedContact;
use std::any::Any;

/// Contact on the grid.
pub(crate) const GRID: ContactType = ContactType {
    plan_entries: plan_entries::plan_entries,
    make: GridContact::of,
};

/// Contact on the grid: its pairs, and its state from step to step.
#[derive(Clone, Debug, Default)]
pub struct GridContact {
    /// Contacts of the model.
    given: PairValues,
    /// Pairs, and what all slabs share beside them.
    pub(crate) shared: SharedContact,
    /// Surfaces of the bodies of near pairs.
    pub(crate) faces: Faces,
    /// Nodes where bodies met and the action of contact there, per slab, as of the last equation of motion.
    pub(crate) met: Vec<SlabContactState>,
    /// Forces of pairs in the last step, and what else all slabs give together.
    sums: ContactSums,
    /// Depth of the last overlap of each pair that became an event \[m\].
    noted: Vec<f64>,
    /// Contact statuses at the nodes of all ranks, where a sort may have given planes to another rank since (USF).
    carried: Option<ContactStatuses>,
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
    /// A correction of velocities that are mapped a second time feels no force.
    unheeded: ContactResult,
    lists: NodeLists,
}

impl GridContact {
    /// Contact on the grid, where a model has any.
    pub(crate) fn of(
        values: &ContactValues,
        settings: &CycleSettings,
        bodies: &[BodyRun],
        _: &mut Memory,
    ) -> Option<InteractionResult> {
        let given = values.pairs();
        let any =
            !given.contacts.is_empty() || bonds::all(&given, settings, bodies).next().is_some();
        any.then(|| Ok(Box::new(Self::new(given, settings, bodies)) as _))
    }

    fn new(given: PairValues, settings: &CycleSettings, bodies: &[BodyRun]) -> Self {
        let pairs = pairs_of(&given, settings, bodies);
        let count = pairs.len();
        Self {
            given,
            shared: SharedContact {
                pairs,
                near: vec![false; count],
                ..SharedContact::default()
            },
            sums: ContactSums::of_pairs(count),
            noted: vec![0.0; count],
            ..Self::default()
        }
    }

    /// Sets the coefficient of friction of a contact, by its identifier; false where there is none of it.
    pub fn set_friction(&mut self, contact: i64, friction: f64) -> bool {
        let mut contacts = self.given.contacts.iter_mut();
        let Some(entry) = contacts.find(|c| c.id == contact) else {
            return false;
        };
        entry.friction = friction;
        for pair in self.shared.pairs.iter_mut().filter(|p| p.id == contact) {
            pair.friction = friction;
        }
        true
    }

    /// Adds the forces of its pairs on a body in the last step to a sum \[N\].
    pub fn add_force_on(&self, set: usize, sum: &mut Vector) {
        for (pair, force) in self.shared.pairs.iter().zip(&self.sums.forces) {
            for axis in 0..3 {
                if pair.slave == set {
                    sum[axis] += force[axis];
                } else if pair.master == set {
                    sum[axis] -= force[axis];
                }
            }
        }
    }

    /// True for a body in a pair that can touch.
    #[must_use]
    pub fn acts_on(&self, set: usize) -> bool {
        let mut pairs = self.shared.pairs.iter();
        pairs.any(|p| p.master == set || p.slave == set)
    }

    /// Makes an event of each pair that overlaps deeply, and another when the overlap has grown as much.
    fn note_overlaps(&mut self, update: &mut StepUpdate<'_>) {
        let shape = update.grid.shape.clone();
        let least = DEEP
            * (0..shape.axes)
                .map(|k| shape.cell[k])
                .fold(f64::INFINITY, f64::min);
        for (index, pair) in self.shared.pairs.iter().enumerate() {
            let deepest = self.sums.overlaps[index];
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

    /// Keeps the contact statuses of this step before a sort between the two mappings of USF.
    fn keep_statuses(&mut self, view: &StepView<'_>) {
        let usf = view.settings.scheme == StressScheme::Usf;
        let ranks = view.ranks.filter(|_| usf);
        self.carried = ranks.map(|ranks| statuses_of_all(&self.met, ranks));
    }

    fn tunnelling(&self, at: NodeTunnelling, view: &StepView<'_>) -> Tunnelling {
        let pair = &self.shared.pairs[at.pair];
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
    /// Refuses bodies of a pair that overlap.
    fn start(&self, view: &StepView<'_>) -> Result<(), SetupError> {
        let bodies = view.bodies.iter();
        let half_lengths: Vec<Vector> = bodies.map(|b| b.particle_half_length).collect();
        let origin = view.origin();
        // What is bonded may overlap: no gap between them is a condition.
        let pairs = self.shared.pairs.iter().zip(&self.shared.near);
        let near = pairs.filter(|(pair, near)| **near && !pair.bonded);
        let overlapping = near.filter_map(|(pair, _)| {
            let found = overlap(pair, view.particles, &half_lengths)?;
            let mut contacts = self.given.contacts.iter();
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
        self.keep_statuses(view);
        let mut reach = BodyReach::new(view);
        broad::near(&self.shared.pairs, &mut reach, &mut self.shared.near);
    }

    fn not_local(&self) -> Option<&'static str> {
        None
    }

    /// Bodies of near pairs.
    fn owners(&self) -> BodyList {
        let near = self
            .shared
            .pairs
            .iter()
            .zip(&self.shared.near)
            .filter(|(_, near)| **near);
        near.flat_map(|(pair, _)| [pair.master, pair.slave])
            .collect()
    }

    /// Bodies without a pair share their velocity.
    fn apart(&self) -> BodyList {
        BodyList::new()
    }

    fn pairs(&self) -> PairList {
        let pairs = self.shared.pairs.iter();
        pairs.map(|pair| [pair.master, pair.slave]).collect()
    }

    /// Makes surfaces for the bodies of near pairs, in order of the identifier.
    fn fields_given(&mut self, view: &StepView<'_>) {
        let mut bodies = self.owners();
        bodies.sort_by_key(|&i| view.bodies[i].id);
        bodies.dedup();
        self.faces.set(
            &bodies,
            &self.shared.pairs,
            &self.shared.near,
            view,
            &mut self.shared.interfaces,
        );
    }

    /// Pairs of two driven bodies do not act, so the pairs may be others now. No shape begins to act: where it was at the start is
    /// not known.
    fn motion_changed(&mut self, view: &StepView<'_>, _: usize) {
        let before = std::mem::take(&mut self.shared.pairs);
        *self = Self::new(std::mem::take(&mut self.given), view.settings, view.bodies);
        for pair in &mut self.shared.pairs {
            let same = |old: &&Pair| (old.master, old.slave) == (pair.master, pair.slave);
            pair.by_shape &= before.iter().find(same).is_some_and(|old| old.by_shape);
        }
        self.shared
            .pairs
            .retain(|pair| pair.by_shape || !pair.bonded);
        self.shared.near.resize(self.shared.pairs.len(), false);
        self.sums = ContactSums::of_pairs(self.shared.pairs.len());
    }

    /// Refuses a step in which the bodies of a pair could approach by more than a cell: they could pass through each
    /// other without sharing a node. Only a scene that allows unstable steps gets there.
    fn check_time_step(&self, view: &StepView<'_>, dt: f64) -> Result<(), InteractionError> {
        let h = view.settings.mesh.cell[..view.grid.shape.axes]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        for pair in self.shared.pairs.iter().filter(|pair| !pair.bonded) {
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

    fn balance(&self) -> BalanceTraits {
        let any = !self.given.contacts.is_empty();
        BalanceTraits {
            moves_damping: any,
            dissipates: false,
            may_be_stiff: any,
            moves: false,
        }
    }

    fn nodal_forces(&self, _: &Grid, give: &mut dyn FnMut(NodalForce)) {
        for meetings in self.met.iter().map(|met| &met.meetings) {
            for meeting in &meetings.nodes {
                for touch in &meetings.touches[meeting.touches.clone()] {
                    let pair = &self.shared.pairs[touch.pair];
                    let on = |body, force| NodalForce {
                        body,
                        node: meeting.node,
                        force,
                        gap: touch.gap,
                    };
                    give(on(pair.master, touch.force.map(|f| -f)));
                    give(on(pair.slave, touch.force));
                }
            }
        }
    }

    /// Surfaces of bodies, which are found anew in each visit.
    fn take_scratch(&mut self) -> Option<Box<dyn Any + Send + Sync>> {
        let interfaces = std::mem::take(&mut self.shared.interfaces);
        Some(Box::new((std::mem::take(&mut self.faces), interfaces)))
    }

    fn give_scratch(&mut self, scratch: Box<dyn Any + Send + Sync>) {
        if let Ok(scratch) = scratch.downcast() {
            (self.faces, self.shared.interfaces) = *scratch;
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
        let ranks = update.view().ranks.filter(|_| !self.faces.list.is_empty());
        self.sums.sum(self.shared.pairs.len(), &self.met, ranks);
        self.note_overlaps(update);
        match self.sums.tunnelling {
            None => Ok(self.sums.nodes),
            Some(at) => Err(self.tunnelling(at, &update.view()).into()),
        }
    }

    fn save(&self) -> SavedArrays {
        let near = self
            .shared
            .near
            .iter()
            .map(|&near| f64::from(u8::from(near)));
        vec![
            ("near pairs".into(), near.collect()),
            (
                "forces of pairs".into(),
                self.sums.forces.as_flattened().to_vec(),
            ),
            (
                "depths of overlaps that became events".into(),
                self.noted.clone(),
            ),
        ]
    }

    fn restore(&mut self, saved: &SavedArrays) {
        self.shared.near = saved[0].1.iter().map(|&near| near != 0.0).collect();
        self.sums.forces = saved[1].1.as_chunks().0.to_vec();
        self.noted.clone_from(&saved[2].1);
    }
}

/// The pairs of a scene and its bonds, in order of the identifiers of their bodies. Two bodies whose motion is prescribed cannot
/// act on each other.
pub(crate) fn pairs_of(
    given: &PairValues,
    settings: &CycleSettings,
    bodies: &[BodyRun],
) -> Vec<Pair> {
    let index = |id: i64| bodies.iter().position(|b| b.id == id);
    let mut pairs: Vec<Pair> = given
        .contacts
        .iter()
        .filter_map(|contact| {
            let (master, slave) = (index(contact.master)?, index(contact.slave)?);
            let both = bodies[master].motion.is_some() && bodies[slave].motion.is_some();
            (!both).then(|| pair(given, settings, bodies, contact, master, slave))
        })
        .chain(bonds::all(given, settings, bodies))
        .collect();
    pairs.sort_by_key(|pair| {
        let (a, b) = (bodies[pair.master].id, bodies[pair.slave].id);
        (a.min(b), a.max(b))
    });
    pairs
}

fn pair(
    given: &PairValues,
    settings: &CycleSettings,
    bodies: &[BodyRun],
    contact: &Contact,
    master: usize,
    slave: usize,
) -> Pair {
    let of_particles: Vector = std::array::from_fn(|axis| {
        bodies[master].particle_half_length[axis] + bodies[slave].particle_half_length[axis]
    });
    let distance = match given.distance {
        Some(lambda) if lambda > 0.0 => settings.mesh.cell.map(|h| lambda * h),
        _ => of_particles,
    };
    Pair {
        id: contact.id,
        master,
        slave,
        friction: contact.friction,
        normal: contact.normal,
        distance,
        corrects_distance: given.distance != Some(0.0),
        by_shape: acts_by_shape(settings, bodies, [master, slave])
            || acts_by_shape(settings, bodies, [slave, master]),
        bonded: false,
    }
}

/// True where the first body is driven and its shape acts on the second.
///
/// Nodes do as well where a body stands still and ends on lines of the mesh. With MUSL they do it better: what rests on such a line
/// has its end now before, now behind it, and the node behind comes and goes with each step. With USF, whose strain is that of
/// velocities at the new positions, a block that a shape moves loses energy.
pub(crate) fn acts_by_shape(
    settings: &CycleSettings,
    bodies: &[BodyRun],
    pair: [usize; 2],
) -> bool {
    let driven = pair[0];
    let within = || bonds::ends_within_cells(settings, bodies, pair);
    bodies[driven].keeps_shape
        && bodies[driven].shape.has_surface()
        && match settings.scheme {
            StressScheme::Usl => true,
            StressScheme::Musl => !bonds::stands(bodies, driven) || within(),
            StressScheme::Usf => bonds::stands(bodies, driven) && within(),
        }
}
