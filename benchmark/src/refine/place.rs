//! The same scene with its mesh moved by a part of a cell: whether results depend on where the mesh lies.

use proctor_scene::{PlaneCondition, Scene, Vector};

/// Cells between a plane and all particles from which on it does nothing to them.
const OUT_OF_REACH: f64 = 2.0;

/// Axes along which the mesh of a scene can move without another change: those whose planes are free or so far from the box
/// `bounds` \[m\], which held all particles at all times, that nothing reaches them. None where loads or held boxes are tied to
/// the mesh.
#[must_use]
pub fn free_axes(scene: &Scene, bounds: [Vector; 2]) -> Vec<usize> {
    if !(scene.tractions.is_empty()
        && scene.held_boxes.is_empty()
        && scene.point_loads.is_empty()
        && scene.base_motion.is_none())
    {
        return vec![];
    }
    let mesh = &scene.mesh;
    let [low, high] = bounds;
    let far = |axis: usize, side: usize| {
        let distance = if side == 0 {
            low[axis] - mesh.origin[axis]
        } else {
            mesh.upper()[axis] - high[axis]
        };
        mesh.planes[axis][side] == PlaneCondition::Free || distance > OUT_OF_REACH * mesh.cell[axis]
    };
    (0..scene.dimension.axes())
        .filter(|axis| (0..2).all(|side| far(*axis, side)))
        .collect()
}

/// The scene with its mesh moved by a part of a cell along these axes, and as much of it as before.
#[must_use]
pub fn moved(scene: &Scene, axes: &[usize], part: f64) -> Scene {
    let mut scene = scene.clone();
    for &axis in axes {
        let mesh = &mut scene.mesh;
        mesh.origin[axis] -= part * mesh.cell[axis];
        mesh.cells[axis] += 1;
    }
    scene
}
