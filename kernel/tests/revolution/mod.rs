//! Bodies of revolution: forces at rest, motion, loads of the full circle, and what is refused.

mod absorbing;
mod loads;
mod means;
mod motion;
mod patch;
mod refused;
mod steps;

use crate::common::{body, cuboid, empty};
use proctor_scene::{Dimension, PlaneCondition, Scene};

/// A scene without bodies whose first axis is a radius from zero on; its axis slides, its other planes are free.
pub fn revolved(cells: [usize; 2], h: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [cells[0], cells[1], 1], h);
    scene.mesh.axisymmetric = true;
    scene.mesh.planes[0][0] = PlaneCondition::Sliding;
    scene
}

/// A solid cylinder of 0.5 m by 0.4 m on the axis of a mesh of cells of 0.1 m.
pub fn cylinder() -> Scene {
    let mut scene = revolved([8, 8], 0.1);
    scene.bodies = vec![body(1, cuboid([0.0, 0.2, 0.0], [0.5, 0.6, 0.0]))];
    scene.bodies[0].particles_per_cell = [2, 2, 1];
    scene
}
