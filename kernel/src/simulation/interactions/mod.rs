//! Interactions between velocity fields, or between them and rigid obstacles.
//!
//! Contact on the grid, mortar contact and rigid surfaces are made by one list, each in a folder of its own; what
//! a library user adds ([`Options::interactions`](super::Options)) comes after them, by the same trait. A scene that has
//! none of a kind has no element of it, and nothing in the cycle asks for it.

use crate::memory::Memory;
use crate::plan::PlanEntries;
use crate::scene::{Scene, Vector};
use crate::simulation::conditions::{Condition, NodalConditions, Walls};
use crate::simulation::error::{InteractionError, SetupError, StepError, StepErrorKind};
use crate::simulation::fields::{Grid, Slab};
use crate::simulation::mapping::ParticleToGrid;
use crate::simulation::phase::Phase;
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::work_state::WorkState;
use crate::simulation::{BodyRun, Drift, Simulation};
use crate::stage::solve::PlaneSums;
use smallvec::SmallVec;
use std::any::Any;
use std::sync::Arc;

/// An interaction between velocity fields, or between them and rigid obstacles.
///
/// A step calls it in this order: [`Interaction::sorted`], [`Interaction::owners`] and [`Interaction::fields_given`] after a
/// sort; [`Interaction::find`] between the mapping and the choice of the time step; [`Interaction::load`] before the
/// equation of motion; slab by slab [`SlabInteraction`] within it; [`Interaction::settle`] when all slabs are done;
/// [`Interaction::advance`] once it is known how far positions move; [`SlabInteraction::correct_remapped`] and
/// [`Interaction::settle_remapped`] where velocities are mapped a second time.
///
/// Slabs are visited at once by several threads, and their number must not change a result: sums go to the planes of a
/// slab, and from there plane by plane.
pub trait Interaction: Any + Send + Sync {
    /// A copy.
    fn boxed(&self) -> Box<dyn Interaction>;

    /// Refuses a scene at its start.
    ///
    /// # Errors
    /// What is wrong with it.
    fn start(&self, _view: &StepView<'_>) -> Result<(), SetupError> {
        Ok(())
    }

    /// Particles have new places.
    fn sorted(&mut self, _view: &StepView<'_>) {}

    /// Bodies that need a velocity field of their own until the next sort, by their places in the scene.
    fn owners(&self) -> BodyList {
        BodyList::new()
    }

    /// Which of them keep a velocity of their own wherever another field is.
    fn apart(&self) -> BodyList {
        self.owners()
    }

    /// Pairs of bodies that keep velocities of their own where they meet. Fields that nothing separates share one.
    fn pairs(&self) -> PairList {
        PairList::new()
    }

    /// All bodies have the fields that were asked for.
    fn fields_given(&mut self, _view: &StepView<'_>) {}

    /// The motion of a body, by its place in the scene, is now prescribed in another way, or no longer.
    fn motion_changed(&mut self, _view: &StepView<'_>, _body: usize) {}

    /// Whether [`Interaction::find`] is to be called: mapping and equation of motion take two visits of the slabs then.
    fn finds(&self) -> bool {
        false
    }

    /// Gaps and forces from the mapped masses, velocities and forces; `free_step` is the step that would be taken now if nothing
    /// interacted \[s\].
    ///
    /// # Errors
    /// Where the step cannot go on.
    fn find(&mut self, _view: &StepView<'_>, _free_step: f64) -> Result<(), InteractionError> {
        Ok(())
    }

    /// Critical time step, as of what was found \[s\].
    fn time_step(&self) -> f64 {
        f64::INFINITY
    }

    /// Time in which a gap closes as far as it may in one step \[s\].
    fn closing_step(&self) -> f64 {
        f64::INFINITY
    }

    /// Refuses a time step \[s\] in which something would pass through something else unseen.
    ///
    /// # Errors
    /// What would.
    fn refuse_leaps(&self, _view: &StepView<'_>, _dt: f64) -> Result<(), InteractionError> {
        Ok(())
    }

    /// Adds forces to those at the nodes.
    fn load(&mut self, _grid: &mut Grid, _scene: &Scene) {}

    /// Gives what acts on each slab of a visit, in their order; nothing where it acts on none.
    fn on_slabs<'a>(
        &'a mut self,
        _grid: &Grid,
        _visit: VelocityMapping,
        _give: &mut dyn FnMut(SlabPart<'a>),
    ) {
    }

    /// Whether [`Interaction::settle`] changes velocities: the sums over the nodes are taken after it then.
    fn settles(&self) -> bool {
        false
    }

    /// Acts on the velocities of all slabs together; the number of nodes or vertices where a force acts.
    ///
    /// # Errors
    /// Where the step cannot go on.
    fn settle(
        &mut self,
        _update: &mut StepUpdate<'_>,
        _nodal: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        Ok(0)
    }

    /// The same for velocities that were mapped a second time.
    ///
    /// # Errors
    /// Where the step cannot go on.
    fn settle_remapped(
        &mut self,
        _update: &mut StepUpdate<'_>,
        _nodal: &NodalConditions,
        _remap: Remap,
    ) -> Result<(), InteractionError> {
        Ok(())
    }

    /// Positions move; called where [`Interaction::finds`].
    fn advance(&mut self, _view: &StepView<'_>, _nodal: &NodalConditions, _drift: &Drift) {}

    /// The coefficient of friction of a contact, by its identifier, is now another in the scene.
    fn friction_changed(&mut self, _scene: &Scene, _contact: i64) {}

    /// Gives force \[N\] and gap \[m\] of each contact at a node in the last step, with the place of the body that it acts on, for
    /// output: `(body, node, force, gap)`.
    fn nodal_forces(&self, _grid: &Grid, _give: &mut dyn FnMut(usize, usize, Vector, f64)) {}

    /// Takes out the memory that each step fills anew, so that a snapshot does not copy it.
    fn take_scratch(&mut self) -> Option<Box<dyn Any + Send + Sync>> {
        None
    }

    /// Has that memory again.
    fn give_scratch(&mut self, _scratch: Box<dyn Any + Send + Sync>) {}

    /// Energy that is stored between the fields \[J\].
    fn energy(&self) -> f64 {
        0.0
    }

    /// Its state from step to step as arrays with names, of lengths that the scene decides.
    fn save(&self) -> SavedArrays {
        vec![]
    }

    /// Takes up what was saved; names and lengths are those that [`Interaction::save`] gives.
    fn restore(&mut self, _saved: &SavedArrays) {}
}

/// Bodies by their places in the scene; few take no memory.
pub type BodyList = SmallVec<[usize; 8]>;

/// Pairs of them.
pub type PairList = SmallVec<[[usize; 2]; 8]>;

/// Saved arrays: lists of numbers with their names.
pub type SavedArrays = Vec<(String, Vec<f64>)>;

/// The action of an interaction on the fields of one slab.
pub trait SlabInteraction: Send {
    /// The masses of all fields are there.
    fn mapped(&mut self, _slab: &mut Slab<'_>, _now: &StepContext<'_>) {}

    /// Corrects the trial velocities and their increments; adds power \[W\] to the sums of the planes.
    fn correct(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>, sums: &mut [PlaneSums]);

    /// Corrects velocities that were mapped again, from which strain is taken.
    fn correct_remapped(&mut self, _slab: &mut Slab<'_>, _now: &StepContext<'_>) {}
}

/// One interaction on one slab in a visit.
pub struct SlabPart<'a>(OfSlab<'a>);

enum OfSlab<'a> {
    Grid(grid::SlabContact<'a>),
    Own(Box<dyn SlabInteraction + 'a>),
}

impl<'a> SlabPart<'a> {
    /// Of an interaction of the user.
    #[must_use]
    pub fn own(part: impl SlabInteraction + 'a) -> Self {
        Self(OfSlab::Own(Box::new(part)))
    }

    pub(super) fn on_slab(&mut self) -> &mut (dyn SlabInteraction + 'a) {
        match &mut self.0 {
            OfSlab::Grid(part) => part,
            OfSlab::Own(part) => &mut **part,
        }
    }
}

/// The context of a visit of all slabs, beside the fields.
pub struct StepContext<'a> {
    pub(super) mapping: ParticleToGrid<'a>,
    pub(super) nodal: &'a NodalConditions,
    pub(super) conditions: &'a [Arc<dyn Condition>],
    /// Lower corner of the mesh in the coordinates of the scene \[m\].
    pub(super) origin: Vector,
    /// Walls, with the velocities of this visit.
    pub(super) walls: Walls,
    /// Velocities half a step before and after of bodies whose motion is prescribed \[m/s\].
    pub(super) prescribed: &'a [Option<[Vector; 2]>],
    /// The second mapping that the velocities are of, if they are of one.
    pub(super) remap: Option<Remap>,
    /// Whether kinetic energy and residual are measured.
    pub(super) measure: bool,
    /// Whether velocities still change when all slabs are done, and sums are taken after that.
    pub(super) settles: bool,
}

impl<'a> StepContext<'a> {
    /// The nodal conditions of this step.
    #[must_use]
    pub fn nodal(&self) -> &'a NodalConditions {
        self.nodal
    }

    /// Offset of the velocity in the node record.
    pub(super) fn lane(&self) -> usize {
        self.remap.map_or(1, Remap::lane)
    }
}

/// The mapping whose velocities a visit changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VelocityMapping {
    /// Those of the equation of motion.
    Trial,
    /// Those that were mapped a second time.
    Remap(Remap),
}

/// The second mapping of velocities (remap), by the positions that it maps from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remap {
    /// From the positions of the first mapping, to the upper lanes of the nodes (MUSL).
    OldPositions,
    /// From the positions at the end of the step, to the lower lanes (USF).
    NewPositions,
}

impl Remap {
    /// The lane of a node where its velocity begins.
    pub(super) fn lane(self) -> usize {
        match self {
            Self::OldPositions => 4,
            Self::NewPositions => 1,
        }
    }
}

/// Interactions, in the order in which they act.
pub(crate) type Interactions = Vec<Box<dyn Interaction>>;

/// An interaction, or why there cannot be one.
pub(super) type InteractionResult = Result<Box<dyn Interaction>, SetupError>;

/// Builds the interaction of a type, where a scene has any.
type InteractionBuilder = fn(&Scene, &[BodyRun], &mut Memory) -> Option<InteractionResult>;

/// A type of interaction, as it stands in a list.
struct InteractionType {
    /// What the plan says of it.
    plan_entries: fn(&Scene, &mut PlanEntries),
    /// How it is made.
    make: InteractionBuilder,
}

/// Kinds of interactions, each in the folder of that name, in the order in which they act.
macro_rules! list {
    ($($folder:ident: $kind:ident,)*) => {
        $(pub(super) mod $folder;)*

        const ALL: &[InteractionType] = &[$($folder::$kind),*];
    };
}

list! {
    grid: GRID,
    mortar: MORTAR,
    surfaces: SURFACES,
}

/// What the plan says of interactions.
pub(crate) fn describe(scene: &Scene, list: &mut PlanEntries) {
    for kind in ALL {
        (kind.plan_entries)(scene, list);
    }
}

/// The interactions of a scene, those of the user after them.
///
/// # Errors
/// A boundary that is none, or surfaces that overlap.
pub(super) fn of(
    scene: &Scene,
    bodies: &[BodyRun],
    own: &[Box<dyn Interaction>],
    memory: &mut Memory,
) -> Result<Interactions, SetupError> {
    let made = ALL
        .iter()
        .filter_map(|kind| (kind.make)(scene, bodies, memory));
    made.chain(own.iter().cloned().map(Ok)).collect()
}

impl Clone for Box<dyn Interaction> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// For each slab what acts there in a visit. Few slabs with one interaction take no memory for their list.
pub(super) type SlabParts<'a> = SmallVec<[SmallVec<[SlabPart<'a>; 1]>; 8]>;

/// Fills the list, which stays empty where nothing acts on slabs.
pub(super) fn on_slabs<'a>(
    interactions: &'a mut Interactions,
    grid: &Grid,
    visit: VelocityMapping,
    parts: &mut SlabParts<'a>,
) {
    for one in interactions {
        let mut slab = 0;
        one.on_slabs(grid, visit, &mut |part| {
            if parts.is_empty() {
                parts.resize_with(grid.slabs.len(), SmallVec::new);
            }
            parts[slab].push(part);
            slab += 1;
        });
    }
}

/// What acts on one slab after the other.
pub(super) fn in_turn<'p, 'a>(
    parts: &'p mut SlabParts<'a>,
) -> impl Iterator<Item = &'p mut [SlabPart<'a>]> + Send {
    let parts = parts.iter_mut().map(|parts| &mut parts[..]);
    parts.chain(std::iter::repeat_with(|| &mut [][..]))
}

impl Simulation {
    /// All interactions.
    pub(super) fn interactions(&self) -> impl Iterator<Item = &dyn Interaction> {
        self.work.interactions.iter().map(|one| &**one)
    }

    /// The interaction of a kind, for what it tells of itself.
    #[must_use]
    pub fn interaction<T: Interaction>(&self) -> Option<&T> {
        let mut all = self.interactions();
        all.find_map(|one| (one as &dyn Any).downcast_ref())
    }

    /// The view of this step.
    pub(crate) fn view(&self) -> StepView<'_> {
        StepView::of(&self.model, &self.state, &self.work.grid)
    }

    /// Calls `act` for each interaction with the view of this step.
    pub(super) fn each(&mut self, mut act: impl FnMut(&mut dyn Interaction, &StepView<'_>)) {
        let view = StepView::of(&self.model, &self.state, &self.work.grid);
        for one in &mut self.work.interactions {
            act(&mut **one, &view);
        }
    }

    /// After a sort: which bodies need a field of their own.
    pub(super) fn sorted(&mut self) {
        self.each(|one, view| one.sorted(view));
        self.set_fields();
    }

    /// Gives each body that needs one its velocity field.
    pub(crate) fn set_fields(&mut self) {
        let mut owners: BodyList = self.interactions().flat_map(Interaction::owners).collect();
        owners.sort_by_key(|&i| self.model.bodies[i].id);
        owners.dedup();
        for (index, own) in self.work.own_field.iter_mut().enumerate() {
            *own = owners.contains(&index);
        }
        self.work
            .grid
            .set_owners(&owners, &self.state.sets, self.state.stencil);
        self.join_fields(&owners);
        self.each(|one, view| one.fields_given(view));
    }

    /// Which fields share their velocity; `owners` have one each, after that of the phase.
    fn join_fields(&mut self, owners: &[usize]) {
        let number = |body: usize| {
            owners
                .iter()
                .position(|&owner| owner == body)
                .map(|at| 1 + at)
        };
        let count = 1 + owners.len();
        let mut joined = std::mem::take(&mut self.work.grid.joined);
        joined.clear();
        joined.resize(count * count, true);
        let mut separate = |a: Option<usize>, b: Option<usize>| {
            if let (Some(a), Some(b)) = (a, b)
                && a != b
            {
                joined[a * count + b] = false;
                joined[b * count + a] = false;
            }
        };
        for one in self.interactions() {
            for body in one.apart() {
                (0..count).for_each(|other| separate(number(body), Some(other)));
            }
            for [a, b] in one.pairs() {
                separate(number(a), number(b));
            }
        }
        self.work.grid.joined = joined;
    }

    /// Whether gaps and forces are sought between the mapping and the choice of the time step.
    pub(super) fn finds(&self) -> bool {
        self.interactions().any(Interaction::finds)
    }

    /// Contact detection: gaps, forces, and the time steps that they allow.
    pub(super) fn detect_contact(&mut self) -> Result<(), StepError> {
        if self.finds() {
            let free_step = self.free_step();
            let mut found = Ok(());
            self.each(|one, view| {
                if found.is_ok() {
                    found = one.find(view, free_step);
                }
            });
            found.map_err(|error| self.error(StepErrorKind::Interaction(error)))?;
            self.work.phase_timer.end(Phase::Contact);
        }
        Ok(())
    }

    /// Interactions act on the velocities of all slabs together, and the sums over the nodes are taken after it where they change
    /// them; the number of nodes or vertices where a contact force acts.
    pub(super) fn settle(&mut self, nodal: &NodalConditions) -> Result<usize, StepError> {
        let settles = self.interactions().any(Interaction::settles);
        let WorkState {
            grid,
            interactions,
            sums,
            ..
        } = &mut self.work;
        let mut update = StepUpdate::of(&self.model, &mut self.state, grid, sums);
        let all = interactions.iter_mut();
        let touching = all
            .map(|one| one.settle(&mut update, nodal))
            .sum::<Result<usize, _>>();
        let touching = touching.map_err(|error| self.error(StepErrorKind::Interaction(error)))?;
        if settles {
            self.add_sums_of_planes(nodal);
        }
        Ok(touching)
    }

    /// The same for velocities that were mapped a second time.
    pub(super) fn settle_remapped(
        &mut self,
        nodal: &NodalConditions,
        remap: Remap,
    ) -> Result<(), StepError> {
        let WorkState {
            grid,
            interactions,
            sums,
            ..
        } = &mut self.work;
        let mut update = StepUpdate::of(&self.model, &mut self.state, grid, sums);
        let mut all = interactions.iter_mut();
        all.try_for_each(|one| one.settle_remapped(&mut update, nodal, remap))
            .map_err(|error| self.error(StepErrorKind::Interaction(error)))
    }

    /// Moves the boundaries of interactions with the velocities after the equation of motion.
    pub(super) fn move_boundaries(&mut self, nodal: &NodalConditions, drift: &Drift) {
        if self.finds() {
            self.each(|one, view| one.advance(view, nodal, drift));
            self.work.phase_timer.end(Phase::Contact);
        }
    }
}
