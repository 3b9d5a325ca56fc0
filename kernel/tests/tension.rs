//! Bodies in tension: they hold, or the run stops before they are torn and names the methods that hold.

use crate::common::{
    APIC, DENSITY, DIMENSIONS, FLIP, NEVER, TPIC, body, cuboid, empty, material, run, simulation,
    simulation_from,
};
use proctor_laws::NeoHookean;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::{InitialState, Simulation, StepErrorKind, plan};
use proctor_scene::{
    BoxLoad, Damping, Dimension, DomainUpdate, History, PlaneCondition, Scene, StressScheme,
    Traction, Weighting,
};
use std::sync::Arc;

const YOUNG: f64 = 1.0e5;
const POISSON: f64 = 0.3;
/// Nominal stress of the bars \[Pa\].
const PULL: f64 = 2.0e4;
const H: f64 = 0.1;
/// Share of the energy in motion that no node sees from which a run stops.
const MOST_UNSEEN: f64 = 0.04;
const LENGTH: f64 = 1.0;
const GIMP: [Weighting; 2] = [
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
];
const LOSES: [StressScheme; 2] = [StressScheme::Musl, StressScheme::Usf];

/// A bar of 1 m between smooth sides, held at its lower end along x, so that it is strained along x alone.
fn bar(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [24, 3, 3], H);
    scene.time = 8.0;
    scene.materials = vec![material(NeoHookean::new(YOUNG, POISSON))];
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[0] = [PlaneCondition::Fixed, PlaneCondition::Free];
    scene.bodies = vec![body(1, cuboid([0.0; 3], [LENGTH, 3.0 * H, 3.0 * H]))];
    if dimension == Dimension::Two {
        scene.bodies[0].shape = cuboid([0.0; 3], [LENGTH, 3.0 * H, 0.0]);
    }
    scene
}

fn area(dimension: Dimension) -> f64 {
    match dimension {
        Dimension::Two => 3.0 * H,
        Dimension::Three => 9.0 * H * H,
    }
}

/// The bar, pulled by a force on its last cell and damped.
fn pulled(dimension: Dimension, stress: f64) -> Scene {
    let mut scene = bar(dimension);
    scene.damping = Damping::Viscous { alpha: 0.05 };
    scene.box_loads = vec![BoxLoad {
        p1: [LENGTH - H, 0.0, 0.0],
        p2: [LENGTH, 3.0 * H, 3.0 * H],
        force: [stress * area(dimension), 0.0, 0.0],
    }];
    scene
}

/// The bar, shared with a driven one that pulls it to 1.6 times its length.
fn driven(dimension: Dimension) -> Scene {
    let mut scene = bar(dimension);
    scene.time = 1.6;
    let mut puller = body(2, scene.bodies[0].shape.clone());
    puller.shape = match scene.bodies[0].shape {
        proctor_scene::Shape::Cuboid { p2, .. } => {
            cuboid([LENGTH, 0.0, 0.0], [LENGTH + 0.3, p2[1], p2[2]])
        }
        _ => unreachable!("a cuboid"),
    };
    puller.motion = Some(History {
        times: vec![0.0, 0.2, 1.6],
        values: vec![[0.0; 3], [0.4, 0.0, 0.0], [0.4, 0.0, 0.0]],
    });
    scene.bodies.push(puller);
    scene
}

/// The bar, which hangs from its lower plane: gravity points along x.
fn hanging(dimension: Dimension) -> Scene {
    let mut scene = bar(dimension);
    scene.gravity[0] = PULL / (DENSITY * LENGTH);
    scene
}

/// A traction on the end of the bar while that is there, with a body whose end lies in the cell.
fn drawn(dimension: Dimension) -> Scene {
    let mut scene = bar(dimension);
    let mut upper = [LENGTH, 3.0 * H, 3.0 * H];
    if dimension == Dimension::Two {
        upper[2] = 0.0;
    }
    scene.tractions = vec![Traction {
        p1: [LENGTH, 0.0, 0.0],
        p2: upper,
        traction: [PULL, 0.0, 0.0].into(),
    }];
    scene
}

/// Steps to the time of the scene; why it stopped.
fn to_the_end(scene: &Scene) -> (Simulation, Option<StepErrorKind>) {
    let mut simulation = simulation(scene);
    while simulation.time() < scene.time {
        if let Err(error) = simulation.step(scene.time) {
            return (simulation, Some(error.kind));
        }
    }
    (simulation, None)
}

/// The stretch under a nominal stress: (mu (s² - 1) + lambda ln s)/s, by bisection.
fn stretch(nominal: f64) -> f64 {
    let mu = YOUNG / (2.0 * (1.0 + POISSON));
    let lambda = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let stress = |s: f64| (mu * (s * s - 1.0) + lambda * s.ln()) / s;
    let (mut low, mut high) = (0.3, 3.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if stress(middle) < nominal {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The run stops for tension, in words that name what holds, before energy from nowhere is a tenth of what was given.
fn stops(scene: &Scene, what: &str) {
    let mut simulation = simulation(scene);
    let mut given = 0.0_f64;
    let error = loop {
        assert!(simulation.time() < scene.time, "{what}: goes to its end");
        if let Err(error) = simulation.step(scene.time) {
            break error;
        }
        given = given.max(simulation.energy().external_work);
    };
    let StepErrorKind::Tension(tension) = &error.kind else {
        panic!("{what}: {error}");
    };
    assert!(
        tension.stress > 0.0 && tension.growth > 0.0,
        "{what}: {tension:?}"
    );
    assert!(tension.unseen > MOST_UNSEEN, "{what}: {tension:?}");
    let words = error.to_string();
    for word in ["tension", "\"USL\"", "\"APIC\"", "per step"] {
        assert!(words.contains(word), "{words}");
    }
    assert!(!words.contains("TPIC"), "{words}");
    let energy = simulation.energy();
    // A traction acts where it was, past which the bar has gone: its work is not that of the bar.
    assert!(
        !scene.tractions.is_empty() || energy.remainder > -0.1 * given,
        "{what}: {energy:?} of {given}"
    );
    let farthest = simulation.center(0).position[0] / (0.5 * LENGTH);
    assert!(farthest < 1.6, "{what}: the body is torn, {farthest}");
}

fn methods() -> impl Iterator<Item = (Dimension, Weighting, StressScheme)> {
    let weightings = GIMP.into_iter().chain([Weighting::QuadraticBSpline]);
    weightings.flat_map(|weighting| {
        DIMENSIONS
            .into_iter()
            .flat_map(move |dimension| LOSES.map(move |scheme| (dimension, weighting, scheme)))
    })
}

#[test]
fn a_pulled_bar_stops_before_it_is_torn() {
    for (dimension, weighting, scheme) in methods() {
        for make in [|d| pulled(d, PULL), hanging, driven, drawn] {
            let mut scene = make(dimension);
            (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, FLIP);
            let what = format!(
                "{dimension:?} {weighting:?} {scheme:?} {} loads {} tractions {} bodies",
                scene.box_loads.len(),
                scene.tractions.len(),
                scene.bodies.len()
            );
            stops(&scene, &what);
        }
    }
}

/// Its particles are where those of a bar of that stretch are.
#[test]
fn a_pulled_bar_holds_with_usl_and_with_affine_velocities() {
    let exact = stretch(PULL);
    assert!((exact - 1.171).abs() < 5.0e-4, "{exact}");
    for dimension in DIMENSIONS {
        for weighting in GIMP {
            for (scheme, transfer) in [
                (StressScheme::Usl, FLIP),
                (StressScheme::Usl, APIC),
                (StressScheme::Musl, APIC),
                (StressScheme::Usf, TPIC),
            ] {
                let mut scene = pulled(dimension, PULL);
                (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                let (simulation, error) = to_the_end(&scene);
                assert_eq!(
                    error, None,
                    "{dimension:?} {weighting:?} {scheme:?} {transfer:?}"
                );
                // The last cell carries the load, from all of it to none: linear in a first approximation.
                let way = (exact - 1.0) * (0.5 * LENGTH - 0.5 * H * H / LENGTH / 3.0);
                let found = simulation.center(0).position[0] - 0.5 * LENGTH;
                assert!(
                    (found - way).abs() < 0.02 * exact * 0.5 * LENGTH,
                    "{dimension:?} {weighting:?} {scheme:?} {transfer:?}: {found} {way}"
                );
            }
        }
    }
}

#[test]
fn a_slow_pull_holds_with_usl() {
    for dimension in DIMENSIONS {
        for weighting in GIMP {
            let mut scene = driven(dimension);
            scene.weighting = weighting;
            let (mut simulation, error) = to_the_end(&scene);
            assert_eq!(error, None, "{dimension:?} {weighting:?}");
            let energy = simulation.energy();
            let created = -energy.remainder / energy.external_work;
            assert!(created < 0.01, "{dimension:?} {weighting:?}: {energy:?}");
        }
    }
}

/// Neither compression nor a swing through both stops a run.
#[test]
fn what_is_pressed_or_swings_goes_on() {
    for (dimension, weighting, scheme) in methods() {
        let mut scene = pulled(dimension, -PULL);
        (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, FLIP);
        let (_, error) = to_the_end(&scene);
        assert_eq!(error, None, "{dimension:?} {weighting:?} {scheme:?}");

        let mut scene = bar(dimension);
        (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, FLIP);
        let mut swinging = simulation_from(
            &scene,
            Arc::new(|x| InitialState {
                velocity: [0.5 * (0.5 * std::f64::consts::PI * x[0]).sin(), 0.0, 0.0],
                ..InitialState::default()
            }),
        );
        run(&mut swinging, 1000);
        assert!(swinging.time() < NEVER, "a time");
    }
}

/// The plan tells it before.
#[test]
fn the_plan_warns_of_tension() {
    let told = |scene: &Scene| {
        let warnings = plan(scene, PlanOptions::default()).warnings;
        warnings.iter().any(|w| w.contains("in tension"))
    };
    for dimension in DIMENSIONS {
        for make in [|d| pulled(d, PULL), hanging, driven, drawn] {
            for scheme in LOSES {
                let mut scene = make(dimension);
                scene.scheme = scheme;
                assert!(told(&scene), "{dimension:?} {scheme:?}");
                scene.transfer = APIC;
                assert!(!told(&scene), "{dimension:?} {scheme:?} APIC");
            }
            assert!(!told(&make(dimension)), "{dimension:?} USL");
        }
        let mut pressed = pulled(dimension, -PULL);
        pressed.scheme = StressScheme::Musl;
        assert!(!told(&pressed));
        // It stands on its plane.
        let mut standing = hanging(dimension);
        standing.scheme = StressScheme::Musl;
        standing.gravity[0] = -standing.gravity[0];
        assert!(!told(&standing));
    }
}

/// TPIC lets a way that no strain sees grow as well, though slowly: the plan of a long run warns, and never names it as what holds.
#[test]
fn the_plan_does_not_trust_tpic_in_tension() {
    let told = |scene: &Scene| {
        let warnings = plan(scene, PlanOptions::default()).warnings;
        warnings.into_iter().find(|w| w.contains("in tension"))
    };
    for scheme in [StressScheme::Musl, StressScheme::Usf] {
        let mut scene = pulled(Dimension::Two, 2.0 * PULL);
        (scene.scheme, scene.time) = (scheme, 20.0);
        let of_flip = told(&scene).expect("FLIP does not hold");
        assert!(!of_flip.contains("TPIC"), "{of_flip}");
        scene.transfer = TPIC;
        let warning = told(&scene).unwrap_or_else(|| panic!("{scheme:?}"));
        assert!(
            warning.contains("TPIC with") && warning.contains("\"USL\" and \"APIC\" hold"),
            "{warning}"
        );
        // So little tension TPIC takes back.
        let mut light = pulled(Dimension::Two, 0.4 * PULL);
        (light.scheme, light.transfer, light.time) = (scheme, TPIC, 20.0);
        assert_eq!(told(&light), None);
        (scene.scheme, scene.transfer) = (StressScheme::Usl, TPIC);
        assert_eq!(told(&scene), None);
        (scene.scheme, scene.transfer) = (scheme, APIC);
        assert_eq!(told(&scene), None);
    }
}
