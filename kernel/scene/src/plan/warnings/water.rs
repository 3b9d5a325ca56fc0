//! Pore water that cannot leave.

use super::places::{free_box, from_plane, name, plane};
use crate::values::{Body, Scene};
use proctor_kernel::model::{PlaneCondition, Vector};

/// Planes that are free for the skeleton and shut for its water, and bodies whose water can leave nowhere.
pub(super) fn shut_in(scene: &Scene) -> Vec<String> {
    if !scene.has_water() {
        return vec![];
    }
    let sides: Vec<(usize, usize)> = (0..scene.dimension.axes())
        .flat_map(|axis| [(axis, 0), (axis, 1)])
        .collect();
    let shut =
        |(axis, side): (usize, usize)| scene.water_planes[axis][side] != PlaneCondition::Free;
    let mut all = vec![];
    for &(axis, side) in &sides {
        let touches =
            |body: &&Body| free_box(body).is_some_and(|bounds| ends_at(scene, &bounds, axis, side));
        let free = scene.mesh.planes[axis][side] == PlaneCondition::Free;
        if free
            && shut((axis, side))
            && let Some(body) = scene.bodies.iter().find(touches)
        {
            let plane = plane(axis, side);
            all.push(format!(
                "{}: its skeleton moves freely through {plane} of the mesh, its water not at all: `boundary_conditions_fluid` with \
                 {plane} `free` drains it",
                name(body)
            ));
        }
    }
    let boxes: Vec<[Vector; 2]> = scene.bodies.iter().filter_map(free_box).collect();
    let within = |&(axis, side): &(usize, usize)| {
        let ends = |bounds: &[Vector; 2]| ends_at(scene, bounds, axis, side);
        shut((axis, side)) && boxes.iter().any(ends)
    };
    if !boxes.is_empty() && all.is_empty() && sides.iter().all(within) {
        all.push(
            "the ground fills the mesh, and all planes are shut for its water: none can leave, and the pressure stays for good; \
             `boundary_conditions_fluid` names planes that are `free`"
                .to_owned(),
        );
    }
    all
}

/// True for a box that ends at a boundary plane.
fn ends_at(scene: &Scene, bounds: &[Vector; 2], axis: usize, side: usize) -> bool {
    from_plane(scene, bounds, axis, side).abs() <= scene.mesh.tolerance(axis)
}
