//! Pore water at the nodes: the pressure shared out between water and skeleton, and the drag between both.

use crate::grid::{GHOSTS_BELOW, GridShape, Line};
use crate::model::PoreWater;
use crate::simulation::context::StepContext;
use crate::simulation::fields::{Owner, Slab};
use crate::stage::solve::{PlaneSums, Wall, is_ghost};

/// Lane of a node of the water that holds the drag before the equation of motion, and the porosity after it.
const SPARE: usize = 7;

/// Shares out the force of the pressure by the porosity of the node: n of it moves the water, the rest the skeleton.
pub(in crate::simulation) fn split(slab: &mut Slab<'_>, context: &StepContext<'_>) {
    let Some(water) = constants(slab, context) else {
        return;
    };
    fold_drag(slab, context);
    let (shape, pressed) = (slab.shape(), &context.nodal.water_pressures);
    for_both(slab, |at, skeleton, flow| {
        let n = porosity(&water, skeleton, flow);
        for lane in 4..7 {
            let force = flow[lane];
            flow[lane] = n * force;
            skeleton[lane] += (1.0 - n) * force;
        }
        for plane in pressed {
            if let Some(force) = plane.force(shape, at, volume(&water, skeleton, flow)) {
                flow[4 + plane.axis] += n * force;
                skeleton[4 + plane.axis] -= n * force;
            }
        }
    });
}

/// Drag between water and skeleton, from the velocities of the equation of motion: with r* their difference
/// r = r*/(1 + dt B (1/`m_s` + 1/`m_w`)), which solves the implicit equations of both exactly. A velocity that a plane prescribes
/// stays as it is. Sums what it takes, and the power of the weight of the water; notes the porosity of each node.
pub(in crate::simulation) fn drag(
    slab: &mut Slab<'_>,
    context: &StepContext<'_>,
    sums: &mut [PlaneSums],
) {
    let Some(water) = constants(slab, context) else {
        return;
    };
    let (shape, first) = (slab.shape(), slab.range().start);
    let (kick, gravity) = (context.nodal.kick, context.nodal.gravity);
    let ratios = water.drag_ratios();
    let walls = [
        context.walls_of(Owner::Phase),
        context.walls_of(Owner::Water),
    ];
    let pressed = &context.nodal.water_pressures;
    for_both(slab, |at, skeleton, flow| {
        let b = flow[SPARE];
        flow[SPARE] = porosity(&water, skeleton, flow);
        let of_node = [1.0 / skeleton[0], 1.0 / flow[0]];
        // Hardly a node lies in a plane of the mesh or beyond it.
        let inside = is_inside(shape, at);
        let mut taken = 0.0;
        for axis in 0..shape.axes {
            let mut inverse = of_node;
            for phase in 0..2 {
                if !inside && is_prescribed(shape, walls[phase], at, axis) {
                    inverse[phase] = 0.0;
                }
            }
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
        if !inside && walls.iter().any(|walls| is_ghost(shape, walls, at)) {
            return;
        }
        let sums = &mut sums[at[0] - first];
        sums.drag += taken;
        let weight = |axis: usize| gravity[axis] * flow[1 + axis];
        sums.power += flow[0] * (0..shape.axes).map(weight).sum::<f64>();
        for plane in pressed {
            if let Some(force) = plane.force(shape, at, volume(&water, skeleton, flow)) {
                let seeping = flow[1 + plane.axis] - skeleton[1 + plane.axis];
                sums.power += flow[SPARE] * force * seeping;
            }
        }
    });
}

/// True for a node that lies neither in a plane of the mesh nor beyond it.
fn is_inside(shape: &GridShape, at: [usize; 3]) -> bool {
    (0..shape.axes).all(|axis| {
        let layer = at[shape.direction(axis)];
        layer > GHOSTS_BELOW && layer < GHOSTS_BELOW + shape.cells[axis]
    })
}

/// True where a wall prescribes the velocity of a node along an axis.
fn is_prescribed(shape: &GridShape, walls: &[Wall], at: [usize; 3], axis: usize) -> bool {
    walls
        .iter()
        .any(|wall| wall.prescribes(axis) && at[shape.direction(wall.axis)] == wall.layers(shape).1)
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
    for_both(slab, |_, skeleton, flow| {
        if share != 0.0 {
            for axis in 0..3 {
                let increment = flow[4 + axis];
                flow[4 + axis] = increment + share * (flow[1 + axis] - increment);
            }
        }
        if let Some(lane) = lane {
            let n = flow[SPARE];
            for axis in 0..3 {
                let v = skeleton[lane + axis];
                flow[lane + axis] = v + n * (flow[lane + axis] - v);
            }
        }
    });
}

/// Volume of water and grains around a node \[m³\].
fn volume(water: &PoreWater, skeleton: &Line, flow: &Line) -> f64 {
    flow[0] / water.density + skeleton[0] / water.grain_density
}

/// Porosity of a node, from the masses of water and grains there: a mean over its particles.
fn porosity(water: &PoreWater, skeleton: &Line, flow: &Line) -> f64 {
    let pores = flow[0] / water.density;
    pores / (pores + skeleton[0] / water.grain_density)
}

/// The constants that all waters of a scene share, where the slab has water: densities and ratios of conductivity.
fn constants(slab: &Slab<'_>, context: &StepContext<'_>) -> Option<PoreWater> {
    let water = slab
        .fields
        .last()
        .filter(|field| field.owner == Owner::Water);
    water?;
    context.mapping.bodies.iter().find_map(|body| body.water)
}

/// Calls `act` for each node where water and skeleton have mass, with its storage indices and the lines of both.
fn for_both(slab: &mut Slab<'_>, mut act: impl FnMut([usize; 3], &mut Line, &mut Line)) {
    let last = slab.fields.len() - 1;
    let Ok([skeleton, water]) = slab.fields.get_disjoint_mut([0, last]) else {
        return;
    };
    let (shape, range) = (water.planes.shape, water.planes.range.clone());
    let first = range.start * shape.plane_nodes();
    for plane in range {
        for row in water.planes.rows.in_plane(plane) {
            for k in water.planes.rows.span(plane, row) {
                let at = [plane, row, k];
                let index = shape.index(at) - first;
                let lines = (
                    &mut skeleton.planes.nodes[index],
                    &mut water.planes.nodes[index],
                );
                if lines.0[0] > 0.0 && lines.1[0] > 0.0 {
                    act(at, lines.0, lines.1);
                }
            }
        }
    }
}
