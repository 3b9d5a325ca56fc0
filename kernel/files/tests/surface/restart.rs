//! A run that is interrupted and goes on has the bits of one that is not.

use crate::surface::slope::Slope;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;
use proctor_scene::{Results, Scene, StressScheme};
use std::path::Path;

fn run(scene: &Scene, folder: &Path, restart: Option<&Path>) -> (u64, [f64; 3]) {
    let options = Options {
        threads: Some(2),
        least_share: Some(1),
        ..Options::default()
    };
    let mut run = Run::start(scene, &options, Some(folder), restart).expect("a start");
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On).expect("steps");
        run.write().expect("files");
    }
    let simulation = run.simulation();
    (simulation.state_hash(), simulation.surface_impulse(0, 0))
}

#[test]
fn a_restart_keeps_the_bits_and_the_history_has_the_forces() {
    let slope = Slope {
        end: 0.02,
        ..Slope::new(StressScheme::Musl, 0.3)
    };
    let mut whole = slope.scene();
    whole.results = Results {
        print: 4,
        ..Results::default()
    };
    let mut half = whole.clone();
    half.time *= 0.5;
    half.results.print = 2;
    let (a, b) = (
        tempfile::tempdir().expect("a folder"),
        tempfile::tempdir().expect("a folder"),
    );
    let unbroken = run(&whole, a.path(), None);
    run(&half, b.path(), None);
    let resumed = run(&whole, b.path(), Some(&b.path().join("checkpoint.bin")));
    assert_eq!(resumed, unbroken);

    let history = std::fs::read_to_string(a.path().join("history.csv")).expect("a history");
    assert_eq!(
        history,
        std::fs::read_to_string(b.path().join("history.csv")).expect("a history")
    );
    let mut rows = csv::Reader::from_reader(history.as_bytes());
    let names = rows.headers().expect("names").clone();
    let column = |name: &str| names.iter().position(|n| n == name).expect("a column");
    let last = rows.records().last().expect("rows").expect("a row");
    for axis in ["x", "y", "z"] {
        let value = |name: String| last[column(&name)].parse::<f64>().expect("a number");
        let body = value(format!("body1_contact_f{axis}"));
        assert_eq!(value(format!("surface0_contact_f{axis}")), -body);
        assert!(axis == "y" || body != 0.0);
    }
}
