//! Passes of a step over its interactions.

use crate::fields::Grid;
use crate::simulation::Cycle;
use crate::simulation::context::{NodalConditions, Remap};
use crate::simulation::interactions::{BalanceTraits, BodyList, Interaction};
use crate::simulation::model::Model;
use crate::simulation::phase::Phase;
use crate::simulation::ranks::Share;
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::values::{Drift, State, StepError, StepErrorKind};
use crate::simulation::work_state::WorkState;
use crate::stage::solve::StepSums;
use std::any::Any;

impl<'a> StepView<'a> {
    /// View of a simulation in parts.
    pub(crate) fn of(
        model: &'a Model,
        state: &'a State,
        grid: &'a Grid,
        share: Option<&'a Share>,
    ) -> Self {
        Self {
            settings: &model.settings,
            bodies: &model.bodies,
            particles: &state.sets,
            maxima: &state.found,
            clock: &state.clock,
            grid,
            base: model.base.as_ref(),
            lanes: model.lanes,
            stencil: state.stencil,
            travel: state.travel,
            mesh_shift: state.mesh_shift,
            ranks: share.map(Share::ranks),
        }
    }
}

impl<'a> StepUpdate<'a> {
    /// View of a simulation in parts.
    pub(crate) fn of(
        model: &'a Model,
        state: &'a mut State,
        grid: &'a mut Grid,
        sums: &'a mut StepSums,
        share: Option<&'a Share>,
    ) -> Self {
        Self {
            grid,
            sums,
            events: &mut state.events,
            settings: &model.settings,
            bodies: &model.bodies,
            particles: &state.sets,
            maxima: &state.found,
            clock: &state.clock,
            base: model.base.as_ref(),
            lanes: model.lanes,
            stencil: state.stencil,
            travel: state.travel,
            mesh_shift: state.mesh_shift,
            ranks: share.map(Share::ranks),
        }
    }
}

impl Cycle {
    /// All interactions.
    pub(crate) fn interactions(&self) -> impl Iterator<Item = &dyn Interaction> {
        self.work.interactions.iter().map(|one| &**one)
    }

    /// Traits of all interactions in the energy balance.
    pub(crate) fn balance_traits(&self) -> BalanceTraits {
        self.interactions()
            .fold(BalanceTraits::default(), |all, one| all.and(one.balance()))
    }

    /// The interaction of a kind, to be changed between two stages.
    pub fn interaction_mut<T: Interaction>(&mut self) -> Option<&mut T> {
        let mut all = self.work.interactions.iter_mut();
        all.find_map(|one| (&mut **one as &mut dyn Any).downcast_mut())
    }

    /// The interaction of a kind, for what it tells of itself.
    #[must_use]
    pub fn interaction<T: Interaction>(&self) -> Option<&T> {
        let mut all = self.interactions();
        all.find_map(|one| (one as &dyn Any).downcast_ref())
    }

    /// The view of this step.
    #[must_use]
    pub fn view(&self) -> StepView<'_> {
        let share = self.work.share.as_ref();
        StepView::of(&self.model, &self.state, &self.work.grid, share)
    }

    /// Calls `act` for each interaction with the view of this step.
    pub(crate) fn each(&mut self, mut act: impl FnMut(&mut dyn Interaction, &StepView<'_>)) {
        let share = self.work.share.as_ref();
        let view = StepView::of(&self.model, &self.state, &self.work.grid, share);
        for one in &mut self.work.interactions {
            act(&mut **one, &view);
        }
    }

    /// After a sort: which bodies need a field of their own.
    pub(crate) fn sorted(&mut self) {
        self.each(Interaction::sorted);
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
        self.each(Interaction::fields_given);
    }

    /// Fields that share their velocity; `owners` have one each, after that of the phase.
    fn join_fields(&mut self, owners: &[usize]) {
        let number = |body: usize| {
            owners
                .iter()
                .position(|&owner| owner == body)
                .map(|at| 1 + at)
        };
        let count = 1 + owners.len() + usize::from(self.work.grid.has_water);
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

    /// True if gaps and forces are sought between the mapping and the choice of the time step.
    pub(crate) fn detects(&self) -> bool {
        self.interactions().any(Interaction::detects)
    }

    /// Contact detection: gaps, forces, and the time steps that they allow.
    pub(crate) fn detect_contact(&mut self) -> Result<(), StepError> {
        if self.detects() {
            let free_step = self.free_step();
            let mut found = Ok(());
            self.each(|one, view| {
                if found.is_ok() {
                    found = one.detect(view, free_step);
                }
            });
            found.map_err(|error| self.error(StepErrorKind::Interaction(error)))?;
            self.work.phase_timer.end(Phase::Contact);
        }
        Ok(())
    }

    /// Interactions act on the velocities of all slabs together, and the sums over the nodes are taken after it where they change
    /// them; the number of nodes or vertices where a contact force acts.
    pub(crate) fn settle(&mut self, nodal: &NodalConditions) -> Result<usize, StepError> {
        let settles = self.interactions().any(Interaction::settles);
        self.exchange_to_settle();
        let WorkState {
            grid,
            interactions,
            sums,
            share,
            ..
        } = &mut self.work;
        let mut update = StepUpdate::of(&self.model, &mut self.state, grid, sums, share.as_ref());
        let all = interactions.iter_mut();
        let touching = all
            .map(|one| one.settle(&mut update, nodal))
            .sum::<Result<usize, _>>();
        let touching = touching.map_err(|error| self.error(StepErrorKind::Interaction(error)))?;
        if settles {
            self.add_settled_sums(nodal);
        }
        Ok(touching)
    }

    /// Sends the nodes that an interaction of another rank reads.
    fn exchange_to_settle(&mut self) {
        let reads = self.interactions().any(Interaction::settles_across_ranks);
        if reads {
            self.exchange_nodes();
        }
    }

    /// The same for velocities that were mapped a second time.
    pub(crate) fn settle_remapped(
        &mut self,
        nodal: &NodalConditions,
        remap: Remap,
    ) -> Result<(), StepError> {
        self.exchange_to_settle();
        let WorkState {
            grid,
            interactions,
            sums,
            share,
            ..
        } = &mut self.work;
        let mut update = StepUpdate::of(&self.model, &mut self.state, grid, sums, share.as_ref());
        let mut all = interactions.iter_mut();
        all.try_for_each(|one| one.settle_remapped(&mut update, nodal, remap))
            .map_err(|error| self.error(StepErrorKind::Interaction(error)))
    }

    /// Moves the boundaries of interactions with the velocities after the equation of motion.
    pub(crate) fn move_boundaries(&mut self, nodal: &NodalConditions, drift: &Drift) {
        if self.detects() {
            self.each(|one, view| one.move_boundaries(view, nodal, drift));
            self.work.phase_timer.end(Phase::Contact);
        }
    }
}
