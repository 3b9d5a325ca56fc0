//! Mortar contact in the cycle: balance, bits, and vertices that follow their body.

use crate::common::{
    APIC, FLIP, IDENTITY, body, cuboid, elastic, empty, material, momentum_scale, options,
    run_towards, simulation,
};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{
    BodyBoundary, Dimension, Enforcement, HeldBox, History, Mortar, MortarContact, PlaneCondition,
    RigidLine, Scene, Shape, StressScheme, TimeStep, Transfer, Vertices, Weighting,
};
use std::f64::consts::TAU;
use std::sync::Arc;

pub const GAP: f64 = 0.04;

pub fn contact(master: i64, slave: i64, friction: f64) -> MortarContact {
    MortarContact {
        name: "contact".into(),
        id: 1,
        master,
        slave,
        friction,
        critical_gap: GAP,
        normal_stiffness: 1.0e6,
        tangential_stiffness: 1.0e7,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    }
}

pub fn disc(center: [f64; 2], radius: f64) -> Shape {
    Shape::Sphere {
        center: [center[0], center[1], 0.0],
        radius,
    }
}

pub fn boundary(body: i64, follow: FollowMode) -> BodyBoundary {
    BodyBoundary {
        body,
        vertices: Vertices::Spacing(0.05),
        follow,
    }
}

pub fn line(points: &[[f64; 2]]) -> RigidLine {
    RigidLine {
        name: "line".into(),
        id: 9,
        chains: vec![Chain {
            points: points.iter().map(|p| Point::from(*p)).collect(),
            side: BoundarySide::Open,
        }],
        motion: None,
    }
}

/// Two discs that hit each other off centre.
pub fn collision(friction: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [24, 14, 1], 0.1);
    scene.transfer = APIC;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![
        body(1, disc([0.75, 0.6], 0.3)),
        body(2, disc([1.41, 0.75], 0.3)),
    ];
    for body in &mut scene.bodies {
        body.particles_per_cell = [2, 2, 1];
    }
    scene.bodies[0].velocity = [2.0, 0.0, 0.0];
    scene.bodies[1].velocity = [-2.0, 0.5, 0.0];
    scene.mortar.boundaries = vec![
        boundary(1, FollowMode::Spin),
        boundary(2, FollowMode::Material),
    ];
    scene.mortar.contacts = vec![contact(1, 2, friction)];
    scene
}

pub fn run_until(simulation: &mut Simulation, time: f64) {
    while simulation.time() < time {
        run_towards(simulation, 1, time);
    }
}

#[test]
fn a_collision_keeps_the_momentum() {
    let usl = StressScheme::Usl;
    let runs = [
        (0.0, APIC, usl),
        (0.4, APIC, usl),
        (0.4, FLIP, usl),
        (0.4, APIC, StressScheme::Musl),
        (0.4, FLIP, StressScheme::Musl),
    ];
    for (friction, transfer, scheme) in runs {
        let mut scene = collision(friction);
        scene.transfer = transfer;
        scene.scheme = scheme;
        scene.check().expect("sound");
        let mut simulation = simulation(&scene);
        let (before, scale) = (simulation.momentum(), momentum_scale(&simulation));
        let mut pushed = 0.0_f64;
        while simulation.time() < 0.12 {
            run_towards(&mut simulation, 1, 0.12);
            let [a, b] = [1, 2].map(|id| simulation.mortar_force(id).expect("has a boundary"));
            for axis in 0..2 {
                assert!((a[axis] + b[axis]).abs() <= 1e-12 * a[axis].abs().max(1.0));
            }
            pushed = pushed.max(b[0]);
        }
        assert!(pushed > 100.0, "{pushed}");
        // They part, each the way it came.
        assert!(simulation.center(0).velocity[0] < -0.5 && simulation.center(1).velocity[0] > 0.5);
        for (axis, p) in simulation.momentum().iter().enumerate() {
            assert!(
                (p - before[axis]).abs() < 1e-12 * scale,
                "{p} {}",
                before[axis]
            );
        }
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
        run_towards(&mut simulation, 60, 1.0);
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

/// A line that is never reached is a contact that does nothing.
#[test]
fn a_contact_that_never_meets_changes_no_bit() {
    let run = |with: bool| {
        let mut scene = collision(0.0);
        scene.bodies.truncate(1);
        scene.mortar = Mortar::default();
        if with {
            scene.mortar.boundaries = vec![boundary(1, FollowMode::Spin)];
            scene.mortar.lines = vec![line(&[[2.2, 0.05], [0.1, 0.05]])];
            scene.mortar.contacts = vec![contact(9, 1, 0.3)];
        }
        let mut simulation = simulation(&scene);
        run_towards(&mut simulation, 40, 1.0);
        simulation.state_hash()
    };
    assert_eq!(run(true), run(false));
}

/// Mean distance of the vertices from where the mean turn of the particles would have brought them, after about one turn \[m\].
fn drift(follow: FollowMode, transfer: Transfer) -> f64 {
    let mut scene = empty(Dimension::Two, [14, 14, 1], 0.1);
    let center = [0.7, 0.7, 0.0];
    scene.transfer = transfer;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![body(
        1,
        Shape::Cuboid {
            p1: [0.4, 0.5, 0.0],
            p2: [1.0, 0.9, 0.0],
        },
    )];
    scene.mortar.boundaries = vec![boundary(1, follow)];
    let options = Options {
        displacement: true,
        initial: Some(Arc::new(move |x| InitialState {
            velocity: [-TAU * (x[1] - center[1]), TAU * (x[0] - center[0]), 0.0],
            velocity_gradient: [[0.0, -TAU, 0.0], [TAU, 0.0, 0.0], [0.0; 3]],
            stress: [0.0; 6],
            deformation: IDENTITY,
        })),
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("sound");
    let before = simulation.boundary_vertices(1).expect("has one");
    while simulation.time() < 1.0 {
        run_towards(&mut simulation, 1, 1.0);
    }
    let from_center = |x: [f64; 3]| Point::new(x[0] - center[0], x[1] - center[1]);
    let (mut sin, mut cos) = (0.0, 0.0);
    for p in 0..simulation.particles() {
        let now = from_center(simulation.position(0, p));
        let then = from_center(simulation.initial_position(0, p).expect("kept"));
        sin += then.perp(&now);
        cos += then.dot(&now);
    }
    let turn = nalgebra::Rotation2::new(sin.atan2(cos));
    let after = simulation.boundary_vertices(1).expect("has one");
    let sum: f64 = before
        .iter()
        .zip(&after)
        .map(|(a, b)| (turn * from_center(*a) - from_center(*b)).norm_squared())
        .sum();
    (sum / before.len() as f64).sqrt()
}

/// The body deforms a little meanwhile; what the update of the vertices leaves out comes on top.
#[test]
fn vertices_follow_a_turning_body() {
    let follows = [
        FollowMode::Velocity,
        FollowMode::Spin,
        FollowMode::Gradient,
        FollowMode::Material,
    ];
    let [velocity, spin, gradient, material] = follows.map(|follow| drift(follow, APIC));
    // With FLIP the spins come from a velocity gradient that is kept for them alone.
    let flip = drift(FollowMode::Spin, FLIP);
    assert!(flip < 0.02, "{flip}");
    assert!(spin < 0.02, "{velocity} {spin} {gradient}");
    assert!(gradient < 0.02, "{velocity} {spin} {gradient}");
    assert!(material < 0.02, "{velocity} {spin} {gradient} {material}");
    assert!(velocity > 3.0 * spin, "{velocity} {spin} {gradient}");
}

/// A block whose middle hangs behind its ends, or its right half beside a plane of symmetry: the way of the vertices on
/// the right half in the first steps, with the places that they had \[m\].
fn sagging(half: bool, follow: FollowMode) -> Vec<([f64; 2], f64)> {
    let middle = 1.2;
    let mut scene = empty(Dimension::Two, [24, 14, 1], 0.1);
    let mut left = 0.7;
    if half {
        scene.mesh.origin[0] = middle;
        scene.mesh.cells[0] = 12;
        scene.mesh.planes[0][0] = PlaneCondition::Sliding;
        left = middle;
    }
    scene.transfer = APIC;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    let shape = cuboid([left, 0.45, 0.0], [1.7, 0.95, 0.0]);
    scene.bodies = vec![body(1, shape)];
    scene.mortar.boundaries = vec![boundary(1, follow)];
    // Of a spin alone the images count, for which particles must reach beyond the plane.
    if follow == FollowMode::Spin {
        scene.weighting = Weighting::QuadraticBSpline;
    }
    let options = Options {
        initial: Some(Arc::new(move |x| {
            let k = TAU / 1.0;
            let (sin, cos) = (k * (x[0] - middle)).sin_cos();
            InitialState {
                velocity: [0.0, -cos, 0.0],
                velocity_gradient: [[0.0; 3], [k * sin, 0.0, 0.0], [0.0; 3]],
                stress: [0.0; 6],
                deformation: IDENTITY,
            }
        })),
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("sound");
    let before = simulation.boundary_vertices(1).expect("has one");
    run_towards(&mut simulation, 5, 1.0);
    let after = simulation.boundary_vertices(1).expect("has one");
    let ways = before
        .iter()
        .zip(&after)
        .map(|(a, b)| ([a[0], a[1]], b[1] - a[1]));
    // The side that lies in the plane is no part of the whole block.
    ways.filter(|([x, y], _)| *x > middle - 1e-9 && (*y - 0.7).abs() > 0.2)
        .collect()
}

/// Nodes on a plane of symmetry have half of the mass that they have in the whole body, and the same share in a vertex; its
/// image turns the other way.
#[test]
fn half_a_body_beside_a_plane_of_symmetry_moves_as_the_whole_does() {
    for follow in [FollowMode::Velocity, FollowMode::Spin, FollowMode::Material] {
        let (whole, half) = (sagging(false, follow), sagging(true, follow));
        assert!(half.len() > 20);
        let most = whole.iter().map(|(_, way)| way.abs()).fold(0.0, f64::max);
        assert!(most > 1e-3);
        // With spins the vertices in the plane itself leave it by what images give them of normal velocity, and those beside
        // it go another way by the square of that.
        let within = if follow == FollowMode::Spin {
            1e-5
        } else {
            1e-7
        };
        let judged = |at: &[f64; 2]| follow != FollowMode::Spin || at[0] > 1.2 + 1e-9;
        for (at, way) in half.iter().filter(|(at, _)| judged(at)) {
            let near = |(x, _): &&([f64; 2], f64)| (x[0] - at[0]).hypot(x[1] - at[1]) < 1e-9;
            let (_, expected) = whole.iter().find(near).expect("the same vertices");
            assert!(
                (way - expected).abs() < within * most,
                "{follow:?} {at:?}: {way} {expected}"
            );
        }
    }
}

/// Nodes without mass take their share of contact forces with them.
#[test]
fn without_augmentation_momentum_is_lost() {
    let mut scene = collision(0.4);
    for boundary in &mut scene.mortar.boundaries {
        boundary.follow = FollowMode::Unaugmented;
    }
    let mut simulation = simulation(&scene);
    let (before, scale) = (simulation.momentum(), momentum_scale(&simulation));
    // Vertices at nodes of no mass follow a part of the velocity alone. Those of bodies that end on lines of the mesh soon leave
    // them, and the run stops.
    let mut lost = 0.0_f64;
    while simulation.time() < 0.12 && simulation.step(0.12).is_ok() {
        let after = simulation.momentum();
        lost = lost.max((after[0] - before[0]).hypot(after[1] - before[1]) / scale);
    }
    assert!(lost > 1e-6, "{lost}");
}

/// Strains from velocities that are mapped again keep the energy of FLIP; those before the particles have the forces
/// of the step take some with every swing. What the former gain goes with the time step.
#[test]
fn musl_keeps_the_energy_that_usl_takes() {
    let lost = |scheme, multiplier| {
        let mut scene = collision(0.0);
        (scene.scheme, scene.transfer) = (scheme, FLIP);
        scene.time_step = TimeStep::Multiplier {
            multiplier,
            allow_unstable: false,
        };
        scene.check().expect("sound");
        let mut simulation = simulation(&scene);
        let before = simulation.kinetic_energy();
        run_until(&mut simulation, 0.12);
        assert_eq!(simulation.mortar_energy(), 0.0);
        1.0 - (simulation.kinetic_energy() + simulation.strain_energy()) / before
    };
    let [usl, musl] = [StressScheme::Usl, StressScheme::Musl].map(|scheme| lost(scheme, 0.1));
    assert!(musl.abs() < 0.015 && usl > 5.0 * musl.abs(), "{usl} {musl}");
    let coarse = lost(StressScheme::Musl, 0.2);
    assert!(coarse.abs() > 1.3 * musl.abs(), "{coarse} {musl}");
}

/// Nodes that are held stand still in the field of a body with a boundary too.
#[test]
fn a_held_body_with_a_boundary_stands_still() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene = collision(0.0);
        scene.scheme = scheme;
        scene.gravity = [0.0, -10.0, 0.0];
        scene.mortar.contacts.clear();
        scene.bodies[1].velocity = [0.0; 3];
        scene.held_boxes = vec![HeldBox {
            p1: [1.05, 0.3, 0.0],
            p2: [2.4, 1.4, 0.0],
        }];
        let mut simulation = simulation(&scene);
        let before = simulation.boundary_vertices(2);
        run_towards(&mut simulation, 50, 0.05);
        assert_eq!(simulation.boundary_vertices(2), before);
        assert_eq!(simulation.center(1).velocity, [0.0; 3]);
        assert!(simulation.center(0).velocity[1] < -0.1);
    }
}

/// A plate that comes up at a disc at rest.
pub fn plate(speed: f64) -> Scene {
    let mut scene = collision(0.0);
    scene.bodies.truncate(1);
    scene.bodies[0].velocity = [0.0; 3];
    scene.mortar.boundaries.truncate(1);
    scene.mortar.lines = vec![line(&[[2.2, 0.2], [0.1, 0.2]])];
    scene.mortar.lines[0].motion = Some(History {
        times: vec![0.0],
        values: vec![[0.0, speed, 0.0]],
    });
    scene.mortar.contacts = vec![contact(9, 1, 0.0)];
    scene
}

/// A plate at constant speed does the work of its speed times the impulse, and the disc has it when it flies off.
#[test]
fn the_work_of_a_plate_is_the_energy_of_what_it_hits() {
    let speed = 2.0;
    let mut scene = plate(speed);
    scene.transfer = FLIP;
    scene.scheme = StressScheme::Musl;
    let mut simulation = simulation(&scene);
    run_until(&mut simulation, 0.12);
    assert_eq!(simulation.mortar_energy(), 0.0, "they have parted");
    let energy = simulation.energy();
    let work = speed * simulation.momentum()[1];
    assert!(work > 0.0);
    assert!(
        (energy.external_work / work - 1.0).abs() < 0.01,
        "{energy:?} {work}"
    );
    assert!(energy.dissipated.abs() < 0.05 * work, "{energy:?}");
}
