//! Interactions between velocity fields, or between them and rigid obstacles.
//!
//! Contact on the grid, mortar contact and rigid surfaces are made by one list, each in a folder of its own; what
//! a library user adds ([`Options::interactions`](super::Options)) comes after them, by the same trait. A scene that has
//! none of a kind has no element of it, and nothing in the cycle asks for it.

use crate::memory::Memory;
use crate::plan::PlanEntries;
use crate::scene::{Scene, Vector};
use crate::simulation::context::{NodalConditions, Remap, StepContext, VelocityMapping};
use crate::simulation::fields::{Grid, Slab};
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::values::{BodyRun, Drift, InteractionError, SavedArrays, SetupError};
use crate::stage::solve::PlaneSums;
use smallvec::SmallVec;
use std::any::Any;

/// An interaction between velocity fields, or between them and rigid obstacles.
///
/// A step calls it in this order: [`Interaction::sorted`], [`Interaction::owners`] and [`Interaction::fields_given`] after a
/// sort; [`Interaction::detect`] between the mapping and the choice of the time step; [`Interaction::add_forces`] before the
/// equation of motion; slab by slab [`SlabInteraction`] within it; [`Interaction::settle`] when all slabs are done;
/// [`Interaction::move_boundaries`] once it is known how far positions move; [`SlabInteraction::correct_remapped`] and
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

    /// True if [`Interaction::detect`] is to be called: mapping and equation of motion take two visits of the slabs then.
    fn detects(&self) -> bool {
        false
    }

    /// Gaps and forces from the mapped masses, velocities and forces; `free_step` is the step that would be taken now if nothing
    /// interacted \[s\].
    ///
    /// # Errors
    /// Where the step cannot go on.
    fn detect(&mut self, _view: &StepView<'_>, _free_step: f64) -> Result<(), InteractionError> {
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
    fn check_time_step(&self, _view: &StepView<'_>, _dt: f64) -> Result<(), InteractionError> {
        Ok(())
    }

    /// Adds forces to those at the nodes.
    fn add_forces(&mut self, _grid: &mut Grid, _scene: &Scene) {}

    /// Gives what acts on each slab of a visit, in their order; nothing where it acts on none.
    fn on_slabs<'a>(
        &'a mut self,
        _grid: &Grid,
        _visit: VelocityMapping,
        _give: &mut dyn FnMut(SlabPart<'a>),
    ) {
    }

    /// True if [`Interaction::settle`] changes velocities: the sums over the nodes are taken after it then.
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

    /// Positions move; called where [`Interaction::detects`].
    fn move_boundaries(&mut self, _view: &StepView<'_>, _nodal: &NodalConditions, _drift: &Drift) {}

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

    /// Numbers per entry of a saved array whose count of entries changes from step to step; `None` for a fixed length.
    fn entry_length(&self, _name: &str) -> Option<usize> {
        None
    }

    /// Takes up what was saved; names and lengths are those that [`Interaction::save`] gives.
    fn restore(&mut self, _saved: &SavedArrays) {}
}

/// Bodies by their places in the scene; few take no memory.
pub type BodyList = SmallVec<[usize; 8]>;

/// Pairs of them.
pub type PairList = SmallVec<[[usize; 2]; 8]>;

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
