//! A run that went wrong says so, and a good one does not.

use crate::common::{
    APIC, FLIP, body, cuboid, elastic, empty, material, rough, simulation, simulation_from,
};
use proctor_scene::simulation::{
    Condition, FieldNodes, Invariant, Options, Simulation, StepErrorKind,
};
use proctor_scene::{Dimension, OnImbalance, Scene, Shape, StressScheme, TimeStep};
use std::sync::Arc;

/// A disc in the air that swings, with steps of `multiplier` times h/(c + |v|).
fn swinging(multiplier: f64) -> Scene {
    let mut scene = empty(Dimension::Two, [16, 16, 1], 0.1);
    scene.transfer = FLIP;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    let disc = Shape::Sphere {
        center: [0.6, 0.8, 0.0],
        radius: 0.4,
    };
    scene.bodies = vec![body(1, disc)];
    scene.bodies[0].particles_per_cell = [2, 2, 1];
    scene.time_step = TimeStep::Multiplier {
        multiplier,
        allow_unstable: true,
    };
    scene
}

/// The scene with velocities and stresses that differ from particle to particle.
fn rough_start(scene: &Scene) -> Simulation {
    simulation_from(scene, rough(Dimension::Two, 1.0e-6, 0.0, 7))
}

/// Steps until there is a doubt, an error, or `most` steps.
fn run(mut simulation: Simulation, most: u64) -> Simulation {
    for _ in 0..most {
        if simulation.step(1.0e9).is_err() || simulation.invariants().violation.is_some() {
            break;
        }
    }
    simulation
}

#[test]
fn an_unstable_run_says_so_and_a_stable_one_does_not() {
    for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
        let mut stable = swinging(0.3);
        stable.scheme = scheme;
        let good = run(rough_start(&stable), 600);
        let invariants = good.invariants();
        assert_eq!(invariants.violation, None, "{scheme:?}");
        assert_eq!(good.steps(), 600);
        assert!(
            invariants.gain < 0.05 && invariants.given > 0.0,
            "{invariants:?}"
        );
        assert!(
            invariants.increment > 0.0 && invariants.increment < 1.0e-6,
            "{invariants:?}"
        );
        assert!(invariants.lost_momentum < 1.0e-13, "{invariants:?}");

        let mut unstable = swinging(if scheme == StressScheme::Usl {
            1.0
        } else {
            2.4
        });
        unstable.scheme = scheme;
        let bad = run(rough_start(&unstable), 2000);
        let violation = bad
            .invariants()
            .violation
            .unwrap_or_else(|| panic!("{scheme:?}: {:?}", bad.invariants()));
        assert!(violation.reason != Invariant::Momentum, "{violation}");
        assert!(
            violation.step <= bad.steps() && violation.value > 0.5,
            "{violation}"
        );
    }
}

#[test]
fn a_scene_may_ask_to_stop() {
    let mut scene = swinging(1.0);
    scene.on_imbalance = OnImbalance::Stop;
    let mut simulation = rough_start(&scene);
    let error = loop {
        match simulation.step(1.0e9) {
            Ok(info) => assert!(info.step < 2000, "nobody noticed"),
            Err(error) => break error,
        }
    };
    let StepErrorKind::NotTrusted(violation) = error.kind else {
        panic!("{error}");
    };
    assert_eq!(simulation.invariants().violation, Some(violation));
    assert!(
        error.to_string().contains("not to be trusted since step"),
        "{error}"
    );
}

/// The first doubt stays, whatever comes after it, and with the state.
#[test]
fn a_doubt_stays() {
    let mut unstable = run(rough_start(&swinging(1.0)), 2000);
    let violation = unstable.invariants().violation.expect("unstable");
    for _ in 0..10 {
        let _ = unstable.step(1.0e9);
    }
    assert_eq!(unstable.invariants().violation, Some(violation));
    let mut other = simulation(&swinging(1.0));
    other.restore(unstable.save()).expect("the same scene");
    assert_eq!(other.invariants(), unstable.invariants());
}

/// A fast body that is squeezed by half its length within a step: the strain increment is told at once.
#[test]
fn a_step_that_strains_too_far_is_told_at_once() {
    let mut scene = empty(Dimension::Two, [16, 8, 1], 0.1);
    scene.transfer = FLIP;
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![
        body(1, cuboid([0.4, 0.3, 0.0], [0.7, 0.5, 0.0])),
        body(2, cuboid([0.7, 0.3, 0.0], [1.0, 0.5, 0.0])),
    ];
    for (body, v) in scene.bodies.iter_mut().zip([30.0, -30.0]) {
        body.particles_per_cell = [2, 2, 1];
        body.velocity = [v, 0.0, 0.0];
    }
    scene.time_step = TimeStep::Fixed {
        dt: 2.0e-3,
        allow_unstable: true,
    };
    let violation = run(simulation(&scene), 5)
        .invariants()
        .violation
        .expect("strained too far");
    assert_eq!(
        (violation.reason, violation.step),
        (Invariant::Increment, 1),
        "{violation}"
    );
}

/// Acceleration of all nodes, given as a rate, or as constant.
struct NodeAcceleration {
    says_so: bool,
}

impl Condition for NodeAcceleration {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let (after, kick) = (field.time(), field.kick());
        let before = if self.says_so { after - kick } else { after };
        field.for_each(|node| node.prescribe([before, 0.0, 0.0], [after, 0.0, 0.0]));
    }
}

/// Momentum that no change at the nodes accounts for is told at the first look.
#[test]
fn momentum_from_nowhere_is_told() {
    let mut scene = swinging(0.3);
    scene.transfer = APIC;
    let carried = |says_so: bool| {
        let options = Options {
            conditions: vec![Arc::new(NodeAcceleration { says_so })],
            ..Options::default()
        };
        run(Simulation::new(&scene, &options).expect("sound"), 300)
    };
    assert_eq!(carried(true).invariants().violation, None);
    let violation = carried(false)
        .invariants()
        .violation
        .expect("momentum from nowhere");
    assert_eq!(
        (violation.reason, violation.step),
        (Invariant::Momentum, 16),
        "{violation}"
    );
    assert!(violation.to_string().contains("momentum"), "{violation}");
}
