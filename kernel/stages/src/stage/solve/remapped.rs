//! The second mapping of MUSL: momentum and velocity in the upper lanes, beside the velocities of the equation of motion.

use super::{DrivenNode, Planes, Wall, owned};

impl Planes<'_> {
    /// Sets the upper lanes of the active nodes to zero.
    pub fn clear_upper(&mut self) {
        self.for_rows(|row| {
            for node in row {
                node[4..7].fill(0.0);
            }
        });
    }

    /// Velocity of the second mapping of MUSL in the upper lanes: remapped momentum over mass.
    pub fn remapped_velocities(&mut self) {
        self.for_rows(|row| {
            for node in row {
                if node[0] > 0.0 {
                    for c in 4..7 {
                        node[c] /= node[0];
                    }
                }
            }
        });
    }

    /// As [`Planes::constrain`] for the remapped velocity of MUSL in the upper lanes.
    pub fn constrain_remapped(&mut self, walls: &[Wall]) {
        for wall in walls {
            let (ghost, plane, mirror) = wall.layers(self.shape);
            self.for_pairs(wall.axis, plane, plane, |nodes, node, _| {
                for axis in 0..3 {
                    if wall.prescribes(axis) {
                        nodes[node][4 + axis] = wall.after[axis];
                    }
                }
            });
            // The ghosts of earlier walls are filled by now, so corners come out right.
            if wall.extrapolates {
                self.extrapolate(wall, 4..7);
                continue;
            }
            self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                for axis in 0..3 {
                    let v = nodes[mirror][4 + axis];
                    nodes[ghost][4 + axis] = if wall.prescribes(axis) {
                        2.0 * wall.after[axis] - v
                    } else {
                        v
                    };
                }
            });
        }
    }

    /// As [`Planes::fold`] for the remapped momentum of MUSL in the upper lanes. The mass of the mirror nodes was
    /// folded before; a ghost node still holds its own.
    pub fn fold_remapped(&mut self, walls: &[Wall]) {
        for wall in walls {
            let (ghost, _, mirror) = wall.layers(self.shape);
            if wall.extrapolates {
                self.fold_linearly(wall, 4..7);
                continue;
            }
            self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                let from = nodes[ghost];
                for axis in 0..3 {
                    nodes[mirror][4 + axis] += if wall.prescribes(axis) {
                        2.0 * wall.after[axis] * from[0] - from[4 + axis]
                    } else {
                        from[4 + axis]
                    };
                }
            });
        }
    }

    /// As [`Planes::drive`] for the remapped velocity of MUSL in the upper lanes.
    pub fn drive_remapped(&mut self, driven: &[DrivenNode]) {
        let first = self.first();
        for d in owned(driven, |d| d.node, first, self.nodes.len()) {
            self.nodes[d.node - first][4..7].copy_from_slice(&d.after);
        }
    }
}
