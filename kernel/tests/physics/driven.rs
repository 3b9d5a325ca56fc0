//! Bodies whose motion is prescribed, and what lies on them.

use crate::common::{
    DENSITY, IDENTITY, NEVER, SCHEMES, body, cuboid, elastic, empty, material, options, simulation,
};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Contact, ContactNormal, Dimension, History};
use std::sync::Arc;

const H: f64 = 0.1;
/// Thickness of the base and height of the block \[m\].
const TOP: f64 = 0.3;
const HEIGHT: f64 = 0.3;
const GRAVITY: f64 = 10.0;
/// Acceleration of the base \[m/s²\].
const BASE: f64 = 3.0;

/// A base that accelerates sideways takes a block along up to mu g: with a larger friction the block has its acceleration,
/// with a smaller one it lags behind by a - mu g.
#[test]
fn a_block_on_a_base_that_accelerates() {
    for scheme in SCHEMES {
        for (friction, exact) in [(0.5, BASE), (0.2, 2.0), (0.0, 0.0)] {
            let mut scene = empty(Dimension::Two, [30, 8, 1], H);
            scene.scheme = scheme;
            scene.gravity[1] = -GRAVITY;
            scene.materials = vec![material(elastic(1.0e7, 0.0))];
            scene.bodies = vec![
                body(1, cuboid([0.3, 0.0, 0.0], [2.3, TOP, 0.0])),
                body(2, cuboid([0.8, TOP, 0.0], [1.8, TOP + HEIGHT, 0.0])),
            ];
            for body in &mut scene.bodies {
                body.particles_per_cell = [2, 2, 1];
            }
            scene.bodies[0].motion = Some(History {
                times: vec![0.0, 1.0],
                values: vec![[0.0; 3], [BASE, 0.0, 0.0]],
            });
            scene.contacts = vec![Contact {
                name: "block on base".into(),
                id: 1,
                friction,
                master: 1,
                slave: 2,
                normal: ContactNormal::Master,
            }];
            // The block carries its weight from the start.
            let settled = Options {
                initial: Some(Arc::new(|x| InitialState {
                    velocity: [0.0; 3],
                    velocity_gradient: [[0.0; 3]; 3],
                    stress: [
                        0.0,
                        -DENSITY * GRAVITY * (TOP + HEIGHT - x[1]).min(HEIGHT),
                        0.0,
                        0.0,
                        0.0,
                        0.0,
                    ],
                    deformation: IDENTITY,
                })),
                ..options()
            };
            let mut simulation = Simulation::new(&scene, &settled).expect("the scene is sound");
            let mut speed = |until: f64| {
                simulation.run_until(until).expect("a step");
                (simulation.velocity_time(), simulation.center(1).velocity[0])
            };
            let ((t_0, v_0), (t, v)) = (speed(0.1), speed(0.4));
            let a = (v - v_0) / (t - t_0);
            println!("{scheme:?} mu {friction}: {a} of {exact}");
            assert!(
                (a - exact).abs() < 0.02 * BASE,
                "{scheme:?} mu {friction}: {a} of {exact}"
            );
        }
    }
}

/// Where two driven bodies share a node the later one decides.
#[test]
fn the_later_of_two_driven_bodies_moves_the_node_between_them() {
    for scheme in SCHEMES {
        for swapped in [false, true] {
            let mut scene = empty(Dimension::Two, [10, 8, 1], H);
            scene.scheme = scheme;
            let driven = |id: i64, from: f64, v: [f64; 3]| {
                let mut one = body(id, cuboid([from, 0.2, 0.0], [from + 0.2, 0.4, 0.0]));
                one.motion = Some(History {
                    times: vec![0.0],
                    values: vec![v],
                });
                one
            };
            let mut pair = [
                driven(1, 0.2, [0.1, 0.0, 0.0]),
                driven(2, 0.4, [0.0, 0.2, 0.0]),
            ];
            if swapped {
                pair.swap(0, 1);
            }
            let [first, last] = pair;
            let velocity = last.motion.as_ref().expect("driven").values[0];
            // Its particles give the nodes between them mass.
            let free = body(3, cuboid([0.2, 0.4, 0.0], [0.6, 0.5, 0.0]));
            scene.bodies = vec![first, last, free];
            for body in &mut scene.bodies {
                body.particles_per_cell = [2, 2, 1];
            }
            let mut simulation = simulation(&scene);
            simulation.step(NEVER).expect("the step is sound");
            let nodes = simulation.node_values();
            let between = |x: &[f64; 3]| (x[0] - 0.4).abs() < 1.0e-9 && (x[1] - 0.4).abs() < 1.0e-9;
            let node = nodes.iter().find(|node| between(&node.position));
            let node = node.expect("a node with mass");
            assert_eq!(node.velocity, velocity, "{scheme:?} {swapped}");
        }
    }
}
