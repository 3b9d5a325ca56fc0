//! Places of bodies at the start: the boxes around them, and the planes and bodies that share nodes with them.

use crate::values::{Body, Scene};
use proctor_kernel::model::Vector;

/// Lower and upper corner of the box around a body \[m\]; `None` for one that is moved as prescribed, or empty.
pub(super) fn free_box(body: &Body) -> Option<[Vector; 2]> {
    body.motion.is_none().then(|| body.shape.bounds())?
}

/// Distance of a box from a boundary plane \[m\].
pub(super) fn from_plane(scene: &Scene, bounds: &[Vector; 2], axis: usize, side: usize) -> f64 {
    let mesh = &scene.mesh;
    if side == 0 {
        bounds[0][axis] - mesh.origin[axis]
    } else {
        mesh.upper()[axis] - bounds[1][axis]
    }
}

/// True if a box is so near a boundary plane that particles in it reach the nodes of the plane.
pub(super) fn at_plane(scene: &Scene, bounds: &[Vector; 2], axis: usize, side: usize) -> bool {
    let reach = scene.mesh.cell[axis] - scene.mesh.tolerance(axis);
    from_plane(scene, bounds, axis, side) < reach
}

/// Gap between two boxes along an axis \[m\]; negative where they overlap.
pub(super) fn gap(a: &[Vector; 2], b: &[Vector; 2], axis: usize) -> f64 {
    (b[0][axis] - a[1][axis]).max(a[0][axis] - b[1][axis])
}

/// Key of a boundary plane in scene files.
pub(super) fn plane(axis: usize, side: usize) -> String {
    format!("plane_{}{}", ["X", "Y", "Z"][axis], ["0", "n"][side])
}

/// A name for messages: that of the body, or its identifier.
pub(super) fn name(body: &Body) -> String {
    if body.name.is_empty() {
        format!("body {}", body.id)
    } else {
        body.name.clone()
    }
}
