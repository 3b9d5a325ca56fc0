//! The nodes of a slab where the fields of bodies meet, and contact there.

mod contact_result;
mod gaps;

use super::faces::SlabFields;
pub(crate) use contact_result::{ContactResult, DEEP, NodeTunnelling, Overlap, RowForce};
use contact_result::{taken, touched};
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::Owner;

use crate::pairs::Pair;
use crate::pairs::coulomb::{Coulomb, FieldTouch, FrictionLaw, Member};
use crate::pairs::interface::Interface;
use crate::pairs::surface::{SurfaceSide, normal};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::stage::solve::{StepSum, Wall, is_ghost};
use proctor_kernel::weights::{Family, round_off_weight};
use smallvec::SmallVec;
use std::ops::Range;

/// Share of the distance of contact within which bodies touch in spite of round-off.
const TOUCHING: f64 = 1e-9;

/// The nodes of a slab where fields meet. A field is known by its number in the slab.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ContactNodes {
    /// The nodes, increasing.
    pub nodes: Vec<ContactNode>,
    /// Numbers of the fields that meet, node by node.
    pub fields: Vec<usize>,
    /// Pairs that meet, node by node.
    pub touches: Vec<NodePair>,
}

/// A node where fields meet.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ContactNode {
    /// Index of the node in the grid.
    pub node: usize,
    /// Places in [`ContactNodes::fields`] of those that meet here.
    pub fields: Range<usize>,
    /// Places in [`ContactNodes::touches`] of those that meet here.
    pub touches: Range<usize>,
}

/// A pair at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NodePair {
    /// Index of the pair.
    pub pair: usize,
    /// Places of master and slave among the fields of the node.
    pub sides: [usize; 2],
    /// Unit normal from master to slave.
    pub normal: Vector,
    /// True if the mass gradients of both are opposite there.
    pub opposite: bool,
    /// Distance of the bodies less that at which they touch \[m\]; not a number where it is not looked for.
    pub gap: f64,
    /// Force on the slave in the last step \[N\].
    pub force: Vector,
    /// Its result in the last step.
    pub state: ContactStatus,
}

/// Contact status of a pair at a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum ContactStatus {
    /// No force acts.
    #[default]
    Open,
    /// The bodies stick.
    Sticks,
    /// The bodies slide.
    Slides,
}

/// Contact statuses of pairs at nodes, in order of node and pair.
pub(crate) type ContactStatuses = Vec<((usize, usize), ContactStatus)>;

/// The scene as contact reads it, beside the fields.
#[derive(Clone, Copy)]
pub(crate) struct Bodies<'a> {
    /// All pairs.
    pub pairs: &'a [Pair],
    /// True for those of them that are near.
    pub near: &'a [bool],
    /// Particles that can reach a node of a partner, for each surface.
    pub interfaces: &'a [Interface],
    /// Particles of all bodies.
    pub sets: &'a [ParticleSet],
    /// Velocities of bodies whose motion is prescribed \[m/s\].
    pub prescribed: &'a [Option<[Vector; 2]>],
    /// Boundary planes with a condition.
    pub walls: &'a [Wall],
    /// Nodes per axis of the stencil.
    pub stencil: usize,
    /// Weighting functions.
    pub family: Family,
}

impl Bodies<'_> {
    /// Largest mass of a field at a node that counts as none \[kg\]: of a driven body that which its particles give by
    /// round-off alone, as every other field there would take its velocity. Between bodies that move freely contact goes
    /// with their masses.
    fn least_mass(&self, owner: Owner) -> f64 {
        let driven = owner.body().filter(|&body| self.prescribed[body].is_some());
        let mass = driven.and_then(|body| self.sets[body].columns[Layout::MASS].first());
        mass.map_or(0.0, |mass| mass * round_off_weight(self.family))
    }
}

/// The velocities that contact acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ContactVelocities {
    /// Trial velocities in the lower lanes and their increments in the upper ones. Forces are those that act over the
    /// time `kick` \[s\]; `dt` is the step by which bodies move \[s\].
    Trial {
        /// Time over which velocities change \[s\].
        kick: f64,
        /// Time step \[s\].
        dt: f64,
        /// Factor of the local damping that is in the increments.
        damping: Option<f64>,
    },
    /// Velocities in the lower lanes, mapped at the new positions (USF), from which strain is taken. They feel no
    /// force: where the pair touched in this step they keep to what it did, elsewhere they are free. To test them for
    /// approach would clip one side of their noise, and strain the bodies until they hover.
    Mapped,
    /// Remapped velocities in the upper lanes (MUSL). As those of USF.
    Remapped,
}

/// Lists that are filled at one node after the other, or for one pair after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeLists {
    coulomb: Coulomb,
    members: Vec<Member>,
    touches: Vec<FieldTouch>,
    impulses: Vec<Vector>,
    /// Range of the touches of a slab that act at a node.
    which: Vec<usize>,
    /// Numbers of the fields of each pair that is near.
    sides: Vec<Option<[usize; 2]>>,
    /// Largest mass of each field at a node that counts as none.
    least: Vec<f64>,
    gaps: gaps::GapLists,
}

impl ContactNodes {
    fn clear(&mut self) {
        self.nodes.clear();
        self.fields.clear();
        self.touches.clear();
    }

    /// Finds the nodes of a slab where fields meet, with the normals and gaps of the pairs. Masses and mass gradients
    /// of the slab must be there, folded.
    pub(crate) fn find(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        lists: &mut NodeLists,
    ) {
        self.clear();
        let shape = fields.shape();
        let pairs = bodies.pairs.iter().zip(bodies.near);
        let sides = pairs.map(|(pair, near)| {
            if !near {
                return None;
            }
            Some([
                fields.slab.number_of(pair.master)?,
                fields.slab.number_of(pair.slave)?,
            ])
        });
        lists.sides.clear();
        lists.sides.extend(sides);
        lists.least.clear();
        let owners = fields.slab.fields.iter().map(|field| field.owner);
        lists
            .least
            .extend(owners.map(|owner| bodies.least_mass(owner)));
        for plane in fields.range() {
            for row in (0..shape.nodes[1]).filter(|row| fields.slab.owns_row(*row)) {
                let Some(span) = shared_span(fields, plane, row) else {
                    continue;
                };
                for k in span {
                    if !is_ghost(shape, bodies.walls, [plane, row, k]) {
                        self.add(fields, bodies, lists, [plane, row, k]);
                    }
                }
            }
        }
        self.measure(fields, bodies, &lists.sides, &mut lists.gaps);
    }

    /// Adds a node, if fields meet there.
    fn add(
        &mut self,
        fields: &SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        NodeLists { sides, least, .. }: &NodeLists,
        at: [usize; 3],
    ) {
        let shape = fields.shape();
        let node = shape.index(at) - fields.range().start * shape.plane_nodes();
        let first = (self.fields.len(), self.touches.len());
        for number in 0..fields.count() {
            if mass(fields, number, at, node) > least[number] {
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
            if bodies.pairs[index].by_shape {
                continue;
            }
            let [Some(m), Some(s)] = numbers.map(|n| present.iter().position(|p| *p == n)) else {
                continue;
            };
            let [Some(master), Some(slave)] = numbers.map(|number| {
                Some(SurfaceSide {
                    mass: mass(fields, number, at, node),
                    surface: &fields.faces[fields.place_of(number)?].lines[node],
                })
            }) else {
                continue;
            };
            let kind = bodies.pairs[index].normal;
            if let Some(found) = normal(kind, &master, &slave, &shape.cell) {
                self.touches.push(NodePair {
                    pair: index,
                    sides: [m, s],
                    normal: found.normal,
                    opposite: found.opposite,
                    gap: f64::NAN,
                    force: [0.0; 3],
                    state: ContactStatus::Open,
                });
            }
        }
        self.nodes.push(ContactNode {
            node: shape.index(at),
            fields: first.0..self.fields.len(),
            touches: first.1..self.touches.len(),
        });
    }

    /// Takes up what pairs did at the same nodes before.
    pub(crate) fn recall(&mut self, states: &ContactStatuses) {
        for meeting in &self.nodes {
            for touch in &mut self.touches[meeting.touches.clone()] {
                let place = (meeting.node, touch.pair);
                let before = states.binary_search_by_key(&place, |(place, _)| *place);
                touch.state = before.map_or(ContactStatus::Open, |at| states[at].1);
            }
        }
    }

    /// Results of pairs at the nodes where a force acted.
    pub(crate) fn states(&self) -> impl Iterator<Item = ((usize, usize), ContactStatus)> {
        self.nodes.iter().flat_map(|meeting| {
            self.touches[meeting.touches.clone()]
                .iter()
                .filter(|touch| touch.state != ContactStatus::Open)
                .map(|touch| ((meeting.node, touch.pair), touch.state))
        })
    }

    /// Joins fields without a pair and lets pairs touch, on one kind of velocity.
    pub(crate) fn act(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        on: ContactVelocities,
        lists: &mut NodeLists,
        done: &mut ContactResult,
    ) {
        let shape = fields.shape();
        let first = fields.range().start * shape.plane_nodes();
        done.begin(bodies.pairs.len());
        let (count, joined) = (fields.count(), fields.slab.joined);
        let is_driven = |owner: Owner| {
            let body = owner.body();
            body.is_some_and(|body| bodies.prescribed[body].is_some())
        };
        let all = fields.slab.fields.iter();
        let driven: SmallVec<[bool; 8]> = all.map(|field| is_driven(field.owner)).collect();
        let lane = if on == ContactVelocities::Remapped {
            4
        } else {
            1
        };
        let NodeLists {
            coulomb,
            members,
            touches,
            impulses,
            which,
            ..
        } = lists;
        for meeting in &self.nodes {
            let numbers = &self.fields[meeting.fields.clone()];
            let node = meeting.node - first;
            members.clear();
            members.extend(numbers.iter().map(|&number| {
                let line = &fields.planes(number).nodes[node];
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
                let law = if let ContactVelocities::Trial { dt, .. } = on {
                    let [a, b] = touch.sides.map(|side| &members[side]);
                    let at = shape.indices(meeting.node);
                    done.watch(touch, pair, [a, b], dt, at);
                    done.watch_overlap(touch, &shape.cell, at);
                    (touch.force, touch.state) = ([0.0; 3], ContactStatus::Open);
                    let near = pair.distance_along(&touch.normal) * TOUCHING;
                    let touching = !pair.corrects_distance || touch.gap <= near;
                    touching.then_some(FrictionLaw::Coulomb(pair.friction))
                } else {
                    match touch.state {
                        ContactStatus::Open => None,
                        ContactStatus::Sticks => Some(FrictionLaw::Stick),
                        ContactStatus::Slides => Some(FrictionLaw::Slide),
                    }
                };
                if let Some(law) = law {
                    which.push(index);
                    touches.push(FieldTouch {
                        master: touch.sides[0],
                        slave: touch.sides[1],
                        normal: touch.normal,
                        law,
                    });
                }
            }
            let is_joined = |i: usize, j: usize| joined[numbers[i] * count + numbers[j]];
            if let ContactVelocities::Trial {
                damping: Some(alpha),
                ..
            } = on
                && coulomb.damp_again(members, is_joined, touches, alpha, impulses)
            {
                for (&number, member) in numbers.iter().zip(&*members) {
                    let line = &mut fields.nodes_mut(number)[node];
                    if !driven[number] {
                        for axis in 0..3 {
                            let change = member.increment[axis] - line[4 + axis];
                            let mean = member.velocity[axis] - 0.5 * member.increment[axis];
                            done.sums.add(StepSum::Damping, -(line[0] * change * mean));
                        }
                    }
                    line[1..4].copy_from_slice(&member.velocity);
                    line[4..7].copy_from_slice(&member.increment);
                }
            }
            coulomb.resolve(members, is_joined, touches, impulses);
            let row = meeting.node / shape.nodes[2];
            if let ContactVelocities::Trial { kick, .. } = on {
                let mut acts = false;
                for (&index, impulse) in which.iter().zip(&*impulses) {
                    let touch = &mut self.touches[index];
                    let friction = bodies.pairs[touch.pair].friction;
                    touch.force = impulse.map(|c| c / kick);
                    touch.state = touched(impulse, &touch.normal, friction);
                    acts |= touch.state != ContactStatus::Open;
                    done.add_force(row, touch.pair, &touch.force);
                    let [friction, impact] = taken(
                        impulse,
                        &touch.normal,
                        touch.sides.map(|side| &members[side]),
                    );
                    done.sums.add(StepSum::Friction, friction);
                    done.sums.add(StepSum::Impact, impact);
                }
                done.nodes += usize::from(acts);
            }
            let by = numbers
                .iter()
                .rposition(|&n| driven[n])
                .map(|by| members[by].velocity);
            for (&number, member) in numbers.iter().zip(&*members) {
                if driven[number] {
                    continue;
                }
                let line = &mut fields.nodes_mut(number)[node];
                for axis in 0..3 {
                    // Not where nothing changes, so that a zero keeps its sign.
                    if line[lane + axis] != member.velocity[axis] {
                        line[lane + axis] = member.velocity[axis];
                    }
                    let change = member.increment[axis] - line[4 + axis];
                    if let ContactVelocities::Trial { kick, .. } = on
                        && change != 0.0
                    {
                        line[4 + axis] = member.increment[axis];
                        // What a driven body does to the others is its power.
                        if let Some(velocity) = by {
                            let power = line[0] * change / kick * velocity[axis];
                            done.sums.add(StepSum::Power, power);
                        }
                    }
                }
            }
        }
    }
}

/// Range from the first to the last node of a row that two fields use.
fn shared_span(fields: &SlabFields<'_, '_, '_>, plane: usize, row: usize) -> Option<Range<usize>> {
    let span = |number: usize| fields.planes(number).rows.span(plane, row);
    (1..fields.count())
        .flat_map(|b| (0..b).map(move |a| (a, b)))
        .map(|(a, b)| {
            let (a, b) = (span(a), span(b));
            a.start.max(b.start)..a.end.min(b.end)
        })
        .filter(|both| !both.is_empty())
        .reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
}

/// Mass of a field at a node; zero outside the rows that the field uses, where old values lie.
fn mass(fields: &SlabFields<'_, '_, '_>, number: usize, at: [usize; 3], node: usize) -> f64 {
    let planes = fields.planes(number);
    if planes.rows.span(at[0], at[1]).contains(&at[2]) {
        planes.nodes[node][0]
    } else {
        0.0
    }
}
