//! Motions that are known to round-off: free fall, rest, uniform translation.

use crate::common::{
    BLEND, DIMENSIONS, IDENTITY, NEO_HOOKEAN, TRANSFERS, YOUNG, block, body, calm, cuboid,
    distance, elastic, empty, light_nodes_act, material, particles, run, simulation,
    weightings_and_schemes,
};
use proctor_laws::{AnyLaw, NeoHookean};
use proctor_scene::{Dimension, Field, Scene, TimeStep};

/// Time step of these tests \[s\]: below the critical one of every method (linear functions with USF: 0.217 * 0.1 m / 46 m/s).
const STEP: TimeStep = TimeStep::Fixed {
    dt: 4.0e-4,
    allow_unstable: false,
};

/// `x = x_0 + v t + g t²/2`: the leapfrog is exact for a constant acceleration, whatever the grid does.
#[test]
fn a_free_body_falls_exactly() {
    for (dimension, transfer) in DIMENSIONS
        .into_iter()
        .flat_map(|d| TRANSFERS.map(|t| (d, t)))
    {
        for (weighting, scheme) in weightings_and_schemes() {
            for step in [STEP, TimeStep::Automatic] {
                let mut scene = block(dimension);
                scene.weighting = weighting;
                scene.scheme = scheme;
                scene.transfer = transfer;
                scene.time_step = step;
                scene.gravity = [
                    1.0,
                    -2.0,
                    if dimension == Dimension::Two {
                        0.0
                    } else {
                        3.0
                    },
                ];
                scene.bodies[0].velocity = [
                    0.5,
                    1.5,
                    if dimension == Dimension::Two {
                        0.0
                    } else {
                        -0.5
                    },
                ];
                calm(&mut scene);
                let (g, v) = (scene.gravity, scene.bodies[0].velocity);
                let mut simulation = simulation(&scene);
                let before = particles(&simulation);
                run_to(&mut simulation, 0.04);
                let steps = simulation.steps() as f64;
                let (t, t_v) = (simulation.time(), simulation.velocity_time());
                // Half a step of the kick is lost by nobody: velocities belong to t - dt/2.
                for (old, new) in before.iter().zip(particles(&simulation)) {
                    for axis in 0..3 {
                        let x = old.1[axis] + v[axis] * t + 0.5 * g[axis] * t * t;
                        // Per step one rounding of a position below 1 m, a weighted mean of velocities below
                        // 2 m/s.
                        assert!(
                            (new.1[axis] - x).abs() <= steps * 1.0e-15,
                            "{dimension:?} {weighting:?} {scheme:?} {transfer:?}: {} {x}",
                            new.1[axis]
                        );
                        let v = v[axis] + g[axis] * t_v;
                        assert!(
                            (new.2[axis] - v).abs() <= steps * 4.0e-15,
                            "{dimension:?} {weighting:?} {scheme:?} {transfer:?} {step:?}: {} {v}",
                            new.2[axis]
                        );
                    }
                    // Gradients of a uniform velocity are round-off over h: 2 m/s * 1e-15 / 0.1 m * t * E.
                    assert!(
                        new.3.iter().all(|s| s.abs() < 1.0e-12 * YOUNG),
                        "{:?}",
                        new.3
                    );
                }
            }
        }
    }
}

fn run_to(simulation: &mut proctor_scene::simulation::Simulation, time: f64) {
    while simulation.time() < time * (1.0 - 1.0e-9) {
        simulation.step(time).expect("the step is sound");
    }
}

/// One particle alone is its own continuum; no offset on the grid may give it a force from itself.
#[test]
fn one_particle_falls_exactly() {
    for offset in [0.0, 1.0e-12, 0.025, 0.05, 0.0999] {
        for (weighting, scheme) in weightings_and_schemes() {
            let mut scene = empty(Dimension::Two, [9, 9, 1], 0.1);
            let corner = [0.3 + offset, 0.4 + offset, 0.0];
            scene.bodies = vec![body(
                1,
                cuboid(corner, [corner[0] + 0.02, corner[1] + 0.02, 0.0]),
            )];
            scene.bodies[0].particles_per_cell = [1; 3];
            scene.weighting = weighting;
            scene.scheme = scheme;
            scene.gravity = [0.0, -10.0, 0.0];
            scene.time_step = TimeStep::Fixed {
                dt: 2.0e-4,
                allow_unstable: false,
            };
            let mut simulation = simulation(&scene);
            assert_eq!(simulation.particles(), 1);
            let x = particles(&simulation)[0].1;
            run(&mut simulation, 50);
            let (after, t) = (particles(&simulation)[0], simulation.time());
            assert!(
                (after.1[1] - (x[1] - 5.0 * t * t)).abs() < 1.0e-14,
                "{weighting:?} {scheme:?}"
            );
            assert!((after.1[0] - x[0]).abs() < 1.0e-15);
            assert!(after.3.iter().all(|s| s.abs() < 1.0e-12 * YOUNG));
        }
    }
}

#[test]
fn a_resting_body_does_not_change_a_bit() {
    for dimension in DIMENSIONS {
        for (weighting, scheme) in weightings_and_schemes() {
            for law in [AnyLaw::from(crate::common::ELASTIC), NEO_HOOKEAN.into()] {
                for transfer in [TRANSFERS[0], BLEND, TRANSFERS[2], TRANSFERS[3]] {
                    let mut scene = block(dimension);
                    scene.weighting = weighting;
                    scene.scheme = scheme;
                    scene.transfer = transfer;
                    scene.materials = vec![material(law.clone())];
                    // A density whose reciprocal is not a number of the machine.
                    scene.materials[0].density = 1234.5;
                    let mut simulation = simulation(&scene);
                    let before = simulation.state_hash();
                    run(&mut simulation, 200);
                    assert_eq!(
                        simulation.state_hash(),
                        before,
                        "{dimension:?} {weighting:?} {scheme:?} {transfer:?} {law:?}"
                    );
                }
            }
        }
    }
}

/// Five cells along x and two along y (and two back along z), with particles sorted anew on the way, also at an origin of
/// 1e6 m: velocity stays, no stress arises, and the deformation gradient stays the identity.
#[test]
fn translation_keeps_velocity_and_makes_no_stress() {
    for dimension in DIMENSIONS {
        for origin in [0.0, 1.0e6] {
            for (index, (weighting, scheme)) in weightings_and_schemes().enumerate() {
                for (turn, transfer) in TRANSFERS.into_iter().enumerate() {
                    let mut scene = flying(dimension, origin);
                    (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                    // Where light nodes multiply round-off without bound the body must be soft.
                    let young = if light_nodes_act(&scene) { 1.0 } else { YOUNG };
                    let poisson = 0.3;
                    let law: AnyLaw = if (index + turn) % 2 == 0 {
                        elastic(young, poisson).into()
                    } else {
                        NeoHookean::new(young, poisson).into()
                    };
                    scene.materials = vec![material(law)];
                    translate(&scene, young);
                }
            }
        }
    }
}

/// A block that flies through its mesh.
fn flying(dimension: Dimension, origin: f64) -> Scene {
    let mut scene = empty(dimension, [14, 9, 8], 0.1);
    let flat = dimension == Dimension::Two;
    let corner = [origin, -origin, if flat { 0.0 } else { 0.5 * origin }];
    let at = |x: f64, y: f64, z: f64| {
        let z = if flat { 0.0 } else { z };
        [corner[0] + x, corner[1] + y, corner[2] + z]
    };
    scene.mesh.origin = corner;
    scene.bodies = vec![body(1, cuboid(at(0.23, 0.24, 0.33), at(0.53, 0.54, 0.63)))];
    scene.bodies[0].velocity = [8.0, 3.0, if flat { 0.0 } else { -3.0 }];
    scene.time_step = STEP;
    // The deformation gradient is kept where it is written.
    scene.results.print = 1;
    scene.results.fields = vec![Field::DeformationGradient];
    scene
}

fn translate(scene: &Scene, young: f64) {
    let what = format!(
        "{:?} {:?} {:?} {:?} {:?} at {:?}",
        scene.dimension,
        scene.weighting,
        scene.scheme,
        scene.transfer,
        scene.materials[0].law,
        scene.mesh.origin
    );
    let v = scene.bodies[0].velocity;
    let mut simulation = simulation(scene);
    let before = particles(&simulation);
    run_to(&mut simulation, 0.062);
    for (old, new) in before.iter().zip(particles(&simulation)) {
        for axis in 0..3 {
            assert!(
                (new.2[axis] - v[axis]).abs() <= 1.0e-13 * 8.0,
                "{what}: {:?}",
                new.2
            );
            // A position of 1e6 m is read back with an ulp of 1.2e-10 m; inside it is relative to the origin.
            let x = old.1[axis] + v[axis] * simulation.time();
            assert!(
                (new.1[axis] - x).abs() <= 1.0e-13 + 2.4e-16 * scene.mesh.origin[axis].abs(),
                "{what}: {:?}",
                new.1
            );
        }
        assert!(
            new.3.iter().all(|s| s.abs() < 1.0e-12 * young),
            "{what}: {:?}",
            new.3
        );
    }
    for p in 0..simulation.particles() {
        let f = simulation.deformation(0, p).expect("it is written");
        for (row, exact) in f.iter().zip(IDENTITY) {
            // A stress below 1e-12 E is a strain below 1e-12.
            assert!(distance(row, &exact) < 1.0e-12, "{what}: F {f:?}");
        }
    }
}
