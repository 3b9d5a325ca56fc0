//! The impulse of a force of contact, step by step.

use proctor_scene::simulation::Simulation;

/// Impulse of a force and its moment about time zero. The force is that at the positions before a step; it kicks velocities from
/// half step to half step.
pub struct Impulse {
    /// Impulse \[N s\].
    pub total: f64,
    /// Integral of force times time \[N s²\].
    moment: f64,
    /// Time of the velocities and of the positions before the step \[s\].
    before: [f64; 2],
}

impl Impulse {
    /// None yet, of a simulation before a step.
    pub fn of(simulation: &Simulation) -> Self {
        Self {
            total: 0.0,
            moment: 0.0,
            before: [simulation.velocity_time(), simulation.time()],
        }
    }

    /// Adds the force of a step \[N\], after it: the time at which it acted, and that for which it did \[s\].
    pub fn add(&mut self, simulation: &Simulation, force: f64) -> (f64, f64) {
        let [kicked, at] = self.before;
        let kick = simulation.velocity_time() - kicked;
        self.total += force * kick;
        self.moment += force * kick * at;
        self.before = [simulation.velocity_time(), simulation.time()];
        (at, kick)
    }

    /// Duration of contact: twice the centroid of the force, which ringing behind its front does not move \[s\].
    pub fn duration(&self) -> f64 {
        2.0 * self.moment / self.total
    }
}
