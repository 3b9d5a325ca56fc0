//! Loads are totals of the full circle.

use super::{cylinder, revolved};
use crate::common::{
    APIC, DENSITY, WEIGHTINGS, body, cuboid, distance, elastic, material, run, simulation,
    simulation_from,
};
use proctor_scene::simulation::InitialState;
use proctor_scene::{
    BoxLoad, InitialStress, ParticleSeed, PlaneCondition, PointLoad, Shape, TimeStep, Traction,
    Weighting,
};
use std::f64::consts::PI;
use std::sync::Arc;

const PRESSURE: f64 = 1000.0;

fn traction(p1: [f64; 2], p2: [f64; 2], traction: [f64; 2]) -> Traction {
    let in_space = |v: [f64; 2]| [v[0], v[1], 0.0];
    Traction {
        p1: in_space(p1),
        p2: in_space(p2),
        traction: in_space(traction).into(),
    }
}

/// A body under one pressure inside and outside stays at rest: areas on planes and on the mantle are those of its particles.
#[test]
fn a_body_under_pressure_stays_at_rest() {
    for (inner, origin) in [(0.0, 0.0), (0.3, 0.0), (0.3, 0.2)] {
        for weighting in [Weighting::UniformGimp, Weighting::Linear] {
            for particles in 1..=4 {
                let mut scene = revolved([8, 8], 0.1);
                scene.mesh.origin[0] = origin;
                scene.mesh.planes[1][0] = PlaneCondition::Sliding;
                scene.weighting = weighting;
                scene.bodies = vec![body(1, cuboid([inner, 0.0, 0.0], [0.6, 0.4, 0.0]))];
                scene.bodies[0].particles_per_cell = [particles, particles, 1];
                scene.bodies[0].initial_stress = InitialStress::Isotropic(-PRESSURE);
                scene.tractions = vec![
                    traction([inner, 0.4], [0.6, 0.4], [0.0, -PRESSURE]),
                    traction([0.6, 0.0], [0.6, 0.4], [-PRESSURE, 0.0]),
                ];
                if inner > 0.0 {
                    scene
                        .tractions
                        .push(traction([inner, 0.0], [inner, 0.4], [PRESSURE, 0.0]));
                }
                crate::common::calm(&mut scene);
                let mut simulation = simulation(&scene);
                run(&mut simulation, 1);
                let set = &simulation.sets()[0];
                let scale = PRESSURE / 1000.0 / 0.1 * simulation.time();
                for p in 0..set.len() {
                    let speed = set.velocity(p).iter().fold(0.0_f64, |a, v| a.max(v.abs()));
                    // Hats take the hoop force at the radius of the particle, not of its ring.
                    let along = if weighting == Weighting::Linear {
                        set.velocity(p)[1].abs()
                    } else {
                        speed
                    };
                    assert!(
                        along < 1e-11 * scale,
                        "{inner} {weighting:?} {particles}: {speed:e} {scale:e}"
                    );
                }
            }
        }
    }
}

/// A ring whose domains lie across nodes stays at rest between pressures on its two faces.
#[test]
fn a_ring_across_nodes_stays_at_rest() {
    for particles in 1..=4 {
        let mut scene = revolved([9, 4], 0.1);
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
        scene.bodies = vec![body(1, cuboid([0.35, 0.0, 0.0], [0.65, 0.4, 0.0]))];
        scene.bodies[0].particles_per_cell = [particles, particles, 1];
        scene.bodies[0].initial_stress = InitialStress::Isotropic(-PRESSURE);
        scene.tractions = vec![
            traction([0.65, 0.0], [0.65, 0.4], [-PRESSURE, 0.0]),
            traction([0.35, 0.0], [0.35, 0.4], [PRESSURE, 0.0]),
        ];
        let mut simulation = simulation(&scene);
        run(&mut simulation, 1);
        let scale = PRESSURE / 1000.0 / 0.1 * simulation.time();
        for p in 0..simulation.sets()[0].len() {
            let speed = simulation.sets()[0].velocity(p)[0].abs();
            assert!(speed < 1e-11 * scale, "{particles}: {speed:e}, {scale:e}");
        }
    }
}

/// The force on the body is what each kind of load names.
#[test]
fn loads_are_totals() {
    let load = |kind: usize| {
        let mut scene = cylinder();
        match kind {
            0 => scene.tractions = vec![traction([0.0, 0.6], [0.3, 0.6], [0.0, -PRESSURE])],
            1 => {
                scene.point_loads = vec![PointLoad {
                    position: [0.0, 0.6, 0.0],
                    force: [0.0, -100.0, 0.0],
                }];
            }
            2 => {
                scene.point_loads = vec![PointLoad {
                    position: [0.3, 0.6, 0.0],
                    force: [0.0, -100.0, 0.0],
                }];
            }
            3 => {
                scene.box_loads = vec![BoxLoad {
                    p1: [0.0, 0.2, 0.0],
                    p2: [0.2, 0.3, 0.0],
                    force: [0.0, -100.0, 0.0],
                }];
            }
            _ => scene.gravity = [0.0, -10.0, 0.0],
        }
        let mut simulation = simulation(&scene);
        run(&mut simulation, 1);
        // The first kick is over half a step.
        simulation.momentum()[1] / (0.5 * simulation.time())
    };
    let area = PI * 0.09;
    for (kind, exact) in [
        -PRESSURE * area,
        -100.0,
        -100.0,
        -100.0,
        -1e4 * PI * 0.25 * 0.4,
    ]
    .into_iter()
    .enumerate()
    {
        let found = load(kind);
        assert!(
            (found / exact - 1.0).abs() < 1e-9,
            "{kind}: {found} {exact}"
        );
    }
}

/// The strain of a uniform expansion is the same in both directions across the axis, and the stress that of the law in space; also
/// in domains that lie across nodes or across the axis.
#[test]
fn a_uniform_expansion_has_the_stress_of_space() {
    let (young, poisson, rate) = (1e6, 0.25, 1e-2);
    let across: Vec<ParticleSeed> = (0..8)
        .flat_map(|i| (0..8).map(move |k| [0.02 + 0.06 * f64::from(i), 0.23 + 0.06 * f64::from(k)]))
        .map(|[r, z]| ParticleSeed {
            position: [r, z, 0.0],
            volume: 2.0 * PI * r * 0.06 * 0.06,
        })
        .collect();
    let shapes = [
        cylinder().bodies[0].shape.clone(),
        Shape::Particles(Arc::new(across)),
    ];
    for weighting in WEIGHTINGS {
        for shape in &shapes {
            let mut scene = cylinder();
            scene.materials = vec![material(elastic(young, poisson))];
            scene.bodies[0].shape = shape.clone();
            // With affine velocity alone the nodes have a linear velocity whatever the masses.
            (scene.weighting, scene.transfer) = (weighting, APIC);
            scene.time_step = TimeStep::Fixed {
                dt: 1e-4,
                allow_unstable: true,
            };
            let mut simulation = simulation_from(
                &scene,
                Arc::new(move |x| InitialState {
                    velocity: [rate * x[0], 0.0, 0.0],
                    velocity_gradient: [[rate, 0.0, 0.0], [0.0; 3], [0.0; 3]],
                    ..InitialState::default()
                }),
            );
            run(&mut simulation, 1);
            let lame = young * poisson / (1.0 + poisson) / (1.0 - 2.0 * poisson);
            let shear = young / (2.0 * (1.0 + poisson));
            let strain = rate * simulation.time();
            let sides = 2.0 * lame + 2.0 * shear;
            let exact = [sides, 2.0 * lame, sides, 0.0, 0.0, 0.0].map(|modulus| modulus * strain);
            let set = &simulation.sets()[0];
            for p in 0..set.len() {
                let volume =
                    simulation.particle_volume(0, p) * DENSITY / simulation.particle_mass(0, p);
                assert!(
                    (volume - (1.0 + strain).powi(2)).abs() < 1e-13,
                    "{weighting:?} {volume}"
                );
                let off = distance(&set.stress(p), &exact) / exact[0];
                // The midpoint strain of the law differs from the linear one by half of its square.
                assert!(
                    off < 1e-5,
                    "{weighting:?} at {:?}: {off:e}",
                    simulation.position(0, p)
                );
            }
        }
    }
}
