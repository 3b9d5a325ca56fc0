//! Axisymmetry: the axis of revolution, and what has no axisymmetric form.

use super::collector::Collector;
use crate::values::{Body, Scene};
use proctor_geometry::number::Number;
use proctor_kernel::model::{Dimension, History, Motion, PlaneCondition, TransferKind};

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    if !scene.mesh.axisymmetric {
        return;
    }
    if scene.dimension == Dimension::Three {
        problems.add(
            "mesh.axisymmetric",
            "true in three dimensions",
            "true with `dimension` 2, whose axes are the radius and the height",
        );
        return;
    }
    check_axis(scene, problems);
    check_method(scene, problems);
    check_loads(scene, problems);
    for (i, body) in scene.bodies.iter().enumerate() {
        let path = format!("bodies[{i}].prescribed_velocity");
        check_radial(body.motion.as_ref(), path, problems);
    }
}

/// The mesh begins on the axis, where it slides, or beyond it.
fn check_axis(scene: &Scene, problems: &mut Collector) {
    let mesh = &scene.mesh;
    if mesh.origin[0] < 0.0 {
        problems.add(
            "mesh.origin[0]",
            format!("{}, a radius below zero", Number(mesh.origin[0])),
            "0, the axis, or a number greater than 0 [m]",
        );
    }
    let [low, high] = mesh.planes[0];
    if mesh.origin[0] == 0.0 && low != PlaneCondition::Sliding {
        problems.add(
            "mesh.boundary_conditions.plane_X0",
            format!("{} on the axis of an axisymmetric mesh", low.word()),
            "sliding: nothing crosses the axis, and points on it move along it",
        );
    }
    for (key, condition) in [("plane_X0", low), ("plane_Xn", high)] {
        let on_axis = key == "plane_X0" && mesh.origin[0] == 0.0;
        if condition == PlaneCondition::Antisymmetric && !on_axis {
            problems.add(
                format!("mesh.boundary_conditions.{key}"),
                "antisymmetric along the radius of an axisymmetric mesh",
                "free, sliding or fixed: half a turn changes the radius",
            );
        }
    }
}

fn check_method(scene: &Scene, problems: &mut Collector) {
    if scene.transfer.kind == TransferKind::Mls {
        problems.add(
            "transfer",
            "MLS in an axisymmetric scene",
            "FLIP, APIC or TPIC: the gradient of least squares has no form with the radius",
        );
    }
    let mortar = &scene.mortar;
    if !(mortar.contacts.is_empty() && mortar.lines.is_empty() && mortar.boundaries.is_empty()) {
        problems.add(
            "contact",
            "mortar contact in an axisymmetric scene",
            "contact on the grid: `method` left out, and no `rigid_line`",
        );
    }
}

fn check_loads(scene: &Scene, problems: &mut Collector) {
    if scene.gravity[0] != 0.0 {
        problems.add(
            "gravity[0]",
            format!("{} along the radius", Number(scene.gravity[0])),
            "0: gravity acts along the axis",
        );
    }
    if let Some(base) = &scene.base_motion {
        let (Motion::Acceleration(history) | Motion::Velocity(history)) = &base.motion;
        if base.axis == 0 {
            problems.add(
                "earthquake.plane",
                "a plane of the radius in an axisymmetric scene",
                "Y0 or Yn, a plane across the axis",
            );
        }
        check_radial(Some(history), "earthquake.file".into(), problems);
    }
    for (i, load) in scene.point_loads.iter().enumerate() {
        let near = scene.mesh.tolerance(0);
        if load.position[0].abs() <= near && load.force[0] != 0.0 {
            problems.add(
                format!("nodal_point_load[{i}][1][0]"),
                format!("{} on the axis", Number(load.force[0])),
                "0: a force on the axis acts along it",
            );
        }
    }
    let rows = |body: &Body| body.particles_per_cell[0];
    let first = scene.bodies.first().map(rows);
    let other = (scene.bodies.iter()).position(|body| Some(rows(body)) != first);
    if let Some(other) = other.filter(|_| !scene.tractions.is_empty()) {
        problems.add(
            format!("bodies[{other}].particles_per_cell[0]"),
            format!(
                "{} beside a traction, and {} in another body",
                rows(&scene.bodies[other]),
                first.unwrap_or(0)
            ),
            "as many along the radius in all bodies: a traction acts on rings of particles",
        );
    }
}

/// Nothing that moves as a whole moves along the radius.
fn check_radial(history: Option<&History>, path: String, problems: &mut Collector) {
    let radial = history.and_then(|history| {
        let mut values = history.values.iter();
        values.find(|value| value[0] != 0.0)
    });
    if let Some(value) = radial {
        problems.add(
            path,
            format!("{} along the radius", Number(value[0])),
            "0 along the radius: a rigid body of revolution moves along the axis",
        );
    }
}
