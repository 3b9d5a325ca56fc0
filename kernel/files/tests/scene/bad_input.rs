//! Bad input: each class gives a message with file, line, column, path, what was found, what is accepted and the
//! nearest known word. The messages are a snapshot; each was read when it was accepted.

use std::path::Path;

use proctor_files::json::from_json;
use proctor_scene::SceneError;

use crate::scene::bad_cases::{CASES, SOUND};

fn parse(text: &str) -> Result<(), SceneError> {
    from_json(text, "bad.json", Path::new("../../fixtures/records")).map(|_| ())
}

#[test]
fn the_sound_scene_is_sound() {
    assert_eq!(parse(SOUND), Ok(()));
}

#[test]
fn every_class_has_its_message() {
    let mut shown = Vec::new();
    for (name, from, to) in CASES {
        assert!(SOUND.contains(from), "{name}: nothing to replace");
        let text = SOUND.replacen(from, to, 1);
        let error = parse(&text).expect_err(name);
        for problem in &error.problems {
            assert!(
                !problem.found.is_empty() && !problem.accepted.is_empty(),
                "{name}"
            );
            assert!(problem.location.is_some(), "{name} has no place: {problem}");
        }
        shown.push(format!("[{name}]\n{error}"));
    }
    insta::assert_snapshot!(shown.join("\n\n"));
}

#[test]
fn an_empty_scene_lacks_four_things() {
    let error = parse("{}").expect_err("nothing is there");
    let lacking: Vec<_> = error
        .problems
        .iter()
        .map(|p| {
            (
                p.path.as_str(),
                p.location.as_ref().map(|at| (at.line, at.column)),
            )
        })
        .collect();
    assert_eq!(
        lacking,
        ["mesh", "time", "material", "body"].map(|path| (path, Some((1, 1))))
    );
}

/// The text of an error is walked again to find the place, so it must not be deeper than the stack.
#[test]
fn a_text_of_brackets_is_an_error() {
    for text in ["[".repeat(1_000_000), "{\"a\":".repeat(100_000)] {
        assert_eq!(parse(&text).expect_err("brackets").problems.len(), 1);
    }
}

#[test]
fn polygons_that_are_none() {
    let scene = |points: &str| {
        format!(
            r#"{{"dimension": 2, "time": 1, "mesh": {{"cells_dimension": [1, 1], "cells_number": [4, 4]}},
"material": [{{"type": "elastic", "id": 0, "young": 1, "poisson": 0, "density": 1}}],
"body": [{{"type": "polygon", "id": 1, "material_id": 0, "points": {points}}}]}}"#
        )
    };
    assert_eq!(parse(&scene("[[0, 0], [1, 0], [1, 1]]")), Ok(()));
    let mut shown = Vec::new();
    for points in [
        "[[0, 0], [1, 1]]",
        "[[0, 0], [1, 1], [1, 0], [0, 1]]",
        "[[0, 0], [1, 0], [1, 1], [0, 0]]",
        "[[0, 0], [1, 0, 0], [1, 1]]",
        "[[0, 0], [1, 0], [1, 5]]",
    ] {
        let error = parse(&scene(points)).expect_err(points);
        shown.push(format!("[{points}]\n{error}"));
    }
    insta::assert_snapshot!(shown.join("\n\n"));
}

/// One bad value does not hide the others, and is itself reported once.
#[test]
fn all_problems_are_reported_at_once() {
    let text = SOUND
        .replace("\"time\": 1.0", "\"time\": -1.0")
        .replace("\"young\": 1e6, ", "")
        .replace("\"density\": 2000", "\"density\": -5")
        .replace("[4, 4, 4]", "[4, 4]")
        .replace("\"material_id\": 1", "\"material_id\": 7");
    let error = parse(&text).expect_err("five problems");
    let paths: Vec<_> = error.problems.iter().map(|p| p.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "time",
            "mesh.cells_number",
            "material.rock.young",
            "material.rock.density",
            "body[0].material_id"
        ],
        "{error}"
    );
}

#[test]
fn a_scene_that_is_not_there() {
    let error = proctor_files::json::read(Path::new("nowhere/scene.json")).expect_err("no file");
    assert!(error.to_string().contains("nowhere/scene.json"), "{error}");
}
