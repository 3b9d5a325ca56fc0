//! Warnings of a plan and of a run, as a person and a program read them.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};

/// A soft elastic block that falls on a plane.
fn bounce(law: &str, time: f64) -> Value {
    json!({
        "dimension": 2,
        "time": time,
        "gravity": [0, -9.8],
        "stress_scheme_update": "MUSL",
        "mesh": {"cells_dimension": [0.5, 0.5], "cells_number": [16, 14], "boundary_conditions": {"plane_Y0": "sliding"}},
        "material": [{"type": law, "id": 1, "young": 4e5, "poisson": 0.25, "density": 1000}],
        "body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [2, 1.5], "point_p2": [6, 5.5]}],
        "results": {"print": 4, "fields": ["displacement"]}
    })
}

#[test]
fn energy_from_nowhere_is_told_on_the_terminal_and_in_the_summary() {
    let desk = Desk::new();
    let scene = desk.scene("bounce.json", &bounce("elastic", 1.4));
    let plan = proctor(&["plan", &scene]);
    assert!(
        stdout(&plan).contains("warning: ") && stdout(&plan).contains("`neo_hookean` and `hencky`"),
        "{}",
        stdout(&plan)
    );
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    let attention = text.lines().filter(|line| line.starts_with("attention"));
    assert!(
        attention
            .clone()
            .any(|line| line.contains("came from nowhere")),
        "{text}"
    );
    assert!(
        attention.clone().any(|line| line.contains("J - 1")),
        "{text}"
    );
    let summary = desk.summary("out");
    let mut kinds: Vec<&str> = summary["warnings"]
        .as_array()
        .expect("warnings")
        .iter()
        .filter_map(|warning| warning["kind"].as_str())
        .collect();
    kinds.sort_unstable();
    assert_eq!(kinds, ["energy", "strain"], "{summary:#}");
    // Nothing of it where the law has an energy.
    let scene = desk.scene("other.json", &bounce("neo_hookean", 1.4));
    let output = desk.run(&scene, "other", &[]);
    assert!(!stdout(&output).contains("nowhere"), "{}", stdout(&output));
    assert!(desk.summary("other").get("warnings").is_none());
}

/// Scenes of the manuals and of this repository are sound. Two of them have something beside: named here.
#[test]
fn sound_scenes_have_no_warnings_of_a_plan() {
    for folder in ["fixtures/scenes", "fixtures/scenes/manual"] {
        for entry in std::fs::read_dir(fixture(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "json") {
                continue;
            }
            let output = proctor(&["plan", &path.display().to_string()]);
            let text = stdout(&output);
            for words in [
                "out of balance",
                "stand still",
                "stands still",
                "upright along its weight",
                "on common nodes",
                "`hencky`",
            ] {
                assert!(!text.contains(words), "{}: {text}", path.display());
            }
        }
    }
}
