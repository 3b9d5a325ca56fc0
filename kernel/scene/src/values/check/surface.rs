//! Rigid surfaces.

use super::collector::Collector;
use super::history::check_history;
use crate::values::Scene;
use proctor_kernel::model::Dimension;

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    if scene.dimension == Dimension::Two && !scene.surfaces.is_empty() {
        problems.add(
            "terrain_contact",
            "a surface of triangles in two dimensions",
            "three dimensions; a mesh of one cell between sliding planes gives plane strain",
        );
    }
    for (i, surface) in scene.surfaces.iter().enumerate() {
        let key = |key: &str| format!("terrain_contact[{i}].{key}");
        problems.not_negative(key("friction"), surface.friction);
        problems.positive(key("distance_threshold"), surface.distance_threshold, "m");
        if let Some(stiffness) = surface.penalty_stiffness {
            problems.positive(key("penalty_stiffness"), stiffness, "N/m");
        }
        if let Some(motion) = &surface.motion {
            check_history(&key("prescribed_velocity"), motion, problems);
        }
    }
}
