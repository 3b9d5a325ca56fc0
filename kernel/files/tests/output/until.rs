//! Runs that end once forces are in balance.

use std::path::Path;

use proctor_files::json::from_json;
use proctor_files::run::{Run, RunControl};
use proctor_scene::simulation::Options;

/// A block that settles under its weight, and the share of unbalanced forces that ends the run.
fn settled(until: &str) -> (f64, f64) {
    let text = format!(
        r#"{{"dimension": 2, "time": 20, "gravity": [0, -10], "damping": {{"type": "local", "value": 0.7}},
        "mesh": {{"cells_dimension": [0.5, 0.5], "cells_number": [4, 8]}},
        "material": [{{"id": 0, "type": "elastic", "young": 1e7, "poisson": 0.3, "density": 2000}}],
        "body": [{{"type": "rectangle", "id": 7, "material_id": 0, "point_p1": [0, 0], "point_p2": [2, 2]}}],
        {until} "results": {{"print": 2}}}}"#
    );
    let scene = from_json(&text, "block.json", Path::new(".")).unwrap_or_else(|e| panic!("{e}"));
    let folder = tempfile::tempdir().expect("a folder");
    let mut run =
        Run::start(&scene, &Options::default(), Some(folder.path()), None).expect("a run");
    while let Some(stop) = run.next_stop() {
        run.advance(stop, |_| RunControl::On).expect("all steps");
        run.write().expect("the files are written");
    }
    let stress = run.simulation().sets()[0].stress(0)[1];
    let history = std::fs::read_to_string(folder.path().join("history.csv")).expect("a history");
    let last = history.lines().last().expect("a row").split(',').next();
    let last: f64 = last.expect("a time").parse().expect("a number");
    let time = run.simulation().time();
    assert!(
        (last - time).abs() < 1e-12,
        "the end is written: {last}, {time}"
    );
    (time, stress)
}

#[test]
fn a_run_ends_in_balance() {
    let (whole, at_rest) = settled("");
    assert!((whole - 20.0).abs() < 1e-9, "{whole} s");
    let (early, stress) = settled(r#""until": {"unbalanced_force": 1e-4},"#);
    assert!(early < 5.0, "{early} s");
    assert!(
        (stress / at_rest - 1.0).abs() < 1e-3,
        "{stress} Pa, not {at_rest}"
    );
    let (later, _) = settled(r#""until": {"unbalanced_force": 1e-6},"#);
    assert!(later > early, "{later} s after {early} s");
}
