//! Ranks that share a simulation: state, sums, events and errors are those of one process, bit by bit.

mod absorbing;
mod conditions;
mod contact;
mod driven_shapes;
mod harness;
mod rows;
mod surfaces;
mod threads;
mod turned;
mod water;

use crate::common::{APIC, DIMENSIONS, FLIP, MLS, NEVER, SCHEMES, body, cuboid, empty, material};
use harness::{compare, compare_from, drifting, shared, start, strip};
use proctor_kernel::simulation::{SharingRefusal, StepErrorKind};
use proctor_laws::{NeoHookean, Newtonian, VonMises};
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{
    BaseMotion, BoxLoad, Damping, Dimension, DomainUpdate, History, Motion, Outside,
    PlaneCondition, Scene, StressScheme, Traction, Weighting,
};
use std::sync::Arc;
use threads::Meddle;

#[test]
#[ignore = "takes 9 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ranks_change_no_bit() {
    let gimp = Weighting::UniformGimp;
    let stretch = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let determinant = Weighting::ContiguousGimp(DomainUpdate::Determinant);
    let spline = Weighting::QuadraticBSpline;
    let methods = [
        (gimp, FLIP),
        (gimp, APIC),
        (stretch, FLIP),
        (determinant, APIC),
        (spline, MLS),
    ];
    let mut index = 0;
    for dimension in DIMENSIONS {
        for (weighting, transfer) in methods {
            for scheme in SCHEMES {
                index += 1;
                let mut scene = strip(dimension);
                (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
                in_turn(&mut scene, index);
                let end = compare(&scene, 80, 8.0);
                assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
            }
        }
    }
}

/// Gives scenes of a list each kind of damping in turn, and each second one a box load.
fn in_turn(scene: &mut Scene, index: usize) {
    scene.damping = match index % 4 {
        0 => Damping::Local { alpha: 0.2 },
        1 => Damping::Viscous { alpha: 0.1 },
        2 => Damping::Kinetic,
        _ => Damping::None,
    };
    if index.is_multiple_of(2) {
        scene.box_loads = vec![BoxLoad {
            p1: [0.0; 3],
            p2: [1.0; 3],
            force: [0.0, 5.0, 0.0],
        }];
    }
}

/// One body moves as prescribed, and takes the nodes along that it reaches.
#[test]
fn ranks_drive_a_body_together() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = strip(dimension);
            scene.scheme = scheme;
            scene.bodies[1].motion = Some(History {
                times: vec![0.0, 0.1],
                values: vec![[8.0, 0.0, 0.0], [4.0, 0.5, 0.0]],
            });
            let end = compare(&scene, 60, 8.0);
            assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
        }
    }
}

/// Tractions look at the masses of the nodes around theirs, and bodies leave some of these behind.
#[test]
fn ranks_bear_tractions_together() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        let depth = if dimension == Dimension::Three {
            0.4
        } else {
            0.0
        };
        scene.gravity = [0.0; 3];
        scene.tractions = vec![Traction {
            p1: [0.3, 0.4, 0.5 * depth],
            p2: [3.9, 0.4, depth],
            traction: History {
                times: vec![0.0, 0.05],
                values: vec![[0.0, -4.0, 0.0], [1.0, -8.0, 0.0]],
            },
        }];
        let end = compare(&scene, 60, 8.0);
        assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
    }
}

/// A base that moves along its normal takes the mesh along.
#[test]
fn ranks_move_with_the_base() {
    let mut scene = strip(Dimension::Two);
    scene.base_motion = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(History {
            times: vec![0.0, 0.1],
            values: vec![[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
        }),
    });
    let end = compare(&scene, 80, 8.0);
    assert!(
        end.error.is_none() && end.sorts >= 10,
        "{} sorts",
        end.sorts
    );
}

/// With MUSL, FLIP does not hold tension: each rank stops for the same particle. The growth of a particle goes with it.
#[test]
fn ranks_stop_for_the_same_tension() {
    let mut scene = empty(Dimension::Two, [24, 3, 3], 0.1);
    scene.materials = vec![material(NeoHookean::new(1.0e5, 0.3))];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[0] = [PlaneCondition::Fixed, PlaneCondition::Free];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [1.0, 0.3, 0.0]))];
    scene.scheme = StressScheme::Musl;
    scene.damping = Damping::Viscous { alpha: 0.05 };
    scene.box_loads = vec![BoxLoad {
        p1: [0.9, 0.0, 0.0],
        p2: [1.0, 0.3, 0.3],
        force: [6.0e3, 0.0, 0.0],
    }];
    let rest: InitialField = Arc::new(|_| InitialState::default());
    let end = compare_from(&scene, 4000, &rest);
    let error = end.error.expect("tension tears the bar");
    assert!(matches!(error.kind, StepErrorKind::Tension(_)), "{error}");
}

/// Laws with memory, and one whose viscosity bounds the step.
#[test]
fn ranks_change_no_bit_of_laws_with_memory() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        scene.materials = vec![
            material(VonMises::new(1.0e3, 0.3, 5.0, 10.0)),
            material(Newtonian::new(2.0e3, 40.0)),
        ];
        let end = compare(&scene, 80, 8.0);
        assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
    }
}

/// Particles leave through the end of the mesh and are removed, on ranks that own them and as ghosts.
#[test]
fn particles_leave_on_all_ranks() {
    for dimension in DIMENSIONS {
        let mut scene = strip(dimension);
        scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
        scene.outside = Outside::Remove;
        scene.gravity = [0.0, 8.0, 0.0];
        let end = compare(&scene, 300, 20.0);
        assert!(
            end.state.state.events.len() > 20,
            "{}",
            end.state.state.events.len()
        );
    }
}

/// Domains of particles grow beyond half a cell, so that the stencil has four nodes.
#[test]
fn a_wider_stencil_has_wider_ghosts() {
    let mut scene = strip(Dimension::Two);
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    scene.bodies.truncate(1);
    scene.bodies[0].particles_per_cell = [1, 1, 1];
    let end = compare(&scene, 200, 8.0);
    assert_eq!(end.state.state.stencil, 4);
}

/// The error of a particle is the same on every rank.
#[test]
fn ranks_stop_for_the_same_particle() {
    let mut scene = strip(Dimension::Two);
    scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
    let end = compare(&scene, 400, 30.0);
    let error = end.error.expect("the strip leaves the mesh");
    assert!(matches!(error.kind, StepErrorKind::Outside(_)), "{error}");
}

/// The bytes that travel in a step are those that the plan counts.
#[test]
fn a_step_sends_what_the_plan_counts() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = strip(dimension);
            scene.scheme = scheme;
            sends_what_the_plan_counts(&scene);
        }
    }
}

fn sends_what_the_plan_counts(scene: &Scene) {
    let initial = &drifting(scene, 0.5);
    let forecast = start(scene, 1, initial).forecast_ranks(3);
    let forecast = forecast.expect("the scene can be shared");
    let particles: usize = forecast.iter().map(|share| share.particles).sum();
    assert_eq!(particles, start(scene, 1, initial).particles());
    let ranks = threads::ranks(3, None);
    let sent: Vec<usize> = std::thread::scope(|scope| {
        let step = |rank: threads::Thread| {
            move || {
                let sent = rank.sent();
                let mut simulation = start(scene, 1, initial);
                let shared = simulation.share_among(Arc::new(rank));
                shared.expect("the scene can be shared");
                simulation.step(NEVER).expect("a sound step");
                sent.load(std::sync::atomic::Ordering::Relaxed)
            }
        };
        let all: Vec<_> = ranks
            .into_iter()
            .map(|rank| scope.spawn(step(rank)))
            .collect();
        let joined = all.into_iter().map(std::thread::ScopedJoinHandle::join);
        joined.map(|sent| sent.expect("no rank panics")).collect()
    });
    let foretold: Vec<usize> = forecast.iter().map(|share| share.sent).collect();
    assert_eq!(sent, foretold, "{:?}", scene.scheme);
}

/// Of all cuts the one that is taken leaves the rank with most particles, ghosts among them, the fewest.
#[test]
fn the_fullest_rank_has_as_few_particles_as_can_be() {
    for ppc in [1, 2] {
        let mut scene = strip(Dimension::Two);
        // Domains of a whole cell reach a fourth node.
        scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
        scene.bodies[0].particles_per_cell = [ppc, 1, 1];
        let simulation = start(&scene, 1, &drifting(&scene, 0.0));
        let stencil = simulation.view().stencil;
        let planes = simulation.view().grid.shape.nodes[0];
        let held = |from: usize, to: usize| -> usize {
            let layers = from.saturating_sub(stencil)..(to + 1).min(planes);
            let sets = simulation.sets().iter();
            sets.map(|set| set.in_layers(layers.clone()).len()).sum()
        };
        let mut best = usize::MAX;
        for a in 5..=planes - 10 {
            for b in a + 5..=planes - 5 {
                best = best.min(held(0, a).max(held(a, b)).max(held(b, planes)));
            }
        }
        let forecast = simulation.forecast_ranks(3).expect("it can be shared");
        let found = forecast.iter().map(|rank| rank.particles + rank.ghosts);
        assert_eq!(found.max(), Some(best), "stencil {stencil}");
        assert!(forecast.iter().all(|rank| rank.planes.len() >= 5));
    }
}

/// One number of a ghost that changes on its way is found when ghosts are compared with their owners.
#[test]
fn a_changed_ghost_is_found() {
    let scene = strip(Dimension::Two);
    let meddle: Meddle = |from, to, words| {
        // The last word is the last column of the last particle: a ghost on the rank below.
        if from == 1 && to == 0 && words.len() > 8 {
            *words.last_mut().expect("not empty") ^= 1;
        }
    };
    let (_, of_ranks) = shared(&scene, (2, 1), 300, &drifting(&scene, 2.0), Some(meddle));
    for (_, error, _) in of_ranks {
        let error = error.expect("ranks disagree");
        assert!(
            matches!(error.kind, StepErrorKind::RanksDisagree { .. }),
            "{error}"
        );
        assert_eq!(error.step, 257, "{error}");
    }
}

#[test]
fn what_is_not_local_is_refused() {
    let refused = |scene: &Scene, count: usize| {
        let rank = threads::ranks(count, None).swap_remove(0);
        let mut simulation = start(scene, 1, &drifting(scene, 1.0));
        simulation
            .share_among(Arc::new(rank))
            .expect_err("not local")
    };
    let scene = crate::physics::mortar::collision(0.4);
    let part = "mortar contact";
    assert_eq!(refused(&scene, 2), SharingRefusal::Part { part });
    let scene = strip(Dimension::Two);
    let error = refused(&scene, 13);
    assert_eq!(
        error,
        SharingRefusal::TooMany {
            ranks: 13,
            most: 12
        }
    );
    assert!(error.to_string().contains("at most 12"), "{error}");
}
