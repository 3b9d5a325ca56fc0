//! A history with an interval of its own, and probes of lines and bodies.

use std::fs;
use std::path::Path;

use super::names;
use proctor_files::json::read;
use proctor_files::run::{Run, RunControl};
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::Options;
use proctor_scene::{Field, Probe, ProbeTarget, ProbedQuantity, Scene, TimeStep};

/// A column that bends to nobody's outputs: 0.05 s with two frames.
fn column(time_step: TimeStep) -> Scene {
    let path = Path::new("../../fixtures/scenes/column_gravity_2d.json");
    let mut scene = read(path).unwrap_or_else(|error| panic!("{error}"));
    scene.time = 0.05;
    scene.time_step = time_step;
    scene.results.print = 2;
    scene
}

const FIXED: TimeStep = TimeStep::Fixed {
    dt: 7e-4,
    allow_unstable: true,
};

/// Runs to the end, or over so many outputs.
fn go(run: &mut Run, outputs: usize) {
    for _ in 0..outputs {
        let Some(stop) = run.next_stop() else { return };
        run.advance(stop, |_| RunControl::On).expect("steps");
        run.write().expect("files");
    }
}

/// The columns of the history in a folder, each with its name.
fn columns(folder: &Path) -> Vec<(String, Vec<f64>)> {
    let text = fs::read_to_string(folder.join("history.csv")).expect("a history");
    let mut lines = text.lines();
    let names = lines.next().expect("a header").split(',');
    let mut columns: Vec<(String, Vec<f64>)> =
        names.map(|name| (name.to_owned(), vec![])).collect();
    for line in lines {
        for (cell, (_, column)) in line.split(',').zip(&mut columns) {
            column.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    columns
}

fn column_of(columns: &[(String, Vec<f64>)], name: &str) -> Vec<f64> {
    let found = columns.iter().find(|(known, _)| known == name);
    found
        .unwrap_or_else(|| panic!("no column {name}"))
        .1
        .clone()
}

#[test]
fn no_bit_of_the_state_depends_on_the_interval() {
    for step in [FIXED, TimeStep::Automatic] {
        let plain = column(step);
        let mut dense = plain.clone();
        dense.results.history_interval = Some(1e-3);
        let states = [plain, dense].map(|scene| {
            let folder = tempfile::tempdir().unwrap();
            let mut run =
                Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
            go(&mut run, usize::MAX);
            let summary = run.summary();
            (run.simulation().save(), summary.warnings, summary.events)
        });
        assert!(states[0] == states[1], "{step:?}");
    }
}

#[test]
fn a_row_is_of_the_step_nearest_to_its_nominal_time() {
    for step in [FIXED, TimeStep::Automatic] {
        let mut scene = column(step);
        scene.results.history_interval = Some(2e-3);
        let folder = tempfile::tempdir().unwrap();
        let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
        go(&mut run, usize::MAX);
        let longest = run.simulation().clock().dt_max;
        let columns = columns(folder.path());
        assert_eq!(columns.last().expect("columns").0, "nominal_time");
        let (times, nominal) = (
            column_of(&columns, "time"),
            column_of(&columns, "nominal_time"),
        );
        let expected: Vec<f64> = (0..=25).map(|i| f64::from(i) * 2e-3).collect();
        assert_eq!(nominal, expected);
        for (time, nominal) in times.iter().zip(&nominal) {
            assert!(
                (time - nominal).abs() <= 0.5 * longest * (1.0 + 1e-9),
                "{step:?}: {time} for {nominal}"
            );
        }
    }
}

#[test]
fn an_interval_below_the_step_has_a_row_for_each_step() {
    let mut scene = column(FIXED);
    scene.results.history_interval = Some(1e-4);
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    go(&mut run, usize::MAX);
    let steps = column_of(&columns(folder.path()), "step");
    let all: Vec<f64> = (0..=run.simulation().steps())
        .map(|step| step as f64)
        .collect();
    assert_eq!(steps, all);
}

#[test]
fn a_history_needs_no_frames() {
    let mut scene = column(TimeStep::Automatic);
    scene.results.print = 0;
    scene.results.history_interval = Some(5e-3);
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    go(&mut run, usize::MAX);
    assert_eq!(names(folder.path()), ["history.csv"]);
    assert_eq!(column_of(&columns(folder.path()), "time").len(), 11);
}

#[test]
fn a_run_in_two_parts_has_the_history_of_one() {
    for step in [FIXED, TimeStep::Automatic] {
        let mut scene = column(step);
        scene.results.print = 5;
        scene.results.history_interval = Some(1.3e-3);
        let [whole, parts] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let options = Options::default();
        go(
            &mut Run::start(&scene, &options, Some(whole.path()), None).unwrap(),
            usize::MAX,
        );
        go(
            &mut Run::start(&scene, &options, Some(parts.path()), None).unwrap(),
            3,
        );
        let checkpoint = parts.path().join("checkpoint.bin");
        let mut second =
            Run::start(&scene, &options, Some(parts.path()), Some(&checkpoint)).unwrap();
        go(&mut second, usize::MAX);
        let text = |folder: &Path| fs::read_to_string(folder.join("history.csv")).unwrap();
        assert_eq!(text(whole.path()), text(parts.path()), "{step:?}");
        drop(second);

        // In a folder of its own the second part has the rows from the restart on.
        let apart = tempfile::tempdir().unwrap();
        go(
            &mut Run::start(&scene, &options, Some(parts.path()), None).unwrap(),
            3,
        );
        let mut second =
            Run::start(&scene, &options, Some(apart.path()), Some(&checkpoint)).unwrap();
        go(&mut second, usize::MAX);
        let [all, later] = [text(whole.path()), text(apart.path())];
        let rows: Vec<&str> = later.lines().skip(1).collect();
        assert!(rows.len() > 10, "{later}");
        let end: Vec<&str> = all.lines().rev().take(rows.len()).collect();
        assert!(rows.iter().rev().eq(end.iter()), "{step:?}\n{all}\n{later}");
    }
}

#[test]
fn probes_follow_lines_and_bodies() {
    let mut scene = column(TimeStep::Automatic);
    let id = scene.bodies[0].id;
    let largest = |name: &str, quantity| Probe {
        name: name.into(),
        target: ProbeTarget::Largest { body: id, quantity },
    };
    scene.probes = vec![
        Probe {
            name: "axis".into(),
            target: ProbeTarget::Line {
                from: [0.5, 0.0, 0.0],
                to: [0.5, 2.0, 0.0],
                count: 3,
            },
        },
        Probe::at("middle", [0.5, 1.0, 0.0]),
        Probe {
            name: "all".into(),
            target: ProbeTarget::Body(id),
        },
        largest("far", ProbedQuantity::Displacement),
        largest("fast", ProbedQuantity::Velocity),
        largest("stressed", ProbedQuantity::MisesStress),
        largest("pressed", ProbedQuantity::Pressure),
    ];
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    go(&mut run, usize::MAX);
    let columns = columns(folder.path());
    let last = |name: &str| *column_of(&columns, name).last().expect("a row");
    for component in ["ux", "uy", "vx", "vy", "sxx", "sxy"] {
        let [line, point] = ["axis_2", "middle"].map(|probe| last(&format!("{probe}_{component}")));
        assert_eq!(line, point, "{component}");
    }
    let simulation = run.simulation();
    let set = &simulation.sets()[0];
    let all = || 0..set.len();
    // The masses are equal.
    let mean = |value: &dyn Fn(usize) -> f64| all().map(value).sum::<f64>() / set.len() as f64;
    let displacement = |p: usize| {
        simulation
            .displacement(0, p)
            .expect("displacements are kept")
    };
    let near = |found: f64, expected: f64| {
        assert!(
            (found - expected).abs() <= 1e-12 * expected.abs(),
            "{found}, not {expected}"
        );
    };
    near(last("all_uy"), mean(&|p| displacement(p)[1]));
    near(last("all_vy"), last(&format!("body{id}_vy")));
    let volume: f64 = set.columns[Layout::VOLUME].iter().sum();
    let weighted = all().map(|p| set.columns[Layout::VOLUME][p] * set.stress(p)[1]);
    near(last("all_syy"), weighted.sum::<f64>() / volume);

    let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let most = |value: &dyn Fn(usize) -> f64| all().map(value).fold(f64::NEG_INFINITY, f64::max);
    near(last("far_displacement"), most(&|p| length(displacement(p))));
    near(last("fast_velocity"), most(&|p| length(set.velocity(p))));
    let pressure = |p: usize| -set.stress(p)[..3].iter().sum::<f64>() / 3.0;
    near(last("pressed_pressure"), most(&pressure));
    let deviator = |p: usize| {
        let s = set.stress(p);
        let mean = -pressure(p);
        let normal: f64 = s[..3].iter().map(|c| (c - mean).powi(2)).sum();
        let shear: f64 = s[3..].iter().map(|c| c * c).sum();
        (1.5 * (normal + 2.0 * shear)).sqrt()
    };
    near(last("stressed_mises_stress"), most(&deviator));
    let particle = all()
        .find(|p| set.id[*p] as f64 == last("far_particle"))
        .expect("the particle is one of the body");
    assert_eq!(length(displacement(particle)), last("far_displacement"));
    assert_eq!(simulation.position(0, particle)[1], last("far_y"));
}

/// Probes and frames of soil with water have the pore pressure, the effective stress and the total one.
#[test]
fn probes_and_frames_have_both_stresses_of_wet_soil() {
    let path = Path::new("../../fixtures/scenes/peers/two_phase.json");
    let mut scene = read(path).unwrap_or_else(|error| panic!("{error}"));
    (scene.time, scene.threads, scene.results.print) = (0.01, None, 1);
    scene.results.fields = vec![Field::Stress, Field::Pressure];
    let id = scene.bodies[0].id;
    scene.probes = vec![
        Probe::at("base", [0.5, 0.5, 0.0]),
        Probe {
            name: "all".into(),
            target: ProbeTarget::Body(id),
        },
    ];
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    go(&mut run, usize::MAX);
    let columns = columns(folder.path());
    let last = |name: &str| *column_of(&columns, name).last().expect("a row");
    let set = &run.simulation().sets()[0];
    let pressures = &set.columns[set.layout.pore_pressure().expect("there is water")];
    let followed = |p: &usize| set.stress(*p)[2] == last("base_szz");
    let p = (0..set.len()).find(followed).expect("a particle");
    assert!(pressures[p] > 1e3, "{}", pressures[p]);
    assert_eq!(last("base_pore_pressure"), pressures[p]);
    for (name, stress) in ["xx", "yy", "zz"].into_iter().zip(set.stress(p)) {
        assert_eq!(last(&format!("base_total_s{name}")), stress - pressures[p]);
    }
    assert_eq!(last("base_total_syz"), set.stress(p)[3]);
    let volumes = &set.columns[Layout::VOLUME];
    let sum: f64 = (0..set.len()).map(|p| volumes[p] * pressures[p]).sum();
    let mean = sum / volumes.iter().sum::<f64>();
    assert!((last("all_pore_pressure") / mean - 1.0).abs() < 1e-12);
    let apart = last("all_szz") - last("all_total_szz") - mean;
    assert!(apart.abs() < 1e-9 * mean, "{apart}");
    let frame = fs::read(folder.path().join("particles_000001.vtu")).expect("a frame");
    let text = String::from_utf8_lossy(&frame);
    for name in ["Stress_ZZ", "Total_Stress_ZZ", "Pore Pressure"] {
        assert!(text.contains(&format!("Name=\"{name}\"")), "{name}");
    }
}
