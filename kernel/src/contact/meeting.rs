//! The nodes of a slab where the fields of bodies meet, and contact there.

use super::Pair;
use super::coulomb::{Coulomb, Member, Touch};
use super::layers::SlabFields;
use super::surface::{Probe, Search, Side, normal};
use crate::grid::GridShape;
use crate::particles::ParticleSet;
use crate::scene::Vector;
use crate::stage::solve::Wall;
use std::ops::Range;

/// Share of the distance of contact within which bodies touch in spite of round-off.
const TOUCHING: f64 = 1e-9;

/// The nodes of a slab where fields meet. A field is known by its number: 0 the common one, then the layers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meetings {
    /// The nodes, increasing.
    pub nodes: Vec<Meeting>,
    /// Numbers of the fields that meet, node by node.
    pub fields: Vec<usize>,
    /// Pairs that meet, node by node.
    pub touches: Vec<Touching>,
}

/// A node where fields meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Index of the node in the slab.
    pub node: usize,
    /// Which of [`Meetings::fields`] meet here.
    pub fields: Range<usize>,
    /// Which of [`Meetings::touches`] meet here.
    pub touches: Range<usize>,
}

/// A pair at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touching {
    /// Index of the pair.
    pub pair: usize,
    /// Places of master and slave among the fields of the node.
    pub sides: [usize; 2],
    /// Unit normal from master to slave.
    pub normal: Vector,
    /// Distance of the bodies less that at which they touch \[m\]; not a number where it is not looked for.
    pub gap: f64,
    /// Force on the slave in the last step \[N\].
    pub force: Vector,
}

/// What contact knows of the scene beside the fields.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    /// All pairs.
    pub pairs: &'a [Pair],
    /// Which of them are near.
    pub near: &'a [bool],
    /// Particles of all bodies.
    pub sets: &'a [ParticleSet],
    /// Whether the motion of a body is prescribed.
    pub driven: &'a [bool],
    /// Boundary planes with a condition.
    pub walls: &'a [Wall],
    /// Nodes per axis of the stencil.
    pub stencil: usize,
}

/// Which velocities contact acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum On {
    /// Trial velocities in the lower lanes and their increments in the upper ones. Forces are those that act over the
    /// time `kick` \[s\]; `dt` is the step by which bodies move \[s\].
    Trial {
        /// Time over which velocities change \[s\].
        kick: f64,
        /// Time step \[s\].
        dt: f64,
    },
    /// Velocities in the lower lanes, mapped at the new positions (USF). No forces: particles do not feel them.
    Mapped,
    /// Remapped velocities in the upper lanes (MUSL). No forces.
    Remapped,
}

/// What contact did in a slab.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Done {
    /// Force on the slave of each pair \[N\], plane by plane.
    pub forces: Vec<Vector>,
    /// Power of driven bodies \[W\], plane by plane.
    pub power: Vec<f64>,
    /// Number of nodes where a contact force acts.
    pub nodes: usize,
    /// The node where a pair approaches by most over its distance of contact in one step, if by more than that.
    pub tunnelling: Option<Tunnelling>,
}

/// A pair that would pass through itself in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tunnelling {
    /// Index of the pair.
    pub pair: usize,
    /// Storage indices of the node.
    pub at: [usize; 3],
    /// Approach in one step \[m\].
    pub approach: f64,
    /// Distance of contact \[m\].
    pub distance: f64,
}

impl Meetings {
    /// Finds the nodes of a slab where fields meet, with the normals and gaps of the pairs. Masses and mass gradients
    /// of the slab must be there, folded.
    #[must_use]
    pub fn find(fields: &mut SlabFields<'_>, bodies: &Bodies<'_>) -> Self {
        let mut found = Self::default();
        let shape = fields.common.shape;
        let sides: Vec<Option<[usize; 2]>> = bodies
            .pairs
            .iter()
            .zip(bodies.near)
            .map(|(pair, near)| {
                let number = |body| fields.layers.iter().position(|l| l.body == body);
                if !near {
                    return None;
                }
                Some([number(pair.master)? + 1, number(pair.slave)? + 1])
            })
            .collect();
        for plane in fields.common.range.clone() {
            for row in 0..shape.nodes[1] {
                let Some(span) = union_of_rows(fields, plane, row) else {
                    continue;
                };
                for k in span {
                    if !is_ghost(shape, bodies.walls, [plane, row, k]) {
                        found.add(fields, bodies, &sides, [plane, row, k]);
                    }
                }
            }
        }
        found.measure(fields, bodies, &sides);
        found
    }

    /// Adds a node, if fields meet there.
    fn add(
        &mut self,
        fields: &SlabFields<'_>,
        bodies: &Bodies<'_>,
        sides: &[Option<[usize; 2]>],
        at: [usize; 3],
    ) {
        let shape = fields.common.shape;
        let node = shape.index(at) - fields.common.range.start * shape.plane_nodes();
        let first = (self.fields.len(), self.touches.len());
        for number in 0..=fields.layers.len() {
            if mass(fields, number, at, node) > 0.0 {
                self.fields.push(number);
            }
        }
        let present = &self.fields[first.0..];
        if present.len() < 2 {
            self.fields.truncate(first.0);
            return;
        }
        for (index, numbers) in sides.iter().enumerate() {
            let Some(numbers) = numbers else { continue };
            let [Some(m), Some(s)] = numbers.map(|n| present.iter().position(|p| *p == n)) else {
                continue;
            };
            let [master, slave] = numbers.map(|number| Side {
                mass: mass(fields, number, at, node),
                surface: &fields.layers[number - 1].surface[node],
            });
            if let Some(normal) = normal(bodies.pairs[index].normal, &master, &slave, &shape.cell) {
                self.touches.push(Touching {
                    pair: index,
                    sides: [m, s],
                    normal,
                    gap: f64::NAN,
                    force: [0.0; 3],
                });
            }
        }
        self.nodes.push(Meeting {
            node,
            fields: first.0..self.fields.len(),
            touches: first.1..self.touches.len(),
        });
    }

    /// Measures the gaps of all pairs whose distance matters.
    fn measure(
        &mut self,
        fields: &mut SlabFields<'_>,
        bodies: &Bodies<'_>,
        sides: &[Option<[usize; 2]>],
    ) {
        let shape = fields.common.shape;
        let search = Search {
            shape,
            planes: fields.common.range.clone(),
            stencil: bodies.stencil,
        };
        let first = search.planes.start * shape.plane_nodes();
        for (index, (pair, numbers)) in bodies.pairs.iter().zip(sides).enumerate() {
            let Some(numbers) = numbers.filter(|_| pair.corrects_distance) else {
                continue;
            };
            let mut own = vec![];
            for meeting in &self.nodes {
                for touch in meeting.touches.clone() {
                    if self.touches[touch].pair == index {
                        own.push((meeting.node, touch));
                    }
                }
            }
            if own.is_empty() {
                continue;
            }
            let reach = [1.0, -1.0].map(|sign| {
                let mut probes: Vec<Probe> = own
                    .iter()
                    .map(|&(node, touch)| {
                        let direction = self.touches[touch].normal.map(|c| sign * c);
                        Probe::new(node, shape.indices(first + node), direction)
                    })
                    .collect();
                let side = if sign > 0.0 { 0 } else { 1 };
                let layer = &mut fields.layers[numbers[side] - 1];
                search.probe(&bodies.sets[layer.body], layer.surface, &mut probes);
                probes
            });
            for (i, &(_, touch)) in own.iter().enumerate() {
                let touch = &mut self.touches[touch];
                // Eq. (8) along one normal: the position of the node drops out.
                let distance = -reach[0][i].reach - reach[1][i].reach;
                touch.gap = distance - pair.distance_along(&touch.normal);
            }
        }
    }

    /// Joins fields without a pair and lets pairs touch, on one kind of velocity.
    pub fn act(&mut self, fields: &mut SlabFields<'_>, bodies: &Bodies<'_>, on: On) -> Done {
        let shape = fields.common.shape;
        let (first_plane, per_plane) = (fields.common.range.start, shape.plane_nodes());
        let planes = fields.common.range.len();
        let mut done = Done {
            forces: vec![[0.0; 3]; planes * bodies.pairs.len()],
            power: vec![0.0; planes],
            ..Done::default()
        };
        let joined = joined_fields(fields, bodies.pairs);
        let count = fields.layers.len() + 1;
        let driven: Vec<bool> = std::iter::once(false)
            .chain(fields.layers.iter().map(|l| bodies.driven[l.body]))
            .collect();
        let lane = if on == On::Remapped { 4 } else { 1 };
        let mut coulomb = Coulomb::default();
        let (mut members, mut touches, mut impulses) = (vec![], vec![], vec![]);
        let mut which = vec![];
        for meeting in &self.nodes {
            let numbers = &self.fields[meeting.fields.clone()];
            members.clear();
            members.extend(numbers.iter().map(|&number| {
                let line = &nodes(fields, number)[meeting.node];
                Member {
                    mass: if driven[number] {
                        f64::INFINITY
                    } else {
                        line[0]
                    },
                    velocity: std::array::from_fn(|axis| line[lane + axis]),
                    increment: std::array::from_fn(|axis| line[4 + axis]),
                }
            }));
            touches.clear();
            which.clear();
            for index in meeting.touches.clone() {
                let touch = &mut self.touches[index];
                let pair = &bodies.pairs[touch.pair];
                if let On::Trial { dt, .. } = on {
                    touch.force = [0.0; 3];
                    let before = |side: usize, axis: usize| {
                        let line = &nodes(fields, numbers[touch.sides[side]])[meeting.node];
                        line[1 + axis] - line[4 + axis]
                    };
                    let approach = dt
                        * (0..3)
                            .map(|axis| touch.normal[axis] * (before(0, axis) - before(1, axis)))
                            .sum::<f64>();
                    let distance = pair.distance_along(&touch.normal);
                    if approach > distance
                        && done
                            .tunnelling
                            .is_none_or(|t| t.approach / t.distance < approach / distance)
                    {
                        done.tunnelling = Some(Tunnelling {
                            pair: touch.pair,
                            at: shape.indices(first_plane * per_plane + meeting.node),
                            approach,
                            distance,
                        });
                    }
                }
                let near = pair.distance_along(&touch.normal) * TOUCHING;
                if !pair.corrects_distance || touch.gap <= near {
                    which.push(index);
                    touches.push(Touch {
                        master: touch.sides[0],
                        slave: touch.sides[1],
                        normal: touch.normal,
                        friction: pair.friction,
                    });
                }
            }
            let is_joined = |i: usize, j: usize| joined[numbers[i] * count + numbers[j]];
            coulomb.resolve(&mut members, is_joined, &touches, &mut impulses);
            let plane = meeting.node / per_plane;
            if let On::Trial { kick, .. } = on {
                let mut acts = false;
                for (&index, impulse) in which.iter().zip(&impulses) {
                    let touch = &mut self.touches[index];
                    touch.force = impulse.map(|c| c / kick);
                    acts |= *impulse != [0.0; 3];
                    let sum = &mut done.forces[plane * bodies.pairs.len() + touch.pair];
                    for axis in 0..3 {
                        sum[axis] += touch.force[axis];
                    }
                }
                done.nodes += usize::from(acts);
            }
            let by = numbers
                .iter()
                .rposition(|&n| driven[n])
                .map(|by| members[by].velocity);
            for (&number, member) in numbers.iter().zip(&members) {
                if driven[number] {
                    continue;
                }
                let line = &mut nodes_mut(fields, number)[meeting.node];
                for axis in 0..3 {
                    // Not where nothing changes, so that a zero keeps its sign.
                    if line[lane + axis] != member.velocity[axis] {
                        line[lane + axis] = member.velocity[axis];
                    }
                    let change = member.increment[axis] - line[4 + axis];
                    if let On::Trial { kick, .. } = on
                        && change != 0.0
                    {
                        line[4 + axis] = member.increment[axis];
                        // What a driven body does to the others is its power.
                        if let Some(velocity) = by {
                            done.power[plane] += line[0] * change / kick * velocity[axis];
                        }
                    }
                }
            }
        }
        done
    }
}

/// Whether two fields share their velocity where they meet: all but the layers of a pair. By numbers, row by row.
fn joined_fields(fields: &SlabFields<'_>, pairs: &[Pair]) -> Vec<bool> {
    let count = fields.layers.len() + 1;
    let mut joined = vec![true; count * count];
    for pair in pairs {
        let number = |body| fields.layers.iter().position(|l| l.body == body);
        if let (Some(m), Some(s)) = (number(pair.master), number(pair.slave)) {
            joined[(m + 1) * count + s + 1] = false;
            joined[(s + 1) * count + m + 1] = false;
        }
    }
    joined
}

/// From the first to the last node of a row that any layer uses.
fn union_of_rows(fields: &SlabFields<'_>, plane: usize, row: usize) -> Option<Range<usize>> {
    fields
        .layers
        .iter()
        .map(|layer| layer.planes.rows.span(plane, row))
        .filter(|span| !span.is_empty())
        .reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
}

/// Whether a node is the ghost of a wall, which mirrors what lies inside.
fn is_ghost(shape: &GridShape, walls: &[Wall], at: [usize; 3]) -> bool {
    walls
        .iter()
        .any(|wall| at[shape.direction(wall.axis)] == wall.layers(shape).0)
}

/// Mass of a field at a node; zero outside the rows that the field uses, where old values lie.
fn mass(fields: &SlabFields<'_>, number: usize, at: [usize; 3], node: usize) -> f64 {
    let planes = match number {
        0 => &fields.common,
        _ => &fields.layers[number - 1].planes,
    };
    if planes.rows.span(at[0], at[1]).contains(&at[2]) {
        planes.nodes[node][0]
    } else {
        0.0
    }
}

fn nodes<'a>(fields: &'a SlabFields<'_>, number: usize) -> &'a [crate::grid::Line] {
    match number {
        0 => fields.common.nodes,
        _ => fields.layers[number - 1].planes.nodes,
    }
}

fn nodes_mut<'a>(fields: &'a mut SlabFields<'_>, number: usize) -> &'a mut [crate::grid::Line] {
    match number {
        0 => fields.common.nodes,
        _ => fields.layers[number - 1].planes.nodes,
    }
}
