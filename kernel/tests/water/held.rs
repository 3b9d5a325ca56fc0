//! Pore pressures that particles keep: their bits, the work of what holds them, what is refused, later stages.

use super::support::{column, means, strip};
use crate::common::{options, simulation};
use proctor_scene::simulation::Simulation;
use proctor_scene::{HeldPressure, InitialPressure, Scene, StressScheme};

/// A strip whose upper two cells keep a pressure, and whose water has none at the start.
fn held(pressure: f64, cells: usize) -> Scene {
    let mut scene = strip(&column(1e-3), 1e-3, cells, StressScheme::Usl);
    scene.tractions.clear();
    let h = 1.0 / cells as f64;
    scene.held_pressures = vec![HeldPressure {
        p1: [0.0, 1.0 - 2.0 * h, 0.0],
        p2: [1.0, 1.0, 0.0],
        pressure,
    }];
    scene
}

/// Pore pressure and height of each particle.
fn pressures(simulation: &Simulation) -> Vec<(f64, f64)> {
    let set = &simulation.sets()[0];
    let column = set.layout.pore_pressure().expect("there is water");
    (0..set.len())
        .map(|p| (set.columns[column][p], set.position(p)[1]))
        .collect()
}

/// Water flows in until all of the column has the pressure of the box, whose particles have it to the last bit all the time.
#[test]
fn a_held_pressure_spreads() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene = held(1.0, 10);
        scene.scheme = scheme;
        let mut simulation = simulation(&scene);
        for time in [2e-3, 0.02, 0.2, 2.0] {
            simulation.run_until(time).expect("the step is stable");
            let kept = pressures(&simulation);
            let kept: Vec<_> = kept.iter().filter(|(_, z)| *z > 0.8).collect();
            assert_eq!(kept.len(), 8);
            assert!(kept.iter().all(|(p, _)| *p == 1.0), "{kept:?}");
        }
        let base = means(&simulation, 0.1, 10)[0][0];
        assert!((base - 1.0).abs() < 0.01, "{base}");
        assert!(simulation.energy().external_work > 0.0);
    }
}

/// The box pumps water, which flows out at the free top and is dragged on its way: the books close, while the column is loaded
/// slowly.
#[test]
fn the_work_of_a_held_pressure_is_booked() {
    let mut scene = held(1.0, 10);
    let of = column(1e-3);
    scene.tractions = strip(&of, 1e-3, 10, StressScheme::Usl).tractions;
    for value in &mut scene.tractions[0].traction.values {
        value[1] -= 1.0;
    }
    scene.initial_pressures = vec![InitialPressure::Box {
        p1: [0.0; 3],
        p2: [1.0, 1.0, 0.0],
        pressure: 1.0,
    }];
    let mut simulation = simulation(&scene);
    simulation.run_until(2.0).expect("the step is stable");
    let energy = simulation.energy();
    assert!(energy.external_work > 20.0 * energy.strain, "{energy:?}");
    let apart = energy.remainder.abs() / energy.external_work;
    assert!(apart < 1e-3, "{apart} of {energy:?}");
}

/// A box of no pressure does no work: it drains what is around it.
#[test]
fn a_box_without_pressure_drains() {
    let mut scene = held(0.0, 10);
    scene.initial_pressures = vec![InitialPressure::Box {
        p1: [0.0; 3],
        p2: [1.0, 1.0, 0.0],
        pressure: 1.0,
    }];
    let mut simulation = simulation(&scene);
    let stored = simulation.energy().water;
    simulation.run_until(2.0).expect("the step is stable");
    let left = pressures(&simulation);
    assert!(left.iter().all(|(p, _)| p.abs() < 0.02), "{left:?}");
    let energy = simulation.energy();
    assert_eq!(energy.external_work, 0.0);
    assert!(energy.drag > 0.5 * stored, "{energy:?}");
}

/// Of two boxes that overlap the later one counts.
#[test]
fn the_later_box_counts() {
    let mut scene = held(1.0, 10);
    let first = scene.held_pressures[0];
    scene.held_pressures.push(HeldPressure {
        p1: [0.0, 0.9, 0.0],
        pressure: 2.0,
        ..first
    });
    let count = |value: f64| {
        let all = pressures(&simulation(&scene));
        all.iter().filter(|(p, _)| *p == value).count()
    };
    assert_eq!([count(0.0), count(1.0), count(2.0)], [32, 4, 4]);
}

#[test]
fn empty_boxes_and_dry_scenes_are_refused() {
    let mut scene = held(1.0, 10);
    scene.held_pressures[0].p1[1] = 1.05;
    scene.held_pressures[0].p2[1] = 1.2;
    let error = Simulation::new(&scene, &options())
        .err()
        .expect("no particle is there");
    assert!(
        error.to_string().contains("no particle lies in the box"),
        "{error}"
    );

    let mut scene = held(f64::NAN, 10);
    scene.held_pressures[0].p2[0] = -1.0;
    let paths: Vec<String> = (scene.check().expect_err("it is faulty").problems.iter())
        .map(|problem| problem.path.clone())
        .filter(|path| path.starts_with("held"))
        .collect();
    assert_eq!(
        paths,
        [
            "held_pressures[0].point_p2[0]",
            "held_pressures[0].pressure"
        ]
    );

    let mut scene = held(1.0, 10);
    scene.pore_water.clear();
    let problems = scene.check().expect_err("it is dry").problems;
    assert!(
        problems
            .iter()
            .any(|problem| problem.path == "prescribed_pressure_box")
    );
}
