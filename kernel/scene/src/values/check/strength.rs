//! Strength that follows from the vertical stress at the start.

use super::collector::Collector;
use crate::values::{InitialStress, Scene};
use proctor_laws::UndrainedClay;

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    let clay = |material: usize| {
        let material = scene.materials.get(material)?;
        material.law.downcast::<UndrainedClay>()
    };
    for (i, body) in scene.bodies.iter().enumerate() {
        let Some(law) = clay(body.material) else {
            continue;
        };
        let stressed = body.initial_stress != InitialStress::None || scene.initial_state.is_some();
        if !stressed && law.strength(0.0) == 0.0 {
            problems.add(
                format!("bodies[{i}].initial_stress"),
                "none, with a strength that is a share of the vertical stress at the start",
                "a stress at the start, or a `least_strength` of the material",
            );
        }
    }
    let any = (0..scene.materials.len()).any(|material| clay(material).is_some());
    let axes = scene.dimension.axes();
    if any && scene.gravity[..axes - 1].iter().any(|g| *g != 0.0) {
        problems.add(
            "gravity",
            format!(
                "{:?} with a strength that is a share of the vertical stress",
                &scene.gravity[..axes]
            ),
            "gravity along the last axis, which is the vertical one",
        );
    }
}
