//! The forecast of a run, held against the run.

use std::fs;
use std::path::Path;

use proctor_files::json::read;
use proctor_files::run::{OutputForecast, Run, RunControl, StepForecast};
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Field, NodalField, Scene, TimeStep};

fn scene(name: &str, dt: f64) -> Scene {
    let path = Path::new("../../fixtures/scenes").join(name);
    let mut scene = read(&path).unwrap_or_else(|error| panic!("{error}"));
    scene.time_step = TimeStep::Fixed {
        dt,
        allow_unstable: true,
    };
    scene
}

/// Bytes of the files in a folder whose names begin so.
fn bytes(folder: &Path, stem: &str) -> u64 {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    let ours = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(stem));
    ours.map(|entry| entry.metadata().unwrap().len()).sum()
}

#[test]
fn steps_and_bytes_of_a_constant_step_are_those_of_the_run() {
    let mut column = scene("column_gravity_2d.json", 7e-4);
    column.time = 0.1;
    column.results.print = 7;
    column.results.fields = Field::ALL.to_vec();
    column
        .results
        .fields
        .retain(|field| *field != Field::DeformationGradient);
    column.results.history_interval = Some(1.7e-3);
    let mut plain = column.clone();
    plain.results.history_interval = None;
    plain.results.nodal_fields = NodalField::ALL.to_vec();
    // As many steps as outputs, and fewer.
    let mut few = plain.clone();
    few.time = 3.1 * 7e-4;
    for scene in [column, plain, few] {
        let mut simulation = Simulation::new(&scene, &Options::default()).unwrap();
        let steps = StepForecast::new(&scene, f64::NAN);
        let foretold = OutputForecast::new(&mut simulation, &steps);

        let folder = tempfile::tempdir().unwrap();
        let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
        let mut outputs = vec![(0.0, 0)];
        while let Some(stop) = run.next_stop() {
            run.advance(stop, |_| RunControl::On).unwrap();
            run.write().unwrap();
            outputs.push((run.simulation().time(), run.simulation().steps()));
        }
        assert!(steps.is_exact);
        assert_eq!(steps.steps, run.simulation().steps());
        assert_eq!(steps.outputs, outputs);
        assert_eq!(foretold.frames, outputs.len() as u64);
        assert_eq!(foretold.frame_bytes, bytes(folder.path(), "particles"));
        assert_eq!(
            foretold.checkpoint_bytes,
            bytes(folder.path(), "checkpoint")
        );
        // A frame, its list and a checkpoint at each output; nodes have none before the first step.
        assert_eq!(foretold.files(), 3 * foretold.frames);
        let again = foretold.checkpoint_bytes * (foretold.frames - 1);
        assert_eq!(foretold.bytes_written(), foretold.bytes() + again);
        let history = fs::read_to_string(folder.path().join("history.csv")).unwrap();
        assert_eq!(foretold.history_rows, history.lines().count() as u64 - 1);
    }
}

#[test]
fn histories_and_nodes_are_foretold_from_a_state_on_the_way() {
    let mut scene = scene("column_gravity_2d.json", 7e-4);
    scene.time = 0.1;
    scene.results.print = 10;
    scene.results.nodal_fields = NodalField::ALL.to_vec();
    let steps = StepForecast::new(&scene, f64::NAN);
    let folder = tempfile::tempdir().unwrap();
    let mut run = Run::start(&scene, &Options::default(), Some(folder.path()), None).unwrap();
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On).unwrap();
        run.write().unwrap();
    }
    let mut simulation = Simulation::new(&scene, &Options::default()).unwrap();
    for _ in 0..10 {
        simulation.step(scene.time).unwrap();
    }
    let foretold = OutputForecast::new(&mut simulation, &steps);
    // Two frames, two lists and a checkpoint at each output.
    assert_eq!(foretold.files(), 5 * foretold.frames);
    for (stem, said) in [
        ("history", foretold.history_bytes),
        ("grid", foretold.other_frame_bytes),
    ] {
        let found = bytes(folder.path(), stem) as f64;
        assert!(
            (said as f64 - found).abs() < 0.1 * found,
            "{stem}: {said}, not {found}"
        );
    }
}

#[test]
fn other_steps_are_counted_between_outputs() {
    let mut scene = scene("column_gravity_2d.json", 1.0);
    scene.time_step = TimeStep::Automatic;
    scene.time = 1.0;
    scene.results.print = 4;
    let steps = StepForecast::new(&scene, 0.1);
    assert!(!steps.is_exact);
    assert_eq!(
        steps.outputs,
        [(0.0, 0), (0.25, 3), (0.5, 6), (0.75, 9), (1.0, 12)]
    );
}
