//! Ranks that share the rows of planes: a block that is short along the first axis is cut along the second, too.

use super::harness::{End, compare_teams, drifting, end, plate, shared, start, step, strip};
use super::threads::{self, Meddle};
use super::turned::turned;
use super::{absorbing, contact, driven_shapes, in_turn, surfaces, water};
use crate::common::{APIC, FLIP, MLS, NEVER, SCHEMES, material, options};
use proctor_kernel::ranks::Ranks;
use proctor_kernel::simulation::StepErrorKind;
use proctor_laws::{Newtonian, VonMises};
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{
    Damping, Dimension, DomainUpdate, History, Outside, PlaneCondition, Scene, StressScheme,
    Traction, VolumetricStrain, Weighting,
};
use std::sync::Arc;

/// Ranks and threads of each.
const TEAMS: [(usize, usize); 3] = [(2, 2), (4, 1), (6, 1)];

/// Compares one process with ranks that share rows; the end.
fn compare(scene: &Scene, steps: usize, drift: f64) -> End {
    compare_teams(scene, steps, &drifting(scene, drift), &TEAMS)
}

#[test]
fn ranks_that_share_rows_change_no_bit() {
    let stretch = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let spline = Weighting::QuadraticBSpline;
    let methods = [
        (Weighting::UniformGimp, FLIP),
        (stretch, FLIP),
        (spline, MLS),
        (Weighting::UniformGimp, APIC),
    ];
    let mut index = 0;
    for (weighting, transfer) in methods {
        for scheme in SCHEMES {
            index += 1;
            let mut scene = plate();
            (scene.weighting, scene.transfer, scene.scheme) = (weighting, transfer, scheme);
            in_turn(&mut scene, index);
            let end = compare(&scene, 80, 3.0);
            assert!(end.sorts >= 10, "{} sorts of {scene:?}", end.sorts);
        }
    }
}

/// Planes alone leave no room for four ranks, and each of these has a part of the rows.
#[test]
fn rows_are_cut_where_planes_end() {
    let scene = plate();
    let simulation = start(&scene, 1, &drifting(&scene, 0.0));
    let shape = &simulation.view().grid.shape;
    let forecast = simulation.forecast_ranks(4).expect("there is room");
    assert!(forecast.iter().all(|rank| rank.rows.len() < shape.nodes[1]));
    let nodes = forecast
        .iter()
        .map(|rank| rank.planes.len() * rank.rows.len());
    assert_eq!(
        nodes.sum::<usize>(),
        shape.plane_nodes() / shape.nodes[2] * shape.nodes[0]
    );
    let error = simulation.forecast_ranks(9).expect_err("there is no room");
    assert!(error.to_string().contains("at most 8"), "{error}");
}

#[test]
fn ranks_that_share_rows_bear_tractions_and_drive_a_body() {
    let mut scene = plate();
    scene.gravity = [0.0; 3];
    scene.tractions = vec![Traction {
        p1: [0.1, 0.3, 0.4],
        p2: [0.6, 1.9, 0.4],
        traction: History {
            times: vec![0.0, 0.05],
            values: vec![[0.0, 0.0, -4.0], [1.0, 0.0, -8.0]],
        },
    }];
    let end = compare(&scene, 60, 1.0);
    assert!(end.error.is_none(), "{:?}", end.error);
    assert!(end.sorts >= 3, "{} sorts", end.sorts);
    for scheme in SCHEMES {
        let mut scene = plate();
        scene.scheme = scheme;
        scene.bodies[1].motion = Some(History {
            times: vec![0.0, 0.1],
            values: vec![[0.0, 1.0, 0.0], [0.0, 0.6, 0.2]],
        });
        let end = compare(&scene, 40, 3.0);
        assert!(end.error.is_none(), "{:?}", end.error);
        assert!(end.sorts >= 3, "{} sorts", end.sorts);
    }
}

#[test]
fn particles_leave_where_ranks_share_rows() {
    let mut scene = plate();
    scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
    scene.outside = Outside::Remove;
    let end = compare(&scene, 200, 10.0);
    let events = end.state.state.events.len();
    assert!(events > 20, "{events}");
}

#[test]
fn laws_with_memory_where_ranks_share_rows() {
    let mut scene = plate();
    scene.materials = vec![
        material(VonMises::new(1.0e3, 0.3, 5.0, 10.0)),
        material(Newtonian::new(2.0e3, 40.0)),
    ];
    let end = compare(&scene, 80, 3.0);
    assert!(end.error.is_none() && end.sorts >= 5, "{} sorts", end.sorts);
}

/// The bytes that travel in a step are those that the plan counts, with a message along the rows and one along the planes.
#[test]
fn a_step_of_rows_sends_what_the_plan_counts() {
    for scheme in SCHEMES {
        let mut scene = plate();
        scene.scheme = scheme;
        let initial = &drifting(&scene, 0.5);
        let forecast = start(&scene, 1, initial).forecast_ranks(4);
        let forecast = forecast.expect("the scene can be shared");
        let particles: usize = forecast.iter().map(|share| share.particles).sum();
        assert_eq!(particles, start(&scene, 1, initial).particles());
        let ranks = threads::ranks(4, None);
        let sent: Vec<usize> = std::thread::scope(|scope| {
            let step = |rank: threads::Thread| {
                let scene = &scene;
                move || {
                    let sent = rank.sent();
                    let mut simulation =
                        super::harness::start_on(Some(Arc::new(rank)), scene, 1, initial);
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
}

fn compare_turned(scene: &Scene, steps: usize, initial: &InitialField) -> End {
    let (scene, initial) = turned(scene, initial);
    let shape = &start(&scene, 1, &initial);
    let forecast = shape.forecast_ranks(4).expect("there is room");
    let rows = shape.view().grid.shape.nodes[1];
    assert!(forecast.iter().all(|rank| rank.rows.len() < rows));
    let end = compare_teams(&scene, steps, &initial, &TEAMS[1..]);
    assert!(end.error.is_none(), "{:?}", end.error);
    end
}

#[test]
fn rows_touch_as_one_process() {
    for (scheme, damping) in
        SCHEMES
            .into_iter()
            .zip([Damping::None, Damping::Local { alpha: 0.2 }, Damping::None])
    {
        let mut scene = contact::layers(Dimension::Three);
        (scene.scheme, scene.damping) = (scheme, damping);
        let end = compare_turned(&scene, 80, &contact::sliding(&scene));
        assert!(end.sorts >= 10, "{} sorts", end.sorts);
        assert!(end.touching.len() > 20, "{} nodes", end.touching.len());
    }
}

#[test]
fn rows_rest_on_surfaces_and_plates_as_one_process() {
    for driven in [false, true] {
        let mut scene = if driven {
            surfaces::beside_driven_bodies()
        } else {
            surfaces::on_a_slope(0.3)
        };
        scene.damping = Damping::Local { alpha: 0.2 };
        let end = compare_turned(&scene, 26, &drifting(&scene, 8.0));
        assert!(end.sorts >= 3, "{} sorts", end.sorts);
        assert!(end.touching.len() > 50, "{} nodes", end.touching.len());
    }
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene = driven_shapes::on_a_plate(Dimension::Three, Some(driven_shapes::rising()));
        scene.scheme = scheme;
        let end = compare_turned(&scene, 26, &driven_shapes::along(&scene));
        assert!(end.sorts >= 10, "{} sorts", end.sorts);
        assert!(end.touching.len() > 20, "{} nodes", end.touching.len());
    }
}

#[test]
fn rows_let_waves_leave_and_shake_free_ground() {
    for scheme in SCHEMES {
        let mut scene = absorbing::falling(Dimension::Three);
        scene.scheme = scheme;
        scene.ground_beyond.thickness = Some(1.0);
        scene.contacts = vec![contact::contact(1, [1, 2], 0.3)];
        let initial = absorbing::rough(&scene, [0.0, 0.0, -8.0], 0.1);
        let end = compare_turned(&scene, 32, &initial);
        assert!(end.sorts >= 10, "{} sorts", end.sorts);
        assert!(end.state.state.ledger.absorbed > 0.0);
    }
    for (up, rigid) in [(2, false), (2, true), (0, false)] {
        let mut scene = absorbing::ground(Dimension::Three, up);
        let base = absorbing::shaking(&scene, up);
        if rigid {
            scene.mesh.planes[up][0] = PlaneCondition::Fixed;
            scene.base_motion = Some(base);
        } else {
            scene.ground_beyond.incoming = Some(base);
        }
        let end = compare_turned(&scene, 80, &absorbing::rough(&scene, [0.0; 3], 3.0));
        assert!(end.sorts >= 2, "{} sorts", end.sorts);
        let free = &end.state.state.free_ground;
        assert!(free.iter().any(|node| node.velocity != [0.0; 3]));
    }
}

#[test]
fn rows_share_pore_water_and_standing_water() {
    for (scheme, averaged) in [(StressScheme::Usl, true), (StressScheme::Musl, false)] {
        let mut scene = water::wet(Dimension::Three);
        scene.scheme = scheme;
        if averaged {
            scene.volumetric_strain = VolumetricStrain::CellAverage;
        }
        let end = compare_turned(&scene, 45, &drifting(&scene, 8.0));
        assert!(end.sorts >= 3, "{} sorts", end.sorts);
    }
    for mut scene in [strip(Dimension::Three), water::wet(Dimension::Three)] {
        scene.gravity = [0.0, 0.0, -10.0];
        scene.standing_waters = vec![water::standing()];
        let end = compare_turned(&scene, 60, &drifting(&scene, 8.0));
        assert!(end.sorts >= 3, "{} sorts", end.sorts);
    }
}

/// The error of a particle is the same on every rank, and that of one process.
#[test]
fn ranks_that_share_rows_stop_for_the_same_particle() {
    let mut scene = plate();
    scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
    let end = compare(&scene, 400, 10.0);
    let error = end.error.expect("the plate leaves the mesh");
    assert!(matches!(error.kind, StepErrorKind::Outside(_)), "{error}");
}

/// A ghost along the rows that changes on its way is found when ghosts are compared with their owners.
#[test]
fn a_changed_ghost_of_a_row_is_found() {
    let scene = plate();
    let meddle: Meddle = |from, to, words| {
        if from == 1 && to == 0 && words.len() > 8 {
            *words.last_mut().expect("not empty") ^= 1;
        }
    };
    let (_, of_ranks) = shared(&scene, (4, 2), 300, &drifting(&scene, 0.5), Some(meddle));
    for (_, error, _) in of_ranks {
        let error = error.expect("ranks disagree").kind;
        assert!(
            matches!(error, StepErrorKind::RanksDisagree { .. }),
            "{error:?}"
        );
    }
}

/// Ranks that share each step have the whole after each, with the rows that the next cut needs.
#[test]
fn each_rank_has_the_whole_between_steps_of_rows() {
    let scene = &contact::layers(Dimension::Three);
    let (scene, initial) = &turned(scene, &contact::sliding(scene));
    let saved = &{
        let mut alone = start(scene, 1, initial);
        let stepped = step(&mut alone, 20);
        assert!(stepped.1.is_none(), "{:?}", stepped.1);
        alone.save()
    };
    let run = |rank: Option<threads::Thread>| {
        let options = Options {
            threads: Some(1),
            least_share: Some(1),
            initial: Some(Arc::clone(initial)),
            step_ranks: rank.map(|rank| Arc::new(rank) as Arc<dyn Ranks>),
            ..options()
        };
        let mut simulation = Simulation::new(scene, &options).expect("the scene is sound");
        let first = step(&mut simulation, 30);
        let energy = simulation.energy();
        // A state of one process, which has no rows.
        simulation.restore(saved.clone()).expect("the same scene");
        let second = step(&mut simulation, 30);
        let sorts = first.0 + second.0;
        let end = end(&mut simulation, (sorts, first.1.or(second.1)));
        (energy, end.hash, end.energy, end.touching, end.sorts)
    };
    let expected = run(None);
    assert!(expected.4 >= 5, "{} sorts", expected.4);
    std::thread::scope(|scope| {
        let ranks = threads::ranks(4, None).into_iter();
        let all: Vec<_> = ranks.map(|rank| scope.spawn(|| run(Some(rank)))).collect();
        for found in all {
            assert_eq!(found.join().expect("no rank panics"), expected);
        }
    });
}

/// A saved state goes on on ranks that share rows: nobody knows the rows of its last sort, and the first rank of each range of
/// planes has them all until the next.
#[test]
fn a_saved_state_goes_on_where_rows_are_cut() {
    let scene = &plate();
    let initial = &drifting(scene, 1.0);
    let mut alone = start(scene, 1, initial);
    let first = step(&mut alone, 20);
    assert!(first.1.is_none(), "{:?}", first.1);
    let saved = alone.save();
    let sorted = step(&mut alone, 60);
    let expected = end(&mut alone, sorted);
    assert!(expected.sorts >= 3, "{} sorts", expected.sorts);
    for count in [4, 8] {
        std::thread::scope(|scope| {
            let run = |rank: Arc<dyn Ranks>, saved| {
                move || {
                    let mut simulation = start(scene, 1, initial);
                    simulation.restore(saved).expect("the same scene");
                    simulation.share_among(rank).expect("it can be shared");
                    let sorted = step(&mut simulation, 60);
                    let (saved, parts) = simulation.save_part();
                    let whole = simulation.gather();
                    let end = whole.map(|_| end(&mut simulation, sorted));
                    (saved, parts, end)
                }
            };
            let ranks = threads::ranks(count, None).into_iter();
            let all: Vec<_> = ranks
                .map(|rank| scope.spawn(run(Arc::new(rank), saved.clone())))
                .collect();
            let ends = all.into_iter().map(|rank| rank.join().expect("no panic"));
            let mut ids: Vec<Vec<u64>> = vec![vec![]; scene.bodies.len()];
            for (saved, parts, end) in ends {
                for (body, (set, part)) in saved.state.sets.iter().zip(&parts).enumerate() {
                    assert_eq!(part.before, ids[body].len(), "{count} ranks");
                    ids[body].extend(&set.id);
                    assert_eq!(set.layers, expected.state.state.sets[body].layers);
                }
                assert!(end.is_none_or(|end| end == expected), "{count} ranks");
            }
            let of_one = expected.state.state.sets.iter().map(|set| set.id.clone());
            assert_eq!(ids, of_one.collect::<Vec<_>>(), "{count} ranks");
        });
    }
}
