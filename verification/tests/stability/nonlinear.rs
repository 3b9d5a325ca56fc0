//! The scenes beyond small strain: what they are named for happens in them.

use proctor_scene::simulation::{Bound, Options, Simulation};
use proctor_verification::settings::{Method, Settings};
use proctor_verification::stability::nonlinear::energy;
use proctor_verification::stability::nonlinear::scenes::{self, Set};

fn start(set: fn() -> Set) -> (Simulation, f64) {
    let Set {
        mut scene,
        initial,
        time,
    } = set();
    Settings::new(Method::DEFAULT).apply(&mut scene);
    scene.time = time;
    let options = Options {
        threads: Some(1),
        initial,
        ..Options::default()
    };
    (scene.simulate(&options).expect("a simulation"), time)
}

/// Without this they would be rows of elasticity.
#[test]
fn laws_that_yield_do_so() {
    for set in [scenes::von_mises, scenes::mohr_coulomb] {
        let (mut simulation, time) = start(set);
        let begin = energy(&simulation);
        while simulation.time() < 0.1 * time {
            simulation.step(time).expect("a step");
        }
        let share = simulation.plastic_work() / begin;
        assert!((0.5..1.0).contains(&share), "{share} of the energy");
    }
}

#[test]
fn viscosity_bounds_the_step_of_the_fluid() {
    let (mut simulation, time) = start(scenes::newtonian);
    let info = simulation.step(time).expect("a step");
    assert_eq!(info.bound, Bound::Viscosity);
}
