//! `proctor plan` and `proctor schema`.

use crate::command::support::{code, fixture, proctor, stderr, stdout};

#[test]
fn the_plan_says_what_is_kept_and_what_is_left_out() {
    let output = proctor(&["plan", &fixture("fixtures/scenes/manual/boussinesq.json")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    insta::assert_snapshot!(stdout(&output));
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
