//! The parts of a step that mortar contact adds.

use super::MortarState;
use super::mirrors::Mirrors;
use super::surface::MovingBoundary;
use crate::scene::Scene;
use crate::simulation::conditions::NodalConditions;
use crate::simulation::error::{SetupError, StepError};
use crate::simulation::fields::Grid;
use crate::simulation::interactions::{BodyList, Interaction, SavedArrays};
use crate::simulation::{Drift, Simulation};

impl Interaction for MortarState {
    fn boxed(&self) -> Box<dyn Interaction> {
        Box::new(self.clone())
    }

    /// Bodies whose boundary moves with a velocity field of their own.
    fn owners(&self) -> BodyList {
        let plane = self.plane.surfaces.iter().filter_map(MovingBoundary::body);
        let space = self.space.surfaces.iter().filter_map(MovingBoundary::body);
        plane.chain(space).collect()
    }

    fn start(&self, simulation: &Simulation) -> Result<(), SetupError> {
        let origin = simulation.origin();
        self.plane.refuse_untied(&origin)?;
        self.space.refuse_untied(&origin)
    }

    /// Finds faces, and ties vertices to their particles, before anything has moved.
    fn sorted(&mut self, simulation: &Simulation) {
        self.plane.find_faces(simulation);
        self.space.find_faces(simulation);
        self.plane.tie(simulation);
        self.space.tie(simulation);
    }

    fn motion_changed(&mut self, simulation: &Simulation, body: usize) {
        self.set_carrier(
            &simulation.model.scene,
            &simulation.model.bodies[body],
            body,
        );
    }

    fn finds(&self) -> bool {
        true
    }

    /// Weights of the vertices, gaps and forces, and the time step that they allow.
    fn find(&mut self, simulation: &Simulation) -> Result<(), StepError> {
        self.meet(simulation).map_err(|kind| simulation.error(kind))
    }

    fn time_step(&self) -> f64 {
        self.time_step
    }

    fn closing_step(&self) -> f64 {
        self.closing_step
    }

    /// Refuses a step in which a gap would close too far at the speed that it closes with now.
    fn refuse_leaps(&self, simulation: &Simulation, dt: f64) -> Result<(), StepError> {
        let origin = simulation.origin();
        let in_space = || self.space.closing_too_fast(dt, &origin);
        let found = self.plane.closing_too_fast(dt, &origin).or_else(in_space);
        found.map_or(Ok(()), |kind| Err(simulation.error(kind)))
    }

    /// Adds the contact forces to those at the nodes (eq. 56).
    fn load(&mut self, grid: &mut Grid, scene: &Scene) {
        let mirrors = Mirrors::of(scene);
        self.plane.load_nodes(grid, &mirrors);
        self.space.load_nodes(grid, &mirrors);
    }

    /// Adds the power of the contact forces that prescribed boundaries exert.
    fn settle(
        &mut self,
        simulation: &mut Simulation,
        nodal: &NodalConditions,
    ) -> Result<usize, StepError> {
        let [_, half_step] = nodal.half_steps;
        simulation.work.sums.power +=
            self.plane.power_of_prescribed(half_step) + self.space.power_of_prescribed(half_step);
        Ok(self.plane.under_pressure() + self.space.under_pressure())
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    fn advance(&mut self, simulation: &Simulation, nodal: &NodalConditions, drift: &Drift) {
        let [_, half_step] = nodal.half_steps;
        self.plane.advance(simulation, drift, half_step);
        self.space.advance(simulation, drift, half_step);
    }

    /// What the normal laws store.
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
