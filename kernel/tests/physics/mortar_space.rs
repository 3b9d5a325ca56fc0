//! Mortar contact of triangulated boundaries in the cycle: balance, vertices that follow their body, bits, and edges.

use crate::common::{
    APIC, IDENTITY, body, elastic, empty, material, momentum_scale, options, run_towards,
    simulation,
};
use crate::physics::mortar::{GAP, contact};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_scene::simulation::{InitialState, MortarError, Options, SetupError, Simulation};
use proctor_scene::{BodyBoundary, Dimension, PlaneCondition, Scene, Shape, Vertices};
use std::sync::Arc;

fn boundary(body: i64, follow: FollowMode) -> BodyBoundary {
    BodyBoundary {
        body,
        vertices: Vertices::Spacing(0.1),
        follow,
    }
}

/// Two balls that hit each other off centre.
pub fn collision(friction: f64) -> Scene {
    let ball = |center: [f64; 3]| Shape::Sphere {
        center,
        radius: 0.3,
    };
    let mut scene = empty(Dimension::Three, [18, 10, 10], 0.1);
    scene.transfer = APIC;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![
        body(1, ball([0.5, 0.45, 0.45])),
        body(2, ball([1.16, 0.55, 0.5])),
    ];
    for body in &mut scene.bodies {
        body.particles_per_cell = [2, 2, 2];
    }
    scene.bodies[0].velocity = [2.0, 0.0, 0.0];
    scene.bodies[1].velocity = [-2.0, 0.5, 0.3];
    scene.mortar.boundaries = vec![
        boundary(1, FollowMode::Spin),
        boundary(2, FollowMode::Material),
    ];
    scene.mortar.contacts = vec![contact(1, 2, friction)];
    scene
}

#[test]
fn a_collision_keeps_the_momentum() {
    let scene = collision(0.4);
    scene.check().expect("sound");
    let mut simulation = simulation(&scene);
    let (before, scale) = (simulation.momentum(), momentum_scale(&simulation));
    let mut pushed = 0.0_f64;
    while simulation.time() < 0.1 {
        run_towards(&mut simulation, 1, 0.1);
        let [a, b] = [1, 2].map(|id| simulation.mortar_force(id).expect("has a boundary"));
        for axis in 0..3 {
            assert!((a[axis] + b[axis]).abs() <= 1e-12 * a[0].abs().max(1.0));
        }
        pushed = pushed.max(b[0]);
    }
    assert!(pushed > 30.0, "{pushed}");
    // They part, each the way it came.
    assert!(simulation.center(0).velocity[0] < -0.3 && simulation.center(1).velocity[0] > 0.3);
    for (axis, p) in simulation.momentum().iter().enumerate() {
        assert!(
            (p - before[axis]).abs() < 1e-12 * scale,
            "{p} {}",
            before[axis]
        );
    }
}

#[test]
fn threads_change_no_bit() {
    let scene = collision(0.4);
    let hash = |threads| {
        let options = Options {
            threads: Some(threads),
            least_share: Some(1),
            ..options()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("sound");
        run_towards(&mut simulation, 40, 1.0);
        assert!(simulation.mortar_energy() > 0.0);
        (
            simulation.state_hash(),
            simulation.mortar_energy().to_bits(),
        )
    };
    let one = hash(1);
    for threads in [2, 3, 5] {
        assert_eq!(hash(threads), one, "{threads} threads");
    }
}

/// A ball in free rotation: vertices turn with it when they follow spin or gradient, and lag behind with velocities
/// alone.
#[test]
fn vertices_turn_with_their_body() {
    let omega = [3.0, -2.0, 5.0];
    let (center, time) = ([0.5, 0.5, 0.5], 0.2);
    let error = |follow: FollowMode| {
        let mut scene = empty(Dimension::Three, [10, 10, 10], 0.1);
        scene.transfer = APIC;
        scene.materials = vec![material(elastic(1.0e6, 0.3))];
        let radius = 0.3;
        scene.bodies = vec![body(1, Shape::Sphere { center, radius })];
        scene.bodies[0].particles_per_cell = [3, 3, 3];
        scene.mortar.boundaries = vec![boundary(1, follow)];
        let gradient = [
            [0.0, -omega[2], omega[1]],
            [omega[2], 0.0, -omega[0]],
            [-omega[1], omega[0], 0.0],
        ];
        let options = Options {
            initial: Some(Arc::new(move |x: &[f64; 3]| {
                let r: [f64; 3] = std::array::from_fn(|axis| x[axis] - center[axis]);
                InitialState {
                    velocity: gradient.map(|row| (0..3).map(|k| row[k] * r[k]).sum()),
                    velocity_gradient: gradient,
                    stress: [0.0; 6],
                    deformation: IDENTITY,
                }
            })),
            ..options()
        };
        let mut simulation = Simulation::new(&scene, &options).expect("sound");
        let start = simulation.boundary_vertices(1).expect("has a boundary");
        while simulation.time() < time {
            run_towards(&mut simulation, 1, time);
        }
        let turn = nalgebra::Rotation3::new(nalgebra::Vector3::from(omega) * time);
        let c = nalgebra::Vector3::from(center);
        let vertices = simulation.boundary_vertices(1).expect("has a boundary");
        let squares: f64 = start
            .iter()
            .zip(&vertices)
            .map(|(from, to)| {
                let exact = c + turn * (nalgebra::Vector3::from(*from) - c);
                (nalgebra::Vector3::from(*to) - exact).norm_squared()
            })
            .sum();
        (squares / start.len() as f64).sqrt()
    };
    let follows = [
        FollowMode::Velocity,
        FollowMode::Spin,
        FollowMode::Gradient,
        FollowMode::Material,
    ];
    let [velocity, spin, gradient, material] = follows.map(error);
    // A turn of 1.2 rad carries the vertices by 0.3 m.
    assert!(
        spin < 0.01 && gradient < 0.01 && material < 0.01,
        "{spin} {gradient} {material}"
    );
    assert!(velocity > 3.0 * spin, "{velocity} {spin}");
}

/// A block that fills the mesh from wall to wall: its faces in the walls bound nothing, and its vertices stay in them.
#[test]
fn faces_in_walls_are_left_out() {
    let mut scene = empty(Dimension::Three, [8, 2, 8], 0.1);
    scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
    scene.transfer = APIC;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![body(
        1,
        Shape::Cuboid {
            p1: [0.2, 0.0, 0.2],
            p2: [0.6, 0.2, 0.6],
        },
    )];
    scene.bodies[0].velocity = [1.0, 0.0, 0.5];
    scene.mortar.boundaries = vec![boundary(1, FollowMode::Material)];
    scene.check().expect("sound");
    let mut simulation = simulation(&scene);
    let start = simulation.boundary_vertices(1).expect("has a boundary");
    // Four faces of 4 x 2 cells: no vertex inside the faces y = 0 and y = 0.2.
    assert_eq!(start.len(), 3 * 16);
    run_towards(&mut simulation, 20, 1.0);
    let moved = simulation.boundary_vertices(1).expect("has a boundary");
    for (a, b) in start.iter().zip(&moved) {
        assert_eq!(a[1], b[1]);
        let expected = [simulation.time(), 0.5 * simulation.time()];
        assert!((b[0] - a[0] - expected[0]).abs() < 1e-12);
        assert!((b[2] - a[2] - expected[1]).abs() < 1e-12);
    }
}

/// Two roofs, edge across edge, that come closer: a case that faces do not see.
fn roofs(distance: f64) -> Scene {
    let mut scene = empty(Dimension::Three, [12, 12, 14], 0.1);
    scene.transfer = APIC;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    let roof = |axis: usize, base: f64, top: f64| Shape::ExtrudedPolygon {
        points: vec![[0.3, base], [0.9, base], [0.6, top]],
        axis,
        range: [0.2, 1.0],
    };
    let middle = 0.7;
    scene.bodies = vec![
        body(1, roof(0, middle - 0.4, middle)),
        body(2, roof(1, middle + distance + 0.4, middle + distance)),
    ];
    scene.bodies[1].velocity = [0.0, 0.0, -1.0];
    scene.mortar.boundaries = vec![boundary(1, FollowMode::Spin), boundary(2, FollowMode::Spin)];
    scene.mortar.contacts = vec![contact(1, 2, 0.0)];
    scene
}

#[test]
fn edges_that_meet_are_named() {
    let Err(error) = Simulation::new(&roofs(0.5 * GAP), &options()) else {
        panic!("edges within the critical gap");
    };
    assert!(matches!(&error, SetupError::Interaction { path, .. } if path == "contact"));
    assert!(error.to_string().contains("sharp edge"), "{error}");
    let mut simulation = simulation(&roofs(1.5 * GAP));
    let error = loop {
        match simulation.step(1.0) {
            Ok(_) => assert!(simulation.time() < 0.5, "nobody noticed"),
            Err(error) => break error,
        }
    };
    let Some(&MortarError::EdgesMeet {
        bodies, position, ..
    }) = error.kind.fault()
    else {
        panic!("{error}");
    };
    assert_eq!(bodies, [1, 2]);
    assert!((position[0] - 0.6).abs() < 0.02 && (position[1] - 0.6).abs() < 0.02);
}
