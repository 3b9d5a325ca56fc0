//! What contact did: forces, power and warnings of a slab, and what an impulse says of a pair.

use super::{Touched, Touching};
use crate::contact::Pair;
use crate::contact::coulomb::Member;
use crate::scene::Vector;
use crate::stage::solve::PlaneSums;

/// What contact did in a slab.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Done {
    /// Force on the slave of each pair \[N\], plane by plane.
    pub forces: Vec<Vector>,
    /// Power of driven bodies, and what friction and contact along the normal took, plane by plane.
    pub sums: Vec<PlaneSums>,
    /// Number of nodes where a contact force acts.
    pub nodes: usize,
    /// The node where a pair approaches by most over its distance of contact in one step, if by more than that.
    pub tunnelling: Option<Tunnelling>,
}

/// A pair that would pass through itself in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tunnelling {
    /// Index of the pair.
    pub pair: usize,
    /// Storage indices of the node.
    pub at: [usize; 3],
    /// Approach in one step \[m\].
    pub approach: f64,
    /// Distance of contact \[m\].
    pub distance: f64,
}

impl Done {
    /// Nothing is done yet in so many planes.
    pub(super) fn begin(&mut self, planes: usize, pairs: usize) {
        self.forces.clear();
        self.forces.resize(planes * pairs, [0.0; 3]);
        self.sums.clear();
        self.sums.resize(planes, PlaneSums::default());
        (self.nodes, self.tunnelling) = (0, None);
    }

    /// Notes a pair that approaches in one step by more than the distance at which it touches. The velocities before
    /// the step are means of those of particles; trial velocities of light nodes are not.
    pub(super) fn watch(
        &mut self,
        touch: &Touching,
        pair: &Pair,
        [master, slave]: [&Member; 2],
        dt: f64,
        at: [usize; 3],
    ) {
        let before = |m: &Member, axis: usize| m.velocity[axis] - m.increment[axis];
        let approach = dt
            * (0..3)
                .map(|axis| touch.normal[axis] * (before(master, axis) - before(slave, axis)))
                .sum::<f64>();
        let distance = pair.distance_along(&touch.normal);
        let worst = self.tunnelling.map_or(1.0, |t| t.approach / t.distance);
        if approach > worst * distance {
            self.tunnelling = Some(Tunnelling {
                pair: touch.pair,
                at,
                approach,
                distance,
            });
        }
    }
}

/// What an impulse on the slave takes from the kinetic energy of both \[J\], by friction and along the normal: the impulse
/// times the mean of their relative velocities before and after the step, with the sign turned.
pub(super) fn taken(impulse: &Vector, normal: &Vector, [master, slave]: [&Member; 2]) -> [f64; 2] {
    let mean = |m: &Member, axis: usize| m.velocity[axis] - 0.5 * m.increment[axis];
    let relative: Vector = std::array::from_fn(|k| mean(slave, k) - mean(master, k));
    let dot = |a: &Vector, b: &Vector| -> f64 { (0..3).map(|k| a[k] * b[k]).sum() };
    let along = dot(impulse, normal) * dot(normal, &relative);
    [along - dot(impulse, &relative), -along]
}

/// What a pair does under an impulse.
pub(super) fn touched(impulse: &Vector, normal: &Vector, friction: f64) -> Touched {
    let along: f64 = (0..3).map(|k| impulse[k] * normal[k]).sum();
    let aside: f64 = (0..3)
        .map(|k| (impulse[k] - along * normal[k]).powi(2))
        .sum();
    if along <= 0.0 {
        Touched::Open
    } else if aside.sqrt() < friction * along * (1.0 - 1e-9) {
        Touched::Sticks
    } else {
        Touched::Slides
    }
}
