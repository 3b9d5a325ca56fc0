//! The nodes of a field as a condition sees them.

use super::{Remap, StepContext};
use crate::fields::{Owner, Slab, SlabField};
use crate::grid::Line;
use crate::model::Vector;
use crate::stage::solve::{DrivenNode, ExactStepSums, Planes, StepSum, is_ghost};

/// One velocity field in the planes of nodes that one thread owns.
pub struct FieldNodes<'s, 'a> {
    pub(in crate::simulation) slab: &'s mut Slab<'a>,
    /// Number of the field among those of the node.
    pub(in crate::simulation) number: usize,
    pub(in crate::simulation) context: &'s StepContext<'s>,
    /// Sums over the nodes of the slab; those of a second mapping count for nothing.
    pub(in crate::simulation) sums: &'s mut ExactStepSums,
}

impl<'s, 'a> FieldNodes<'s, 'a> {
    /// Place of the body in the scene that has this field to itself; `None` for the field of all others.
    #[must_use]
    pub fn body(&self) -> Option<usize> {
        self.owner().body()
    }

    /// Time over which velocities change \[s\].
    #[must_use]
    pub fn kick(&self) -> f64 {
        self.context.nodal.kick
    }

    /// Time of the velocities after the acceleration \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.context.nodal.half_steps[1]
    }

    /// Calls `act` for every node with mass, in order. What lies beyond a boundary plane with a condition mirrors what
    /// lies inside, and is left out.
    pub fn for_each(&mut self, mut act: impl FnMut(&mut Node<'_>)) {
        let owner = self.owner();
        let (planes, context, sums) = self.parts();
        let walls = context.walls_of(owner);
        let (lane, shape) = (context.lane(), planes.shape);
        let first = planes.range.start * shape.plane_nodes();
        for plane in planes.range.clone() {
            for row in planes.rows.in_plane(plane) {
                let mut power = 0.0;
                for k in planes.rows.span(plane, row) {
                    let at = [plane, row, k];
                    let index = shape.index(at);
                    let line = &mut planes.nodes[index - first];
                    if line[0] > 0.0 && !is_ghost(shape, walls, at) {
                        let local = shape.position(index);
                        let mut node = Node {
                            position: std::array::from_fn(|axis| {
                                local[axis] + context.origin[axis]
                            }),
                            line,
                            lane,
                            free: true,
                            power: 0.0,
                        };
                        act(&mut node);
                        power += node.power;
                    }
                }
                sums.add(StepSum::Power, power);
            }
        }
        if context.remap == Some(Remap::OldPositions) {
            // The planes have the last word, and what lies beyond them follows.
            planes.constrain_remapped(walls);
        }
    }

    pub(in crate::simulation) fn owner(&self) -> Owner {
        self.slab.fields[self.number].owner
    }

    /// Nodes, what is known of the step, and sums.
    pub(in crate::simulation) fn parts(
        &mut self,
    ) -> (&mut Planes<'a>, &'s StepContext<'s>, &mut ExactStepSums) {
        let planes = &mut self.slab.fields[self.number].planes;
        (planes, self.context, self.sums)
    }

    /// Moves nodes as prescribed, and adds the power that it takes.
    pub(in crate::simulation) fn drive(&mut self, nodes: &[DrivenNode]) {
        let (planes, context, sums) = self.parts();
        match context.remap {
            None => {
                planes.add_power_of_driven(nodes, context.nodal.kick, sums);
                planes.drive(nodes, true);
            }
            Some(Remap::OldPositions) => planes.drive_remapped(nodes),
            Some(Remap::NewPositions) => planes.drive(nodes, false),
        }
    }
}

impl StepContext<'_> {
    /// Calls `act` for every node of a slab where two bodies with velocity fields of their own (by their places in the scene)
    /// have mass, with the node of each, in order. What lies beyond a boundary plane with a condition is left out.
    pub fn for_each_shared(
        &self,
        slab: &mut Slab<'_>,
        bodies: [usize; 2],
        mut act: impl FnMut(&mut [Node<'_>; 2]),
    ) {
        let [Some(a), Some(b)] = bodies.map(|body| slab.number_of(body)) else {
            return;
        };
        let Ok(mut fields) = slab.fields.get_disjoint_mut([a, b]) else {
            return;
        };
        let (shape, range) = (fields[0].planes.shape, fields[0].planes.range.clone());
        let first = range.start * shape.plane_nodes();
        let rows = fields[0].planes.rows;
        for (plane, row) in
            range.flat_map(|plane| rows.in_plane(plane).map(move |row| (plane, row)))
        {
            let other = fields[1].planes.rows.span(plane, row);
            for k in fields[0].planes.rows.span(plane, row) {
                let at = [plane, row, k];
                let index = shape.index(at);
                let massless =
                    |field: &&mut SlabField<'_>| field.planes.nodes[index - first][0] <= 0.0;
                if !other.contains(&k)
                    || fields.iter().any(massless)
                    || is_ghost(shape, &self.walls, at)
                {
                    continue;
                }
                let local = shape.position(index);
                let mut nodes = fields.each_mut().map(|field| Node {
                    position: std::array::from_fn(|axis| local[axis] + self.origin[axis]),
                    line: &mut field.planes.nodes[index - first],
                    lane: self.lane(),
                    free: self.prescribed(field.owner).is_none(),
                    power: 0.0,
                });
                act(&mut nodes);
            }
        }
    }
}

/// A node of a velocity field.
pub struct Node<'n> {
    position: Vector,
    line: &'n mut Line,
    /// Lane of its velocity.
    lane: usize,
    /// True if its motion is not prescribed.
    free: bool,
    /// Power that was added \[W\].
    power: f64,
}

impl Node<'_> {
    /// Position in the coordinates of the scene \[m\].
    #[must_use]
    pub fn position(&self) -> Vector {
        self.position
    }

    /// Mass \[kg\].
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.line[0]
    }

    /// Velocity \[m/s\]: before the acceleration half a step before the positions, after it half a step after them.
    #[must_use]
    pub fn velocity(&self) -> Vector {
        std::array::from_fn(|axis| self.line[self.lane + axis])
    }

    /// Sets the velocity \[m/s\], after the acceleration or in a second mapping. The particles feel the change. A node of a
    /// body whose motion is prescribed keeps the velocity that it has.
    pub fn set_velocity(&mut self, velocity: Vector) {
        if !self.free {
            return;
        }
        for axis in 0..3 {
            if self.lane == 1 {
                self.line[4 + axis] += velocity[axis] - self.line[1 + axis];
            }
            self.line[self.lane + axis] = velocity[axis];
        }
    }

    /// Prescribes the velocity \[m/s\] half a step before and half a step after, as that of a boundary plane is: the
    /// particles feel the difference of the two, and nothing of how the node moved instead.
    pub fn prescribe(&mut self, before: Vector, after: Vector) {
        for axis in 0..3 {
            if self.lane == 1 {
                self.line[4 + axis] = after[axis] - before[axis];
            }
            self.line[self.lane + axis] = after[axis];
        }
    }

    /// Change of the velocity over the kick \[m/s\], after the acceleration.
    #[must_use]
    pub fn change(&self) -> Vector {
        std::array::from_fn(|axis| self.line[4 + axis])
    }

    /// Force of stress and of what was added so far \[N\], before the acceleration; without gravity.
    #[must_use]
    pub fn force(&self) -> Vector {
        std::array::from_fn(|axis| self.line[4 + axis])
    }

    /// Adds a force \[N\], before the acceleration.
    pub fn add_force(&mut self, force: Vector) {
        for axis in 0..3 {
            self.line[4 + axis] += force[axis];
        }
    }

    /// Adds a power \[W\] to the work done from outside. In a second mapping and between two fields it is not counted.
    pub fn add_power(&mut self, power: f64) {
        self.power += power;
    }
}
