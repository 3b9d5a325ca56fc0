//! Mortar contact on a base that moves steadily: seen from the base, nothing has changed.

use crate::common::simulation;
use crate::physics::mortar::{self, run_until};
use crate::physics::mortar_space;
use proctor_scene::simulation::Simulation;
use proctor_scene::{BaseMotion, History, Motion, PlaneCondition, Scene, TimeStep, Vector};

/// The scene with everything in it on a base that moves.
fn carried(scene: &Scene, base: Vector) -> Scene {
    let mut scene = scene.clone();
    scene.base_motion = Some(BaseMotion {
        axis: 0,
        side: 0,
        motion: Motion::Velocity(History {
            times: vec![0.0],
            values: vec![base],
        }),
    });
    for body in &mut scene.bodies {
        body.velocity[0] += base[0];
    }
    scene
}

/// Largest distance between the particles of two simulations, relative to their meshes \[m\].
fn apart(a: &Simulation, b: &Simulation) -> f64 {
    let mut most = 0.0_f64;
    for (a, b) in a.sets().iter().zip(b.sets()) {
        for p in 0..a.len() {
            // Particles are stored in the order of their cells, which round-off may change.
            let q = b.id.iter().position(|id| *id == a.id[p]).expect("the same");
            let (x, y) = (a.position(p), b.position(q));
            let square: f64 = (0..3).map(|axis| (x[axis] - y[axis]).powi(2)).sum();
            most = most.max(square.sqrt());
        }
    }
    most
}

fn check(mut scene: Scene, base: Vector, end: f64) {
    let id = 1;
    scene.time_step = TimeStep::Fixed {
        dt: 2.0e-4,
        allow_unstable: false,
    };
    scene.check().expect("sound");
    let carried = carried(&scene, base);
    carried
        .check()
        .expect("mortar contact on a moving base is sound");
    let (mut still, mut moving) = (simulation(&scene), simulation(&carried));
    let mut pushed = 0.0_f64;
    let mut time = 0.0;
    while time < end {
        time += end / 16.0;
        run_until(&mut still, time);
        run_until(&mut moving, time);
        let force = |s: &Simulation| s.mortar_force(id).expect("a boundary")[0];
        let (a, b) = (force(&still), force(&moving));
        pushed = pushed.max(a.abs());
        assert!((a - b).abs() <= 1e-6 * pushed.max(1.0), "{a} N, {b} N");
    }
    assert!(pushed > 30.0, "{pushed} N");
    let apart = apart(&still, &moving);
    assert!(apart <= 1e-9, "{apart} m");
    assert!((moving.origin()[0] - still.origin()[0] - base[0] * moving.time()).abs() < 1e-9);
    let vertices = |s: &Simulation| s.boundary_vertices(id).expect("has a boundary");
    for (a, b) in vertices(&still).iter().zip(vertices(&moving)) {
        assert!((b[0] - a[0] - base[0] * moving.time()).abs() < 1e-9);
    }
}

#[test]
fn a_collision_in_the_plane_is_the_same_on_a_moving_base() {
    check(mortar::collision(0.4), [1.5, -0.25, 0.0], 0.1);
}

/// Balls cut by a wall that slides along with the base: the vertices in the wall go with it.
#[test]
fn a_collision_in_space_is_the_same_on_a_moving_base() {
    let mut scene = mortar_space::collision(0.4);
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    check(scene, [1.5, -0.25, 0.125], 0.08);
}

/// A block between the walls along which the base moves pushes another: its vertices in the wall go with the mesh.
#[test]
fn vertices_in_a_wall_that_moves_stay_in_it() {
    let mut scene = mortar_space::collision(0.0);
    scene.mesh.planes[0] = [PlaneCondition::Fixed, PlaneCondition::Sliding];
    scene.bodies[0].shape = proctor_scene::Shape::Cuboid {
        p1: [0.0, 0.2, 0.2],
        p2: [0.4, 0.7, 0.7],
    };
    scene.bodies[1].shape = proctor_scene::Shape::Cuboid {
        p1: [0.43, 0.2, 0.2],
        p2: [0.8, 0.7, 0.7],
    };
    scene.bodies[0].velocity = [0.0; 3];
    scene.bodies[1].velocity = [-2.0, 0.0, 0.0];
    check(scene, [1.5, 0.0, 0.0], 0.04);
}
