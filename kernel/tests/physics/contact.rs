//! Contact between bodies: sliding, sticking, parting, colliding, three at a node, rigid partners.

use crate::common::{
    APIC, DENSITY, DIMENSIONS, FLIP, IDENTITY, NEVER, SCHEMES, TPIC, body, cuboid, elastic, empty,
    material, momentum_scale, options, particles, run, simulation,
};
use proctor_scene::simulation::{InitialState, Options, SetupError, Simulation};
use proctor_scene::{
    Contact, ContactNormal, Damping, Dimension, DomainUpdate, History, Scene, Shape, StressScheme,
    TimeStep, Transfer, Weighting,
};
use std::sync::Arc;

pub const H: f64 = 0.1;
/// Thickness of the base and height of the block \[m\].
const TOP: f64 = 0.3;
const HEIGHT: f64 = 0.3;

pub fn pair(id: i64, master: i64, slave: i64, friction: f64) -> Contact {
    Contact {
        name: format!("contact {id}"),
        id,
        friction,
        master,
        slave,
        normal: ContactNormal::Master,
    }
}

/// Direction of the normal of the base: y in two dimensions, z in three.
fn up(dimension: Dimension) -> usize {
    dimension.axes() - 1
}

/// A block on a rigid base, under the gravity (5, -10).
pub fn slope(dimension: Dimension, friction: f64) -> Scene {
    let mut scene = empty(dimension, [24, 8, 8], H);
    let flat = dimension == Dimension::Two;
    let at = |x: f64, side: f64, height: f64| {
        if flat {
            [x, height, 0.0]
        } else {
            [x, side, height]
        }
    };
    scene.bodies = vec![
        body(1, cuboid(at(0.1, 0.1, 0.0), at(2.3, 0.7, TOP))),
        body(2, cuboid(at(0.3, 0.2, TOP), at(0.8, 0.6, TOP + HEIGHT))),
    ];
    for body in &mut scene.bodies {
        body.particles_per_cell = [2, 2, if flat { 1 } else { 2 }];
    }
    scene.bodies[0].motion = Some(still());
    scene.materials = vec![material(elastic(1.0e6, 0.0))];
    scene.contacts = vec![pair(7, 1, 2, friction)];
    scene.gravity[0] = 5.0;
    scene.gravity[up(dimension)] = -10.0;
    scene
}

pub fn still() -> History {
    History {
        times: vec![0.0],
        values: vec![[0.0; 3]],
    }
}

/// The block carries its weight from the start: sigma = -rho g (H - y) along the normal (verification 4, step 1).
fn settled(scene: &Scene) -> Options {
    let up = up(scene.dimension);
    Options {
        initial: Some(Arc::new(move |x| {
            let mut stress = [0.0; 6];
            if x[up] > TOP {
                stress[up] = -DENSITY * 10.0 * (TOP + HEIGHT - x[up]);
            }
            InitialState {
                velocity: [0.0; 3],
                velocity_gradient: [[0.0; 3]; 3],
                stress,
                deformation: IDENTITY,
            }
        })),
        ..options()
    }
}

pub fn until(simulation: &mut Simulation, time: f64) {
    while simulation.time() < time {
        if let Err(e) = simulation.step(time) {
            let s = simulation.scene();
            panic!(
                "{:?} {:?} {:?} {:?}: {e}",
                s.dimension, s.weighting, s.scheme, s.transfer
            );
        }
    }
}

/// Mean acceleration of the block \[m/s²\] between two times, its mean normal force over its weight, and its rise.
fn slide(scene: &Scene) -> (f64, f64, f64) {
    let up = up(scene.dimension);
    let mut simulation = Simulation::new(scene, &settled(scene)).expect("the scene is sound");
    let start = simulation.center(1).position;
    until(&mut simulation, 0.1);
    let center = simulation.center(1);
    let (m, v_0) = (center.mass, center.velocity);
    let t_0 = simulation.velocity_time();
    let (mut impulse, mut time) = (0.0, 0.0);
    while simulation.time() < 0.4 {
        let dt = simulation.step(0.4).expect("the step is sound").dt;
        impulse += simulation.contact_force(1)[up] * dt;
        time += dt;
    }
    let center = simulation.center(1);
    let (x, v) = (center.position, center.velocity);
    let a = (v[0] - v_0[0]) / (simulation.velocity_time() - t_0);
    (a, impulse / time / (10.0 * m), x[up] - start[up])
}

fn check_slide(scene: &Scene, friction: f64) {
    let what = format!(
        "{:?} {:?} {:?} {:?} mu {friction}",
        scene.dimension, scene.weighting, scene.scheme, scene.transfer
    );
    let (a, normal, rise) = slide(scene);
    let exact = 5.0 - friction * 10.0;
    println!("{what}: a {a} of {exact}, N/W {normal}, rise {rise}");
    assert!((a - exact).abs() < 0.02 * 5.0, "{what}: a {a} of {exact}");
    assert!((normal - 1.0).abs() < 0.03, "{what}: N/W {normal}");
    // Neither hovers nor sinks: the static settlement is 4e-4 m.
    assert!(rise.abs() < 0.02 * H, "{what}: rises by {rise} m");
}

#[test]
fn a_block_slides_with_every_scheme_and_weighting() {
    for scheme in SCHEMES {
        for weighting in [
            Weighting::UniformGimp,
            Weighting::ContiguousGimp(DomainUpdate::Stretch),
            Weighting::QuadraticBSpline,
        ] {
            let mut scene = slope(Dimension::Two, 0.3);
            (scene.scheme, scene.weighting) = (scheme, weighting);
            check_slide(&scene, 0.3);
        }
    }
    for friction in [0.0, 0.1, 0.45] {
        check_slide(&slope(Dimension::Two, friction), friction);
    }
}

#[test]
fn a_block_slides_with_every_transfer_and_in_three_dimensions() {
    for (scheme, transfer) in [
        (StressScheme::Usl, APIC),
        (StressScheme::Musl, APIC),
        (StressScheme::Usf, TPIC),
    ] {
        let mut scene = slope(Dimension::Two, 0.3);
        (scene.scheme, scene.transfer) = (scheme, transfer);
        check_slide(&scene, 0.3);
    }
    for scheme in SCHEMES {
        let mut scene = slope(Dimension::Three, 0.2);
        scene.scheme = scheme;
        check_slide(&scene, 0.2);
    }
}

#[test]
fn linear_functions_slide_too() {
    for scheme in [StressScheme::Usf, StressScheme::Musl] {
        let mut scene = slope(Dimension::Two, 0.3);
        (scene.scheme, scene.weighting) = (scheme, Weighting::Linear);
        scene.time_step = TimeStep::Multiplier {
            multiplier: 0.2,
            allow_unstable: false,
        };
        check_slide(&scene, 0.3);
    }
}

/// mu >= tan(theta): the creep velocity falls to zero, either way.
#[test]
fn a_block_sticks() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            for sign in [1.0, -1.0] {
                // The swing of the start asks for twice the static friction of 0.5.
                let mut scene = slope(dimension, 1.2);
                scene.scheme = scheme;
                scene.gravity[0] *= sign;
                let mut simulation =
                    Simulation::new(&scene, &settled(&scene)).expect("the scene is sound");
                let start = simulation.center(1).position;
                until(&mut simulation, 0.4);
                let x = simulation.center(1).position;
                // Free, it would slide 0.4 m. It shears by g_x rho H²/2G = 4.5e-4 m, twice that while it swings.
                assert!(
                    (x[0] - start[0]).abs() < 1.5e-3,
                    "{dimension:?} {scheme:?}: creeps by {} m",
                    x[0] - start[0]
                );
            }
        }
    }
}

/// Local damping resists what is unbalanced, and contact is a part of what balances: a damped block at rest presses with
/// its weight, neither more nor less, and is pulled by its gravity alone.
#[test]
fn damping_takes_no_part_of_the_weight() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = slope(dimension, 0.6);
            scene.scheme = scheme;
            scene.damping = Damping::Local { alpha: 0.3 };
            // Half as steep as the friction allows at the most, where an elastic block surely comes to rest.
            scene.gravity[0] = 3.0;
            let mut simulation =
                Simulation::new(&scene, &settled(&scene)).expect("the scene is sound");
            until(&mut simulation, 0.5);
            let up = up(dimension);
            for _ in 0..40 {
                simulation.step(NEVER).expect("the step is sound");
                let center = simulation.center(1);
                let (m, v) = (center.mass, center.velocity);
                let force = simulation.contact_force(1);
                let off = [force[up] / (10.0 * m) - 1.0, force[0] / (3.0 * m) + 1.0];
                assert!(
                    off.iter().all(|off| off.abs() < 5.0e-3) && v[0].abs() < 1.0e-4,
                    "{dimension:?} {scheme:?}: weight and pull off by {off:?}, moves by {v:?}"
                );
            }
        }
    }
}

/// Two blocks side by side.
pub fn two(dimension: Dimension, gap: f64, velocities: [f64; 2]) -> Scene {
    let mut scene = empty(dimension, [20, 8, 8], H);
    scene.bodies = vec![
        body(1, cuboid([0.5, 0.2, 0.2], [0.9, 0.6, 0.6])),
        body(2, cuboid([0.9 + gap, 0.2, 0.2], [1.3 + gap, 0.6, 0.6])),
    ];
    for (body, v) in scene.bodies.iter_mut().zip(velocities) {
        body.velocity[0] = v;
    }
    scene.contacts = vec![pair(1, 1, 2, 0.3)];
    scene
}

#[test]
fn bodies_that_part_feel_no_force() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            for lambda in [None, Some(0.0), Some(0.5)] {
                for normal in [
                    ContactNormal::Master,
                    ContactNormal::Slave,
                    ContactNormal::Collinear,
                ] {
                    let mut scene = two(dimension, 0.0, [-1.0, 1.0]);
                    scene.scheme = scheme;
                    scene.contact_distance = lambda;
                    scene.contacts[0].normal = normal;
                    let mut together = simulation(&scene);
                    assert_eq!(together.contact_layers(), 2);
                    for _ in 0..30 {
                        let info = together.step(NEVER).expect("the step is sound");
                        let force = together.contact_force(1);
                        if lambda == Some(0.0) {
                            // Without distances round-off at an edge may count as approach.
                            assert!(force.iter().all(|f| f.abs() < 1.0e-12), "{force:?}");
                            continue;
                        }
                        assert_eq!(info.contact_nodes, 0, "{dimension:?} {scheme:?} {normal:?}");
                        assert_eq!((together.contact_force(0), force), ([0.0; 3], [0.0; 3]));
                    }
                    if lambda == Some(0.0) {
                        continue;
                    }
                    // Bit for bit as if the other were not there.
                    let steps = together.steps();
                    scene.contacts.clear();
                    let right = scene.bodies.pop();
                    let mut alone = simulation(&scene);
                    run(&mut alone, steps as usize);
                    let count = alone.particles();
                    assert_eq!(particles(&together)[..count], particles(&alone)[..]);
                    drop(right);
                }
            }
        }
    }
}

#[test]
fn a_collision_keeps_momentum_and_gains_no_energy() {
    for dimension in DIMENSIONS {
        for (scheme, transfer) in [
            (StressScheme::Usl, FLIP),
            (StressScheme::Musl, FLIP),
            (StressScheme::Usf, FLIP),
            (StressScheme::Musl, APIC),
        ] {
            for ratio in [1.0, 1.0e3, 1.0e6] {
                collide(dimension, scheme, transfer, ratio);
            }
        }
    }
}

fn collide(dimension: Dimension, scheme: StressScheme, transfer: Transfer, ratio: f64) {
    let mut scene = two(dimension, 0.03, [1.0, -1.0]);
    (scene.scheme, scene.transfer) = (scheme, transfer);
    // The heavy one is as fast a solid, so that it is not the softer one.
    scene.materials.push(material(elastic(1.0e6 * ratio, 0.3)));
    scene.materials[1].density = DENSITY * ratio;
    scene.bodies[1].material = 1;
    let mut simulation = simulation(&scene);
    let (before, energy) = (simulation.momentum(), simulation.kinetic_energy());
    let (mut touched, mut peak) = (false, 0.0_f64);
    // The wave of 36 m/s crosses a block of 0.4 m and comes back in 22 ms; the gap closes in 15 ms.
    while simulation.time() < 0.06 {
        let info = simulation.step(0.06).expect("the step is sound");
        touched |= info.contact_nodes > 0;
        let (left, right) = (simulation.contact_force(0), simulation.contact_force(1));
        assert_eq!(left, right.map(|f| -f));
        // Never pulls: the right block is pushed to the right, but for friction on the light nodes at its edges.
        peak = peak.max(right[0]);
        assert!(right[0] >= -1.0e-5 * peak, "{right:?} after {peak}");
    }
    let what = format!("{dimension:?} {scheme:?} {transfer:?} {ratio}");
    assert!(touched, "{what}: no contact");
    let scale = momentum_scale(&simulation);
    let drift = crate::common::distance(&before, &simulation.momentum());
    assert!(
        drift < 1.0e-13 * scale,
        "{what}: momentum off by {} of it",
        drift / scale
    );
    let now = simulation.energy();
    assert!(
        now.kinetic + now.strain < energy * (1.0 + 1.0e-3),
        "{what}: energy {} of {energy}",
        now.kinetic + now.strain
    );
    let v_1 = simulation.center(0).velocity;
    let v_2 = simulation.center(1).velocity;
    println!("{what}: restitution {}", (v_2[0] - v_1[0]) / 2.0);
    assert!(
        v_2[0] > v_1[0],
        "{what}: they stick together, {v_1:?} {v_2:?}"
    );
}

#[test]
fn round_bodies_that_overlap_are_refused_all_at_once() {
    let disc = |x: f64| Shape::Sphere {
        center: [x, 0.5, 0.0],
        radius: 0.2,
    };
    let polygon = |x: f64| Shape::Polygon {
        points: vec![
            [x, 0.3, 0.0],
            [x + 0.3, 0.3, 0.0],
            [x + 0.3, 0.6, 0.0],
            [x, 0.6, 0.0],
        ],
    };
    let mut scene = empty(Dimension::Two, [30, 10, 1], H);
    scene.bodies = vec![
        body(1, disc(0.5)),
        body(2, polygon(0.6)),
        body(3, polygon(0.8)),
        body(4, polygon(1.1)),
    ];
    for body in &mut scene.bodies {
        body.particles_per_cell = [2, 2, 1];
    }
    scene.contacts = vec![pair(1, 1, 2, 0.0), pair(2, 3, 2, 0.0), pair(3, 3, 4, 0.0)];
    let error = Simulation::new(&scene, &options())
        .err()
        .expect("they overlap");
    let SetupError::Overlap(all) = &error else {
        panic!("{error}")
    };
    assert_eq!(
        all.iter().map(|o| o.bodies).collect::<Vec<_>>(),
        [[1, 2], [3, 2]]
    );
    assert!(all.iter().all(|o| o.depth > 0.02 && o.position[0] > 0.6));
    assert_eq!(error.to_string().lines().count(), 2, "{error}");
}
