//! The nodes that touching particles reach.

use super::fields::Fields;
use crate::grid::GridShape;
use crate::simulation::conditions::Acting;
use crate::simulation::mapping::NodeWeights;
use crate::stage::solve::Wall;
use crate::stage::touch::TouchedNode;

/// Where a node stands in the list of reached nodes, by field and node. Of an earlier list nothing is cleared: an entry holds
/// the number of the list that it belongs to.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    list: u32,
    places: Vec<Vec<(u32, u32)>>,
}

impl Known {
    /// Begins a list.
    pub(super) fn begin<'a>(&'a mut self, nodes: &'a mut Vec<TouchedNode>) -> Reached<'a> {
        nodes.clear();
        self.list = self.list.wrapping_add(1);
        if self.list == 0 {
            self.places.clear();
            self.list = 1;
        }
        Reached { nodes, known: self }
    }
}

/// A list of reached nodes that grows.
pub(super) struct Reached<'a> {
    nodes: &'a mut Vec<TouchedNode>,
    known: &'a mut Known,
}

impl Reached<'_> {
    /// The place of a node of a field in the list, at its end where it was not reached before.
    pub(super) fn place(
        &mut self,
        shape: &GridShape,
        acting: &Acting,
        fields: &Fields<'_>,
        field: usize,
        node: usize,
    ) -> usize {
        let Known { list, places } = &mut *self.known;
        if places.len() <= field {
            places.resize(field + 1, vec![]);
        }
        if places[field].is_empty() {
            places[field].resize(shape.nodes.iter().product(), (0, 0));
        }
        let (known_in, place) = &mut places[field][node];
        if *known_in != *list {
            (*known_in, *place) = (*list, Self::add(self.nodes, shape, acting, fields, [field, node]) as u32);
        }
        *place as usize
    }

    fn add(
        nodes: &mut Vec<TouchedNode>,
        shape: &GridShape,
        acting: &Acting,
        fields: &Fields<'_>,
        [field, node]: [usize; 2],
    ) -> usize {
        let sharing = fields.sharing(field, node);
        // Another body may have been there whose field moves together with this one.
        let same = |t: &TouchedNode| t.node == node && t.fields == sharing;
        let first = (sharing.len() > 1)
            .then(|| nodes.iter().position(same))
            .flatten();
        first.unwrap_or_else(|| {
            nodes.push(TouchedNode {
                node,
                mobility: mobility(shape, acting, node, fields, &sharing),
                change: [0.0; 3],
                fields: sharing,
            });
            nodes.len() - 1
        })
    }
}

/// The weights of nodes for each component of the velocity, with those of ghosts at the nodes inside the mesh whose velocity
/// they have, increasing by node.
pub(super) fn fold(
    shape: &GridShape,
    walls: &[Wall],
    weights: &NodeWeights,
) -> Vec<(usize, [f64; 3])> {
    let mut folded: Vec<(usize, [f64; 3])> =
        weights.iter().map(|&(node, w)| (node, [w; 3])).collect();
    let (Some(&(first, _)), Some(&(last, _))) = (weights.first(), weights.last()) else {
        return folded;
    };
    // The corners of the box in which all of them lie.
    let (first, last) = (shape.indices(first), shape.indices(last));
    let beside = |wall: &&Wall| {
        let direction = shape.direction(wall.axis);
        (first[direction]..=last[direction]).contains(&wall.layers(shape).0)
    };
    if !walls.iter().any(|wall| beside(&wall)) {
        return folded;
    }
    for (node, w) in &mut folded {
        let (inside, sign) = inside(shape, walls, *node);
        *node = inside;
        for axis in 0..3 {
            w[axis] *= sign[axis];
        }
    }
    // A stable sort: sums in the order of the nodes that were there before.
    folded.sort_by_key(|(node, _)| *node);
    folded.dedup_by(|(node, w), (kept, sum)| {
        let same = node == kept;
        if same {
            for axis in 0..3 {
                sum[axis] += w[axis];
            }
        }
        same
    });
    folded
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

/// 1/m of the fields that move together at a node, zero where a boundary plane or a driven body prescribes the velocity.
fn mobility(
    shape: &GridShape,
    acting: &Acting,
    node: usize,
    fields: &Fields<'_>,
    sharing: &[usize],
) -> [f64; 3] {
    let mass: f64 = sharing.iter().map(|f| fields.mass(*f, node)).sum();
    let driven = |field: &usize| match field {
        0 => {
            let lists = [&acting.driven[..], &acting.held];
            lists
                .iter()
                .any(|list| list.binary_search_by_key(&node, |d| d.node).is_ok())
        }
        _ => fields.is_driven(*field),
    };
    if mass <= 0.0 || sharing.iter().any(driven) {
        return [0.0; 3];
    }
    let at = shape.indices(node);
    let mut mobility = [1.0 / mass; 3];
    for wall in &acting.walls {
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
