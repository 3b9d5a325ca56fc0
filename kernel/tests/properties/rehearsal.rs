//! Observing the phases of a step, or rehearsing a part of it, changes no bit of the result.

use crate::common::{DIMENSIONS, NEVER, SCHEMES, block, observe, run};
use proctor_scene::StressScheme;
use proctor_scene::simulation::{Options, Part, Phase, Simulation};

#[test]
fn an_observer_gets_the_phases_in_order_and_changes_nothing() {
    for scheme in SCHEMES {
        let mut scene = block(DIMENSIONS[1]);
        scene.scheme = scheme;
        scene.gravity = [1.0, 0.0, -10.0];
        let options = Options {
            threads: Some(2),
            least_share: Some(1),
            ..Options::default()
        };
        let start = || Simulation::new(&scene, &options).expect("the scene is sound");
        let (mut alone, mut watched) = (start(), start());
        run(&mut alone, 5);
        let phases = observe(&mut watched);
        for _ in 0..5 {
            phases.lock().expect("no panic").clear();
            watched.step(NEVER).expect("a sound step");
        }
        let phases = phases.lock().expect("no panic").clone();
        assert_eq!(alone.state_hash(), watched.state_hash(), "{scheme:?}");
        let expected = match scheme {
            StressScheme::Usl => vec![
                Phase::Sort,
                Phase::TimeStep,
                Phase::P2gAndSolve,
                Phase::G2p,
                Phase::Finish,
            ],
            StressScheme::Musl => vec![
                Phase::Sort,
                Phase::TimeStep,
                Phase::P2gAndSolve,
                Phase::G2p,
                Phase::Remap,
                Phase::G2p,
                Phase::Finish,
            ],
            StressScheme::Usf => vec![
                Phase::Sort,
                Phase::TimeStep,
                Phase::P2gAndSolve,
                Phase::G2p,
                Phase::Sort,
                Phase::Remap,
                Phase::G2p,
                Phase::Finish,
            ],
        };
        assert_eq!(phases, expected, "{scheme:?}");
    }
}

#[test]
fn a_rehearsal_leaves_no_trace() {
    for dimension in DIMENSIONS {
        for scheme in SCHEMES {
            let mut scene = block(dimension);
            scene.scheme = scheme;
            scene.gravity = [1.0, -10.0, 0.0];
            scene.bodies[0].velocity = [3.0, 1.0, 0.0];
            let start = || {
                let options = Options {
                    threads: Some(2),
                    least_share: Some(1),
                    ..Options::default()
                };
                let mut simulation = Simulation::new(&scene, &options).expect("a sound scene");
                run(&mut simulation, 4);
                simulation
            };
            let mut plain = start();
            run(&mut plain, 4);
            for part in Part::ALL {
                let mut simulation = start();
                let before = simulation.state_hash();
                let mut rehearsal = simulation.rehearse(part).expect("a sound step");
                for _ in 0..3 {
                    rehearsal.set().expect("a sound step");
                    rehearsal.play().expect("a sound step");
                }
                drop(rehearsal);
                assert_eq!(simulation.state_hash(), before, "{part:?} {scheme:?}");
                run(&mut simulation, 4);
                assert_eq!(
                    simulation.state_hash(),
                    plain.state_hash(),
                    "{part:?} {scheme:?}"
                );
            }
        }
    }
}
