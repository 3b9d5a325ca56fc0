//! Loads that are fixed in space and that their bodies leave behind.

use crate::common::{
    APIC, DIMENSIONS, FLIP, SCHEMES, body, cuboid, elastic, empty, material, simulation,
};
use proctor_scene::simulation::{ResultWarning, Simulation};
use proctor_scene::{Dimension, Scene, StressScheme, Traction, Transfer};

/// Density, size along the motion, traction, speed at the start, and the cell.
const DENSITY: f64 = 1000.0;
const LENGTH: f64 = 0.4;
const TRACTION: f64 = 500.0;
const SPEED: f64 = 0.2;
const CELL: f64 = 0.05;

/// A block whose trailing face carries a traction that stays where the face was, beginning `offset` past a node.
fn pushed(
    dimension: Dimension,
    scheme: StressScheme,
    transfer: Transfer,
    young: f64,
    offset: f64,
) -> Scene {
    let mut scene = empty(dimension, [24, 8, 6], CELL);
    scene.scheme = scheme;
    scene.transfer = transfer;
    scene.materials = vec![material(elastic(young, 0.0))];
    let z = if dimension == Dimension::Two {
        [0.0; 2]
    } else {
        [0.1, 0.2]
    };
    let face = 0.4 + offset;
    scene.bodies = vec![body(
        1,
        cuboid([face, 0.1, z[0]], [face + LENGTH, 0.3, z[1]]),
    )];
    scene.bodies[0].velocity = [SPEED, 0.0, 0.0];
    scene.tractions = vec![Traction {
        p1: [face, 0.1, z[0]],
        p2: [face, 0.3, z[1]],
        traction: [TRACTION, 0.0, 0.0].into(),
    }];
    scene
}

/// Steps until a time \[s\].
fn until(scene: &Scene, time: f64) -> Simulation {
    let mut simulation = simulation(scene);
    while simulation.time() < time * (1.0 - 1.0e-12) {
        if let Err(error) = simulation.step(time) {
            panic!(
                "{:?} {:?} {:?}: {error}",
                scene.dimension, scene.scheme, scene.transfer
            );
        }
    }
    simulation
}

/// As long as a particle reaches its nodes the whole traction acts on the body, and its work is that of the body's way: a
/// block of mass m that a force F pushes from a speed v has m (v + F t/m)²/2 after a time t, of which F (v t + F t²/(2 m)) is
/// work. Nodes that are nearly empty once took 40 J of work and gave 134 J in place of 5.0 and 6.6.
#[test]
fn a_traction_acts_on_the_body_that_leaves_it() {
    for dimension in DIMENSIONS {
        let area = if dimension == Dimension::Two {
            0.2
        } else {
            0.2 * 0.1
        };
        let (mass, force) = (DENSITY * LENGTH * area, TRACTION * area);
        let transfers = if dimension == Dimension::Two {
            &[APIC, FLIP][..]
        } else {
            &[APIC][..]
        };
        for scheme in SCHEMES {
            for (&transfer, young) in transfers.iter().flat_map(|t| [(t, 2.0e6), (t, 2.0e5)]) {
                // Begins on a node, or a third of a cell past it.
                for (offset, time) in [(0.0, 0.164), (0.35 * CELL, 0.115)] {
                    let mut found =
                        until(&pushed(dimension, scheme, transfer, young, offset), time);
                    let energy = found.energy();
                    let speed = SPEED + force * time / mass;
                    let work = force * (SPEED * time + 0.5 * force * time * time / mass);
                    let kinetic = 0.5 * mass * speed * speed;
                    let what = format!(
                        "{dimension:?} {scheme:?} {transfer:?} E = {young} at {offset}: {energy:?}"
                    );
                    assert!(
                        (energy.kinetic / kinetic - 1.0).abs() < 0.02,
                        "{kinetic}: {what}"
                    );
                    assert!(
                        (energy.external_work / work - 1.0).abs() < 0.03,
                        "{work}: {what}"
                    );
                    assert!(energy.remainder.abs() < 0.02 * kinetic, "{what}");
                    let momentum = found.momentum()[0];
                    let moved = mass * (SPEED + force * found.velocity_time() / mass);
                    assert!(
                        (momentum / moved - 1.0).abs() < 1.0e-9,
                        "{momentum} {moved}: {what}"
                    );
                }
            }
        }
    }
}

/// When the body is gone the traction acts on nothing: the body goes on as it is, and the run says so.
#[test]
fn a_traction_left_behind_is_told_and_acts_no_more() {
    for dimension in DIMENSIONS {
        let scene = pushed(dimension, StressScheme::Musl, APIC, 2.0e6, 0.0);
        let mut gone = until(&scene, 0.25);
        let speed = gone.center(0).velocity[0];
        let energy = gone.energy();
        let left = |caution: &ResultWarning| matches!(caution, ResultWarning::Traction { index: 0, share } if *share == 1.0);
        assert!(
            gone.cautions(&energy).iter().any(left),
            "{:?}",
            gone.cautions(&energy)
        );
        let later = until(&scene, 0.3);
        // The traction would have made it faster by an eighth meanwhile.
        let faster = later.center(0).velocity[0] / speed - 1.0;
        assert!(faster.abs() < 1.0e-3, "{dimension:?}: {faster:e}");
        // It left after a cell: v² = v0² + 2 a h.
        let exact = (SPEED * SPEED + 2.0 * TRACTION / (DENSITY * LENGTH) * CELL).sqrt();
        assert!((speed / exact - 1.0).abs() < 0.01, "{speed} {exact}");
    }
}
