//! Interactions between velocity fields, or between them and rigid obstacles.
//!
//! The cycle knows an interaction by its trait alone. Contact on the grid, mortar contact and rigid surfaces are in the package
//! `proctor-contact`, and act by the same trait as what a program adds.

use crate::fields::{Grid, Slab};
use crate::grid::Line;
use crate::model::CycleSettings;
use crate::simulation::context::{NodalConditions, Remap, StepContext, VelocityMapping};
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::values::{Drift, InteractionError, NodalForce, SavedArrays, SetupError};
use crate::stage::solve::ExactStepSums;
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
/// Slabs are visited at once by several threads, and their number must not change a result: sums over nodes are exact, so that
/// they may be formed in any order.
pub trait Interaction: InteractionClone + Any + Send + Sync {
    /// Refuses a scene at its start.
    ///
    /// # Errors
    /// If it has a fault.
    fn start(&self, _view: &StepView<'_>) -> Result<(), SetupError> {
        Ok(())
    }

    /// Particles have new places.
    fn sorted(&mut self, _view: &StepView<'_>) {}

    /// Bodies that need a velocity field of their own until the next sort, by their places in the scene.
    fn owners(&self) -> BodyList {
        BodyList::new()
    }

    /// Bodies that keep a velocity of their own wherever another field is.
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
    /// If the step cannot go on.
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
    /// If a body would pass through another unseen.
    fn check_time_step(&self, _view: &StepView<'_>, _dt: f64) -> Result<(), InteractionError> {
        Ok(())
    }

    /// Adds forces to those at the nodes.
    fn add_forces(&mut self, _grid: &mut Grid, _settings: &CycleSettings) {}

    /// Gives what acts on each slab of a visit, in their order; nothing where it acts on none.
    fn on_slabs<'a>(
        &'a mut self,
        _grid: &Grid,
        _visit: VelocityMapping,
        _give: &mut dyn FnMut(SlabPart<'a>),
    ) {
    }

    /// True if [`Interaction::settle`] reads nodes around particles beside the planes of a rank: ranks send each other those nodes
    /// before it, too.
    fn settles_across_ranks(&self) -> bool {
        false
    }

    /// True if [`Interaction::settle`] changes velocities: the sums over the nodes are taken after it then.
    fn settles(&self) -> bool {
        false
    }

    /// Acts on the velocities of all slabs together; the number of nodes or vertices where a force acts.
    ///
    /// # Errors
    /// If the step cannot go on.
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
    /// If the step cannot go on.
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

    /// Its part in the energy balance.
    fn balance(&self) -> BalanceTraits {
        BalanceTraits::default()
    }

    /// The part of a scene that this is, for a refusal, where ranks cannot share it; `None` where they can.
    ///
    /// Ranks can share an interaction that acts on the nodes of a slab by the fields of that slab, and by particles that reach
    /// these nodes. Anything else that it finds must be the same on all ranks: it joins that through [`StepView::ranks`] in
    /// [`Interaction::sorted`], [`Interaction::fields_given`] and [`Interaction::settle`], which all ranks call at the same time.
    fn not_local(&self) -> Option<&'static str> {
        Some("an interaction of a program's own")
    }

    /// Gives the force of each contact at a node in the last step, for output.
    fn nodal_forces(&self, _grid: &Grid, _give: &mut dyn FnMut(NodalForce)) {}

    /// Takes out the memory that each step fills anew, so that a snapshot does not copy it.
    fn take_scratch(&mut self) -> Option<Box<dyn Any + Send + Sync>> {
        None
    }

    /// Takes that memory back.
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

    /// Corrects the trial velocities and their increments; adds power \[W\] to the sums.
    fn correct(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>, sums: &mut ExactStepSums);

    /// Corrects velocities that were mapped again, from which strain is taken.
    fn correct_remapped(&mut self, _slab: &mut Slab<'_>, _now: &StepContext<'_>) {}
}

/// The action of an interaction on the fields of one slab, of what it shares between all slabs. It takes no memory in a step:
/// what it keeps for each slab is lent to it ([`SlabMemory`]).
pub trait SharedSlabInteraction: Sync {
    /// See [`SlabInteraction::mapped`].
    fn mapped(&self, _own: &mut SlabMemory<'_>, _slab: &mut Slab<'_>, _now: &StepContext<'_>) {}

    /// See [`SlabInteraction::correct`].
    fn correct(
        &self,
        own: &mut SlabMemory<'_>,
        slab: &mut Slab<'_>,
        context: &StepContext<'_>,
        sums: &mut ExactStepSums,
    );

    /// See [`SlabInteraction::correct_remapped`].
    fn correct_remapped(
        &self,
        _own: &mut SlabMemory<'_>,
        _slab: &mut Slab<'_>,
        _now: &StepContext<'_>,
    ) {
    }
}

/// Memory of an interaction for one slab.
pub struct SlabMemory<'a> {
    /// Its state, of a type of its own.
    pub state: &'a mut (dyn Any + Send),
    /// Lines that it keeps at the nodes of bodies.
    pub lines: SmallVec<[OwnLines<'a>; 4]>,
}

/// Lines of an interaction at the nodes of one slab, beside those of the field of a body.
pub struct OwnLines<'a> {
    /// Index of the body.
    pub body: usize,
    /// The lines.
    pub lines: &'a mut [Line],
}

/// One interaction on one slab in a visit.
pub struct SlabPart<'a>(OfSlab<'a>);

enum OfSlab<'a> {
    Shared(SharedPart<'a>),
    Own(Box<dyn SlabInteraction + 'a>),
}

/// A shared action with the memory of one slab.
struct SharedPart<'a> {
    action: &'a dyn SharedSlabInteraction,
    own: SlabMemory<'a>,
}

impl SlabInteraction for SharedPart<'_> {
    fn mapped(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        self.action.mapped(&mut self.own, slab, context);
    }

    fn correct(
        &mut self,
        slab: &mut Slab<'_>,
        context: &StepContext<'_>,
        sums: &mut ExactStepSums,
    ) {
        self.action.correct(&mut self.own, slab, context, sums);
    }

    fn correct_remapped(&mut self, slab: &mut Slab<'_>, context: &StepContext<'_>) {
        self.action.correct_remapped(&mut self.own, slab, context);
    }
}

impl<'a> SlabPart<'a> {
    /// Slab part of an action with its own memory, which each visit requests.
    #[must_use]
    pub fn own(part: impl SlabInteraction + 'a) -> Self {
        Self(OfSlab::Own(Box::new(part)))
    }

    /// Slab part of an action that all slabs share, with the memory of this one. It takes no memory.
    #[must_use]
    pub fn shared(action: &'a dyn SharedSlabInteraction, own: SlabMemory<'a>) -> Self {
        Self(OfSlab::Shared(SharedPart { action, own }))
    }

    pub(super) fn on_slab(&mut self) -> &mut (dyn SlabInteraction + 'a) {
        match &mut self.0 {
            OfSlab::Shared(part) => part,
            OfSlab::Own(part) => &mut **part,
        }
    }
}

/// The part of an interaction in the energy balance, for warnings about it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BalanceTraits {
    /// True if it changes velocities that local damping is booked with.
    pub moves_damping: bool,
    /// True if it takes energy that no channel has, or angular momentum.
    pub dissipates: bool,
    /// True if it gives energy where it is too stiff or meets too fast for the step.
    pub may_be_stiff: bool,
    /// True if a part of it moves as prescribed.
    pub moves: bool,
}

impl BalanceTraits {
    /// Traits of two interactions together.
    #[must_use]
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            moves_damping: self.moves_damping || other.moves_damping,
            dissipates: self.dissipates || other.dissipates,
            may_be_stiff: self.may_be_stiff || other.may_be_stiff,
            moves: self.moves || other.moves,
        }
    }
}

/// Interactions, in the order in which they act.
pub type Interactions = Vec<Box<dyn Interaction>>;

impl Clone for Box<dyn Interaction> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}

/// A copy of an interaction of a type that the cycle does not know. Every interaction that is [`Clone`] has it.
pub trait InteractionClone {
    /// A copy.
    fn boxed(&self) -> Box<dyn Interaction>;
}

impl<T: Interaction + Clone> InteractionClone for T {
    fn boxed(&self) -> Box<dyn Interaction> {
        Box::new(self.clone())
    }
}

/// Parts that act in a visit of each slab. Few slabs with one interaction take no memory for their list.
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

/// Interactions that act on one slab after the other.
pub(super) fn in_turn<'p, 'a>(
    parts: &'p mut SlabParts<'a>,
) -> impl Iterator<Item = &'p mut [SlabPart<'a>]> + Send {
    let parts = parts.iter_mut().map(|parts| &mut parts[..]);
    parts.chain(std::iter::repeat_with(|| &mut [][..]))
}
