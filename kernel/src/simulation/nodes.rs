//! Nodal values for output.

use super::Cycle;
use crate::grid::{ActiveRows, GHOSTS_BELOW, Line};
use crate::model::Vector;
use crate::simulation::values::NodalForce;
use std::collections::HashMap;

/// One velocity field at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeValues {
    /// Index of the node in the grid.
    pub node: usize,
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Identifier of the body whose own field this is; `None` for the common field.
    pub body: Option<i64>,
    /// Mass \[kg\].
    pub mass: f64,
    /// Velocity \[m/s\], half a step after the positions from which it was mapped.
    pub velocity: Vector,
    /// Contact force on the body in the last step \[N\], in the common field on all bodies there.
    pub contact_force: Vector,
    /// Smallest distance to a partner of contact less that at which they touch, or smallest gap between an obstacle
    /// and a particle that reaches the node \[m\]; not a number where neither is near or its distance is not looked for.
    pub contact_gap: f64,
}

impl Cycle {
    /// Number of nodes with mass after the last mapping.
    #[must_use]
    pub fn nodes_with_mass(&self) -> usize {
        let mut count = 0;
        for plane in self.work.grid.owned.clone() {
            for row in self.work.grid.block().rows {
                let first = self.work.grid.shape.index([plane, row, 0]);
                count += self.work.grid.fields[0]
                    .rows
                    .span(plane, row)
                    .filter(|&k| {
                        self.fields().any(|(_, rows, lines)| {
                            rows.span(plane, row).contains(&k) && lines[first + k][0] > 0.0
                        })
                    })
                    .count();
            }
        }
        self.join_count(count)
    }

    /// All fields at all nodes with mass as the last step left them, field by field, in order of the node. Ghost nodes
    /// of walls, which mirror what lies inside, are left out. A rank has those of its own planes; ranks that share the simulation
    /// call this at the same time.
    #[must_use]
    pub fn node_values(&self) -> Vec<NodeValues> {
        let touching = self.contact_by_node();
        let mut all = vec![];
        for (body, rows, lines) in self.fields() {
            for plane in self.work.grid.owned.clone() {
                for row in self.work.grid.block().rows {
                    let first = self.work.grid.shape.index([plane, row, 0]);
                    for k in rows.span(plane, row) {
                        let (node, line) = (first + k, &lines[first + k]);
                        if line[0] <= 0.0 || self.is_ghost([plane, row, k]) {
                            continue;
                        }
                        let local = self.work.grid.shape.position(node);
                        let (contact_force, contact_gap) = touching
                            .get(&(body, node))
                            .copied()
                            .unwrap_or(([0.0; 3], f64::NAN));
                        all.push(NodeValues {
                            node,
                            position: std::array::from_fn(|a| local[a] + self.origin()[a]),
                            body: body.map(|b| self.model.bodies[b].id),
                            mass: line[0],
                            velocity: [line[1], line[2], line[3]],
                            contact_force,
                            contact_gap,
                        });
                    }
                }
            }
        }
        all
    }

    /// All fields: the body whose own field it is, rows in use, values.
    pub(super) fn fields(&self) -> impl Iterator<Item = (Option<usize>, &ActiveRows, &[Line])> {
        let fields = self.work.grid.fields.iter();
        fields.map(|field| (field.owner.body(), &field.rows, field.nodes.lines()))
    }

    /// Force and smallest gap by field (its body; `None` for the common one) and node, after the last detection.
    fn contact_by_node(&self) -> HashMap<(Option<usize>, usize), (Vector, f64)> {
        let mut found: HashMap<(Option<usize>, usize), (Vector, f64)> = HashMap::new();
        let own_field = &self.work.own_field;
        let mut add = |one: NodalForce| {
            let field = own_field[one.body].then_some(one.body);
            let at = found
                .entry((field, one.node))
                .or_insert(([0.0; 3], f64::NAN));
            at.0 = std::array::from_fn(|axis| at.0[axis] + one.force[axis]);
            at.1 = at.1.min(one.gap);
        };
        if let Some(forces) = self.nodal_forces_of_ranks() {
            forces.into_iter().for_each(&mut add);
        } else if let Some(forces) = &self.work.forces_of_ranks {
            forces.iter().copied().for_each(&mut add);
        } else {
            for one in self.interactions() {
                one.nodal_forces(&self.work.grid, &mut add);
            }
        }
        found
    }

    /// True if a node lies behind a plane with a condition.
    pub(super) fn is_ghost(&self, at: [usize; 3]) -> bool {
        let shape = &self.work.grid.shape;
        (0..shape.axes).any(|axis| {
            let index = at[shape.direction(axis)];
            let upper = GHOSTS_BELOW + shape.cells[axis];
            let wall = |side| self.model.settings.plane_acts(axis, side);
            (index < GHOSTS_BELOW && wall(0)) || (index > upper && wall(1))
        })
    }
}
