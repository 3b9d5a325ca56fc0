//! Nodes of a frame: they move as the material that is there.

use std::sync::Arc;

use proctor_scene::StressScheme;
use proctor_scene::simulation::{Condition, FieldNodes};

use super::motion::{Moment, Motion, Vector, apply, inverse};
use super::problem::Problem;

/// Nodes whose |A^-1 (x_I - c)| exceeds this along an axis are prescribed \[m\]: beyond the field.
const BEYOND: f64 = 0.56;

/// The condition that a frame moves its nodes. They carry the velocity at the time of the velocities of the material that is
/// there at the time of the positions, A'(t ± dt/2) A(t)^-1 (x_I - c).
pub struct Frame {
    motion: Motion,
    axes: usize,
    /// Time step \[s\].
    dt: f64,
    /// True where velocities that are mapped a second time belong to the positions after the step.
    at_new_positions: bool,
    /// Time by which positions are taken too late \[s\]: 0, but for a test of the mill.
    late: f64,
}

impl Frame {
    /// Frame of a problem with steps of `dt` \[s\].
    #[must_use]
    pub fn new(problem: &Problem, dt: f64) -> Arc<Self> {
        Self::late(problem, dt, 0.0)
    }

    /// The same with positions of another time, so that it is wrong.
    #[must_use]
    pub fn late(problem: &Problem, dt: f64, late: f64) -> Arc<Self> {
        Arc::new(Self {
            motion: problem.motion.clone(),
            axes: problem.axes(),
            dt,
            at_new_positions: problem.method.scheme == StressScheme::Usf,
            late,
        })
    }

    fn prescribe(&self, field: &mut FieldNodes<'_, '_>, positions: f64) {
        let (after, before) = (field.time(), field.time() - field.kick());
        let back = inverse(&self.motion.frame(positions + self.late));
        let [before, after]: [Moment; 2] = [before, after].map(|time| self.motion.at(time));
        let (center, shift, axes) = (self.motion.center, before.shift[1], self.axes);
        field.for_each(|node| {
            let x = node.position();
            let local: Vector =
                std::array::from_fn(|i| if i < axes { x[i] - center[i] } else { 0.0 });
            let x0 = apply(&back, &local);
            if x0[..axes].iter().any(|x| x.abs() > BEYOND) {
                let [before, after] = [&before, &after].map(|moment| {
                    let v = apply(&moment.frame[1], &x0);
                    std::array::from_fn(|i| if i < axes { v[i] + shift[i] } else { 0.0 })
                });
                node.prescribe(before, after);
            }
        });
    }
}

impl Condition for Frame {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        self.prescribe(field, field.time() - 0.5 * self.dt);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        let sign = if self.at_new_positions { 0.5 } else { -0.5 };
        self.prescribe(field, field.time() + sign * self.dt);
    }
}
