//! The nodes of a field as a condition sees them.

use crate::grid::Line;
use crate::scene::Vector;
use crate::simulation::fields::{Owner, Slab};
use crate::simulation::interaction::{Again, Now};
use crate::stage::solve::{DrivenNode, PlaneSums, Planes, is_ghost};

/// One velocity field in the planes of nodes that one thread owns.
pub struct FieldNodes<'s, 'a> {
    pub(in crate::simulation) slab: &'s mut Slab<'a>,
    /// Which of its fields.
    pub(in crate::simulation) number: usize,
    pub(in crate::simulation) now: &'s Now<'s>,
    /// The second mapping that the velocities are of, if they are of one.
    pub(in crate::simulation) again: Option<Again>,
    /// Of each plane; none in a second mapping.
    pub(in crate::simulation) sums: &'s mut [PlaneSums],
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
        self.now.acting.kick
    }

    /// Time of the velocities after the acceleration \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.now.acting.half_steps[1]
    }

    /// Calls `act` for every node with mass, in order. What lies beyond a boundary plane with a condition mirrors what
    /// lies inside, and is left out.
    pub fn for_each(&mut self, mut act: impl FnMut(&mut Node<'_>)) {
        let lane = self.again.map_or(1, Again::lane);
        let (planes, now, sums) = self.parts();
        let shape = planes.shape;
        let first = planes.range.start * shape.plane_nodes();
        for (number, plane) in planes.range.clone().enumerate() {
            let mut power = 0.0;
            for row in 0..shape.nodes[1] {
                for k in planes.rows.span(plane, row) {
                    let at = [plane, row, k];
                    let index = shape.index(at);
                    let line = &mut planes.nodes[index - first];
                    if line[0] > 0.0 && !is_ghost(shape, &now.walls, at) {
                        let local = shape.position(index);
                        act(&mut Node {
                            position: std::array::from_fn(|axis| local[axis] + now.origin[axis]),
                            line,
                            lane,
                            power: &mut power,
                        });
                    }
                }
            }
            if let Some(sums) = sums.get_mut(number) {
                sums.power += power;
            }
        }
        if self.again == Some(Again::OldPositions) {
            // The planes have the last word, and what lies beyond them follows.
            let (planes, now, _) = self.parts();
            planes.constrain_remapped(&now.walls);
        }
    }

    pub(in crate::simulation) fn owner(&self) -> Owner {
        self.slab.fields[self.number].owner
    }

    /// Nodes, what is known of the step, and sums.
    pub(in crate::simulation) fn parts(
        &mut self,
    ) -> (&mut Planes<'a>, &'s Now<'s>, &mut [PlaneSums]) {
        let planes = &mut self.slab.fields[self.number].planes;
        (planes, self.now, self.sums)
    }

    /// Moves nodes as prescribed, and adds the power that it takes.
    pub(in crate::simulation) fn drive(&mut self, nodes: &[DrivenNode]) {
        let again = self.again;
        let (planes, now, sums) = self.parts();
        match again {
            None => {
                planes.add_power_of_driven(nodes, now.acting.kick, sums);
                planes.drive(nodes, true);
            }
            Some(Again::OldPositions) => planes.drive_remapped(nodes),
            Some(Again::NewPositions) => planes.drive(nodes, false),
        }
    }
}

/// A node of a velocity field.
pub struct Node<'n> {
    position: Vector,
    line: &'n mut Line,
    /// Where its velocity lies.
    lane: usize,
    power: &'n mut f64,
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

    /// Sets the velocity \[m/s\], after the acceleration or in a second mapping. The particles feel the change.
    pub fn set_velocity(&mut self, velocity: Vector) {
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

    /// By how much the velocity has changed over the kick \[m/s\], after the acceleration.
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

    /// Adds a power \[W\] to the work done from outside. In a second mapping it is not counted.
    pub fn add_power(&mut self, power: f64) {
        *self.power += power;
    }
}
