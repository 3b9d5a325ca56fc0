//! `proctor picture`: files of the right kind, and answers to what cannot be drawn.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// A block that falls for a moment.
pub fn falling(axes: usize) -> Value {
    let last = |value: f64| {
        let mut vector = vec![0.0; axes];
        vector[axes - 1] = value;
        vector
    };
    json!({
        "dimension": axes, "time": 0.05, "time_step": 1e-3, "gravity": last(-10.0),
        "results": {"print": 4, "fields": ["id", "displacement", "stress"]},
        "mesh": {"cells_dimension": vec![0.1; axes], "cells_number": vec![10; axes]},
        "material": [{"type": "elastic", "id": 1, "young": 1e5, "poisson": 0.2, "density": 1000}],
        "body": [{"type": "cuboid", "id": 1, "material_id": 1,
            "point_p1": vec![0.2; axes], "point_p2": vec![0.6; axes]}],
        "probes": [{"name": "corner", "point": vec![0.2; axes]}]
    })
}

#[test]
fn a_run_in_the_plane_and_one_in_space_are_drawn() {
    for axes in [2, 3] {
        let desk = Desk::new();
        let scene = desk.scene("fall.json", &falling(axes));
        let output = desk.run(&scene, "out", &["--picture"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        for name in ["picture.png", "picture.svg", "history.svg"] {
            assert!(desk.path("out").join(name).is_file(), "{name}");
            assert!(stdout(&output).contains(name), "{}", stdout(&output));
        }
        let out = desk.name("out");
        let choice = [
            "--field",
            "mises_stress",
            "--at",
            "0.03",
            "--range",
            "-5,1e4",
            "--mesh",
            "--view",
            "-30,10",
        ];
        let mut arguments = vec!["picture", &out, "--animate"];
        arguments.extend(choice);
        let output = proctor(&arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let bytes = |name: &str| fs::read(desk.path("out").join(name)).expect("a picture");
        let reader = png::Decoder::new(std::io::Cursor::new(bytes("animation.png"))).read_info();
        let control = reader.expect("a PNG").info().animation_control;
        assert_eq!(control.expect("an animation").num_frames, 5);
        let svg = String::from_utf8(bytes("picture.svg")).expect("text");
        for words in ["Mises stress (Pa)", "x (m)", "fall", "t = 0.025 s"] {
            assert!(svg.contains(words), "{words}");
        }
        assert_eq!(svg.contains("z (m)"), axes == 3);
        let curves = String::from_utf8(bytes("history.svg")).expect("text");
        assert!(curves.contains("corner: displacement"));
    }
}

/// A cylinder that falls along its axis.
fn falling_cylinder() -> Value {
    let mut scene = falling(2);
    scene["mesh"]["axisymmetric"] = true.into();
    scene["body"][0]["point_p1"] = json!([0.0, 0.2]);
    scene
}

#[test]
fn a_body_of_revolution_is_drawn_in_space() {
    let desk = Desk::new();
    let scene = desk.scene("fall.json", &falling_cylinder());
    assert_eq!(code(&desk.run(&scene, "out", &[])), 0);
    let out = desk.name("out");
    let svg = |arguments: &[&str]| {
        let output = proctor(&[&["picture", &out], arguments].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        fs::read_to_string(desk.path("out").join("picture.svg")).expect("a picture")
    };
    assert!(!svg(&[]).contains("z (m)"));
    let [usual, given, whole] = [
        svg(&["--revolve"]),
        svg(&["--revolve", "270"]),
        svg(&["--revolve", "360", "--animate"]),
    ];
    assert!(usual.contains("z (m)"));
    assert!(usual == given && usual != whole);
}

#[test]
fn what_cannot_be_revolved_is_named() {
    let desk = Desk::new();
    for axes in [2, 3] {
        let scene = desk.scene("fall.json", &falling(axes));
        assert_eq!(code(&desk.run(&scene, &format!("out{axes}"), &[])), 0);
        let output = proctor(&["picture", &desk.name(&format!("out{axes}")), "--revolve"]);
        assert_eq!(code(&output), 2);
        for words in ["not axisymmetric", "accepted: ", "\"axisymmetric\": true"] {
            assert!(stderr(&output).contains(words), "{}", stderr(&output));
        }
    }
    for value in ["0", "-90", "361", "half", "NaN"] {
        let output = proctor(&["picture", &desk.name("out2"), "--revolve", value]);
        assert_eq!(code(&output), 2, "{value}");
        assert!(stderr(&output).contains("accepted: degrees above 0"));
    }
}

#[test]
fn a_field_that_is_not_there_is_answered_with_the_list() {
    let desk = Desk::new();
    let scene = desk.scene("fall.json", &falling(2));
    let out = desk.name("out");
    assert_eq!(code(&desk.run(&scene, "out", &[])), 0);
    let output = proctor(&["picture", &out, "--field", "strain"]);
    assert_eq!(code(&output), 2);
    for words in [
        "\"strain\"",
        "Displacement, Displacement x",
        "Stress_XY",
        "Mises stress",
    ] {
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    assert!(!desk.path("out/picture.png").exists());
    for (option, value) in [("--range", "2,1"), ("--view", "north")] {
        let output = proctor(&["picture", &out, option, value]);
        assert_eq!(code(&output), 2);
        assert!(
            stderr(&output).contains("accepted: "),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn a_folder_without_a_run_is_named() {
    let desk = Desk::new();
    fs::create_dir(desk.path("empty")).expect("a folder");
    for (folder, words) in [
        ("empty", "neither frames nor a history"),
        ("none", "no such folder"),
    ] {
        let output = proctor(&["picture", &desk.name(folder)]);
        assert_eq!(code(&output), 2);
        let text = stderr(&output);
        assert!(text.contains(words) && text.contains(folder), "{text}");
    }
}

#[test]
fn a_history_without_frames_is_drawn_alone() {
    let desk = Desk::new();
    let mut scene = falling(2);
    scene["results"] = json!({"print": 0, "history_interval": 0.002});
    let scene = desk.scene("fall.json", &scene);
    let output = desk.run(&scene, "out", &["--picture"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(desk.path("out/history.svg").is_file() && !desk.path("out/picture.png").exists());
    let output = proctor(&["picture", &desk.name("out"), "--field", "displacement"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("`results.print` above 0"));
}
