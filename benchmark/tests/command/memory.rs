//! What a few bytes of input ask for is refused before it is taken: exit code 2, both numbers, nothing written.

use crate::support::{Desk, code, flying_block, stderr, stdout};
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
            "particles of a rectangle",
            with(&|scene| scene["particles_per_cell"] = json!(100_000)),
            "particles",
            "TiB",
        ),
        (
            "particles of a disc",
            with(&|scene| {
                scene["body"][0] = json!({
                    "type": "disc", "id": 1, "material_id": 1, "center": [1, 0.5], "radius": 0.3,
                    "particles_per_cell": 100_000
                });
            }),
            "particles",
            "TiB",
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
            "5.7 GiB",
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
fn a_boundary_finer_than_the_grid_sees_is_refused_with_its_place() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["body"][0]["boundary_segment"] = json!(1e-9);
    let scene = desk.scene("scene.json", &scene);
    let output = crate::support::proctor(&["plan", &scene]);
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
    let output = crate::support::proctor(&["bench", &config]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
}
