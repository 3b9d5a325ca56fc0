//! Scenes in space with the first two axes changed for each other: long strips have few planes and many rows then.

use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{BaseMotion, History, Motion, Scene, Shape, Vector};
use std::sync::Arc;

/// The scene with its start.
pub(super) fn turned(scene: &Scene, initial: &InitialField) -> (Scene, InitialField) {
    let mut scene = scene.clone();
    let turn = |v: &mut Vector| v.swap(0, 1);
    scene.mesh.cells.swap(0, 1);
    scene.mesh.planes.swap(0, 1);
    scene.water_planes.swap(0, 1);
    scene.water_pressures.swap(0, 1);
    turn(&mut scene.gravity);
    for body in &mut scene.bodies {
        let Shape::Cuboid { p1, p2 } = &mut body.shape else {
            panic!("{} is no cuboid", body.name);
        };
        [p1, p2].into_iter().for_each(turn);
        body.particles_per_cell.swap(0, 1);
        turn(&mut body.velocity);
        body.motion.iter_mut().for_each(turn_history);
    }
    for water in scene.pore_water.iter_mut().flatten() {
        turn(&mut water.conductivity);
    }
    for load in &mut scene.box_loads {
        [&mut load.p1, &mut load.p2, &mut load.force]
            .into_iter()
            .for_each(turn);
    }
    for held in &mut scene.held_pressures {
        [&mut held.p1, &mut held.p2].into_iter().for_each(turn);
    }
    for surface in &mut scene.surfaces {
        let all = 0..surface.surface.triangle_count();
        let triangles: Vec<_> = all
            .map(|number| {
                // What is mirrored turns its other side to the outside.
                let [a, c, b] = surface.surface.corners(number).map(|[x, y, z]| [y, x, z]);
                [a, b, c]
            })
            .collect();
        surface.surface = Arc::new(Surface::new(&triangles).expect("triangles"));
        surface.motion.iter_mut().for_each(turn_history);
    }
    let base = scene.base_motion.iter_mut();
    base.chain(&mut scene.ground_beyond.incoming)
        .for_each(turn_base);
    let initial = Arc::clone(initial);
    let start: InitialField = Arc::new(move |&[x, y, z]| {
        let mut state: InitialState = initial(&[y, x, z]);
        state.velocity.swap(0, 1);
        state.stress.swap(0, 1);
        state.stress.swap(3, 4);
        state
    });
    (scene, start)
}

fn turn_history(history: &mut History) {
    history.values.iter_mut().for_each(|v| v.swap(0, 1));
}

fn turn_base(base: &mut BaseMotion) {
    base.axis = [1, 0, 2][base.axis];
    if let Motion::Velocity(history) = &mut base.motion {
        turn_history(history);
    }
}
