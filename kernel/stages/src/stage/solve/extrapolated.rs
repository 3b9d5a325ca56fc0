//! Ghost nodes beyond absorbing planes, where the motion goes on linearly.

use super::{Planes, Wall};
use std::ops::Range;

impl Planes<'_> {
    /// Folds these lanes of the ghost nodes of a plane beyond which the motion goes on linearly: twice onto the plane, and once
    /// off the mirror nodes.
    pub(super) fn fold_linearly(&mut self, wall: &Wall, lanes: Range<usize>) {
        let (ghost, _, mirror) = wall.layers(self.shape);
        self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
            let from = nodes[ghost];
            if from[0] == 0.0 {
                return;
            }
            let plane = usize::midpoint(ghost, mirror);
            for lane in lanes.clone() {
                nodes[plane][lane] += 2.0 * from[lane];
                nodes[mirror][lane] -= from[lane];
            }
        });
    }

    /// Gives ghost nodes beyond a plane these lanes as they go on linearly.
    pub(super) fn extrapolate(&mut self, wall: &Wall, lanes: Range<usize>) {
        let (ghost, _, mirror) = wall.layers(self.shape);
        self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
            let plane = usize::midpoint(ghost, mirror);
            for lane in lanes.clone() {
                nodes[ghost][lane] = 2.0 * nodes[plane][lane] - nodes[mirror][lane];
            }
        });
    }
}
