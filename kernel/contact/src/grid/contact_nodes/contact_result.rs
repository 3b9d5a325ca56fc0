//! Result of contact on a slab: forces, power and warnings, and the status of a pair that follows from an impulse.

use super::{ContactStatus, NodePair};
use crate::pairs::Pair;
use crate::pairs::coulomb::Member;
use proctor_kernel::model::Vector;
use proctor_kernel::stage::solve::ExactStepSums;

/// The result of contact on a slab.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactResult {
    /// Force on the slave of pairs \[N\], row by row.
    pub forces: Vec<RowForce>,
    /// Power of driven bodies, and what friction and contact along the normal took.
    pub sums: ExactStepSums,
    /// Number of nodes where a contact force acts.
    pub nodes: usize,
    /// The node where a pair approaches by most over its distance of contact in one step, if by more than that.
    pub tunnelling: Option<NodeTunnelling>,
    /// Deepest place of overlap of each pair, if by more than [`DEEP`].
    pub overlaps: Vec<Option<Overlap>>,
}

/// Force of a pair in a row of nodes. Sums over rows are formed in their order, whoever owns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RowForce {
    /// Number of the row among all of the grid.
    pub row: usize,
    /// Index of the pair.
    pub pair: usize,
    /// Force on the slave \[N\].
    pub force: Vector,
}

/// Share of a cell from which an overlap is an event: contact lets bodies into each other by no more than round-off and what
/// a step brings.
pub(crate) const DEEP: f64 = 0.25;

/// A pair whose bodies overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Overlap {
    /// Storage indices of the node.
    pub at: [usize; 3],
    /// Depth \[m\].
    pub depth: f64,
}

/// A pair that would pass through itself in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NodeTunnelling {
    /// Index of the pair.
    pub pair: usize,
    /// Storage indices of the node.
    pub at: [usize; 3],
    /// Approach in one step \[m\].
    pub approach: f64,
    /// Distance of contact \[m\].
    pub distance: f64,
}

impl ContactResult {
    /// Nothing is done yet between so many pairs.
    pub(super) fn begin(&mut self, pairs: usize) {
        self.forces.clear();
        self.sums.clear();
        self.overlaps.clear();
        self.overlaps.resize(pairs, None);
        (self.nodes, self.tunnelling) = (0, None);
    }

    /// Adds the force of a pair at a node of a row; rows come in their order.
    pub(super) fn add_force(&mut self, row: usize, pair: usize, force: &Vector) {
        let before = self.forces.iter().rposition(|one| one.row != row);
        let of_row = &mut self.forces[before.map_or(0, |last| last + 1)..];
        match of_row.iter_mut().find(|one| one.pair == pair) {
            Some(one) => {
                for axis in 0..3 {
                    one.force[axis] += force[axis];
                }
            }
            None => self.forces.push(RowForce {
                row,
                pair,
                force: *force,
            }),
        }
    }

    /// Notes a pair that approaches in one step by more than the distance at which it touches. The velocities before
    /// the step are means of those of particles; trial velocities of light nodes are not.
    pub(super) fn watch(
        &mut self,
        touch: &NodePair,
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
            self.tunnelling = Some(NodeTunnelling {
                pair: touch.pair,
                at,
                approach,
                distance,
            });
        }
    }
}

impl ContactResult {
    /// Notes a pair that overlaps by more than [`DEEP`] of the cell along its normal.
    pub(super) fn watch_overlap(&mut self, touch: &NodePair, cell: &Vector, at: [usize; 3]) {
        let (depth, n) = (-touch.gap, &touch.normal);
        // Most nodes have no overlap at all. Where the gradients are not opposite one body goes around a corner of the other,
        // and what is behind it is no depth.
        if depth > 0.0 && depth.is_finite() && touch.opposite {
            let overlap = &mut self.overlaps[touch.pair];
            let deepest = overlap.map_or(0.0, |o| o.depth);
            let across: f64 = (0..3).map(|axis| (n[axis] * cell[axis]).powi(2)).sum();
            if depth > deepest.max(DEEP * across.sqrt()) {
                *overlap = Some(Overlap { at, depth });
            }
        }
    }
}

/// Energy that an impulse on the slave takes from both \[J\], by friction and along the normal: the impulse
/// times the mean of their relative velocities before and after the step, with the sign turned.
pub(super) fn taken(impulse: &Vector, normal: &Vector, [master, slave]: [&Member; 2]) -> [f64; 2] {
    let mean = |m: &Member, axis: usize| m.velocity[axis] - 0.5 * m.increment[axis];
    let relative: Vector = std::array::from_fn(|k| mean(slave, k) - mean(master, k));
    let dot = |a: &Vector, b: &Vector| -> f64 { (0..3).map(|k| a[k] * b[k]).sum() };
    let along = dot(impulse, normal) * dot(normal, &relative);
    [along - dot(impulse, &relative), -along]
}

/// State of a pair under an impulse.
pub(super) fn touched(impulse: &Vector, normal: &Vector, friction: f64) -> ContactStatus {
    let along: f64 = (0..3).map(|k| impulse[k] * normal[k]).sum();
    let aside: f64 = (0..3)
        .map(|k| (impulse[k] - along * normal[k]).powi(2))
        .sum();
    if along <= 0.0 {
        ContactStatus::Open
    } else if aside.sqrt() < friction * along * (1.0 - 1e-9) {
        ContactStatus::Sticks
    } else {
        ContactStatus::Slides
    }
}
