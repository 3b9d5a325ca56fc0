//! Equation of motion at the nodes and conditions on the boundary planes.
//!
//! Before the solve a node holds mass, momentum and force; after it mass, velocity v_I^(k+1/2) and its
//! increment dv_I. Ghost nodes beyond a sliding plane mirror the body (normal component odd, tangential even),
//! beyond a fixed plane all components are odd about the velocity of the plane, beyond an antisymmetric one the
//! tangential components alone; what particles gave to a ghost
//! node is folded onto its mirror node before the solve, and the ghost gets the mirrored velocity after it. Beyond an
//! absorbing plane the motion goes on linearly, and what a ghost was given is folded by the transpose of that.

mod damped;
mod extrapolated;
mod nodes;
mod remapped;
mod sums;

pub use nodes::{DashpotNode, DrivenNode, EmptyNode, NodeForce};
pub use sums::{ExactStepSums, StepSum, StepSums};

use crate::grid::{ActiveRows, GHOSTS_BELOW, GridShape, Line};
use crate::stage::p2g::{join, join_with_hoop};
use std::ops::Range;

/// A boundary plane with a condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Axis of the normal.
    pub axis: usize,
    /// 0 the lower, 1 the upper plane.
    pub side: usize,
    /// Axes along which it prescribes the velocity.
    pub prescribed: [bool; 3],
    /// True where the motion goes on linearly beyond it: a ghost has twice the velocity of the plane less that of its mirror
    /// node, and gives the plane twice its mass, momentum and force, the mirror node that much less.
    pub extrapolates: bool,
    /// Velocity of the plane half a step before \[m/s\].
    pub before: [f64; 3],
    /// Velocity of the plane half a step after \[m/s\].
    pub after: [f64; 3],
}

impl Wall {
    #[must_use]
    #[inline]
    pub fn prescribes(&self, axis: usize) -> bool {
        self.prescribed[axis]
    }

    /// Storage indices along the direction of the normal: ghost, plane, mirror.
    #[must_use]
    #[inline]
    pub fn layers(&self, shape: &GridShape) -> (usize, usize, usize) {
        plane_layers(shape, self.axis, self.side)
    }
}

/// Storage indices along the normal of a plane of the mesh: beyond it, in it, before it.
#[must_use]
#[inline]
pub fn plane_layers(shape: &GridShape, axis: usize, side: usize) -> (usize, usize, usize) {
    if side == 0 {
        (GHOSTS_BELOW - 1, GHOSTS_BELOW, GHOSTS_BELOW + 1)
    } else {
        let plane = GHOSTS_BELOW + shape.cells[axis];
        (plane + 1, plane, plane - 1)
    }
}

/// The planes of nodes that one visit owns.
pub struct Planes<'a> {
    /// Shape of the grid.
    pub shape: &'a GridShape,
    /// Rows in use.
    pub rows: &'a ActiveRows,
    /// Indices of the planes.
    pub range: Range<usize>,
    /// Their nodes.
    pub nodes: &'a mut [Line],
}

/// Terms of the acceleration of all nodes beside the force on each.
#[derive(Clone, Copy, Debug)]
pub struct Acceleration {
    /// Acceleration of gravity \[m/s²\].
    pub gravity: [f64; 3],
    /// Factor of local damping.
    pub local_damping: Option<f64>,
    /// Time over which velocities change \[s\].
    pub kick: f64,
}

impl Planes<'_> {
    fn first(&self) -> usize {
        self.range.start * self.shape.plane_nodes()
    }

    /// Sets the active nodes to zero.
    #[inline]
    pub fn clear(&mut self) {
        self.for_rows(|row| row.fill([0.0; 8]));
    }

    #[inline(always)]
    pub fn for_rows(&mut self, mut act: impl FnMut(&mut [Line])) {
        for plane in self.range.clone() {
            for row in self.rows.in_plane(plane) {
                let span = self.rows.span(plane, row);
                if !span.is_empty() {
                    let start = ((plane - self.range.start) * self.shape.nodes[1] + row)
                        * self.shape.nodes[2];
                    act(&mut self.nodes[start + span.start..start + span.end]);
                }
            }
        }
    }

    /// Adds both parts of what was mapped to each node in the plane.
    pub fn join(&mut self) {
        self.for_rows(|row| row.iter_mut().for_each(join));
    }

    /// The same with the force of the hoop stress.
    pub fn join_with_hoop(&mut self) {
        self.for_rows(|row| row.iter_mut().for_each(join_with_hoop));
    }

    /// Multiplies what lies in the upper lanes of nodes by their radius, of which the lowest plane of the mesh has `first` \[m\].
    /// Nodes on the axis have that of the middle of the half cell around them.
    pub fn multiply_by_radius(&mut self, first: f64) {
        let h = self.shape.cell[0];
        for plane in self.range.clone() {
            let radius = first + (plane as f64 - GHOSTS_BELOW as f64) * h;
            let radius = radius.abs().max(0.25 * h);
            let nodes = self.shape.plane_nodes();
            let from = (plane - self.range.start) * nodes;
            for node in &mut self.nodes[from..from + nodes] {
                for lane in &mut node[4..] {
                    *lane *= radius;
                }
            }
        }
    }

    /// Folds what lies on ghost nodes onto their mirror nodes: mass and momentum (`lower`), force (`upper`).
    pub fn fold(&mut self, walls: &[Wall], lower: bool, upper: bool) {
        for wall in walls {
            let (ghost, _, mirror) = wall.layers(self.shape);
            if wall.extrapolates {
                self.fold_linearly(wall, if lower { 0 } else { 4 }..if upper { 7 } else { 4 });
                continue;
            }
            self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                let from = nodes[ghost];
                if from[0] == 0.0 {
                    return;
                }
                let to = &mut nodes[mirror];
                if lower {
                    to[0] += from[0];
                    for axis in 0..3 {
                        to[1 + axis] += if wall.prescribes(axis) {
                            2.0 * wall.before[axis] * from[0] - from[1 + axis]
                        } else {
                            from[1 + axis]
                        };
                    }
                }
                if upper {
                    for axis in 0..3 {
                        to[4 + axis] += if wall.prescribes(axis) {
                            -from[4 + axis]
                        } else {
                            from[4 + axis]
                        };
                    }
                }
            });
        }
    }

    /// Gives ghost nodes the mirrored velocity (and increment) of their mirror nodes.
    pub fn unfold(&mut self, walls: &[Wall], increments: bool) {
        for wall in walls.iter().rev() {
            let (ghost, _, mirror) = wall.layers(self.shape);
            if wall.extrapolates {
                self.extrapolate(wall, 1..7);
                continue;
            }
            self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                let from = nodes[mirror];
                let to = &mut nodes[ghost];
                for axis in 0..3 {
                    if wall.prescribes(axis) {
                        let (v, dv) = if increments {
                            (wall.after[axis], wall.after[axis] - wall.before[axis])
                        } else {
                            (wall.after[axis], 0.0)
                        };
                        to[1 + axis] = 2.0 * v - from[1 + axis];
                        to[4 + axis] = 2.0 * dv - from[4 + axis];
                    } else {
                        to[1 + axis] = from[1 + axis];
                        to[4 + axis] = from[4 + axis];
                    }
                }
            });
        }
    }

    /// v_I = p_I / m_I in the lower lanes.
    #[inline]
    pub fn velocities(&mut self) {
        if self.shape.axes == 2 {
            self.divide_by_mass::<2>();
        } else {
            self.divide_by_mass::<3>();
        }
    }

    fn divide_by_mass<const D: usize>(&mut self) {
        self.for_rows(|row| {
            for node in row {
                if node[0] > 0.0 {
                    for c in 1..=D {
                        node[c] /= node[0];
                    }
                }
            }
        });
    }

    /// Adds the nodal loads to the force.
    ///
    /// # Errors
    /// If a loaded node has no mass.
    pub fn load(&mut self, loads: &[NodeForce]) -> Result<(), EmptyNode> {
        let first = self.first();
        let (shape, rows) = (self.shape, self.rows);
        for load in owned(loads, |l| l.node, first, self.nodes.len()) {
            let [plane, row, k] = shape.indices(load.node);
            if !rows.owns(row) {
                continue;
            }
            let node = &mut self.nodes[load.node - first];
            // A node outside the active rows still holds what it had when a particle was near.
            if !rows.span(plane, row).contains(&k) || node[0] <= 0.0 {
                return Err(EmptyNode(load.node));
            }
            for axis in 0..3 {
                node[4 + axis] += load.force[axis];
            }
        }
        Ok(())
    }

    /// v_I += dv_I with dv_I = (f_I/m_I + g) dt, damped (technical manual, algorithm 2, lines 7-11). Adds what local
    /// damping takes to the sums.
    pub fn accelerate(&mut self, by: &Acceleration, sums: &mut ExactStepSums) {
        let (g, dt) = (by.gravity, by.kick);
        match by.local_damping {
            None => self.for_rows(|row| {
                for node in row {
                    if node[0] > 0.0 {
                        let r = 1.0 / node[0];
                        for axis in 0..3 {
                            node[4 + axis] = (node[4 + axis] * r + g[axis]) * dt;
                            node[1 + axis] += node[4 + axis];
                        }
                    }
                }
            }),
            Some(alpha) => self.accelerate_damped(by, alpha, sums),
        }
    }

    /// Prescribes the velocity at the nodes of the walls: half a step after, with its increment; or, before the
    /// solve (`increments` false), the velocity alone.
    pub fn constrain(&mut self, walls: &[Wall], increments: bool) {
        for wall in walls {
            let (_, plane, _) = wall.layers(self.shape);
            self.for_pairs(wall.axis, plane, plane, |nodes, node, _| {
                let node = &mut nodes[node];
                for axis in 0..3 {
                    if wall.prescribes(axis) {
                        node[1 + axis] = wall.after[axis];
                        node[4 + axis] = if increments {
                            wall.after[axis] - wall.before[axis]
                        } else {
                            0.0
                        };
                    }
                }
            });
        }
    }

    /// Adds the power of the reactions of moving walls \[W\], from what the walls are about to change.
    pub fn add_power_of_walls(&mut self, walls: &[Wall], kick: f64, sums: &mut ExactStepSums) {
        for wall in walls.iter().filter(|w| w.after != [0.0; 3] && kick > 0.0) {
            let (ghost, plane, mirror) = wall.layers(self.shape);
            self.for_pairs(wall.axis, plane, plane, |nodes, index, _| {
                for axis in (0..3).filter(|&axis| wall.prescribes(axis)) {
                    let (before, after) = (wall.before[axis], wall.after[axis]);
                    let power = power(&nodes[index], axis, before, after, kick);
                    sums.add(StepSum::Power, power);
                }
            });
            self.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                for axis in (0..3).filter(|&axis| wall.prescribes(axis)) {
                    let pair = (&nodes[ghost], &nodes[mirror]);
                    let way = (wall.before[axis], wall.after[axis]);
                    sums.add(StepSum::Power, power_at_ghost(pair, axis, way, kick));
                }
            });
        }
    }

    /// The same for the nodes of driven bodies, where free bodies push against them.
    pub fn add_power_of_driven(&self, driven: &[DrivenNode], kick: f64, sums: &mut ExactStepSums) {
        let first = self.first();
        if kick > 0.0 {
            for d in owned(driven, |d| d.node, first, self.nodes.len()) {
                let index = d.node - first;
                if !self.rows.owns(self.shape.indices(d.node)[1]) {
                    continue;
                }
                for axis in 0..3 {
                    let node = &self.nodes[index];
                    let power = power(node, axis, d.before[axis], d.after[axis], kick);
                    sums.add(StepSum::Power, power);
                }
            }
        }
    }

    /// Moves the nodes of driven bodies with their prescribed velocity.
    pub fn drive(&mut self, driven: &[DrivenNode], increments: bool) {
        let first = self.first();
        for d in owned(driven, |d| d.node, first, self.nodes.len()) {
            let node = &mut self.nodes[d.node - first];
            for axis in 0..3 {
                node[1 + axis] = d.after[axis];
                node[4 + axis] = if increments {
                    d.after[axis] - d.before[axis]
                } else {
                    d.after[axis]
                };
            }
        }
    }

    /// Adds the power of nodal loads, after the solve.
    #[inline]
    pub fn add_power_of_loads(&self, loads: &[NodeForce], sums: &mut ExactStepSums) {
        let first = self.first();
        for load in owned(loads, |l| l.node, first, self.nodes.len()) {
            if !self.rows.owns(self.shape.indices(load.node)[1]) {
                continue;
            }
            let v = &self.nodes[load.node - first];
            let power = load.force[0] * v[1] + load.force[1] * v[2] + load.force[2] * v[3];
            sums.add(StepSum::Power, power);
        }
    }

    /// Adds kinetic energy and unbalanced force, after a change of velocity over `kick` \[s\], of the mesh nodes, row by
    /// row; ghosts repeat what lies inside.
    pub fn measure(&self, kick: f64, out: &mut ExactStepSums) {
        let is_mesh = |direction: usize, index: usize| {
            self.shape.nodes[direction] == 1
                || (index >= GHOSTS_BELOW
                    && index + crate::grid::GHOSTS_ABOVE < self.shape.nodes[direction])
        };
        let per_kick = if kick > 0.0 { kick * kick } else { 1.0 };
        for plane in self.range.clone().filter(|&plane| is_mesh(0, plane)) {
            for row in self.rows.in_plane(plane).filter(|&row| is_mesh(1, row)) {
                let start =
                    ((plane - self.range.start) * self.shape.nodes[1] + row) * self.shape.nodes[2];
                let (mut kinetic, mut unbalanced_squared) = (0.0, 0.0);
                for k in self.rows.span(plane, row).filter(|&k| is_mesh(2, k)) {
                    let node = &self.nodes[start + k];
                    if node[0] > 0.0 {
                        let v2 = node[1] * node[1] + node[2] * node[2] + node[3] * node[3];
                        let dv2 = node[4] * node[4] + node[5] * node[5] + node[6] * node[6];
                        kinetic += 0.5 * node[0] * v2;
                        unbalanced_squared += node[0] * node[0] * dv2;
                    }
                }
                out.add(StepSum::Kinetic, kinetic);
                out.add(StepSum::UnbalancedSquared, unbalanced_squared / per_kick);
            }
        }
    }

    /// Calls `act(nodes, a, b)` for every active pair of nodes in the layers `a` and `b` of the direction of
    /// an axis that lies in the owned planes.
    #[inline(always)]
    pub fn for_pairs(
        &mut self,
        axis: usize,
        a: usize,
        b: usize,
        mut act: impl FnMut(&mut [Line], usize, usize),
    ) {
        let shape = self.shape;
        let start = |plane: usize, row: usize| {
            ((plane - self.range.start) * shape.nodes[1] + row) * shape.nodes[2]
        };
        let common = |p: Range<usize>, q: Range<usize>| p.start.max(q.start)..p.end.min(q.end);
        match shape.direction(axis) {
            0 => {
                if self.range.contains(&a) && self.range.contains(&b) {
                    for row in common(self.rows.in_plane(a), self.rows.in_plane(b)) {
                        for k in common(self.rows.span(a, row), self.rows.span(b, row)) {
                            act(self.nodes, start(a, row) + k, start(b, row) + k);
                        }
                    }
                }
            }
            1 if !(self.rows.owns(a) && self.rows.owns(b)) => {}
            1 => {
                for plane in self.range.clone() {
                    for k in common(self.rows.span(plane, a), self.rows.span(plane, b)) {
                        act(self.nodes, start(plane, a) + k, start(plane, b) + k);
                    }
                }
            }
            _ => {
                for plane in self.range.clone() {
                    for row in self.rows.in_plane(plane) {
                        let span = self.rows.span(plane, row);
                        if span.contains(&a) && span.contains(&b) {
                            act(self.nodes, start(plane, row) + a, start(plane, row) + b);
                        }
                    }
                }
            }
        }
    }
}

/// True if storage indices are those of a ghost of a wall, which mirrors the inside.
#[must_use]
#[inline]
pub fn is_ghost(shape: &GridShape, walls: &[Wall], at: [usize; 3]) -> bool {
    walls
        .iter()
        .any(|wall| at[shape.direction(wall.axis)] == wall.layers(shape).0)
}

/// The part of `items`, which are in order of their node, that lies on `count` nodes from `first`.
fn owned<T>(items: &[T], node: impl Fn(&T) -> usize, first: usize, count: usize) -> &[T] {
    let begin = items.partition_point(|item| node(item) < first);
    let end = items.partition_point(|item| node(item) < first + count);
    &items[begin..end]
}

/// Power along an axis of a wall that moves its ghosts: a ghost goes with 2 w - v of its mirror node and needs a force for it
/// that its own does not give; at the mirror node, which takes the same force, the inertia of the ghost's own way, 2 m dw, is
/// left out of the equation of motion.
fn power_at_ghost(
    (ghost, mirror): (&Line, &Line),
    axis: usize,
    (before, after): (f64, f64),
    kick: f64,
) -> f64 {
    let change = after - before;
    let short = 2.0 * change - mirror[4 + axis] - ghost[4 + axis];
    2.0 * ghost[0] * (after * short - change * mirror[1 + axis]) / kick
}

/// Power along an axis of the force that changes the velocity increment of a node to `after - before`.
fn power(node: &Line, axis: usize, before: f64, after: f64, kick: f64) -> f64 {
    node[0] * (after - before - node[4 + axis]) / kick * after
}
