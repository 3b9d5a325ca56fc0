//! Water that stands beside bodies: its values, and what has no form of it.

use super::collector::Collector;
use super::history::check_history;
use crate::values::Scene;
use proctor_geometry::number::Number;
use proctor_kernel::model::{PlaneCondition, StandingWater};

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    for (i, water) in scene.standing_waters.iter().enumerate() {
        check_one(scene, water, &format!("standing_water[{i}]"), problems);
    }
    if scene.standing_waters.is_empty() {
        return;
    }
    let axes = scene.dimension.axes();
    let along = scene.gravity[..axes].iter().filter(|g| **g != 0.0).count();
    if along != 1 {
        problems.add(
            "standing_water",
            format!("a level with the gravity {:?}", &scene.gravity[..axes]),
            "gravity along one axis, which the level is a coordinate of",
        );
    }
    let mut planes = scene.mesh.planes[..axes].iter().flatten();
    for (path, is, found, accepted) in [
        (
            "mesh.axisymmetric",
            scene.mesh.axisymmetric,
            "true",
            "the plane or space",
        ),
        (
            "mesh.boundary_conditions",
            planes.any(|plane| *plane == PlaneCondition::Absorbing),
            "an absorbing plane",
            "planes that are `free`, `sliding`, `fixed` or `antisymmetric`",
        ),
        (
            "transfer",
            scene.transfer.kind.kind().least_squares,
            "MLS",
            "FLIP, APIC or TPIC, whose gradients are derivatives",
        ),
    ] {
        if is {
            problems.add(path, format!("{found} with `standing_water`"), accepted);
        }
    }
}

fn check_one(scene: &Scene, water: &StandingWater, path: &str, problems: &mut Collector) {
    check_history(&format!("{path}.level"), &water.level, problems);
    problems.positive(format!("{path}.density"), water.density, "kg/m³");
    for (i, id) in water.bodies.iter().enumerate() {
        let body = scene.bodies.iter().find(|body| body.id == *id);
        let accepted = "the `id` of a body that moves freely";
        let path = format!("{path}.body_ids[{i}]");
        match body {
            None => problems.add(path, id.to_string(), accepted),
            Some(body) if body.motion.is_some() => {
                let found = format!("{id}, a body whose motion is prescribed");
                problems.add(path, found, accepted);
            }
            Some(_) => {}
        }
    }
    let Some(shore) = &water.shore else { return };
    if shore.axis >= scene.dimension.axes() || shore.side > 1 {
        problems.add(
            format!("{path}.side"),
            format!("axis {}, side {}", shore.axis, shore.side),
            "a side of the mesh",
        );
    } else if scene.gravity[shore.axis] != 0.0 {
        problems.add(
            format!("{path}.side"),
            "the axis of gravity",
            "a side that the water is beside, across gravity",
        );
    }
    let [from, to] = shore.between;
    let finite = problems.finite(format!("{path}.between[0]"), from)
        & problems.finite(format!("{path}.between[1]"), to);
    if finite && from >= to {
        problems.add(
            format!("{path}.between"),
            format!("[{}, {}]", Number(from), Number(to)),
            "two coordinates, the lower one first [m]",
        );
    }
}
