//! Case A4: a fixed-free bar, and the energy of an undamped bounce.

use crate::common::{
    FLIP, SCHEMES, body, cuboid, elastic, empty, material, run, simulation, simulation_from,
};
use proctor_scene::simulation::{InitialState, Simulation};
use proctor_scene::{Dimension, PlaneCondition, Scene, StressScheme, TimeStep, Weighting};
use std::f64::consts::PI;
use std::sync::Arc;

const LENGTH: f64 = 25.0;
const CELLS: usize = 25;
/// `v_0/c` = 1e-4: small, so that the amplitude does not change the period, whose error is of that order.
const SPEED: f64 = 1.0e-4 * 10.0;

/// E = 100, rho = 1, c = 10, T = 4 L/c = 10; a strip of one row of cells with sliding sides and nu = 0 is one
/// dimension.
fn bar(scheme: StressScheme) -> Simulation {
    let mut scene = empty(Dimension::Two, [CELLS + 2, 1, 1], LENGTH / CELLS as f64);
    scene.materials = vec![material(elastic(100.0, 0.0))];
    scene.materials[0].density = 1.0;
    scene.scheme = scheme;
    scene.transfer = FLIP;
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [LENGTH, 1.0, 0.0]))];
    // C = 0.2, where the error of time is below that of space.
    scene.time_step = TimeStep::Fixed {
        dt: 0.02,
        allow_unstable: false,
    };
    simulation_from(
        &scene,
        Arc::new(|x| InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [SPEED * (0.5 * PI * x[0] / LENGTH).sin(), 0.0, 0.0],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    )
}

#[test]
fn a_bar_swings_with_its_period() {
    for scheme in SCHEMES {
        let mut simulation = bar(scheme);
        // Up-crossings of the displacement of the centre of mass: after 0, T, 2 T ...
        let start = simulation.center(0).position[0];
        let (mut last, mut crossings) = (0.0, vec![]);
        let mut largest = 0.0_f64;
        while crossings.len() < 2 {
            let before = simulation.time();
            run(&mut simulation, 1);
            let x = simulation.center(0).position[0] - start;
            if last < 0.0 && x >= 0.0 {
                crossings.push(before + (simulation.time() - before) * last / (last - x));
            }
            last = x;
            largest = largest.max(x);
            assert!(simulation.time() < 30.0, "{scheme:?}: no vibration");
        }
        let period = crossings[1] - crossings[0];
        // 25 cells of two particles: the discrete wave is slower by (k h)²/24 and little more, 0.055 % known.
        assert!(
            (period / 10.0 - 1.0).abs() < 2.0e-3,
            "{scheme:?}: period {period}"
        );
        // First crossing: leapfrog starts in phase.
        assert!(
            (crossings[0] / 10.0 - 1.0).abs() < 2.0e-3,
            "{scheme:?}: {crossings:?}"
        );
        // Centre of mass: amplitude v_0/w * 2/pi; schemes differ by what they dissipate in a period and a half.
        let exact = SPEED / (2.0 * PI / 10.0) * 2.0 / PI;
        assert!(
            (largest / exact - 1.0).abs() < 2.0e-2,
            "{scheme:?}: {largest} {exact}"
        );
    }
}

/// A block that falls on a sliding plane and bounces.
fn bounce(scheme: StressScheme, weighting: Weighting) -> Scene {
    let mut scene = empty(Dimension::Two, [4, 16, 1], 0.1);
    scene.weighting = weighting;
    scene.scheme = scheme;
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.bodies = vec![body(1, cuboid([0.0, 0.1, 0.0], [0.4, 0.5, 0.0]))];
    scene.bodies[0].velocity = [0.0, -0.5, 0.0];
    scene.gravity = [0.0, -10.0, 0.0];
    scene
}

#[test]
fn the_energy_of_a_bounce_is_accounted_for() {
    for scheme in SCHEMES {
        let mut simulation = simulation(&bounce(scheme, Weighting::QuadraticBSpline));
        let start = simulation.energy();
        let top = simulation.center(0).position[1];
        let mut lowest = f64::INFINITY;
        let mut compressed = 0.0_f64;
        while simulation.time() < 0.25 {
            simulation.step(0.25).expect("the step is sound");
            lowest = lowest.min(simulation.center(0).position[1]);
            compressed = compressed.max(simulation.energy().strain);
        }
        let end = simulation.energy();
        let size = start.kinetic + simulation.mass() * 10.0 * (top - lowest);
        assert!(
            compressed > 0.2 * size,
            "it must hit: {compressed} of {size}"
        );
        // By definition; the ledger must not lose a term.
        let balance = start.kinetic + end.external_work - end.kinetic - end.strain;
        assert!((balance - end.dissipated).abs() < 1.0e-12 * size);
        // External work is the weight alone: the plane at rest does none.
        let fallen = top - simulation.center(0).position[1];
        assert!((end.external_work - simulation.mass() * 10.0 * fallen).abs() < 1.0e-10 * size);
        // The impact is a jump in velocity; what the grid cannot resolve is lost or, with USF, gained.
        assert!(
            end.dissipated.abs() < 0.1 * size,
            "{scheme:?}: {} of {size}",
            end.dissipated
        );
    }
}
