//! Automatic steps are stable for rods and discs on the axis, rings and balls; a rod needs a shorter one than the plane.

use super::revolved;
use crate::common::{
    APIC, FLIP, NEVER, SCHEMES, body, cuboid, elastic, material, rough, simulation_from,
};
use proctor_scene::{Dimension, OnImbalance, Scene, Shape, StressScheme, TimeStep, Weighting};

const H: f64 = 0.1;
const STEPS: usize = 1500;

/// A body of these edges in cells, with noise, in automatic steps times `factor`; whether its energy stays.
fn stays([inner, outer]: [f64; 2], height: f64, set: impl Fn(&mut Scene), factor: f64) -> bool {
    let mut scene = revolved([8, 10], H);
    let low = 3.3 * H;
    scene.bodies = vec![body(
        1,
        cuboid([inner * H, low, 0.0], [outer * H, low + height * H, 0.0]),
    )];
    scene.bodies[0].particles_per_cell = [2, 2, 1];
    set(&mut scene);
    keeps_energy(&mut scene, factor)
}

fn keeps_energy(scene: &mut Scene, factor: f64) -> bool {
    scene.on_imbalance = OnImbalance::Tell;
    let initial = rough(Dimension::Two, 1e-5, 0.0, 5);
    let mut simulation = simulation_from(scene, initial.clone());
    if factor != 1.0 {
        let info = simulation.step(NEVER).expect("the first step");
        scene.time_step = TimeStep::Fixed {
            dt: factor * info.dt,
            allow_unstable: true,
        };
        simulation = simulation_from(scene, initial);
    }
    let before = simulation.kinetic_energy();
    for _ in 0..STEPS {
        if simulation.step(NEVER).is_err() {
            return false;
        }
    }
    simulation.kinetic_energy() < 2.0 * before
}

#[test]
fn automatic_steps_are_stable_on_the_axis() {
    let mut unstable: Vec<String> = vec![];
    for poisson in [0.0, 0.3, 0.49] {
        for scheme in SCHEMES {
            for transfer in [FLIP, APIC] {
                for particles in [1, 2] {
                    let set = |scene: &mut Scene| {
                        scene.materials = vec![material(elastic(1e6, poisson))];
                        (scene.scheme, scene.transfer) = (scheme, transfer);
                        scene.bodies[0].particles_per_cell = [particles, particles, 1];
                    };
                    for (edges, height) in [
                        ([0.0, 0.5], 4.0),
                        ([0.0, 1.0], 4.0),
                        ([0.0, 1.5], 4.0),
                        ([0.0, 2.0], 4.0),
                        ([0.0, 2.5], 4.0),
                        ([0.0, 6.0], 1.0),
                        ([2.3, 3.3], 1.0),
                        ([0.6, 1.1], 4.0),
                    ] {
                        if !stays(edges, height, set, 1.0) {
                            let kind = transfer.kind;
                            unstable.push(format!(
                                "{poisson} {scheme:?} {kind:?} {particles} {edges:?} {height}"
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(unstable.is_empty(), "{unstable:#?}");
}

#[test]
fn automatic_steps_are_stable_at_the_pole_of_a_ball() {
    for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
        for radius in [2.0, 2.4, 3.0] {
            let mut scene = revolved([8, 10], H);
            (scene.weighting, scene.scheme) = (weighting, StressScheme::Usl);
            scene.materials = vec![material(elastic(1e6, 0.3))];
            scene.bodies = vec![body(
                1,
                Shape::Sphere {
                    center: [0.0, 0.52, 0.0],
                    radius: radius * H,
                },
            )];
            scene.bodies[0].particles_per_cell = [2, 2, 1];
            assert!(keeps_energy(&mut scene, 1.0), "{weighting:?} {radius}");
        }
    }
}

/// Twice the step of a rod is that of the plane.
#[test]
fn a_rod_does_not_bear_the_step_of_the_plane() {
    let set = |scene: &mut Scene| {
        scene.materials = vec![material(elastic(1e6, 0.49))];
        scene.scheme = StressScheme::Musl;
        scene.bodies[0].particles_per_cell = [1, 1, 1];
    };
    assert!(stays([0.0, 1.0], 4.0, set, 1.0));
    assert!(!stays([0.0, 1.0], 4.0, set, 2.0));
}
