//! The parts of a step that mortar contact adds.

use super::MortarState;
use super::boundaries::Hosts;
use super::surface::Mirrors;
use crate::scene::PlaneCondition;
use crate::simulation::Simulation;
use crate::simulation::error::StepError;
use crate::simulation::fields::Grid;

impl MortarState {
    /// Adds the contact forces to those at the nodes (eq. 56).
    pub(in crate::simulation) fn load_nodes(&self, grid: &mut Grid) {
        self.plane.load_nodes(grid);
        self.space.load_nodes(grid);
    }

    /// Power of the contact forces that prescribed boundaries exert, with their velocities at a time \[W\].
    pub(in crate::simulation) fn power_of_prescribed(&self, half_step: f64) -> f64 {
        self.plane.power_of_prescribed(half_step) + self.space.power_of_prescribed(half_step)
    }
}

impl Simulation {
    /// Weights of the vertices, gaps and forces, and the time step that they allow.
    pub(in crate::simulation) fn meet_boundaries(&mut self) -> Result<(), StepError> {
        let time = self.clock.time;
        let mut state = std::mem::take(&mut self.mortar);
        let met = state.meet(&self.hosts(), time);
        self.mortar = state;
        met.map_err(|kind| self.error(kind))
    }

    /// What boundaries need to know of the bodies that carry them.
    fn hosts(&self) -> Hosts<'_> {
        let mesh = &self.scene.mesh;
        Hosts {
            grid: &self.grid,
            sets: &self.sets,
            bodies: &self.bodies,
            stencil: self.stencil,
            mirrors: Mirrors {
                planes: mesh
                    .planes
                    .map(|sides| sides.map(|condition| condition != PlaneCondition::Free)),
                cells: mesh.cells,
            },
            origin: self.origin(),
        }
    }

    /// Refuses a step in which a gap would close too far at the speed that it closes with now.
    pub(in crate::simulation) fn refuse_fast_closing(&self, dt: f64) -> Result<(), StepError> {
        let (state, origin) = (&self.mortar, self.origin());
        let in_space = || state.space.closing_too_fast(dt, &origin);
        let found = state.plane.closing_too_fast(dt, &origin).or_else(in_space);
        found.map_or(Ok(()), |kind| Err(self.error(kind)))
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    pub(in crate::simulation) fn move_vertices(&mut self, drift: f64, half_step: f64) {
        let mut state = std::mem::take(&mut self.mortar);
        let hosts = self.hosts();
        state.plane.advance(&hosts, drift, half_step);
        state.space.advance(&hosts, drift, half_step);
        self.mortar = state;
    }
}
