//! Round bodies that collide on few cells.

use super::places::name;
use crate::values::{Body, Scene};
use proctor_kernel::model::Damping;

/// Cells across a round body from which it bounces back within 10 % of what it does on fine meshes.
const ENOUGH: f64 = 12.0;

/// Round bodies that fly at another with which they are in contact on the grid, undamped, a few cells across.
///
/// The two discs of the starter `discs` bounce back with 0.936 of their speed on fine meshes. On eight cells across it was 0.78 to
/// 0.89, for seven places of the mesh and two to four particles per cell and axis; on twelve 0.85 to 0.91, on sixteen 0.87 to 0.92,
/// for five places each. The nodes at which they touch take part with their whole mass at once, and the transfer smooths the waves
/// that follow.
pub(super) fn collide_on_few_cells(scene: &Scene) -> Vec<String> {
    if scene.damping != Damping::None {
        return vec![];
    }
    let axes = &scene.mesh.cell[..scene.dimension.axes()];
    let cell = axes.iter().copied().fold(0.0, f64::max);
    let flies_at = |body: &Body, id: i64| {
        let other = scene.bodies.iter().find(|other| other.id == id);
        other.is_some_and(|other| other.motion.is_none() && other.velocity != body.velocity)
    };
    let of = |body: &Body| {
        let across = 2.0 * body.shape.radius()? / cell;
        let mut contacts = scene.contacts.iter();
        let collides = contacts.any(|c| {
            (c.master == body.id && flies_at(body, c.slave))
                || (c.slave == body.id && flies_at(body, c.master))
        });
        (collides && body.motion.is_none() && across < ENOUGH * (1.0 - 1e-9)).then(|| {
            format!(
                "{}: it is {across:.3} cells across and collides: discs eight cells across bounced back with 5 to 17 % less of \
                 their speed than on fine meshes, depending on their place in the mesh, those of sixteen with 2 to 7 % less; \
                 `proctor refine` says what is lost in this scene",
                name(body)
            )
        })
    };
    scene.bodies.iter().filter_map(of).collect()
}
