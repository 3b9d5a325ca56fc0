//! Bad input gets a message that says where and what, exit code 2, and nothing is written.

use crate::command::support::{Desk, code, column, fixture, flying_block, proctor, stderr, stdout};
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

/// The place at which a message begins, behind the name of the file.
fn place(message: &str, file: &str) -> (usize, usize) {
    // Warnings of the plan may come before it.
    let message = message
        .lines()
        .find(|line| line.starts_with(file))
        .unwrap_or(message);
    let rest = message.strip_prefix(&format!("{file}:"));
    let numbers: Vec<usize> = rest
        .and_then(|rest| rest.split_once(": "))
        .map(|(place, _)| place.split(':').flat_map(str::parse).collect())
        .unwrap_or_default();
    match numbers[..] {
        [line, column] => (line, column),
        _ => panic!("no place in {message}"),
    }
}

/// The line on which a text first has a word, from 1.
fn line_of(text: &str, word: &str) -> usize {
    let at = text.lines().position(|line| line.contains(word));
    at.unwrap_or_else(|| panic!("{word} in {text}")) + 1
}

/// A fault that shows only with particles has its place in the file all the same.
#[test]
fn faults_at_set_up_have_their_place() {
    let discs = |gap: f64| {
        let mut scene = flying_block();
        scene["time_step"] = json!(0.0002);
        let disc = |id: i32, x: f64| {
            json!({
                "type": "disc", "id": id, "material_id": 1, "center": [x, 0.5], "radius": 0.3,
                "boundary_segment": 0.05
            })
        };
        scene["body"] = json!([disc(1, 0.5), disc(2, 1.1 + gap)]);
        scene["contact"] = json!([{
            "method": "mortar", "master_id": 1, "slave_id": 2, "friction": 0, "critical_gap": 0.02,
            "normal_stiffness": 1e5
        }]);
        scene
    };
    let mut small = flying_block();
    small["body"] = json!([{
        "type": "disc", "id": 1, "material_id": 1, "center": [0.5, 0.5], "radius": 1e-3
    }]);
    let mut unstable = flying_block();
    unstable["time_step"] = json!(0.1);
    let mut many = flying_block();
    many["particles_per_cell"] = json!(100_000_000);
    for (scene, key, said) in [
        (small, "\"body\"", "gets no particle"),
        (unstable, "\"time_step\"", "critical time step"),
        (discs(-0.1), "\"contact\"", "gap"),
        (many, "\"body\"", "particles"),
    ] {
        let desk = Desk::new();
        let name = desk.scene("scene.json", &scene);
        let text = fs::read_to_string(&name).expect("a scene");
        for verb in ["plan", "run"] {
            let output = proctor(&[verb, &name]);
            let message = stderr(&output);
            assert_eq!(code(&output), 2, "{verb}: {message}");
            assert!(message.contains(said), "{verb}: {message}");
            let (line, _) = place(&message, &name);
            let first = line_of(&text, key);
            // The value itself, or the first entry of the list.
            assert!((first..=first + 1).contains(&line), "{verb}: {message}");
        }
    }
}

#[test]
fn bytes_that_are_no_text_have_their_place() {
    let desk = Desk::new();
    let name = desk.name("scene.json");
    fs::write(&name, b"{\n  \"time\": \xff1\n}").expect("written");
    for verb in ["run", "plan", "bench"] {
        let output = proctor(&[verb, &name]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{verb}: {message}");
        assert_eq!(place(&message, &name), (2, 11), "{verb}");
        assert!(message.contains("found the byte 0xff"), "{message}");
    }
}

#[test]
fn a_text_that_ends_too_early_is_told_as_that() {
    let desk = Desk::new();
    let text = "{\n  \"time\": 1,\n  \"mesh\": {\"cells_number\": [4,\n\n";
    for end in 3..text.len() {
        let name = desk.name("scene.json");
        fs::write(&name, &text[..end]).expect("written");
        let output = proctor(&["plan", &name]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{message}");
        assert!(
            !message.contains('?') && !message.contains("found ,"),
            "{message}"
        );
        assert!(
            message.contains("found the end of the text; accepted: JSON in which every bracket"),
            "{end}: {message}"
        );
        let (line, _) = place(&message, &name);
        assert_eq!(line, text[..end].trim_end().lines().count(), "{message}");
    }
}

#[test]
fn numbers_in_messages_are_no_rows_of_zeros() {
    let desk = Desk::new();
    for (pointer, value) in [
        ("/time", json!(-5e-324)),
        ("/material/0/young", json!(-1e308)),
    ] {
        let mut scene = flying_block();
        *scene.pointer_mut(pointer).expect("it is there") = value;
        let output = proctor(&["plan", &desk.scene("scene.json", &scene)]);
        assert_eq!(code(&output), 2);
        let message = stderr(&output);
        assert!(!message.contains("00000000"), "{message}");
    }
    let mut scene = flying_block();
    scene["body"] = json!([{
        "type": "disc", "id": 1, "material_id": 1, "center": [0.5, 0.5], "radius": 5e-324
    }]);
    let output = proctor(&["plan", &desk.scene("scene.json", &scene)]);
    assert_eq!(code(&output), 2);
    assert!(!stderr(&output).contains("00000000"), "{}", stderr(&output));
}

/// No folder holds so many frames, and the next output would be no later than this one.
#[test]
fn more_outputs_than_frames_have_names_are_refused() {
    let desk = Desk::new();
    for print in [1_000_000_u64, 1 << 63, u64::MAX] {
        let mut scene = flying_block();
        scene["results"]["print"] = json!(print);
        let name = desk.scene("scene.json", &scene);
        let output = proctor(&["plan", &name]);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{print}: {message}");
        place(&message, &name);
        assert!(
            message.contains(&format!("results.print: found {print}"))
                && message.contains("999999"),
            "{message}"
        );
    }
}

/// A step of the run that fails for a value of the scene is told at that value.
#[test]
fn a_step_that_fails_is_told_at_the_value_that_would_have_to_be_another() {
    let desk = Desk::new();
    let mut scene = flying_block();
    // Stable at the start, and no more when the block has become faster.
    scene["time_step"] = json!(0.002);
    scene["gravity"] = json!([200, 0]);
    let name = desk.scene("scene.json", &scene);
    let text = fs::read_to_string(&name).expect("a scene");
    let output = desk.run(&name, "out", &[]);
    let message = stderr(&output);
    assert_eq!(code(&output), 1, "{message}");
    assert!(
        message.contains("is above the critical time step"),
        "{message}"
    );
    assert_eq!(place(&message, &name).0, line_of(&text, "\"time_step\""));
}

/// A number so large or so small that its square overflows is refused at its place, with the accepted values.
#[test]
fn numbers_beyond_all_use_are_refused_with_their_place() {
    let desk = Desk::new();
    let cases = [
        (
            "/material/0/density",
            json!(1.7e308),
            "density: found 1.7e308",
        ),
        ("/material/0/young", json!(1e200), "young: found 1e200"),
        (
            "/body/0/initial_velocity/0",
            json!(1e154),
            "initial_velocity[0]: found 1e154",
        ),
        (
            "/mesh/cells_dimension/0",
            json!(1e-200),
            "cells_dimension[0]: found 1e-200",
        ),
        (
            "/time_step",
            json!(0.5),
            "time_step: found 0.5, which is longer than the time of 0.4 s",
        ),
    ];
    for (place, value, found) in cases {
        let mut scene = flying_block();
        *scene.pointer_mut(place).expect("there") = value;
        let scene = desk.scene("scene.json", &scene);
        for arguments in [vec!["plan", &scene], vec!["run", &scene]] {
            let output = proctor(&arguments);
            let message = stderr(&output);
            assert_eq!(code(&output), 2, "{place}: {message}");
            assert!(
                message.starts_with(&scene)
                    && message.contains(found)
                    && message.contains("accepted: a number"),
                "{place}: {message}"
            );
        }
    }
}

/// A traction that lies beside its body, or in part: its name and its place in the file, before the first step; and in the step
/// where the body leaves it.
#[test]
fn a_traction_that_no_body_carries_is_named_with_its_place() {
    let desk = Desk::new();
    let with = |from: f64, to: f64, name: &str| {
        let mut scene = flying_block();
        scene["traction"] = json!([
            {"point_p1": [0.4, 0.3], "point_p2": [0.5, 0.3], "traction": [0, 1]},
            {"point_p1": [from, 0.6], "point_p2": [to, 0.6], "traction": [0, -10]},
        ]);
        desk.scene(name, &scene)
    };
    for (from, to, told) in [
        (0.3, 1.1, "from (0.7, 0.6) to (1.1, 0.6) m, 50 %"),
        (1.2, 1.4, "lies over no body;"),
    ] {
        let scene = with(from, to, "scene.json");
        for verb in ["plan", "run"] {
            let output = proctor(&[verb, &scene]);
            let message = stderr(&output);
            assert_eq!(code(&output), 2, "{message}");
            assert!(message.starts_with(&format!("{scene}:")), "{message}");
            assert!(message.contains("traction[1]: the rectangle"), "{message}");
            assert!(message.contains(told), "{message}");
        }
    }
}
