//! Bad input gets a message that says where and what, exit code 2, and nothing is written.

use crate::support::{Desk, code, column, fixture, flying_block, proctor, stderr, stdout};
use serde_json::json;
use std::fs;

#[test]
fn a_misspelt_key_is_named_with_its_place_and_the_nearest_key() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["material"][0]["yung"] = json!(1e5);
    let scene = desk.scene("scene.json", &scene);
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    let place = message
        .strip_prefix(&format!("{scene}:"))
        .and_then(|rest| rest.split_once(": "))
        .map_or_else(
            || panic!("no place in {message}"),
            |(place, _)| place.to_owned(),
        );
    let numbers: Vec<&str> = place.split(':').collect();
    assert!(
        numbers.len() == 2 && numbers.iter().all(|n| n.parse::<u32>().is_ok()),
        "{message}"
    );
    assert!(
        message.contains("yung") && message.contains("`young`"),
        "{message}"
    );
    assert!(!desk.path("out").exists());
    assert_eq!(stdout(&output), "");
}

#[test]
fn all_problems_are_reported_at_once() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["material"][0]["young"] = json!(0);
    scene["material"][0]["poisson"] = json!(0.5);
    scene["body"][0]["material_id"] = json!(7);
    scene["time"] = json!(-1);
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    for path in [
        "material[0].young",
        "material[0].poisson",
        "body[0].material_id",
        "time",
    ] {
        assert!(message.contains(path), "{path} is missing in {message}");
    }
    assert_eq!(message.lines().count(), 4, "{message}");
    assert!(!desk.path("out").exists());
}

#[test]
fn bodies_in_contact_that_overlap_are_refused_with_depth_and_place() {
    let desk = Desk::new();
    let text = fs::read_to_string(fixture("fixtures/scenes/manual/inclined_two_blocks.json"))
        .expect("the fixture");
    // Both blocks sink into the plane by 0.25 m.
    let text = text
        .replace("[ 2, 2, 2 ]", "[ 2, 2, 1.75 ]")
        .replace("[ 12, 2, 2 ]", "[ 12, 2, 1.75 ]");
    let scene = desk.scene("scene.json", &serde_json::from_str(&text).expect("JSON"));
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert_eq!(
        message.matches("overlap by 0.25 m at").count(),
        2,
        "{message}"
    );
    assert!(
        message.contains("contact[0]") && message.contains("contact[1]"),
        "{message}"
    );
    assert!(!desk.path("out").exists());
}

#[test]
fn a_file_that_is_not_there_is_bad_input() {
    for verb in ["run", "plan"] {
        let output = proctor(&[verb, "no/such/scene.json"]);
        assert_eq!(code(&output), 2, "{verb}");
        assert!(stderr(&output).contains("no/such/scene.json"));
    }
}

#[test]
fn an_unstable_time_step_is_refused_before_anything_is_written() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["time_step"] = json!(0.1);
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("critical time step"),
        "{}",
        stderr(&output)
    );
    assert!(!desk.path("out").exists());
}

#[test]
fn a_folder_that_cannot_be_made_is_bad_input() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    // A file stands where the folder should be: refused whatever the rights of the user.
    fs::write(desk.path("taken"), "mine").expect("written");
    let output = desk.run(&scene, "taken", &[]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("taken"), "{}", stderr(&output));
    assert_eq!(
        fs::read_to_string(desk.path("taken")).expect("read"),
        "mine"
    );
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let desk = Desk::new();
    let first = desk.scene("first.json", &column(&json!({})));
    assert_eq!(code(&desk.run(&first, "first", &[])), 0);
    let mut other = column(&json!({}));
    other["material"][0]["young"] = json!(2e5);
    let other = desk.scene("other.json", &other);
    let checkpoint = desk.path("first").join("checkpoint.bin");
    let output = desk.run(
        &other,
        "second",
        &["--restart", &checkpoint.display().to_string()],
    );
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("another scene"),
        "{}",
        stderr(&output)
    );
    assert!(!desk.path("second").exists());
}

#[test]
fn a_checkpoint_that_is_none_is_refused() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &column(&json!({})));
    let output = desk.run(&scene, "out", &["--restart", &scene]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(!desk.path("out").exists());
}

#[test]
fn zero_threads_and_unknown_options_are_bad_input() {
    let scene = fixture("fixtures/scenes/manual/boussinesq.json");
    for wrong in [["--threads", "0"], ["--lanes", "mmx"], ["--colour", "red"]] {
        let output = proctor(&["run", &scene, wrong[0], wrong[1]]);
        assert_eq!(code(&output), 2, "{wrong:?}");
    }
}
