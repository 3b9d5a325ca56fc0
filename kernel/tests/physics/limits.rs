//! Steps that damping and acceleration bound, bodies that are crushed, and steps that cannot be.

use crate::common::{
    SCHEMES, block, body, cuboid, elastic, empty, material, rough, simulation, simulation_from,
};
use proctor_scene::simulation::{
    Bound, EventKind, InitialState, Options, SetupError, Simulation, StepErrorKind,
};
use proctor_scene::{
    Damping, Dimension, Outside, PlaneCondition, Scene, StressScheme, TimeStep, Weighting,
};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// V/V_0 of a particle that raise no event, as the book promises.
const VOLUME_RATIOS: RangeInclusive<f64> = 0.1..=10.0;

/// A free block of 0.5 m under strong viscous damping: rate 8 c/h = 2530 1/s, more than two in a step of wave speed alone.
fn damped() -> Scene {
    let mut scene = empty(Dimension::Two, [20, 20, 1], 0.1);
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene.bodies = vec![body(1, cuboid([0.7, 0.7, 0.0], [1.2, 1.2, 0.0]))];
    scene.bodies[0].velocity = [0.01, 0.0, 0.0];
    scene.damping = Damping::Viscous { alpha: 8.0 };
    scene
}

const RATE: f64 = 8.0 / 0.1 * 31.622_776_601_683_793;

#[test]
fn viscous_damping_bounds_the_step() {
    for scheme in SCHEMES {
        let mut scene = damped();
        scene.scheme = scheme;
        let mut simulation = simulation(&scene);
        let start = simulation.kinetic_energy();
        for _ in 0..400 {
            let info = simulation.step(1.0e3).expect("the step is sound");
            assert_eq!(info.bound, Bound::Damping);
            assert!(info.dt * RATE < 2.0 && info.dt <= info.dt_critical);
        }
        let energy = simulation.energy();
        assert!(energy.kinetic < 1e-6 * start, "{scheme:?} {energy:?}");
        assert!(
            (energy.damping / start - 1.0).abs() < 1e-6,
            "{scheme:?} {energy:?}"
        );
        assert_eq!(simulation.invariants().violation, None, "{scheme:?}");
    }
}

/// Damping beyond all use, with steps that wave speed and travel alone would allow, threw the whole body out of the mesh
/// within a few steps, and what leaves may leave here: mass 0 and no word.
#[test]
fn damping_of_any_strength_throws_no_particle_out() {
    for scheme in SCHEMES {
        let mut scene = damped();
        scene.scheme = scheme;
        scene.damping = Damping::Viscous { alpha: 2500.0 };
        scene.outside = Outside::Remove;
        let mut simulation = simulation(&scene);
        let (start, mass) = (simulation.kinetic_energy(), simulation.mass());
        for _ in 0..400 {
            simulation.step(1.0e3).expect("the step is sound");
        }
        assert_eq!(simulation.mass(), mass, "{scheme:?}");
        assert!(simulation.events().is_empty(), "{scheme:?}");
        let left = simulation.energy().kinetic;
        assert!(left < 1e-6 * start, "{scheme:?} {left}");
    }
}

#[test]
fn a_step_too_long_for_the_damping_is_refused_with_its_rate() {
    let mut scene = damped();
    scene.time_step = TimeStep::Fixed {
        dt: 8.0e-4,
        allow_unstable: false,
    };
    let refused = Simulation::new(&scene, &Options::default()).err();
    let Some(SetupError::UnstableTimeStep(unstable)) = refused else {
        panic!("{refused:?}");
    };
    assert!((unstable.viscous_rate / RATE - 1.0).abs() < 1e-12);
    let message = unstable.to_string();
    assert!(
        message.contains("viscous damping at a rate of 2529"),
        "{message}"
    );
    assert!(message.contains("or less damping"), "{message}");
    scene.damping = Damping::None;
    assert!(Simulation::new(&scene, &Options::default()).is_ok());
}

/// A block whose own limit is that of the table of stable steps, with quadratic B-splines and FLIP: corners \[cells\].
const AT_THE_LIMIT: [[f64; 3]; 2] = [[3.5, 5.69, 3.79], [5.26, 11.0, 5.09]];

/// Energy of a block with rough velocities after a thousand steps that are so many critical ones, over that of the start;
/// automatic steps where none is given.
fn left(scheme: StressScheme, alpha: f64, share: Option<f64>) -> f64 {
    let [p1, p2] = AT_THE_LIMIT.map(|corner| corner.map(|x| 0.1 * x));
    let mut scene = empty(Dimension::Three, [9, 15, 9], 0.1);
    (scene.scheme, scene.weighting) = (scheme, Weighting::QuadraticBSpline);
    scene.materials = vec![material(elastic(1.0e6, 0.4))];
    scene.bodies = vec![body(1, cuboid(p1, p2))];
    scene.damping = Damping::Local { alpha };
    let start = rough(Dimension::Three, 1e-9, 0.0, 7);
    if let Some(share) = share {
        let mut first = simulation_from(&scene, start.clone());
        let critical = first.step(1.0e3).expect("the step is sound").dt_critical;
        scene.time_step = TimeStep::Fixed {
            dt: share * critical,
            allow_unstable: true,
        };
    }
    let mut simulation = simulation_from(&scene, start);
    let energy = |s: &mut Simulation| {
        let energy = s.energy();
        energy.kinetic + energy.strain
    };
    let before = energy(&mut simulation);
    for _ in 0..1000 {
        simulation.step(1.0e3).expect("the step is sound");
        // Far beyond doubt: strains stay small, and no error ends the run.
        if energy(&mut simulation) > 1e3 * before {
            break;
        }
    }
    energy(&mut simulation) / before
}

/// Local damping is against the velocity of half a step before. Where velocity and force change their signs from step to step it
/// adds to the force, so that the step that holds falls as 1/sqrt(1 + alpha): with 0.8 these blocks grew by 1e6 at the automatic
/// step.
#[test]
fn local_damping_bounds_the_step() {
    for scheme in [StressScheme::Usf, StressScheme::Musl] {
        for alpha in [0.6, 0.8, 1.0] {
            let at_automatic = left(scheme, alpha, None);
            assert!(at_automatic < 1.0, "{scheme:?} {alpha}: {at_automatic}");
        }
        // The critical step is where it is, with much damping as with little.
        for alpha in [0.05, 0.8] {
            let below = left(scheme, alpha, Some(0.99));
            assert!(below < 1.0, "{scheme:?} {alpha}: {below}");
            let beyond = left(scheme, alpha, Some(1.04));
            assert!(beyond > 1e3, "{scheme:?} {alpha}: {beyond}");
        }
    }
}

#[test]
fn a_step_too_long_for_local_damping_is_refused_with_its_factor() {
    let mut scene = damped();
    scene.bodies[0].velocity = [0.0; 3];
    scene.damping = Damping::Local { alpha: 0.7 };
    let critical = |scene: &Scene| {
        let mut simulation = simulation(scene);
        let info = simulation.step(1.0e3).expect("the step is sound");
        (info.dt, info.dt_critical)
    };
    let (dt, damped) = critical(&scene);
    let (_, undamped) = critical(&Scene {
        damping: Damping::None,
        ..scene.clone()
    });
    assert!((damped * 1.7_f64.sqrt() / undamped - 1.0).abs() < 1e-12);
    assert!((dt / damped - 0.9).abs() < 1e-4, "{dt} {damped}");
    scene.time_step = TimeStep::Fixed {
        dt: 0.8 * undamped,
        allow_unstable: false,
    };
    let refused = Simulation::new(&scene, &Options::default()).err();
    let Some(SetupError::UnstableTimeStep(unstable)) = refused else {
        panic!("{refused:?}");
    };
    let message = unstable.to_string();
    assert!(
        message.contains("local damping with a factor of 0.7"),
        "{message}"
    );
    assert!(message.contains("or less damping"), "{message}");
}

/// A body at rest that is pulled hard does not cross more than half a cell in its first step.
#[test]
fn acceleration_bounds_the_step() {
    let mut scene = block(Dimension::Two);
    scene.gravity = [0.0, -1.0e6, 0.0];
    let mut simulation = simulation(&scene);
    let before = simulation.center(0).position[1];
    let info = simulation.step(1.0e3).expect("the step is sound");
    assert_eq!(info.bound, Bound::Travel);
    let way = before - simulation.center(0).position[1];
    assert!(way > 0.0 && way <= 0.05, "{way}");
}

/// Runs a scene in which particles leave the range of volume ratios: said once, in the step in which the first one does, with
/// particle, step and time.
fn told_once(scene: &Scene, end: f64) {
    let mut simulation = simulation(scene);
    let ratio = |s: &Simulation, p: usize| {
        let (mass, volume) = (s.particle_mass(0, p), s.particle_volume(0, p));
        volume * 1000.0 / mass
    };
    while simulation.time() < end && simulation.step(end).is_ok() {
        let outside = (0..simulation.particles())
            .map(|p| ratio(&simulation, p))
            .any(|j| !VOLUME_RATIOS.contains(&j));
        let seen: Vec<_> = simulation.events().iter().collect();
        if seen.is_empty() {
            assert!(!outside, "step {}: nobody said so", simulation.steps());
        } else {
            assert_eq!(seen.len(), 1);
            let EventKind::VolumeRatio { particle, ratio } = &seen[0].kind else {
                panic!("{:?}", seen[0]);
            };
            assert!(*ratio < *VOLUME_RATIOS.start() && particle.mass > 0.0);
            assert!(seen[0].time > 0.0 && seen[0].step > 1);
        }
    }
    assert_eq!(simulation.events().len(), 1, "crushed");
}

/// A column too soft for its weight.
#[test]
fn a_crushed_body_is_told_once() {
    let mut scene = empty(Dimension::Two, [10, 15, 1], 0.1);
    scene.materials = vec![material(elastic(1.0e3, 0.3))];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [1.0, 1.0, 0.0]))];
    scene.gravity = [0.0, -9.81, 0.0];
    told_once(&scene, 1.0);
}

/// Three hundred times as fast as its waves: flat on the plane before anything could push it back.
#[test]
fn a_body_thrown_flat_at_a_plane_is_told_once() {
    for scheme in SCHEMES {
        let mut scene = empty(Dimension::Two, [20, 10, 1], 0.1);
        scene.scheme = scheme;
        scene.materials = vec![material(elastic(1.0e6, 0.3))];
        scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
        scene.bodies = vec![body(1, cuboid([0.7, 0.1, 0.0], [1.2, 0.6, 0.0]))];
        scene.bodies[0].velocity = [0.0, -1.0e4, 0.0];
        told_once(&scene, 2.0e-4);
    }
}

/// Without particles a step goes to the time that is asked for, and from there nowhere.
#[test]
fn a_run_that_all_particles_have_left_takes_no_endless_step() {
    let mut scene = block(Dimension::Two);
    scene.outside = Outside::Remove;
    scene.bodies[0].velocity = [4.0, 0.0, 0.0];
    let mut simulation = simulation(&scene);
    let error = loop {
        match simulation.step(1.0e3) {
            Ok(info) => assert!(info.dt.is_finite()),
            Err(error) => break error,
        }
    };
    assert_eq!(simulation.particles(), 0);
    assert_eq!(error.kind, StepErrorKind::NothingLeft);
}

/// An endless speed is no step of no length, but a particle with a value that is not finite.
#[test]
fn an_infinite_velocity_is_called_by_its_name() {
    let endless = |x: &[f64; 3]| InitialState {
        velocity: [if x[0] < 0.3 { f64::INFINITY } else { 0.0 }, 0.0, 0.0],
        ..InitialState::default()
    };
    let mut simulation = simulation_from(&block(Dimension::Two), Arc::new(endless));
    let error = simulation.step(1.0e3).expect_err("there is no such step");
    assert!(matches!(error.kind, StepErrorKind::NotFinite(_)), "{error}");
}

/// After a step that left a particle outside, each further one says so, and the balance can still be asked for.
#[test]
fn a_step_after_an_error_is_that_error() {
    for scheme in SCHEMES {
        let mut scene = block(Dimension::Two);
        scene.scheme = scheme;
        scene.bodies[0].velocity = [1.0e3, -1.0e3, 0.0];
        scene.time_step = TimeStep::Fixed {
            dt: 0.1,
            allow_unstable: true,
        };
        let mut simulation = simulation(&scene);
        let first = (0..5).find_map(|_| simulation.step(1.0e3).err());
        let first = first.expect("it leaves the mesh");
        for _ in 0..3 {
            assert_eq!(simulation.step(1.0e3), Err(first.clone()));
        }
        assert!(simulation.energy().external_work.is_finite());
    }
}
