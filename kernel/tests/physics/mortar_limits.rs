//! Limits of mortar contact: starts that overlap or squeeze, vertices off their body, leaps; and the steps that
//! it shortens before it must.

use crate::common::{body, cuboid, elastic, empty, material, options, simulation};
use crate::physics::mortar::{GAP, boundary, collision, contact, disc, line, plate};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::law::NormalLaw;
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_scene::simulation::{Bound, MortarError, SetupError, Simulation};
use proctor_scene::{
    BodyBoundary, Dimension, Enforcement, MortarContact, PlaneCondition, Scene, Shape,
    StressScheme, TimeStep, Vertices,
};

#[test]
fn surfaces_that_overlap_are_refused() {
    let mut scene = collision(0.0);
    scene.bodies[1].shape = disc([1.34, 0.6], 0.3);
    let Err(SetupError::Interaction { path, reason }) = Simulation::new(&scene, &options()) else {
        panic!("they overlap");
    };
    assert!(
        path == "contact" && reason.contains("gap is -"),
        "{path}: {reason}"
    );
}

/// A block over a line: the barrier may press with a tenth of Young's modulus at the start, and the message says from which
/// gap on it does not press more.
#[test]
fn a_start_that_squeezes_is_refused() {
    let (young, height) = (1.0e6, 0.4);
    let of = |gap: f64| {
        let mut scene = empty(Dimension::Two, [24, 14, 1], 0.1);
        scene.materials = vec![material(elastic(young, 0.3))];
        let block = cuboid([0.6, height + gap, 0.0], [1.2, 0.9, 0.0]);
        scene.bodies = vec![body(1, block)];
        scene.mortar.boundaries = vec![boundary(1, FollowMode::Spin)];
        scene.mortar.lines = vec![line(&[[2.0, height], [0.2, height]])];
        scene.mortar.contacts = vec![contact(9, 1, 0.0)];
        Simulation::new(&scene, &options())
    };
    let law = NormalLaw::barrier(1.0e6, GAP);
    let least = law.gap_at(0.1 * young);
    assert!(least > 0.1 * GAP && least < 0.9 * GAP);
    assert!(of(least * 1.001).is_ok());
    let Err(SetupError::Interaction { reason, .. }) = of(0.3 * least) else {
        panic!("it squeezes");
    };
    let said = reason.split("at least ").nth(1).expect("the gap to use");
    let said: f64 = said.trim_end_matches(" m").parse().expect("a number");
    assert!((said - least).abs() < 1e-12 * GAP, "{reason}");
}

#[test]
fn a_vertex_off_the_body_is_named() {
    let mut scene = collision(0.0);
    let triangle = [[0.5, 0.3], [0.8, 0.3], [0.5, 1.2]];
    scene.mortar.boundaries[0].vertices = Vertices::Given(vec![Chain {
        points: triangle.iter().map(|p| Point::from(*p)).collect(),
        side: BoundarySide::Outer,
    }]);
    let mut simulation = simulation(&scene);
    let error = simulation.step(1.0).expect_err("nothing is near it");
    assert!(
        matches!(
            error.kind.fault(),
            Some(MortarError::VertexLost {
                body: 1,
                vertex: 2,
                ..
            })
        ),
        "{error}"
    );
}

#[test]
fn a_surface_inside_another_is_refused() {
    let mut scene = collision(0.0);
    scene.bodies[1].shape = disc([0.75, 0.6], 0.1);
    let Err(SetupError::Interaction { reason, .. }) = Simulation::new(&scene, &options()) else {
        panic!("one is in the other");
    };
    assert!(
        reason.contains("vertex 0 of the slave lies inside"),
        "{reason}"
    );
    // In the hole of a ring there is room.
    scene.bodies[0].shape = Shape::Ring {
        center: [0.75, 0.6, 0.0],
        inner: 0.2,
        outer: 0.4,
    };
    assert!(Simulation::new(&scene, &options()).is_ok());
}

/// Steps are shortened so that no gap closes by more than half the critical one, and the disc is carried along.
#[test]
fn bodies_do_not_pass_through_each_other() {
    let speed = 30.0;
    let mut simulation = simulation(&plate(speed));
    let mut shortened = 0;
    let end = 0.014;
    while simulation.time() < end {
        // A stop that is far away, so that steps are as long as they may be.
        let info = simulation.step(1.0).unwrap_or_else(|e| panic!("{e}"));
        shortened += u32::from(info.bound == Bound::Closing);
        let at = simulation.boundary_vertices(9).expect("is there")[0][1];
        let lowest = simulation.boundary_vertices(1).expect("is there");
        let lowest = lowest.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
        assert!(lowest > at - GAP, "{lowest} {at}");
    }
    assert!(shortened > 0);
    assert!(simulation.center(0).velocity[1] > 0.5 * speed);
}

/// Steps that are prescribed are refused instead.
#[test]
fn a_prescribed_step_in_which_a_gap_closes_too_far_is_refused() {
    let failure = |speed: f64| {
        let mut scene = plate(speed);
        scene.time_step = TimeStep::Fixed {
            dt: 1.0e-3,
            allow_unstable: true,
        };
        let mut simulation = simulation(&scene);
        loop {
            if let Err(error) = simulation.step(0.1) {
                break error;
            }
        }
    };
    let error = failure(30.0);
    let Some(&MortarError::ClosingTooFast {
        bodies,
        vertex: Some((_, at)),
        approach,
        allowed,
    }) = error.kind.fault()
    else {
        panic!("{error}");
    };
    assert_eq!(bodies, [9, 1]);
    assert!((at[0] - 0.75).abs() < 0.1 && at[1] < 0.35, "{at:?}");
    assert!(approach > allowed && allowed >= 0.5 * GAP);
    let message = error.to_string();
    assert!(message.contains("vertex") && message.starts_with(&format!("step {}", error.step)));
    // So fast that it would pass from out of reach to the other side.
    let error = failure(1000.0);
    assert!(
        matches!(
            error.kind.fault(),
            Some(MortarError::ClosingTooFast { vertex: None, .. })
        ) && error.step == 1,
        "{error}"
    );
}

/// Blocks that bounce on a penalty 1e2 times as stiff as a cell turn towards each other again while their surfaces are still
/// apart. A step that is chosen by how the gap closes now, and not by the forces that will close it, passes through the
/// surface and is thrown back with twenty times the energy.
#[test]
fn a_gap_that_turns_is_not_run_over() {
    let mut scene = Scene::plane([16, 9], 1.0).with_planes(PlaneCondition::Free);
    scene.time = 25.0;
    scene.scheme = StressScheme::Musl;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for (from, speed) in [([3.1, 3.1], 0.05), ([7.5, 3.5], -0.05)] {
        let to = [from[0] + 4.0, from[1] + 3.0];
        let mut body = scene.add_body(Shape::rectangle(from, to), material);
        body.velocity = [speed, 0.0, 0.0];
        let id = body.id;
        scene.mortar.boundaries.push(BodyBoundary {
            body: id,
            vertices: Vertices::Spacing(0.5),
            follow: FollowMode::Velocity,
        });
    }
    scene.mortar.contacts = vec![MortarContact {
        critical_gap: 0.2,
        normal_stiffness: 1e2,
        enforcement: Enforcement::Penalty,
        ..contact(1, 2, 0.0)
    }];
    let mut simulation = simulation(&scene);
    let begin = simulation.kinetic_energy();
    let mut most = 0.0_f64;
    while simulation.time() < scene.time && most < 2.0 * begin {
        simulation.step(scene.time).expect("a sound step");
        most = most.max(simulation.kinetic_energy() + simulation.strain_energy());
    }
    assert!(most < 1.05 * begin, "{}", most / begin);
    assert!(simulation.center(0).velocity[0] < 0.0, "they part");
}
