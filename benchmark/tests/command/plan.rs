//! `proctor plan` and `proctor schema`.

use super::picture::falling;
use crate::command::support::{Desk, code, fixture, leaving_block, proctor, stderr, stdout};
use proctor_benchmark::show;
use serde_json::json;

#[test]
fn the_plan_says_what_is_kept_and_what_is_left_out() {
    let output = proctor(&["plan", &fixture("fixtures/scenes/manual/boussinesq.json")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    // What follows has the run time on this machine.
    let text = stdout(&output);
    let (plan, forecast) = text.split_once("\nforecast\n").expect("a forecast");
    insta::assert_snapshot!(plan);
    for name in [
        "time step",
        "steps",
        "run time",
        "memory",
        "output",
        "warnings",
    ] {
        let has = |line: &str| line.starts_with(name);
        assert!(forecast.lines().any(has), "{name}: {forecast}");
    }
}

/// Steps, frames and bytes of a scene with a constant step are those of its run.
#[test]
fn what_is_foretold_of_a_constant_step_comes_true() {
    let desk = Desk::new();
    let scene = desk.scene("fall.json", &falling(3));
    let output = proctor(&["plan", &scene]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let steps = desk.summary("out")["steps"].as_u64().expect("a number");
    assert_eq!(steps, 50);
    assert!(text.contains("steps           50\n"), "{text}");
    assert!(
        text.contains("0.001 s, constant, by the scene; bound of stability"),
        "{text}"
    );
    let bytes = |stem: &str| -> u64 {
        let entries = std::fs::read_dir(desk.path("out"))
            .expect("a folder")
            .flatten();
        let ours = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(stem));
        ours.map(|entry| entry.metadata().expect("a size").len())
            .sum()
    };
    let frames = format!("5 frames {}", show::bytes(bytes("particles")));
    let checkpoint = format!("checkpoint {}", show::bytes(bytes("checkpoint")));
    for words in [frames, checkpoint, "5 rows of the history".to_owned()] {
        assert!(text.contains(&words), "{words}: {text}");
    }
}

#[test]
fn a_step_that_will_fail_is_foretold() {
    let desk = Desk::new();
    let mut scene = leaving_block();
    scene["time_step"] = json!(1e-4);
    scene["body"][0]["initial_velocity"] = json!([100.0, 0.0]);
    let scene = desk.scene("leave.json", &scene);
    let output = proctor(&["plan", &scene]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stdout(&output).contains("the run will stop: "),
        "{}",
        stdout(&output)
    );
}

#[test]
fn the_schema_is_json_and_knows_the_keys() {
    let output = proctor(&["schema"]);
    assert_eq!(code(&output), 0);
    let schema: serde_json::Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    assert!(schema["properties"]["stress_scheme_update"].is_object());
}

#[test]
fn every_example_scene_can_be_planned() {
    for folder in ["fixtures/scenes", "fixtures/scenes/speed"] {
        let entries = std::fs::read_dir(fixture(folder)).expect("a folder");
        for entry in entries {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|e| e == "json") && !path.ends_with("block_1m.json") {
                let output = proctor(&["plan", &path.display().to_string()]);
                assert_eq!(code(&output), 0, "{}", stderr(&output));
            }
        }
    }
}
