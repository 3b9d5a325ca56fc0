//! Loads: base motion, forces on nodes, tractions and box loads.

use super::body::{check_box, outside};
use super::collector::Collector;
use super::history::check_history;
use crate::values::Scene;
use proctor_kernel::model::{Damping, HeldBox, Mesh, Motion, PlaneCondition, PointLoad, Traction};

/// A point load must lie on a node within this share of a cell: far above the round-off of any mesh that a file
/// can describe, far below what could be meant otherwise.
const NODE_TOLERANCE: f64 = 1e-6;

pub(super) fn check(scene: &Scene, mesh_is_sound: bool, problems: &mut Collector) {
    if let Some(base) = &scene.base_motion {
        if base.axis >= scene.dimension.axes() || base.side > 1 {
            problems.add(
                "earthquake.plane",
                format!("axis {}, side {}", base.axis, base.side),
                "a plane of the mesh",
            );
        }
        let (Motion::Acceleration(history) | Motion::Velocity(history)) = &base.motion;
        check_history("earthquake.file", history, problems);
    }
    check_ground_beyond(scene, problems);
    for (i, held) in scene.held_boxes.iter().enumerate() {
        check_held(
            scene,
            mesh_is_sound,
            held,
            &format!("held_box[{i}]"),
            problems,
        );
    }
    for (i, load) in scene.point_loads.iter().enumerate() {
        let path = format!("nodal_point_load[{i}]");
        problems.vector(format!("{path}[1]"), &load.force);
        if problems.vector(format!("{path}[0]"), &load.position) && mesh_is_sound {
            check_node(&scene.mesh, scene.dimension.axes(), load, &path, problems);
        }
    }
    for (i, traction) in scene.tractions.iter().enumerate() {
        check_traction(
            scene,
            mesh_is_sound,
            traction,
            &format!("traction[{i}]"),
            problems,
        );
    }
    for (i, load) in scene.box_loads.iter().enumerate() {
        let path = format!("box_load[{i}]");
        problems.vector(format!("{path}.force"), &load.force);
        check_box(&path, &load.p1, &load.p2, scene.dimension.axes(), problems);
    }
}

/// The wave that comes in through an absorbing plane, and the springs beyond it.
fn check_ground_beyond(scene: &Scene, problems: &mut Collector) {
    let planes = &scene.mesh.planes;
    let absorbs = |axis: usize, side: usize| planes[axis][side] == PlaneCondition::Absorbing;
    let axes = scene.dimension.axes();
    let any = (0..axes).any(|axis| absorbs(axis, 0) || absorbs(axis, 1));
    if let Some(wave) = &scene.ground_beyond.incoming {
        if wave.axis >= axes || wave.side > 1 || !absorbs(wave.axis, wave.side) {
            problems.add(
                "earthquake.base",
                "a wave that comes in through a plane which does not absorb",
                "a `plane` whose condition is \"absorbing\", or `base` \"rigid\"",
            );
        }
        let (Motion::Acceleration(history) | Motion::Velocity(history)) = &wave.motion;
        check_history("earthquake.file", history, problems);
    }
    if let Some(base) = &scene.base_motion
        && base.axis < axes
        && base.side < 2
        && absorbs(base.axis, base.side)
    {
        problems.add(
            "earthquake.base",
            "a plane that absorbs and moves as a record says",
            "`base` \"compliant\", or another condition of the plane",
        );
    }
    if let Some(thickness) = scene.ground_beyond.thickness {
        if !(thickness > 0.0 && thickness.is_finite()) {
            problems.add(
                "absorbing_springs",
                thickness.to_string(),
                "the thickness of the ground beyond, a number greater than 0 [m]",
            );
        }
        if !any {
            problems.add(
                "absorbing_springs",
                "springs where no plane absorbs",
                "a plane whose condition is \"absorbing\"",
            );
        }
    }
    if !any {
        return;
    }
    if scene.damping == Damping::Kinetic {
        problems.add(
            "damping",
            "kinetic damping, which stops all motion at a peak of kinetic energy, with absorbing planes: waves that leave make such peaks",
            "no damping, or \"local\" or \"viscous\" damping",
        );
    }
    if !scene.mortar.contacts.is_empty() {
        problems.add(
            "mesh.boundary_conditions",
            "absorbing planes with mortar contact, whose vertices know mirror images alone",
            "contact on the grid, or planes that do not absorb",
        );
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        if body.motion.is_some() {
            problems.add(
                format!("body[{i}].prescribed_velocity"),
                "a body that moves as prescribed, where planes of the mesh absorb",
                "no `prescribed_velocity`, or planes that do not absorb",
            );
        }
    }
}

/// A held box holds at least one node, of a mesh that stands still.
fn check_held(
    scene: &Scene,
    mesh_is_sound: bool,
    held: &HeldBox,
    path: &str,
    problems: &mut Collector,
) {
    if scene.base_motion.is_some() {
        problems.add(
            path,
            "nodes that stand still in a mesh that an earthquake moves",
            "no `held_box`, or no `earthquake`",
        );
    }
    if !scene.contacts.is_empty() {
        problems.add(
            path,
            "held nodes with contact on the grid, which would move them",
            "no `held_box`, or `contact` with `method` \"mortar\"",
        );
    }
    let sound = problems.vector(format!("{path}.point_p1"), &held.p1)
        & problems.vector(format!("{path}.point_p2"), &held.p2);
    if sound && mesh_is_sound {
        for axis in 0..scene.dimension.axes() {
            if held.nodes_along(&scene.mesh, axis).is_empty() {
                problems.add(
                    path,
                    format!(
                        "{} to {} along axis {axis}, where there is no node",
                        held.p1[axis], held.p2[axis]
                    ),
                    "a box that holds nodes of the mesh",
                );
            }
        }
    }
}

/// A point load acts on a node, so it must lie on one.
fn check_node(mesh: &Mesh, axes: usize, load: &PointLoad, path: &str, problems: &mut Collector) {
    let mut nearest = Vec::with_capacity(axes);
    let mut is_on_node = true;
    for axis in 0..axes {
        let cells = (load.position[axis] - mesh.origin[axis]) / mesh.cell[axis];
        let node = cells.round().clamp(0.0, mesh.cells[axis] as f64);
        let x = node.mul_add(mesh.cell[axis], mesh.origin[axis]);
        is_on_node &= (load.position[axis] - x).abs()
            <= NODE_TOLERANCE * mesh.cell[axis] + mesh.tolerance(axis);
        nearest.push(x);
    }
    if !is_on_node {
        problems.add(
            format!("{path}[0]"),
            format!("{:?}, which is not a node", &load.position[..axes]),
            format!("a node of the mesh, within 1e-6 of a cell; the nearest is {nearest:?}"),
        );
    }
}

/// A traction acts on a rectangle: flat along exactly one axis, and in the mesh.
fn check_traction(
    scene: &Scene,
    mesh_is_sound: bool,
    traction: &Traction,
    path: &str,
    problems: &mut Collector,
) {
    let axes = scene.dimension.axes();
    let at = format!("{path}.traction");
    if let Some(vector) = traction.traction.constant() {
        problems.vector(at, &vector);
    } else {
        check_history(&at, &traction.traction, problems);
    }
    if !(problems.vector(format!("{path}.point_p1"), &traction.p1)
        & problems.vector(format!("{path}.point_p2"), &traction.p2))
    {
        return;
    }
    let extents = (0..axes).map(|axis| traction.p2[axis] - traction.p1[axis]);
    let (mut flat, mut inverted) = (0, false);
    for extent in extents {
        flat += usize::from(extent == 0.0);
        inverted |= extent < 0.0;
    }
    if flat != 1 || inverted {
        problems.add(
            format!("{path}.point_p2"),
            format!("{:?}", &traction.p2[..axes]),
            format!(
                "the upper corner, equal to point_p1 {:?} along exactly one axis and greater along the others",
                &traction.p1[..axes]
            ),
        );
    } else if mesh_is_sound {
        for axis in 0..axes {
            for (key, x) in [
                ("point_p1", traction.p1[axis]),
                ("point_p2", traction.p2[axis]),
            ] {
                outside(
                    &scene.mesh,
                    axis,
                    x,
                    &format!("{path}.{key}[{axis}]"),
                    problems,
                );
            }
        }
    }
}
