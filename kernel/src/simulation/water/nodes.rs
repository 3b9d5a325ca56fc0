//! Pore water at the nodes: the pressure shared out between water and skeleton, and the drag between both.

use crate::grid::Line;
use crate::model::{PoreWater, Vector};
use crate::simulation::context::StepContext;
use crate::simulation::fields::{Owner, Slab};
use crate::stage::solve::{PlaneSums, Wall, is_ghost};

/// Lane of a node of the water that holds the drag before the equation of motion, and the porosity after it.
pub(super) const SPARE: usize = 7;

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
        let counts = !walls.iter().any(|walls| is_ghost(shape, walls, at));
        let mut taken = 0.0;
        for axis in 0..shape.axes {
            let b = b * ratios[axis];
            let inverse = |walls: &[Wall], mass: f64| {
                if walls.iter().any(|wall| {
                    wall.prescribes(axis) && at[shape.direction(wall.axis)] == wall.layers(shape).1
                }) {
                    0.0
                } else {
                    1.0 / mass
                }
            };
            let [of_skeleton, of_water] =
                [inverse(walls[0], skeleton[0]), inverse(walls[1], flow[0])];
            let before =
                (flow[1 + axis] - flow[4 + axis]) - (skeleton[1 + axis] - skeleton[4 + axis]);
            let trial = flow[1 + axis] - skeleton[1 + axis];
            let after = trial / (1.0 + kick * b * (of_skeleton + of_water));
            let impulse = kick * b * after;
            for (line, change) in [
                (&mut *skeleton, impulse * of_skeleton),
                (&mut *flow, -(impulse * of_water)),
            ] {
                line[1 + axis] += change;
                line[4 + axis] += change;
            }
            taken += impulse * (0.5 * (before + after));
        }
        if counts {
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
        }
    });
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

/// Divergence \[1/s\] of the mean velocity (1-n) v + n w of a node with this gradient of its weight, whose velocities begin at
/// `lane`.
pub(super) fn flux(skeleton: &Line, flow: &Line, lane: usize, gradient: &Vector) -> f64 {
    let n = flow[SPARE];
    let mut sum = 0.0;
    for axis in 0..3 {
        let v = skeleton[lane + axis];
        sum += gradient[axis] * (v + n * (flow[lane + axis] - v));
    }
    sum
}
