//! Requests for too much memory are refused before it is taken: exit code 2, both numbers, nothing written.

use crate::command::support::{Desk, code, fixture, flying_block, stderr, stdout};
use serde_json::{Value, json};
use std::process::{Command, Output};

/// Address space of the command \[KiB\], so that nothing here depends on the machine.
const ADDRESS_SPACE: &str = "2000000";

/// The command with no more address space than that.
fn within_limits(arguments: &[&str]) -> Output {
    Command::new("sh")
        .arg("-c")
        .arg(format!("ulimit -v {ADDRESS_SPACE}; exec \"$@\""))
        .arg("sh")
        .arg(env!("CARGO_BIN_EXE_proctor"))
        .args(arguments)
        .output()
        .expect("the command starts")
}

/// A scene of the repository, with the files that it names where they are.
fn example(name: &str) -> Value {
    let text = std::fs::read_to_string(fixture(&format!("fixtures/scenes/{name}.json")));
    let mut scene: Value = serde_json::from_str(&text.expect("a fixture")).expect("JSON");
    if let Some(path) = scene.pointer_mut("/terrain_contact/stl_mesh") {
        let below = path.as_str().expect("a path").trim_start_matches("../");
        *path = json!(fixture(&format!("fixtures/{below}")));
    }
    scene
}

/// A scene that needs too much, the key that asks for it, and what it asks for.
fn greedy() -> Vec<(&'static str, Value, &'static str, &'static str)> {
    let with = |act: &dyn Fn(&mut Value)| {
        let mut scene = flying_block();
        act(&mut scene);
        scene
    };
    vec![
        (
            "cells",
            with(&|scene| scene["mesh"]["cells_number"] = json!([30_000, 30_000])),
            "mesh.cells_number",
            "53.7 GiB",
        ),
        (
            "cells beside a surface",
            {
                let mut scene = example("sphere_on_terrain");
                scene["mesh"]["cells_number"] = json!([1_000_000, 20, 16]);
                scene
            },
            "mesh.cells_number",
            "28.6 GiB",
        ),
        (
            "particles of a rectangle",
            with(&|scene| {
                scene["mesh"]["cells_dimension"] = json!([1e-3, 1e-3]);
                scene["mesh"]["cells_number"] = json!([2000, 1000]);
                scene["particles_per_cell"] = json!(100);
            }),
            "1.2000e9 particles",
            "GiB",
        ),
        (
            "particles of a disc",
            with(&|scene| {
                scene["mesh"]["cells_dimension"] = json!([1e-3, 1e-3]);
                scene["mesh"]["cells_number"] = json!([2000, 1000]);
                scene["body"][0] = json!({
                    "type": "disc", "id": 1, "material_id": 1, "center": [1, 0.5], "radius": 0.3,
                    "particles_per_cell": 100
                });
            }),
            "2.8274e9 particles",
            "iB",
        ),
        (
            "particles of many bodies, each of which would fit",
            with(&|scene| {
                scene["particles_per_cell"] = json!(100);
                let bodies = (0..30).map(|i| {
                    let (x, y) = (0.1 * f64::from(i % 15), 0.3 * f64::from(i / 15));
                    json!({
                        "type": "rectangle", "id": i + 1, "material_id": 1,
                        "point_p1": [x, y], "point_p2": [x + 0.1, y + 0.3]
                    })
                });
                scene["body"] = bodies.collect();
                scene["mesh"]["cells_dimension"] = json!([0.01, 0.01]);
                scene["mesh"]["cells_number"] = json!([200, 100]);
            }),
            "particles of 30 bodies",
            "GiB",
        ),
        (
            "vertices",
            with(&|scene| {
                scene["mesh"]["cells_dimension"] = json!([1e-3, 1e-3]);
                scene["mesh"]["cells_number"] = json!([3000, 2000]);
                scene["body"][0]["point_p1"] = json!([0, 1]);
                scene["body"][0]["point_p2"] = json!([3, 1.001]);
                scene["body"][0]["particles_per_cell"] = json!(1);
                scene["body"][0]["boundary_segment"] = json!(1e-6);
            }),
            "boundary_segment",
            "10.2 GiB",
        ),
    ]
}

#[cfg(target_os = "linux")]
#[test]
fn a_scene_that_needs_too_much_is_refused_with_both_numbers() {
    let desk = Desk::new();
    for (name, scene, path, needed) in greedy() {
        let scene = desk.scene("scene.json", &scene);
        let out = desk.name("out");
        for arguments in [vec!["plan", &scene], vec!["run", &scene, "--out", &out]] {
            let output = within_limits(&arguments);
            let message = stderr(&output);
            assert_eq!(code(&output), 2, "{name}: {message}");
            assert!(
                message.contains(path)
                    && message.contains(needed)
                    && message.contains(" that are free"),
                "{name}: {message}"
            );
            assert_eq!(stdout(&output), "", "{name}");
            assert!(!desk.path("out").exists(), "{name}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_without_end_is_refused() {
    for arguments in [
        ["plan", "/dev/zero"],
        ["run", "/dev/zero"],
        ["bench", "/dev/zero"],
    ] {
        let output = within_limits(&arguments);
        let message = stderr(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {message}");
        assert!(message.contains("MiB"), "{message}");
    }
}

#[test]
fn more_particles_in_a_cell_than_tell_anything_are_refused_with_their_place() {
    let desk = Desk::new();
    let counts = [101, 1000, 100_000];
    let scenes = [flying_block(), example("rolling_disc_2d")];
    for (mut scene, count) in scenes
        .into_iter()
        .flat_map(|scene| counts.map(|count| (scene.clone(), count)))
    {
        scene["particles_per_cell"] = json!(count);
        let scene = desk.scene("scene.json", &scene);
        for verb in ["plan", "run"] {
            let output = crate::command::support::proctor(&[verb, &scene]);
            let message = stderr(&output);
            assert_eq!(code(&output), 2, "{message}");
            let found = format!(
                "particles_per_cell[0]: found {count}; accepted: a whole number from 1 to 100"
            );
            assert!(
                message.starts_with(&scene) && message.contains(&found),
                "{message}"
            );
        }
    }
}

#[test]
fn a_boundary_finer_than_the_grid_sees_is_refused_with_its_place() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["body"][0]["boundary_segment"] = json!(1e-9);
    let scene = desk.scene("scene.json", &scene);
    let output = crate::command::support::proctor(&["plan", &scene]);
    let message = stderr(&output);
    assert_eq!(code(&output), 2, "{message}");
    assert!(
        message.starts_with(&scene) && message.contains("body[0].boundary_segment: found 1e-9"),
        "{message}"
    );
}

#[test]
fn more_threads_than_a_machine_has_stacks_for_are_refused() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    let output = desk.run(&scene, "out", &["--threads", "1000000"]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("1000000 threads"),
        "{}",
        stderr(&output)
    );
    assert!(!desk.path("out").exists());
    let mut many = flying_block();
    many["n_threads"] = json!(u64::MAX);
    let output = desk.run(&desk.scene("many.json", &many), "out", &[]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    let config = desk.scene(
        "bench.json",
        &json!({ "scenes": "rest-2d", "threads": [1, 1_000_000] }),
    );
    let output = crate::command::support::proctor(&["bench", &config]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
}
