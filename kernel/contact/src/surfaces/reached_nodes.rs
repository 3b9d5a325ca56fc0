//! The nodes that touching particles reach.

use super::fields::Fields;
use crate::surfaces::touch::{SurfaceTouches, TouchedNode, Weight};
use proctor_kernel::grid::GridShape;
use proctor_kernel::simulation::{NodalConditions, NodeWeights};
use proctor_kernel::stage::solve::Wall;
use std::ops::Range;

/// Place of a node in the list of reached nodes, by field and node. Of an earlier list nothing is cleared: an entry holds the
/// number of the list that it belongs to.
#[derive(Clone, Debug, Default)]
pub(super) struct NodeNumbers {
    list: u32,
    places: Vec<Vec<(u32, u32)>>,
}

impl NodeNumbers {
    /// Begins a list.
    pub(super) fn begin<'a>(&'a mut self, touches: &'a mut SurfaceTouches) -> ReachedNodes<'a> {
        touches.clear();
        self.list = self.list.wrapping_add(1);
        if self.list == 0 {
            self.places.clear();
            self.list = 1;
        }
        ReachedNodes {
            touches,
            known: self,
        }
    }
}

/// A list of reached nodes that grows.
pub(super) struct ReachedNodes<'a> {
    pub(super) touches: &'a mut SurfaceTouches,
    known: &'a mut NodeNumbers,
}

impl ReachedNodes<'_> {
    /// Adds the nodes of a particle of a field to the lists, with weights for each component of the velocity, those of ghosts
    /// at the nodes inside the mesh whose velocity they have, increasing by node; where they stand.
    pub(super) fn reach(
        &mut self,
        shape: &GridShape,
        nodal: &NodalConditions,
        fields: &Fields<'_>,
        field: usize,
        weights: &NodeWeights,
    ) -> Range<usize> {
        let start = self.touches.weights.len();
        if touches_a_wall(shape, &nodal.walls, weights) {
            let mut folded = [(0, [0.0; 4]); NodeWeights::MOST];
            let count = fold(shape, &nodal.walls, weights, &mut folded);
            for &(node, w) in &folded[..count] {
                let place = self.place(shape, nodal, fields, [field, node]);
                self.touches.weights.push((place, w));
            }
        } else {
            for &(node, w) in weights.iter() {
                let place = self.place(shape, nodal, fields, [field, node]);
                self.touches.weights.push((place, [w, w, w, 0.0]));
            }
        }
        start..self.touches.weights.len()
    }

    /// The place of a node of a field in the list, at its end where it was not reached before.
    fn place(
        &mut self,
        shape: &GridShape,
        nodal: &NodalConditions,
        fields: &Fields<'_>,
        [field, node]: [usize; 2],
    ) -> usize {
        let NodeNumbers { list, places } = &mut *self.known;
        if places.len() <= field {
            places.resize(field + 1, vec![]);
        }
        if places[field].is_empty() {
            places[field].resize(shape.nodes.iter().product(), (0, 0));
        }
        let (known_in, place) = &mut places[field][node];
        if *known_in != *list {
            let new = add(self.touches, shape, nodal, fields, [field, node]);
            (*known_in, *place) = (*list, new as u32);
        }
        *place as usize
    }
}

/// The place of a node that its field did not reach before.
fn add(
    touches: &mut SurfaceTouches,
    shape: &GridShape,
    nodal: &NodalConditions,
    fields: &Fields<'_>,
    [field, node]: [usize; 2],
) -> usize {
    let SurfaceTouches { nodes, others, .. } = touches;
    let start = others.len();
    let lowest = fields.sharing([field, node], others);
    if others.len() > start {
        // Another body may have been there whose field moves together with this one.
        let same = |t: &TouchedNode| {
            t.node == node && t.field == lowest && others[t.others.clone()] == others[start..]
        };
        if let Some(place) = nodes.iter().position(same) {
            others.truncate(start);
            return place;
        }
    }
    let line = &fields.lines(lowest)[node];
    nodes.push(TouchedNode {
        node,
        velocity: [line[1], line[2], line[3]],
        increment: [line[4], line[5], line[6]],
        mobility: mobility(shape, nodal, node, fields, (lowest, &others[start..])),
        change: [0.0; 4],
        field: lowest,
        others: start..others.len(),
    });
    nodes.len() - 1
}

/// True if nodes lie beside a wall, where some may be ghosts.
fn touches_a_wall(shape: &GridShape, walls: &[Wall], weights: &NodeWeights) -> bool {
    let (Some(&(first, _)), Some(&(last, _))) = (weights.first(), weights.last()) else {
        return false;
    };
    // The corners of the box in which all of them lie.
    let (first, last) = (shape.indices(first), shape.indices(last));
    walls.iter().any(|wall| {
        let direction = shape.direction(wall.axis);
        (first[direction]..=last[direction]).contains(&wall.layers(shape).0)
    })
}

/// The weights of nodes with those of ghosts at the nodes inside the mesh whose velocity they have, increasing by node, and
/// how many they are.
fn fold(
    shape: &GridShape,
    walls: &[Wall],
    weights: &NodeWeights,
    folded: &mut [Weight; NodeWeights::MOST],
) -> usize {
    let mut count = 0;
    for &(ghost, w) in weights.iter() {
        let (node, [x, y, z]) = inside(shape, walls, ghost);
        // After all that are not behind it, so that sums are in the order of the nodes that were there before.
        let at = folded[..count].partition_point(|(other, _)| *other <= node);
        let w = [w * x, w * y, w * z, 0.0];
        match folded[..at].last_mut() {
            Some((other, sum)) if *other == node => {
                for axis in 0..3 {
                    sum[axis] += w[axis];
                }
            }
            _ => {
                folded[count] = (node, w);
                folded[at..=count].rotate_right(1);
                count += 1;
            }
        }
    }
    count
}

/// The node inside the mesh whose velocity a node has, and the sign of each component; the node itself where it is no
/// ghost.
fn inside(shape: &GridShape, walls: &[Wall], node: usize) -> (usize, [f64; 3]) {
    let mut at = shape.indices(node);
    let mut sign = [1.0; 3];
    for wall in walls {
        let (ghost, _, mirror) = wall.layers(shape);
        let direction = shape.direction(wall.axis);
        if at[direction] == ghost {
            at[direction] = mirror;
            for axis in 0..3 {
                if wall.prescribes(axis) {
                    sign[axis] = -sign[axis];
                }
            }
        }
    }
    (shape.index(at), sign)
}

/// 1/m of the fields that move together at a node, of which the lowest and the others are given; zero where a boundary plane
/// or a driven body prescribes the velocity.
fn mobility(
    shape: &GridShape,
    nodal: &NodalConditions,
    node: usize,
    fields: &Fields<'_>,
    (lowest, others): (usize, &[usize]),
) -> [f64; 4] {
    let sharing = || std::iter::once(lowest).chain(others.iter().copied());
    let mass: f64 = sharing().map(|f| fields.mass(f, node)).sum();
    let driven = |field: usize| match field {
        0 => {
            let lists = [&nodal.driven[..], &nodal.held];
            lists
                .iter()
                .any(|list| list.binary_search_by_key(&node, |d| d.node).is_ok())
        }
        _ => fields.is_driven(field),
    };
    if mass <= 0.0 || sharing().any(driven) {
        return [0.0; 4];
    }
    let at = shape.indices(node);
    let free = 1.0 / mass;
    let mut mobility = [free, free, free, 0.0];
    for wall in &nodal.walls {
        let (_, plane, _) = wall.layers(shape);
        if at[shape.direction(wall.axis)] == plane {
            for axis in 0..3 {
                if wall.prescribes(axis) {
                    mobility[axis] = 0.0;
                }
            }
        }
    }
    mobility
}
