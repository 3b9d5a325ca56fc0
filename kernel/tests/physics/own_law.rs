//! Laws of a user: their variables follow the particles, and what is wrong with them is said by name.

use crate::common::{DENSITY, block, first_error, material, options, rough_drift};
use proctor_kernel::lanes::{LaneChoice, Lanes};
use proctor_kernel::layout::Variable;
use proctor_laws::{Component, Increment, Law, LinearElastic, Particle, Stress};
use proctor_scene::simulation::{Options, Simulation, StepErrorKind};
use proctor_scene::{Dimension, Scene, StressScheme};

const ELASTIC: LinearElastic = LinearElastic::new(1.0e4, 0.3);

/// Use of its variables by the law.
#[derive(Debug, PartialEq)]
enum Habit {
    /// Adds up time and the volume strain.
    AddsUp,
    /// After a few steps the second variable is not a number.
    SpoilsVariable,
    /// After a few steps the stress is infinite.
    SpoilsStress,
}

/// Elasticity with variables.
#[derive(Debug, PartialEq)]
struct Habitual(Habit);

impl Law for Habitual {
    const VARIABLES: &'static [Variable] = &[
        Variable::scalar("age", "s"),
        Variable {
            components: 2,
            ..Variable::scalar("strain", "")
        },
    ];

    fn name(&self) -> &'static str {
        "habitual"
    }
    fn young(&self) -> f64 {
        ELASTIC.young()
    }
    fn wave_speed(&self, density: f64) -> f64 {
        ELASTIC.wave_speed(density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        variables[0] = variables[0] + L::splat(increment.dt);
        for axis in 0..2 {
            variables[1 + axis] = variables[1 + axis] + increment.gradient[axis][axis];
        }
        let speed_squared = ELASTIC.update::<L, D>(increment, stress, &mut []);
        let old = L::splat(0.01).lt(variables[0]);
        match self.0 {
            Habit::AddsUp => {}
            Habit::SpoilsVariable => {
                variables[2] = L::select(old, L::splat(f64::NAN), variables[2]);
            }
            Habit::SpoilsStress => {
                let shear = &mut stress[Component::XY];
                *shear = L::select(old, L::splat(f64::INFINITY), *shear);
            }
        }
        speed_squared
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        ELASTIC.energy(particle)
    }
}

/// Elasticity that asks for a column twice: for one by its own name, and as a component of another.
#[derive(Debug, PartialEq)]
struct Forgetful;

impl Law for Forgetful {
    const VARIABLES: &'static [Variable] = &[
        Variable {
            components: 2,
            ..Variable::scalar("void ratio", "")
        },
        Variable::scalar("void ratio 2", ""),
    ];

    fn name(&self) -> &'static str {
        "forgetful"
    }
    fn young(&self) -> f64 {
        ELASTIC.young()
    }
    fn wave_speed(&self, density: f64) -> f64 {
        ELASTIC.wave_speed(density)
    }
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        _: &mut [L],
    ) -> L {
        ELASTIC.update::<L, D>(increment, stress, &mut [])
    }
    fn energy(&self, particle: &Particle<'_>) -> f64 {
        ELASTIC.energy(particle)
    }
}

fn scene(dimension: Dimension, scheme: StressScheme, habit: Habit) -> Scene {
    let mut scene = block(dimension);
    scene.scheme = scheme;
    scene.materials = vec![material(Habitual(habit))];
    scene
}

/// A block that drifts over several cells, so that its particles are sorted, and shears as it goes.
fn adrift(scene: &Scene, threads: usize, lanes: LaneChoice) -> Simulation {
    let all = Options {
        threads: Some(threads),
        least_share: Some(1),
        lanes,
        initial: Some(rough_drift(scene.dimension, [2.0, 1.0, 0.0], 0.1, 1.0, 3)),
        ..options()
    };
    Simulation::new(scene, &all).expect("the scene is sound")
}

fn run_to(simulation: &mut Simulation, time: f64) {
    simulation.run_until(time).expect("a step");
}

#[test]
fn variables_have_the_same_bits_for_all_threads_and_lanes_and_after_a_restart() {
    for dimension in [Dimension::Two, Dimension::Three] {
        for scheme in [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf] {
            let scene = scene(dimension, scheme, Habit::AddsUp);
            let mut one = adrift(&scene, 1, LaneChoice::Auto);
            run_to(&mut one, 0.04);
            let saved = one.save();
            run_to(&mut one, 0.08);

            // Every particle is as old as the run, and none strained like another.
            let set = &one.sets()[0];
            let age = set.column("age").expect("a variable");
            assert!(age.iter().all(|age| (age - one.time()).abs() < 1.0e-12));
            let strain = set.column("strain 2").expect("a variable");
            assert!(strain.iter().all(|e| *e != 0.0 && e.abs() < 0.1));
            let age = strain
                .iter()
                .map(|e| e.to_bits())
                .collect::<std::collections::HashSet<_>>();
            assert!(age.len() > set.len() / 2);

            for (threads, lanes) in [
                (2, LaneChoice::Scalar),
                (3, LaneChoice::Auto),
                (5, LaneChoice::Scalar),
            ] {
                let mut other = adrift(&scene, threads, lanes);
                run_to(&mut other, 0.04);
                run_to(&mut other, 0.08);
                assert_eq!(
                    other.state_hash(),
                    one.state_hash(),
                    "{dimension:?} {scheme:?}"
                );
            }
            let mut again = adrift(&scene, 2, LaneChoice::Auto);
            again.restore(saved).expect("the same scene");
            run_to(&mut again, 0.08);
            assert_eq!(
                again.state_hash(),
                one.state_hash(),
                "{dimension:?} {scheme:?}"
            );
        }
    }
}

#[test]
fn a_law_that_gives_no_number_is_named_with_its_column() {
    for (habit, expected) in [
        (Habit::SpoilsVariable, "strain 2"),
        (Habit::SpoilsStress, "stress xy"),
    ] {
        let scene = scene(Dimension::Two, StressScheme::Usl, habit);
        let mut simulation = adrift(&scene, 1, LaneChoice::Auto);
        let error = first_error(&mut simulation, 1000);
        let StepErrorKind::Law { law, column, .. } = &error.kind else {
            panic!("{error}");
        };
        assert_eq!((*law, column.as_str()), ("habitual", expected));
        assert!(error.time < 0.012 && error.step > 1, "{error}");
        assert!(error.to_string().contains("the law habitual gave particle"));
    }
}

#[test]
fn a_law_that_asks_for_a_column_twice_is_refused_by_name() {
    let mut scene = block(Dimension::Two);
    scene.materials = vec![material(Forgetful)];
    assert_eq!(scene.materials[0].density, DENSITY);
    let error = scene.check().expect_err("a column twice");
    assert_eq!(error.problems[0].path, "materials[0].law");
    let words = error.to_string();
    assert!(
        words.contains("forgetful") && words.contains("void ratio 2"),
        "{words}"
    );
}
