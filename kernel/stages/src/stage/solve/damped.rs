//! Damping at the nodes, and what it takes.
//!
//! A force that acts over the kick changes the kinetic energy of a node by its impulse times the mean of the velocities
//! before and after: summed over all forces that is the change of m v²/2 exactly. So what damping takes is the mean
//! velocity times its impulse, with the sign turned.

use super::{Acceleration, DrivenNode, ExactStepSums, Planes, StepSum, Wall, is_ghost, owned};
use crate::grid::Line;

/// Increment of the velocity of a node along an axis under local damping \[m/s\], and what the damping takes \[J\].
#[inline(always)]
fn damped(node: &Line, r: f64, axis: usize, by: &Acceleration, alpha: f64) -> (f64, f64) {
    let a = node[4 + axis] * r + by.gravity[axis];
    let v = node[1 + axis];
    let resisted = if v == 0.0 {
        a
    } else {
        a - alpha * a.abs() * v.signum()
    };
    let dv = resisted * by.kick;
    (dv, node[0] * (a - resisted) * by.kick * (v + 0.5 * dv))
}

impl Planes<'_> {
    /// [`Planes::accelerate`] with local damping.
    pub(super) fn accelerate_damped(
        &mut self,
        by: &Acceleration,
        alpha: f64,
        sums: &mut ExactStepSums,
    ) {
        for plane in self.range.clone() {
            for row in self.rows.in_plane(plane) {
                let mut taken = 0.0;
                let start =
                    ((plane - self.range.start) * self.shape.nodes[1] + row) * self.shape.nodes[2];
                let span = self.rows.span(plane, row);
                for node in &mut self.nodes[start + span.start..start + span.end] {
                    if node[0] > 0.0 {
                        let r = 1.0 / node[0];
                        for axis in 0..3 {
                            let (dv, loss) = damped(node, r, axis, by, alpha);
                            node[4 + axis] = dv;
                            node[1 + axis] += dv;
                            taken += loss;
                        }
                    }
                }
                sums.add(StepSum::Damping, taken);
            }
        }
    }

    /// Takes out of the sums what local damping will take where a velocity is prescribed, by a boundary plane or at the
    /// nodes of `lists`: nothing, since another velocity takes its place. Ghost nodes repeat what lies inside, and count
    /// for nothing either. Before [`Planes::accelerate`].
    pub fn leave_out_prescribed(
        &self,
        by: &Acceleration,
        walls: &[Wall],
        lists: [&[DrivenNode]; 2],
        sums: &mut ExactStepSums,
    ) {
        let Some(alpha) = by.local_damping else {
            return;
        };
        let prescribes = |wall: &Wall, at: [usize; 3], axis: usize| {
            let (ghost, plane, _) = wall.layers(self.shape);
            let layer = at[self.shape.direction(wall.axis)];
            layer == ghost || (layer == plane && wall.prescribes(axis))
        };
        let by_walls = |at, axis| walls.iter().any(|wall| prescribes(wall, at, axis));
        let mut leave_out = |at: [usize; 3], axis: usize| {
            let node = &self.nodes[self.shape.index(at) - self.first()];
            if node[0] > 0.0 {
                let (_, loss) = damped(node, 1.0 / node[0], axis, by, alpha);
                sums.add(StepSum::Damping, -loss);
            }
        };
        for (number, wall) in walls.iter().enumerate() {
            let (ghost, plane, _) = wall.layers(self.shape);
            for layer in [ghost, plane] {
                self.for_layer(wall.axis, layer, |at| {
                    let earlier = &walls[..number];
                    for axis in (0..3).filter(|axis| prescribes(wall, at, *axis)) {
                        if !earlier.iter().any(|wall| prescribes(wall, at, axis)) {
                            leave_out(at, axis);
                        }
                    }
                });
            }
        }
        for list in lists {
            for driven in owned(list, |d| d.node, self.first(), self.nodes.len()) {
                let at = self.shape.indices(driven.node);
                let in_use = self.rows.span(at[0], at[1]).contains(&at[2]);
                if in_use && self.rows.owns(at[1]) {
                    (0..3)
                        .filter(|axis| !by_walls(at, *axis))
                        .for_each(|axis| leave_out(at, axis));
                }
            }
        }
    }

    /// Adds what viscous damping with `rate` \[1/s\] took over `kick` \[s\]: at a node its force was -rate m v, with the
    /// velocity before (Liang et al. 2024, eq. 20).
    pub fn add_viscous(&self, rate: f64, kick: f64, walls: &[Wall], sums: &mut ExactStepSums) {
        for plane in self.range.clone() {
            for row in self.rows.in_plane(plane) {
                let mut taken = 0.0;
                for k in self.rows.span(plane, row) {
                    let at = [plane, row, k];
                    let node = &self.nodes[self.shape.index(at) - self.first()];
                    if node[0] > 0.0 && !is_ghost(self.shape, walls, at) {
                        for axis in 0..3 {
                            let (v, dv) = (node[1 + axis], node[4 + axis]);
                            taken += node[0] * (v - dv) * (v - 0.5 * dv);
                        }
                    }
                }
                sums.add(StepSum::Damping, rate * kick * taken);
            }
        }
    }

    /// Calls `act` for the storage indices of every active node in a layer of the direction of an axis that lies in the
    /// owned planes.
    fn for_layer(&self, axis: usize, layer: usize, mut act: impl FnMut([usize; 3])) {
        let direction = self.shape.direction(axis);
        for plane in self.range.clone() {
            if direction == 0 && plane != layer {
                continue;
            }
            for row in self.rows.in_plane(plane) {
                if direction == 1 && row != layer {
                    continue;
                }
                let span = self.rows.span(plane, row);
                if direction == 2 {
                    if span.contains(&layer) {
                        act([plane, row, layer]);
                    }
                } else {
                    span.for_each(|k| act([plane, row, k]));
                }
            }
        }
    }
}
