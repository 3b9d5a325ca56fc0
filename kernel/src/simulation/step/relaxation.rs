//! Kinetic damping: dynamic relaxation to a static solution.

use crate::layout::Layout;
use crate::simulation::Cycle;
use crate::simulation::values::StepInfo;

impl Cycle {
    /// Dynamic relaxation: where the kinetic energy has passed a peak, the drift (negative or zero) that takes
    /// the positions back to it \[s\].
    ///
    /// The energies at t - 3dt/2, t - dt/2 and t + dt/2 define a parabola whose vertex lies in (t - dt, t).
    pub(crate) fn peak_of_kinetic_energy(&mut self, info: &StepInfo) -> Option<f64> {
        if !self.model.plan.kinetic_damping {
            return None;
        }
        let now = self.work.sums.kinetic;
        let [last, earlier] = self.state.kinetic;
        if now >= last || last == 0.0 {
            self.state.kinetic = [now, last];
            return None;
        }
        let curvature = earlier - 2.0 * last + now;
        let vertex = if curvature < 0.0 {
            0.5 * (earlier - now) / curvature
        } else {
            0.0
        };
        self.state.kinetic = [0.0; 2];
        Some((vertex.clamp(-0.5, 0.5) - 0.5) * info.dt)
    }

    /// Sets all velocities to zero, at the time of the positions.
    pub(crate) fn stop_motion(&mut self) {
        self.state.clock.dt_before = 0.0;
        for set in &mut self.state.sets {
            let first = Layout::velocity(set.layout.axes);
            for column in &mut set.columns[first..first + set.layout.axes] {
                column.fill(0.0);
            }
            if let Some(affine) = set.layout.affine {
                for column in &mut set.columns[affine..affine + set.layout.axes.pow(2)] {
                    column.fill(0.0);
                }
            }
        }
    }
}
