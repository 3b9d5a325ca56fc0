//! A run that went wrong says so, and a good one does not.

use crate::common::{
    APIC, FLIP, body, cuboid, elastic, empty, material, rough, simulation, simulation_from,
};
use proctor_kernel::scene::{Dimension, OnImbalance, Scene, Shape, StressScheme, TimeStep};
use proctor_kernel::simulation::{
    Condition, FieldNodes, Options, Reason, Simulation, StepErrorKind,
};
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
        if simulation.step(1.0e9).is_err() || simulation.trust().doubt.is_some() {
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
        let trust = good.trust();
        assert_eq!(trust.doubt, None, "{scheme:?}");
        assert_eq!(good.steps(), 600);
        assert!(trust.gain < 0.05 && trust.given > 0.0, "{trust:?}");
        assert!(
            trust.increment > 0.0 && trust.increment < 1.0e-6,
            "{trust:?}"
        );
        assert!(trust.lost_momentum < 1.0e-13, "{trust:?}");

        let mut unstable = swinging(if scheme == StressScheme::Usl {
            1.0
        } else {
            2.4
        });
        unstable.scheme = scheme;
        let bad = run(rough_start(&unstable), 2000);
        let doubt = bad
            .trust()
            .doubt
            .unwrap_or_else(|| panic!("{scheme:?}: {:?}", bad.trust()));
        assert!(doubt.reason != Reason::Momentum, "{doubt}");
        assert!(doubt.step <= bad.steps() && doubt.value > 0.5, "{doubt}");
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
    let StepErrorKind::NotTrusted(doubt) = error.kind else {
        panic!("{error}");
    };
    assert_eq!(simulation.trust().doubt, Some(doubt));
    assert!(
        error.to_string().contains("not to be trusted since step"),
        "{error}"
    );
}

/// The first doubt stays, whatever comes after it, and with the state.
#[test]
fn a_doubt_stays() {
    let mut unstable = run(rough_start(&swinging(1.0)), 2000);
    let doubt = unstable.trust().doubt.expect("unstable");
    for _ in 0..10 {
        let _ = unstable.step(1.0e9);
    }
    assert_eq!(unstable.trust().doubt, Some(doubt));
    let mut other = simulation(&swinging(1.0));
    other.restore(unstable.save()).expect("the same scene");
    assert_eq!(other.trust(), unstable.trust());
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
    let doubt = run(simulation(&scene), 5)
        .trust()
        .doubt
        .expect("strained too far");
    assert_eq!(
        (doubt.reason, doubt.step),
        (Reason::Increment, 1),
        "{doubt}"
    );
}

/// Has all nodes move faster and faster, and says by how much, or that they always did.
struct Carried {
    says_so: bool,
}

impl Condition for Carried {
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
            conditions: vec![Arc::new(Carried { says_so })],
            ..Options::default()
        };
        run(Simulation::new(&scene, &options).expect("sound"), 300)
    };
    assert_eq!(carried(true).trust().doubt, None);
    let doubt = carried(false).trust().doubt.expect("momentum from nowhere");
    assert_eq!(
        (doubt.reason, doubt.step),
        (Reason::Momentum, 16),
        "{doubt}"
    );
    assert!(doubt.to_string().contains("momentum"), "{doubt}");
}
