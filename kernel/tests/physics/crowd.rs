//! Contact of more than two bodies, and with bodies whose motion is prescribed.

use crate::common::{DIMENSIONS, NEVER, SCHEMES, body, cuboid, empty, particles, run, simulation};
use crate::physics::contact::{H, pair, two};
use proctor_scene::{
    Damping, Dimension, History, PlaneCondition, PointLoad, Scene, StressScheme, Vector,
};

/// A bridge on two pillars that must not take part of each other's load: three bodies at the nodes between the pillars.
fn bridge(order: [usize; 3], pairs: [usize; 3]) -> Scene {
    let mut scene = empty(Dimension::Two, [12, 12, 1], H);
    scene.gravity = [0.0, -10.0, 0.0];
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    let bodies = [
        body(3, cuboid([0.2, 0.0, 0.0], [0.6, 0.4, 0.0])),
        body(1, cuboid([0.6, 0.0, 0.0], [1.0, 0.4, 0.0])),
        body(2, cuboid([0.4, 0.4, 0.0], [0.8, 0.7, 0.0])),
    ];
    scene.bodies = order.map(|i| bodies[i].clone()).to_vec();
    for body in &mut scene.bodies {
        body.particles_per_cell = [2, 2, 1];
    }
    let contacts = [pair(1, 3, 2, 0.2), pair(2, 1, 2, 0.2), pair(3, 1, 3, 0.1)];
    scene.contacts = pairs.map(|i| contacts[i].clone()).to_vec();
    scene.damping = Damping::Local { alpha: 0.3 };
    scene
}

#[test]
fn three_bodies_at_a_node_carry_their_weight() {
    for scheme in SCHEMES {
        let mut scene = bridge([0, 1, 2], [0, 1, 2]);
        scene.scheme = scheme;
        let mut simulation = simulation(&scene);
        let (mut impulse, mut time) = ([[0.0; 3]; 3], 0.0);
        while simulation.time() < 0.5 {
            let dt = simulation.step(0.5).expect("the step is sound").dt;
            if simulation.time() > 0.3 {
                time += dt;
                for (body, impulse) in impulse.iter_mut().enumerate() {
                    for (sum, f) in impulse.iter_mut().zip(simulation.contact_force(body)) {
                        *sum += f * dt;
                    }
                }
            }
        }
        let weight = simulation.center(2).mass * 10.0;
        let force = impulse.map(|i| i.map(|c| c / time / weight));
        println!("{scheme:?}: {force:?}");
        assert!((force[2][1] - 1.0).abs() < 0.03, "{scheme:?}: {force:?}");
        // Each pillar carries half.
        assert!((force[0][1] + 0.5).abs() < 0.05, "{scheme:?}: {force:?}");
        assert!((force[1][1] + 0.5).abs() < 0.05, "{scheme:?}: {force:?}");
    }
}

#[test]
fn the_order_of_bodies_and_pairs_changes_no_bit() {
    let state = |scene: &Scene| {
        let mut simulation = simulation(scene);
        run(&mut simulation, 100);
        let mut bodies: Vec<_> = (0..3)
            .map(|set| {
                let own: Vec<(Vector, Vector, [f64; 6])> = (0..simulation.sets()[set].len())
                    .map(|p| {
                        let particles = &simulation.sets()[set];
                        (
                            particles.position(p),
                            particles.velocity(p),
                            particles.stress(p),
                        )
                    })
                    .collect();
                (simulation.body(set).id, own, simulation.contact_force(set))
            })
            .collect();
        bodies.sort_by_key(|b| b.0);
        bodies
    };
    let reference = state(&bridge([0, 1, 2], [0, 1, 2]));
    assert!(reference.iter().all(|b| b.2 != [0.0; 3]));
    for (order, pairs) in [
        ([2, 1, 0], [0, 1, 2]),
        ([1, 2, 0], [2, 0, 1]),
        ([0, 2, 1], [1, 0, 2]),
    ] {
        assert!(
            state(&bridge(order, pairs)) == reference,
            "{order:?} {pairs:?}"
        );
    }
}

/// Bodies without a pair share one velocity where they meet, also where one of them has a field of its own.
#[test]
fn a_body_without_a_pair_sticks_as_in_mpm_without_contact() {
    for scheme in SCHEMES {
        let mut scene = empty(Dimension::Two, [20, 8, 1], H);
        scene.scheme = scheme;
        scene.bodies = vec![
            body(1, cuboid([0.5, 0.2, 0.0], [0.8, 0.6, 0.0])),
            body(2, cuboid([0.8, 0.2, 0.0], [1.1, 0.6, 0.0])),
            // Near enough to share nodes with body 2, too far to touch it.
            body(3, cuboid([1.3, 0.2, 0.0], [1.6, 0.6, 0.0])),
        ];
        for body in &mut scene.bodies {
            body.particles_per_cell = [2, 2, 1];
        }
        scene.bodies[0].velocity = [-0.1, 0.05, 0.0];
        scene.contacts = vec![pair(1, 2, 3, 0.2)];
        let mut with = simulation(&scene);
        assert_eq!(with.contact_layers(), 2);
        run(&mut with, 60);
        assert_eq!(with.contact_force(2), [0.0; 3]);
        scene.bodies.pop();
        scene.contacts.clear();
        let mut without = simulation(&scene);
        run(&mut without, 60);
        let (a, b) = (particles(&with), particles(&without));
        for (a, b) in a.iter().zip(&b) {
            assert!(
                crate::common::distance(&a.2, &b.2) < 1.0e-12,
                "{scheme:?}: {a:?} {b:?}"
            );
        }
        let v = without.center(1).velocity;
        assert!(v[0] < -0.02, "{scheme:?}: body 2 is pulled along, {v:?}");
    }
}

#[test]
fn a_driven_body_does_the_work_that_it_gives() {
    for scheme in SCHEMES {
        let mut scene = two(Dimension::Two, 0.0, [0.0, 0.0]);
        scene.scheme = scheme;
        scene.contacts[0].friction = 0.0;
        scene.bodies[0].motion = Some(History {
            times: vec![0.0, 0.02],
            values: vec![[0.0; 3], [0.5, 0.0, 0.0]],
        });
        let mut simulation = simulation(&scene);
        let mut work = 0.0;
        while simulation.time() < 0.06 {
            let middle = simulation.time();
            let dt = simulation.step(0.06).expect("the step is sound").dt;
            let v = 0.5 * ((middle + 0.5 * dt) / 0.02).min(1.0);
            work += simulation.contact_force(1)[0] * v * dt;
        }
        let energy = simulation.energy();
        let center = simulation.center(1);
        let (m, v) = (center.mass, center.velocity);
        assert!(v[0] > 0.4, "{v:?}");
        // Whoever moves the body speeds it up, too.
        let driven = 0.5 * simulation.center(0).mass * 0.25;
        assert!(
            (energy.external_work - driven - work).abs() < 1.0e-9 * work,
            "{scheme:?}"
        );
        // USL dissipates some.
        let of_block = energy.kinetic - driven + energy.strain;
        let lost = (work - of_block) / (0.5 * m * 0.25);
        assert!(
            (-0.02..0.2).contains(&lost),
            "{scheme:?}: {lost} of the energy lost"
        );
    }
}

/// Two bodies share the load on a node between them, each by its mass, and the load does its work on both.
#[test]
fn a_load_between_two_bodies_acts_once() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            for swapped in [false, true] {
                let mut scene = two(dimension, 0.0, [0.0; 2]);
                scene.scheme = scheme;
                if swapped {
                    scene.bodies.swap(0, 1);
                }
                let z = if dimension == Dimension::Two {
                    0.0
                } else {
                    0.4
                };
                let load = |x: f64, force: Vector| PointLoad {
                    position: [x, 0.4, z],
                    force,
                };
                let forces = [[2.0, 5.0, 0.0], [1.0, -3.0, 0.0]];
                scene.point_loads = vec![load(0.9, forces[0]), load(0.7, forces[1])];
                let mut simulation = simulation(&scene);
                assert_eq!(simulation.contact_layers(), 2);
                let (mut work, mut impulse) = (0.0, [0.0; 3]);
                let mut before = 0.0;
                for _ in 0..10 {
                    let dt = simulation.step(NEVER).expect("the step is sound").dt;
                    let kick = 0.5 * (before + dt);
                    before = dt;
                    // Nodes hold the velocities in the middle of the step; where both bodies are, each has its share.
                    for (x, force) in [0.9, 0.7].into_iter().zip(forces) {
                        let at = [x, 0.4, z];
                        let nodes = simulation.node_values();
                        let here = || {
                            nodes
                                .iter()
                                .filter(|n| crate::common::distance(&n.position, &at) < 1.0e-9)
                        };
                        let mass: f64 = here().map(|n| n.mass).sum();
                        for node in here() {
                            for axis in 0..3 {
                                let share = node.mass / mass;
                                work += force[axis] * share * node.velocity[axis] * dt;
                                impulse[axis] += force[axis] * share * kick;
                            }
                        }
                    }
                }
                let found = simulation.momentum();
                for axis in 0..3 {
                    assert!(
                        (found[axis] - impulse[axis]).abs() < 1.0e-12,
                        "{dimension:?} {scheme:?} {swapped}: {found:?} {impulse:?}"
                    );
                }
                // USF has mapped the velocities a second time by then.
                if scheme != StressScheme::Usf {
                    let external = simulation.energy().external_work;
                    assert!(
                        (external - work).abs() < 1.0e-9 * work,
                        "{dimension:?} {scheme:?} {swapped}: {external} {work}"
                    );
                }
            }
        }
    }
}
