//! Faults of a run are found in the step in which they happen, and named.

use crate::common::{
    DIMENSIONS, NEO_HOOKEAN, NEVER, SCHEMES, block, body, cuboid, empty, first_error, material,
    options, rough, run, simulation, simulation_from,
};
use proctor_laws::AnyLaw;
use proctor_scene::simulation::{
    EventKind, InitialState, Options, SetupError, Simulation, StepErrorKind,
};
use proctor_scene::{
    BoxLoad, Dimension, DomainUpdate, History, Outside, ParticleSeed, PlaneCondition, Scene, Shape,
    StressScheme, TimeStep, Weighting,
};
use std::sync::Arc;

/// One body at rest and a second one that flies out through a free plane.
fn leaving(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [8, 5, 4], 0.1);
    scene.bodies = vec![
        body(1, cuboid([0.1, 0.1, 0.1], [0.2, 0.3, 0.2])),
        body(7, cuboid([0.6, 0.1, 0.1], [0.75, 0.3, 0.2])),
    ];
    scene.bodies[1].velocity = [5.0, 0.0, 0.0];
    scene
}

#[test]
fn a_particle_that_leaves_the_mesh_stops_the_run() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = leaving(dimension);
            scene.scheme = scheme;
            let mut simulation = simulation(&scene);
            let error = first_error(&mut simulation, 100);
            let StepErrorKind::Outside(at) = error.kind else {
                panic!("{error}")
            };
            assert_eq!(at.body, 7);
            assert!(at.position[0] > 0.8 && at.position[0] < 0.85, "{at:?}");
            assert!(
                error
                    .to_string()
                    .contains(&format!("particle {} of body 7", at.id)),
                "{error}"
            );
        }
    }
}

#[test]
fn a_particle_that_leaves_the_mesh_is_removed_with_its_mass() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = leaving(dimension);
            scene.scheme = scheme;
            scene.outside = Outside::Remove;
            scene.gravity = [1.0, 0.0, 0.0];
            scene.bodies[0].velocity = [-0.0, 0.0, 0.0];
            let mut simulation = simulation(&scene);
            let (mass, count) = (simulation.mass(), simulation.particles());
            let gone_mass = simulation.center(1).mass;
            let mut work = simulation.energy().external_work;
            let power = mass * 1.0 * 5.2;
            while simulation.time() < 0.06 {
                let before = simulation.time();
                simulation.step(0.06).expect("removal is no error");
                let now = simulation.energy().external_work;
                // Gravity's power never exceeds M g v; a removed particle may not jump in the balance.
                assert!(
                    now >= work && now - work <= power * (simulation.time() - before),
                    "work jumps from {work} to {now}"
                );
                work = now;
            }
            let mut removed = 0.0;
            for event in simulation.events() {
                let EventKind::Removed(at) = event.kind else {
                    panic!("{event:?}")
                };
                assert_eq!(at.body, 7);
                assert!(event.step > 0 && at.position[0] > 0.8);
                removed += at.mass;
            }
            assert!(
                (removed - gone_mass).abs() < 1.0e-12 * mass,
                "all of body 7: {removed}"
            );
            assert!((simulation.mass() + removed - mass).abs() < 1.0e-12 * mass);
            assert_eq!(simulation.particles() + simulation.events().len(), count);
            // The run goes on, and with a set that became empty.
            run(&mut simulation, 3);
        }
    }
}

#[test]
fn a_velocity_that_is_not_a_number_is_found_in_its_step() {
    for scheme in SCHEMES {
        let mut scene = block(Dimension::Three);
        scene.scheme = scheme;
        scene.outside = Outside::Remove;
        let mut simulation = simulation_from(
            &scene,
            Arc::new(|x| InitialState {
                velocity_gradient: [[0.0; 3]; 3],
                velocity: [if x[0] > 0.5 { f64::NAN } else { 0.0 }, 0.0, 0.0],
                stress: [0.0; 6],
                deformation: crate::common::IDENTITY,
            }),
        );
        let error = first_error(&mut simulation, 1);
        assert!(
            matches!(error.kind, StepErrorKind::NotFinite(_)),
            "{scheme:?}: {error}"
        );
    }
}

/// USF is left out: its f = (1 - G)^-1 is how the particles really moved, and they do not pass each other here.
#[test]
fn an_inverted_particle_is_named() {
    for law in [AnyLaw::from(crate::common::ELASTIC), NEO_HOOKEAN.into()] {
        for scheme in [StressScheme::Usl, StressScheme::Musl] {
            let mut scene = block(Dimension::Two);
            scene.scheme = scheme;
            scene.materials = vec![material(law.clone())];
            // Two halves run into each other with half a cell per step each.
            scene.time_step = TimeStep::Fixed {
                dt: 4.0e-3,
                allow_unstable: true,
            };
            let mut simulation = simulation_from(
                &scene,
                Arc::new(|x| InitialState {
                    velocity_gradient: [[0.0; 3]; 3],
                    velocity: [if x[0] < 0.41 { 30.0 } else { -30.0 }, 0.0, 0.0],
                    stress: [0.0; 6],
                    deformation: crate::common::IDENTITY,
                }),
            );
            let error = first_error(&mut simulation, 3);
            let StepErrorKind::Inverted(at) = error.kind else {
                panic!("{law:?} {scheme:?}: {error}")
            };
            assert!(at.volume <= 0.0, "{at:?}");
        }
    }
}

#[test]
fn a_step_above_the_critical_one_is_refused() {
    let mut scene = block(Dimension::Two);
    let critical = {
        let mut simulation = simulation(&scene);
        simulation
            .step(NEVER)
            .expect("the step is sound")
            .dt_critical
    };
    for (time_step, fits) in [
        (
            TimeStep::Fixed {
                dt: critical,
                allow_unstable: false,
            },
            true,
        ),
        (
            TimeStep::Fixed {
                dt: 1.01 * critical,
                allow_unstable: false,
            },
            false,
        ),
        (
            TimeStep::Multiplier {
                multiplier: 0.42,
                allow_unstable: false,
            },
            true,
        ),
        (
            TimeStep::Multiplier {
                multiplier: 0.43,
                allow_unstable: false,
            },
            false,
        ),
        (
            TimeStep::Fixed {
                dt: 10.0 * critical,
                allow_unstable: true,
            },
            true,
        ),
    ] {
        scene.time_step = time_step;
        match (Simulation::new(&scene, &options()), fits) {
            (Ok(_), true) => {}
            (Err(SetupError::UnstableTimeStep(found)), false) => {
                assert!((found.critical - critical).abs() < 1.0e-9 * critical);
                assert!(found.dt > found.critical);
            }
            (other, _) => panic!("{time_step:?}: {:?}", other.err()),
        }
    }
}

/// Ten times too large, on request: the run must end with a typed error soon, not with numbers.
#[test]
fn blow_up_is_detected() {
    for scheme in SCHEMES {
        let mut scene = block(Dimension::Two);
        scene.scheme = scheme;
        scene.time_step = TimeStep::Fixed {
            dt: 2.0e-2,
            allow_unstable: true,
        };
        let mut simulation = simulation_from(&scene, rough(Dimension::Two, 0.01, 0.0, 2));
        let error = first_error(&mut simulation, 100);
        assert!(
            matches!(
                error.kind,
                StepErrorKind::Inverted(_)
                    | StepErrorKind::NotFinite(_)
                    | StepErrorKind::Outside(_)
            ),
            "{error}"
        );
    }
}

/// The automatic step knows the velocities of an initial field before the first step.
#[test]
fn the_first_step_knows_the_initial_field() {
    let mut simulation = simulation_from(
        &block(Dimension::Two),
        Arc::new(|_| InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [400.0, 0.0, 0.0],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    );
    let info = simulation.step(NEVER).expect("the step is sound");
    assert!(info.dt * 400.0 <= 0.5 * 0.1, "{info:?}");
}

#[test]
fn a_domain_wider_than_the_stencil_is_refused() {
    let seeds = vec![ParticleSeed {
        position: [0.4, 0.4, 0.0],
        volume: 0.21 * 0.21,
    }];
    for weighting in [
        Weighting::UniformGimp,
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
    ] {
        let mut scene = empty(Dimension::Two, [8, 8, 1], 0.1);
        scene.weighting = weighting;
        scene.bodies = vec![body(3, Shape::Particles(Arc::new(seeds.clone())))];
        let error = Simulation::new(&scene, &options())
            .err()
            .expect("refused")
            .to_string();
        assert!(
            error.contains("body 3") && error.contains("half-length of 1.0"),
            "{error}"
        );
    }
}

/// A stretched cpGIMP domain changes to four nodes per axis with an event, and beyond one cell stops.
#[test]
fn a_stretched_domain_widens_the_stencil_and_then_stops() {
    let mut scene = empty(Dimension::Two, [20, 6, 1], 0.1);
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    scene.materials = vec![material(crate::common::elastic(1.0, 0.0))];
    scene.bodies = vec![body(1, cuboid([0.6, 0.2, 0.0], [1.4, 0.4, 0.0]))];
    let mut simulation = simulation_from(
        &scene,
        Arc::new(|x| InitialState {
            velocity_gradient: [[0.0; 3]; 3],
            velocity: [2.0 * (x[0] - 1.0), 0.0, 0.0],
            stress: [0.0; 6],
            deformation: crate::common::IDENTITY,
        }),
    );
    let mass = simulation.mass();
    let error = first_error(&mut simulation, 1000);
    let widened = simulation.events();
    assert_eq!(widened.len(), 1, "{widened:?}");
    assert_eq!(widened[0].kind, EventKind::WiderStencil);
    // l = h/4 at first: twice that at a stretch of 2, x = X e^(2 t) or X (1 + 2 t) in between.
    assert!(
        widened[0].time > 0.3 && widened[0].time < 0.6,
        "{widened:?}"
    );
    match error.kind {
        StepErrorKind::DomainTooLarge { half_length } => {
            assert!(half_length > 1.0 && half_length < 1.1);
        }
        StepErrorKind::Outside(_) => assert!(error.time > widened[0].time),
        _ => panic!("{error}"),
    }
    assert!((simulation.mass() - mass).abs() < 1.0e-12 * mass);
}

/// A driven body goes where it is told, also out of the mesh, and that is an error like any other's.
#[test]
fn a_driven_body_that_leaves_the_mesh_stops_the_run() {
    for velocity in [[5.0, 0.0, 0.0], [0.0, -3.0, 0.0]] {
        let mut scene = block(Dimension::Two);
        scene.bodies[0].motion = Some(History {
            times: vec![0.0],
            values: vec![velocity],
        });
        let mut simulation = simulation(&scene);
        let error = first_error(&mut simulation, 1000);
        assert!(
            matches!(error.kind, StepErrorKind::Outside(at) if at.body == 1),
            "{error}"
        );
    }
}

/// Both write the force of a particle; together one would be lost.
#[test]
fn box_loads_and_a_body_force_are_not_mixed() {
    let mut scene = block(Dimension::Two);
    scene.box_loads = vec![BoxLoad {
        p1: [0.0; 3],
        p2: [1.0; 3],
        force: [1.0, 0.0, 0.0],
    }];
    let all = Options {
        body_force: Some(Arc::new(|_, _, _| [0.0; 3])),
        ..options()
    };
    let error = Simulation::new(&scene, &all)
        .err()
        .expect("refused")
        .to_string();
    assert!(error.contains("box_load"), "{error}");
}

/// Walls that cross: three planes in one corner and a body that fills it stay sound.
#[test]
fn a_body_in_a_corner_of_fixed_planes_stays_there() {
    let mut scene = empty(Dimension::Three, [4, 4, 4], 0.1);
    scene.mesh.planes = [[PlaneCondition::Fixed; 2]; 3];
    scene.weighting = Weighting::QuadraticBSpline;
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.4; 3]))];
    scene.gravity = [3.0, -10.0, 5.0];
    let mut simulation = simulation(&scene);
    run(&mut simulation, 200);
    let x = simulation.center(0).position;
    assert!(x.iter().all(|c| (c - 0.2).abs() < 2.0e-3), "{x:?}");
}
