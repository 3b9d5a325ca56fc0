//! Contact on the grid on ranks: bodies touch in planes of all ranks, slide, part, and meet again.

use super::harness::{compare_from, end, step, strip};
use super::threads::{self, Thread};
use crate::common::{DIMENSIONS, SCHEMES, body, cuboid, empty, options, rough_drift};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::StepErrorKind;
use proctor_scene::simulation::{InitialField, InitialState, Options, Simulation};
use proctor_scene::{
    Contact, ContactNormal, Damping, Dimension, DomainUpdate, PlaneCondition, Scene, TimeStep,
    Weighting,
};
use std::sync::Arc;

pub(super) fn contact(id: i64, [master, slave]: [i64; 2], friction: f64) -> Contact {
    Contact {
        name: format!("pair {id}"),
        id,
        friction,
        master,
        slave,
        normal: ContactNormal::Collinear,
    }
}

/// Two layers one on the other along the whole strip, and a block that the upper one strikes and the lower one carries along
/// without a contact of their own.
pub(super) fn layers(dimension: Dimension) -> Scene {
    let mut scene = strip(dimension);
    let bodies = [
        ([0.3, 0.1, 0.2], [3.9, 0.3, 0.4]),
        ([0.3, 0.3, 0.2], [3.4, 0.5, 0.4]),
        ([3.5, 0.3, 0.2], [3.9, 0.5, 0.4]),
    ];
    let bodies = bodies.into_iter().zip(1..);
    scene.bodies = bodies
        .map(|((p1, p2), id)| body(id, cuboid(p1, p2)))
        .collect();
    scene.bodies[1].material = 1;
    scene.contacts = vec![contact(1, [1, 2], 0.3), contact(2, [2, 3], 0.0)];
    scene
}

/// The upper layer slides to the right over the lower one.
pub(super) fn sliding(scene: &Scene) -> InitialField {
    let rough = rough_drift(scene.dimension, [6.0, 0.5, 0.0], 0.1, 1.0, 3);
    Arc::new(move |x| {
        let mut state: InitialState = rough(x);
        if x[1] > 0.3 && x[0] < 3.45 {
            state.velocity[0] += 3.0;
        }
        state
    })
}

#[test]
#[ignore = "takes 22 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ranks_touch_as_one_process() {
    let stretch = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let weightings = [Weighting::UniformGimp, stretch, Weighting::QuadraticBSpline];
    let mut index = 0;
    for dimension in DIMENSIONS {
        for weighting in weightings {
            for scheme in SCHEMES {
                index += 1;
                let mut scene = layers(dimension);
                (scene.weighting, scene.scheme) = (weighting, scheme);
                if index % 2 == 0 {
                    scene.damping = Damping::Local { alpha: 0.2 };
                }
                let end = compare_from(&scene, 80, &sliding(&scene));
                assert!(end.error.is_none(), "{:?}", end.error);
                assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
                assert!(
                    end.touching.len() > 20,
                    "{} nodes touch",
                    end.touching.len()
                );
            }
        }
    }
}

/// A pair that is far apart at first has no fields; all ranks give them in the same step, those that no body reaches too.
#[test]
fn ranks_see_the_same_pair_come_near() {
    for scheme in SCHEMES {
        let mut scene = empty(Dimension::Two, [60, 7, 1], 0.1);
        scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
        scene.bodies = vec![
            body(1, cuboid([0.3, 0.1, 0.0], [1.5, 0.5, 0.0])),
            body(2, cuboid([2.4, 0.1, 0.0], [4.6, 0.5, 0.0])),
        ];
        scene.contacts = vec![contact(1, [1, 2], 0.2)];
        scene.scheme = scheme;
        let rough = rough_drift(scene.dimension, [0.0; 3], 0.1, 1.0, 3);
        let initial: InitialField = Arc::new(move |x| {
            let mut state: InitialState = rough(x);
            state.velocity[0] += if x[0] < 2.0 { 5.0 } else { -5.0 };
            state
        });
        let end = compare_from(&scene, 300, &initial);
        assert!(end.error.is_none(), "{:?}", end.error);
        assert!(end.sorts >= 10, "{} sorts", end.sorts);
        assert!(end.energy.impact > 0.0, "the bodies do not meet");
    }
}

/// Ranks that share each step have the whole simulation after each, all of them the same, with what a program changes in it.
#[test]
fn each_rank_has_the_whole_between_steps() {
    let run = |scene: &Scene, rank: Option<Thread>| {
        let rank = rank.map(|rank| Arc::new(rank) as Arc<dyn Ranks>);
        let options = Options {
            threads: Some(1),
            least_share: Some(1),
            initial: Some(sliding(scene)),
            step_ranks: rank,
            ..options()
        };
        let mut simulation = Simulation::new(scene, &options).expect("the scene is sound");
        let first = step(&mut simulation, 40);
        let energy = simulation.energy();
        simulation.set_friction(1, 0.1).expect("there is a contact");
        let second = step(&mut simulation, 40);
        let sorts = first.0 + second.0;
        (energy, end(&mut simulation, (sorts, first.1.or(second.1))))
    };
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = layers(dimension);
            scene.scheme = scheme;
            let expected = run(&scene, None);
            assert!(expected.1.error.is_none() && expected.1.sorts >= 10);
            for count in [2, 3] {
                let run = &run;
                std::thread::scope(|scope| {
                    let ranks = threads::ranks(count, None).into_iter();
                    let all = ranks.map(|rank| (rank, scene.clone()));
                    let all: Vec<_> = all
                        .map(|(rank, scene)| scope.spawn(move || run(&scene, Some(rank))))
                        .collect();
                    for found in all {
                        let found = found.join().expect("no rank panics");
                        assert_eq!(found.0, expected.0, "{count} ranks");
                        assert_eq!(found.1.hash, expected.1.hash, "{count} ranks");
                        assert!(found.1 == expected.1, "{count} ranks");
                    }
                });
            }
        }
    }
}

/// Two bodies that would pass through each other stop all ranks with the same error.
#[test]
fn ranks_stop_for_the_same_pair() {
    let mut scene = layers(Dimension::Two);
    scene.time_step = TimeStep::Fixed {
        dt: 0.01,
        allow_unstable: true,
    };
    let rough = rough_drift(scene.dimension, [0.0; 3], 0.1, 1.0, 3);
    let initial: InitialField = Arc::new(move |x| {
        let mut state: InitialState = rough(x);
        state.velocity[1] = if x[1] > 0.3 { -6.0 } else { 6.0 };
        state
    });
    let end = compare_from(&scene, 20, &initial);
    let error = end.error.expect("the layers pass through each other");
    assert!(
        matches!(error.kind, StepErrorKind::Interaction(_)),
        "{error}"
    );
}
