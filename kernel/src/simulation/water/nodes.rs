//! Pore water at the nodes: the pressure shared out between water and skeleton, and the drag between both.

use super::phases::{constants, porosity};
use super::pressed::each_pressed;
use crate::fields::{Owner, Slab};
use crate::grid::{GHOSTS_BELOW, GridShape, Line};
use crate::simulation::context::StepContext;
use crate::stage::solve::{ExactStepSums, StepSum, Wall};

/// Lane of a node of the water that holds the drag before the equation of motion, and the porosity after it.
const SPARE: usize = 7;

/// Shares out the force of the pressure by the porosity of the node: n of it moves the water, the rest the skeleton.
pub(in crate::simulation) fn split(slab: &mut Slab<'_>, context: &StepContext<'_>) {
    let Some(water) = constants(slab, context) else {
        return;
    };
    fold_drag(slab, context);
    let axes = slab.shape().axes;
    for_both(slab, |_, skeleton, flow| {
        let n = porosity(&water, skeleton, flow);
        for lane in 4..4 + axes {
            let force = flow[lane];
            flow[lane] = n * force;
            skeleton[lane] += (1.0 - n) * force;
        }
    });
    each_pressed(slab, context, |node, skeleton, flow| {
        let force = porosity(&water, skeleton, flow) * node.force;
        flow[4 + node.axis] += force;
        skeleton[4 + node.axis] -= force;
    });
}

/// Drag between water and skeleton, from the velocities of the equation of motion: with r* their difference
/// r = r*/(1 + dt B (1/`m_s` + 1/`m_w`)), which solves the implicit equations of both exactly. A velocity that a plane prescribes
/// stays as it is. Sums what it takes, and the power of the weight of the water; notes the porosity of each node.
pub(in crate::simulation) fn drag(
    slab: &mut Slab<'_>,
    context: &StepContext<'_>,
    sums: &mut ExactStepSums,
) {
    if slab.shape().axes == 2 {
        drag_along::<2>(slab, context, sums);
    } else {
        drag_along::<3>(slab, context, sums);
    }
}

/// The same along so many axes.
fn drag_along<const D: usize>(
    slab: &mut Slab<'_>,
    context: &StepContext<'_>,
    sums: &mut ExactStepSums,
) {
    let Some(water) = constants(slab, context) else {
        return;
    };
    let shape = slab.shape();
    let (kick, gravity) = (context.nodal.kick, context.nodal.gravity);
    let ratios = water.drag_ratios();
    let edges = [Owner::Phase, Owner::Water].map(|owner| Edges::of(context.walls_of(owner), shape));
    let mut of_row = RowSums::default();
    for_both(slab, |node, skeleton, flow| {
        let b = flow[SPARE];
        flow[SPARE] = porosity(&water, skeleton, flow);
        let mut inverse = [[1.0 / skeleton[0]; D], [1.0 / flow[0]; D]];
        let mut is_ghost = false;
        if !node.inside {
            for (inverse, edges) in inverse.iter_mut().zip(&edges) {
                let found = edges.at(node.at);
                is_ghost |= found & GHOST != 0;
                for axis in 0..D {
                    if found & (1 << axis) != 0 {
                        inverse[axis] = 0.0;
                    }
                }
            }
        }
        let mut taken = 0.0;
        for axis in 0..D {
            let inverse = [inverse[0][axis], inverse[1][axis]];
            let b = b * ratios[axis];
            let before =
                (flow[1 + axis] - flow[4 + axis]) - (skeleton[1 + axis] - skeleton[4 + axis]);
            let trial = flow[1 + axis] - skeleton[1 + axis];
            let after = trial / (1.0 + kick * b * (inverse[0] + inverse[1]));
            let impulse = kick * b * after;
            for (line, change) in [
                (&mut *skeleton, impulse * inverse[0]),
                (&mut *flow, -(impulse * inverse[1])),
            ] {
                line[1 + axis] += change;
                line[4 + axis] += change;
            }
            taken += impulse * (0.5 * (before + after));
        }
        if is_ghost {
            return;
        }
        let weight = |axis: usize| gravity[axis] * flow[1 + axis];
        let power = flow[0] * (0..D).map(weight).sum::<f64>();
        of_row.add([node.at[0], node.at[1]], [taken, power], sums);
    });
    of_row.end(sums);
    each_pressed(slab, context, |node, skeleton, flow| {
        if edges.iter().any(|edges| edges.at(node.at) & GHOST != 0) {
            return;
        }
        let seeping = flow[1 + node.axis] - skeleton[1 + node.axis];
        sums.add(StepSum::Power, flow[SPARE] * node.force * seeping);
    });
}

/// Drag and power of one row of nodes: exact sums take a row at a time.
#[derive(Default)]
struct RowSums {
    /// Plane and row.
    at: [usize; 2],
    drag: f64,
    power: f64,
}

impl RowSums {
    /// Adds drag and power of a node of a row; a row that ends goes to the sums.
    #[inline(always)]
    fn add(&mut self, at: [usize; 2], [drag, power]: [f64; 2], sums: &mut ExactStepSums) {
        if at != self.at {
            self.end(sums);
            self.at = at;
        }
        self.drag += drag;
        self.power += power;
    }

    /// Gives the row to the sums.
    fn end(&mut self, sums: &mut ExactStepSums) {
        sums.add(StepSum::Drag, std::mem::take(&mut self.drag));
        sums.add(StepSum::Power, std::mem::take(&mut self.power));
    }
}

/// Bit of what [`Edges::at`] finds for a ghost of a wall.
const GHOST: u8 = 1 << 3;

/// The walls of a phase, by the layers of nodes that they act on.
struct Edges {
    /// For each direction of storage and side, the layer of a plane with the axes along which it prescribes the velocity, as
    /// bits, and the layer of its ghosts; layers that no node has where there is no wall.
    walls: [[(usize, u8, usize); 2]; 3],
}

impl Edges {
    fn of(walls: &[Wall], shape: &GridShape) -> Self {
        let mut edges = Self {
            walls: [[(usize::MAX, 0, usize::MAX); 2]; 3],
        };
        for wall in walls {
            let (ghost, plane, _) = wall.layers(shape);
            let prescribed = (0..3).filter(|axis| wall.prescribes(*axis));
            let bits = prescribed.fold(0, |bits, axis| bits | 1 << axis);
            edges.walls[shape.direction(wall.axis)][wall.side] = (plane, bits, ghost);
        }
        edges
    }

    /// The axes along which walls prescribe the velocity of a node, as bits, and [`GHOST`] for what a wall mirrors.
    #[inline]
    fn at(&self, at: [usize; 3]) -> u8 {
        let mut found = 0;
        for direction in 0..3 {
            for (plane, bits, ghost) in self.walls[direction] {
                if at[direction] == plane {
                    found |= bits;
                }
                if at[direction] == ghost {
                    found |= GHOST;
                }
            }
        }
        found
    }
}

/// Gives nodes beyond planes that hold the water the porosity of the nodes that they mirror.
pub(in crate::simulation) fn share_beyond(slab: &mut Slab<'_>, context: &StepContext<'_>) {
    each_pair_of_walls(slab, context, true);
}

/// Folds the drag that lies on ghost nodes onto their mirror nodes.
fn fold_drag(slab: &mut Slab<'_>, context: &StepContext<'_>) {
    each_pair_of_walls(slab, context, false);
}

fn each_pair_of_walls(slab: &mut Slab<'_>, context: &StepContext<'_>, outwards: bool) {
    let Some(field) = (slab.fields.last_mut()).filter(|field| field.owner == Owner::Water) else {
        return;
    };
    for wall in context.walls_of(Owner::Water) {
        let (ghost, _, mirror) = wall.layers(field.planes.shape);
        field
            .planes
            .for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
                if outwards {
                    nodes[ghost][SPARE] = nodes[mirror][SPARE];
                } else {
                    nodes[mirror][SPARE] += nodes[ghost][SPARE];
                }
            });
    }
}

/// Fills the lanes that particles gather from: the upper ones with a share of the velocity and the rest of its increment, where the share is not
/// zero; to the three lanes from `lane` on the mean velocity (1-n) v + n w of the velocities there.
pub(super) fn hand_over(slab: &mut Slab<'_>, share: f64, lane: Option<usize>) {
    if share == 0.0 && lane.is_none() {
        return;
    }
    let axes = slab.shape().axes;
    for_both(slab, |_, skeleton, flow| {
        if share != 0.0 {
            for axis in 0..axes {
                let increment = flow[4 + axis];
                flow[4 + axis] = increment + share * (flow[1 + axis] - increment);
            }
        }
        if let Some(lane) = lane {
            let n = flow[SPARE];
            for axis in 0..axes {
                let v = skeleton[lane + axis];
                flow[lane + axis] = v + n * (flow[lane + axis] - v);
            }
        }
    });
}

/// Porosity of a node of a slab, by its index in the grid, where both phases have mass.
pub(in crate::simulation) fn porosity_at(
    slab: &Slab<'_>,
    context: &StepContext<'_>,
    node: usize,
) -> Option<f64> {
    let water = constants(slab, context)?;
    let [skeleton, flow] = [slab.fields.first()?, slab.fields.last()?].map(|field| {
        let shape = field.planes.shape;
        let [plane, row, k] = shape.indices(node);
        let is_there = field.planes.rows.span(plane, row).contains(&k);
        is_there.then(|| &field.planes.nodes[node - field.planes.range.start * shape.plane_nodes()])
    });
    let (skeleton, flow) = (skeleton?, flow?);
    (skeleton[0] > 0.0 && flow[0] > 0.0).then(|| porosity(&water, skeleton, flow))
}

/// A node of both fields.
struct Node {
    /// Storage indices.
    at: [usize; 3],
    /// True if it lies neither in a plane of the mesh nor beyond one.
    inside: bool,
}

/// Calls `act` for each node where water and skeleton have mass, with the lines of both.
#[inline(always)]
fn for_both(slab: &mut Slab<'_>, mut act: impl FnMut(&Node, &mut Line, &mut Line)) {
    let last = slab.fields.len() - 1;
    let Ok([skeleton, water]) = slab.fields.get_disjoint_mut([0, last]) else {
        return;
    };
    let (shape, range) = (water.planes.shape, water.planes.range.clone());
    let first = range.start * shape.plane_nodes();
    let mut inside = [0..1, 0..1, 0..1];
    for axis in 0..shape.axes {
        inside[shape.direction(axis)] = GHOSTS_BELOW + 1..GHOSTS_BELOW + shape.cells[axis];
    }
    for plane in range {
        for row in water.planes.rows.in_plane(plane) {
            let span = water.planes.rows.span(plane, row);
            if span.is_empty() {
                continue;
            }
            let own = shape.index([plane, row, span.start]) - first;
            let own = own..own + span.len();
            let is_inside = inside[0].contains(&plane) && inside[1].contains(&row);
            let lines = skeleton.planes.nodes[own.clone()].iter_mut();
            for (k, (skeleton, flow)) in span.zip(lines.zip(&mut water.planes.nodes[own])) {
                if skeleton[0] > 0.0 && flow[0] > 0.0 {
                    let node = Node {
                        at: [plane, row, k],
                        inside: is_inside && inside[2].contains(&k),
                    };
                    act(&node, skeleton, flow);
                }
            }
        }
    }
}
