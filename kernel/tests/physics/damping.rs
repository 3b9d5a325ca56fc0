//! Damping: what it takes away, and where it leads.

use crate::common::{
    BLEND, DIMENSIONS, FLIP, SCHEMES, body, cuboid, elastic, empty, material, options, run,
    simulation_from,
};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Damping, Dimension, PlaneCondition, Scene, StressScheme, Transfer, Weighting};
use std::f64::consts::PI;
use std::sync::Arc;

/// A column on a sliding plane between sliding sides: one dimension whatever the mesh.
fn column(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [1, 12, 1], 0.1);
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    let thick = if dimension == Dimension::Two {
        0.0
    } else {
        0.1
    };
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.1, 1.0, thick]))];
    // S = rho g H / M = 1e-4 with M = E: small strain.
    scene.materials = vec![material(elastic(1.0e8, 0.0))];
    scene.gravity = [0.0, -10.0, 0.0];
    scene
}

/// Case A5: `sigma_yy = -rho g (H - Y)` under self weight.
#[test]
fn kinetic_damping_finds_the_self_weight() {
    for dimension in DIMENSIONS {
        for (scheme, weighting) in [
            (SCHEMES[0], Weighting::UniformGimp),
            (SCHEMES[1], Weighting::QuadraticBSpline),
            (SCHEMES[2], Weighting::UniformGimp),
        ] {
            let mut scene = column(dimension);
            (scene.scheme, scene.weighting) = (scheme, weighting);
            scene.damping = Damping::Kinetic;
            let all = Options {
                displacement: true,
                ..options()
            };
            let mut simulation = Simulation::new(&scene, &all).expect("the scene is sound");
            let weight = simulation.mass() * 10.0;
            let mut residual = f64::INFINITY;
            let mut steps = 0;
            while residual > 1.0e-8 * weight && steps < 20_000 {
                let info = simulation.step(1.0e3).expect("the step is sound");
                residual = info.measured.expect("kinetic damping measures").1;
                steps += 1;
            }
            assert!(
                residual <= 1.0e-8 * weight,
                "{dimension:?} {scheme:?}: {residual} after {steps}"
            );
            for p in 0..simulation.particles() {
                let y = simulation.initial_position(0, p).expect("kept")[1];
                let exact = -1000.0 * 10.0 * (1.0 - y);
                let s = simulation.sets()[0].stress(p)[1];
                // Stress at a particle is that of its cell's hat gradients: within half a subcell, rho g h/4,
                // everywhere but at the free end of B-splines, whose outermost node carries little.
                let tolerance = 1000.0
                    * 10.0
                    * if weighting == Weighting::UniformGimp {
                        0.03
                    } else {
                        0.06
                    };
                assert!(
                    (s - exact).abs() < tolerance,
                    "{dimension:?} {scheme:?} y {y}: {s} {exact}"
                );
            }
        }
    }
}

/// Kinetic plus strain energy of a column that swings in its first mode for three periods, by the start.
fn kept(damping: Damping, transfer: Transfer) -> f64 {
    let mut scene = column(Dimension::Two);
    scene.gravity = [0.0; 3];
    (scene.damping, scene.transfer) = (damping, transfer);
    // B-splines keep what the grid resolves; MUSL neither gains nor loses much.
    (scene.weighting, scene.scheme) = (Weighting::QuadraticBSpline, StressScheme::Musl);
    let mut simulation = simulation_from(
        &scene,
        Arc::new(|x| InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [0.0, 0.1 * (0.5 * PI * x[1]).sin(), 0.0],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    );
    let before = simulation.kinetic_energy();
    simulation.run_until(END).expect("the step is sound");
    let energy = simulation.energy();
    assert!((before - energy.kinetic - energy.strain - energy.dissipated).abs() < 1.0e-12 * before);
    (energy.kinetic + energy.strain) / before
}

/// Three periods 4 H/c \[s\], c = 316 m/s.
const END: f64 = 3.0 * 4.0 / 316.227_766;

#[test]
fn damping_takes_energy_and_more_of_it_takes_more() {
    let free = kept(Damping::None, FLIP);
    assert!(free > 0.9 && free < 1.02, "{free}");
    let local = [0.05, 0.2, 0.7].map(|alpha| kept(Damping::Local { alpha }, FLIP));
    let viscous = [0.001, 0.005, 0.02].map(|alpha| kept(Damping::Viscous { alpha }, FLIP));
    for damped in [local, viscous] {
        assert!(
            free > damped[0] && damped[0] > damped[1] && damped[1] > damped[2],
            "{free} {damped:?}"
        );
    }
    // A lightly damped mode loses exp(-rate t) of its energy, rate = alpha c/h: half of the time it is kinetic.
    for (alpha, kept) in [0.001, 0.005, 0.02].into_iter().zip(viscous) {
        let exact = (-alpha / 0.1 * 316.227_766 * END).exp();
        assert!(
            (kept / free / exact - 1.0).abs() < 0.05,
            "{alpha}: {kept} {exact}"
        );
    }
    let pic = kept(Damping::None, BLEND);
    assert!(pic < 0.9 * free, "PIC must dissipate: {pic} {free}");
}

/// A body that flies alone is slowed by viscous damping as exp(-rate t): in steps of the leapfrog
/// ((1 - rate dt/2) first, then 1 - rate dt).
#[test]
fn viscous_damping_is_the_formula() {
    for scheme in SCHEMES {
        let mut scene = crate::common::block(Dimension::Three);
        scene.scheme = scheme;
        scene.damping = Damping::Viscous { alpha: 0.1 };
        scene.bodies[0].velocity = [0.5, -0.3, 0.2];
        let mut simulation = crate::common::simulation(&scene);
        let rate = 0.1 / 0.1 * (1.0e6_f64 / 1000.0).sqrt();
        let mut factor = 1.0;
        let mut before = 0.0;
        for _ in 0..20 {
            let dt = simulation.step(1.0).expect("the step is sound").dt;
            factor *= 1.0 - rate * 0.5 * (dt + before);
            before = dt;
        }
        let v = simulation.center(0).velocity;
        for axis in 0..3 {
            let exact = [0.5, -0.3, 0.2][axis] * factor;
            assert!(
                (v[axis] - exact).abs() < 1.0e-13,
                "{scheme:?}: {v:?} {factor}"
            );
        }
        assert!(factor < 0.9);
    }
}

/// Local damping works against each component of the velocity with a share of the unbalanced force: a body in
/// free fall gets (1 - alpha) g going down and (1 + alpha) g going up.
#[test]
fn local_damping_is_the_formula() {
    for (velocity, factor) in [(-0.1, 0.7), (3.0, 1.3)] {
        let mut scene = crate::common::block(Dimension::Two);
        scene.damping = Damping::Local { alpha: 0.3 };
        scene.gravity = [0.0, -10.0, 0.0];
        scene.bodies[0].velocity = [0.0, velocity, 0.0];
        let mut simulation = crate::common::simulation(&scene);
        run(&mut simulation, 20);
        let exact = velocity - 10.0 * factor * simulation.velocity_time();
        let v = simulation.center(0).velocity;
        assert!((v[1] - exact).abs() < 1.0e-12, "{v:?} {exact}");
    }
}
