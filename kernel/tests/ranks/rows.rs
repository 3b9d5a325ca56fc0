//! Ranks that share the rows of planes: a block that is short along the first axis is cut along the second, too.

use super::harness::{compare, plate, start, drifting};
use super::threads;
use crate::common::{APIC, FLIP, MLS, NEVER, SCHEMES, material};
use proctor_laws::{Newtonian, VonMises};
use proctor_scene::{
    BoxLoad, Damping, DomainUpdate, History, Outside, PlaneCondition, Traction, Weighting,
};
use std::sync::Arc;

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
            scene.damping = match index % 4 {
                0 => Damping::Local { alpha: 0.2 },
                1 => Damping::Viscous { alpha: 0.1 },
                2 => Damping::Kinetic,
                _ => Damping::None,
            };
            if index % 2 == 0 {
                scene.box_loads = vec![BoxLoad {
                    p1: [0.0; 3],
                    p2: [1.0; 3],
                    force: [0.0, 5.0, 0.0],
                }];
            }
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
    let nodes = forecast.iter().map(|rank| rank.planes.len() * rank.rows.len());
    assert_eq!(nodes.sum::<usize>(), shape.plane_nodes() / shape.nodes[2] * shape.nodes[0]);
    let error = simulation.forecast_ranks(9).expect_err("there is no room");
    assert!(error.to_string().contains("at most 8"), "{error}");
}

#[test]
fn ranks_that_share_rows_bear_tractions_and_drive_a_body() {
    let mut scene = plate();
    scene.gravity = [0.0; 3];
    scene.tractions = vec![Traction {
        p1: [0.2, 0.3, 0.4],
        p2: [0.7, 1.9, 0.4],
        traction: History {
            times: vec![0.0, 0.05],
            values: vec![[0.0, 0.0, -4.0], [1.0, 0.0, -8.0]],
        },
    }];
    let end = compare(&scene, 60, 1.0);
    assert!(end.error.is_none() && end.sorts >= 3, "{} sorts", end.sorts);
    for scheme in SCHEMES {
        let mut scene = plate();
        scene.scheme = scheme;
        scene.bodies[1].motion = Some(History {
            times: vec![0.0, 0.1],
            values: vec![[0.0, 4.0, 0.0], [0.0, 2.0, 0.5]],
        });
        let end = compare(&scene, 60, 3.0);
        assert!(end.error.is_none() && end.sorts >= 3, "{} sorts", end.sorts);
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
