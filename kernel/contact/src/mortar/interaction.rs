//! The parts of a step that mortar contact adds.

use super::MortarState;
use super::mirrors::Mirrors;
use super::surface::MovingBoundary;
use crate::NOT_LOCAL;
use proctor_kernel::model::CycleSettings;
use proctor_kernel::simulation::{
    BalanceTraits, BodyList, Drift, Grid, Interaction, InteractionError, NodalConditions,
    SavedArrays, SetupError, StepUpdate, StepView,
};

impl Interaction for MortarState {
    fn not_local(&self) -> Option<&'static str> {
        Some(NOT_LOCAL[0])
    }

    /// Bodies whose boundary moves with a velocity field of their own.
    fn owners(&self) -> BodyList {
        let plane = self.plane.surfaces.iter().filter_map(MovingBoundary::body);
        let space = self.space.surfaces.iter().filter_map(MovingBoundary::body);
        plane.chain(space).collect()
    }

    fn start(&self, view: &StepView<'_>) -> Result<(), SetupError> {
        let origin = view.origin();
        self.plane.refuse_untied(&origin)?;
        self.space.refuse_untied(&origin)
    }

    /// Finds faces, and ties vertices to their particles, before anything has moved.
    fn sorted(&mut self, view: &StepView<'_>) {
        self.plane.find_faces(view);
        self.space.find_faces(view);
        self.plane.tie(view);
        self.space.tie(view);
    }

    fn motion_changed(&mut self, view: &StepView<'_>, body: usize) {
        self.set_carrier(&view.bodies[body], body);
    }

    fn balance(&self) -> BalanceTraits {
        let any = !self.given.contacts.is_empty();
        BalanceTraits {
            moves_damping: false,
            dissipates: any,
            may_be_stiff: any,
            moves: self.plane.surfaces.iter().any(MovingBoundary::moves)
                || self.space.surfaces.iter().any(MovingBoundary::moves),
        }
    }

    fn detects(&self) -> bool {
        true
    }

    /// Weights of the vertices, gaps and forces, and the time step that they allow.
    fn detect(&mut self, view: &StepView<'_>, free_step: f64) -> Result<(), InteractionError> {
        self.meet(view, free_step).map_err(Into::into)
    }

    fn time_step(&self) -> f64 {
        self.time_step
    }

    fn closing_step(&self) -> f64 {
        self.closing_step
    }

    /// Refuses a step in which a gap would close too far at the speed that it closes with now.
    fn check_time_step(&self, view: &StepView<'_>, dt: f64) -> Result<(), InteractionError> {
        let origin = view.origin();
        let in_space = || self.space.closing_too_fast(dt, &origin);
        let found = self.plane.closing_too_fast(dt, &origin).or_else(in_space);
        found.map_or(Ok(()), |fault| Err(fault.into()))
    }

    /// Adds the contact forces to those at the nodes (eq. 56).
    fn add_forces(&mut self, grid: &mut Grid, settings: &CycleSettings) {
        let mirrors = Mirrors::of(settings);
        self.plane.load_nodes(grid, &mirrors);
        self.space.load_nodes(grid, &mirrors);
    }

    /// Adds the power of the contact forces that prescribed boundaries exert.
    fn settle(
        &mut self,
        update: &mut StepUpdate<'_>,
        nodal: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        let [_, half_step] = nodal.half_steps;
        update.sums.power +=
            self.plane.power_of_prescribed(half_step) + self.space.power_of_prescribed(half_step);
        Ok(self.plane.under_pressure() + self.space.under_pressure())
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    fn move_boundaries(&mut self, view: &StepView<'_>, nodal: &NodalConditions, drift: &Drift) {
        let [_, half_step] = nodal.half_steps;
        self.plane.advance(view, drift, half_step);
        self.space.advance(view, drift, half_step);
    }

    /// Energy that the normal laws store.
    fn energy(&self) -> f64 {
        self.plane.energy() + self.space.energy()
    }

    fn save(&self) -> SavedArrays {
        let mut saved = self.plane.save();
        saved.extend(self.space.save());
        saved
    }

    fn restore(&mut self, saved: &SavedArrays) {
        let mut lists = saved.iter();
        self.plane.restore(&mut lists);
        self.space.restore(&mut lists);
    }
}
