//! A run cut in half and restarted ends in the same state as the whole run.

use crate::command::support::{Desk, code, column, command, methods, stderr};
use std::fs;
use std::time::{Duration, Instant};

/// Kills the run once its second frame and the checkpoint that follows it are there.
#[test]
fn a_run_cut_in_half_and_restarted_ends_the_same() {
    for method in methods() {
        let desk = Desk::new();
        let mut scene = column(&method);
        // Long enough for the run to be killed in its midst.
        scene["time"] = serde_json::json!(4.0);
        scene["results"]["print"] = serde_json::json!(40);
        let scene = desk.scene("scene.json", &scene);
        assert_eq!(code(&desk.run(&scene, "whole", &[])), 0);

        let cut = desk.path("cut");
        let mut child = command(&["run", &scene, "--out", &cut.display().to_string()])
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("starts");
        let start = Instant::now();
        while !cut.join("particles_000004.vtu").exists() {
            assert!(start.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().expect("killed");
        child.wait().expect("ended");
        assert!(
            !cut.join("summary.json").exists(),
            "it ended before it was killed"
        );

        let checkpoint = cut.join("checkpoint.bin").display().to_string();
        let output = desk.run(&scene, "cut", &["--restart", &checkpoint]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let (whole, halves) = (desk.summary("whole"), desk.summary("cut"));
        for key in ["state_hash", "steps", "time", "energy", "dt_min", "dt_max"] {
            assert_eq!(whole[key], halves[key], "{key}, {method}");
        }
        for file in ["history.csv", "particles.pvd", "particles_000040.vtu"] {
            let of = |out: &str| fs::read(desk.path(out).join(file)).expect("read");
            assert!(of("whole") == of("cut"), "{file} differs, {method}");
        }
    }
}

/// Gravity and local damping may change; the run tells both, goes on from its state, and its balance of energy holds.
#[test]
fn a_restart_changes_what_a_stage_changes_and_says_what() {
    let desk = Desk::new();
    let mut scene = column(&methods()[0]);
    scene["time"] = serde_json::json!(0.2);
    let first = desk.scene("first.json", &scene);
    assert_eq!(code(&desk.run(&first, "run", &[])), 0);
    let work = desk.summary("run")["energy"]["external_work"].clone();
    let checkpoint = desk.path("run").join("checkpoint.bin");
    let checkpoint = checkpoint.display().to_string();
    scene["time"] = serde_json::json!(0.4);
    let axes = scene["gravity"].as_array().map_or(2, Vec::len);
    scene["gravity"] = serde_json::json!(vec![0.0; axes]);
    scene["damping"] = serde_json::json!({"type": "local", "value": 0.3});
    let second = desk.scene("second.json", &scene);
    let output = desk.run(&second, "run", &["--restart", &checkpoint]);
    let told = stderr(&output);
    assert_eq!(code(&output), 0, "{told}");
    assert!(
        told.contains("changed from here on: gravity [0.0, 0.0"),
        "{told}"
    );
    assert!(
        told.contains("changed from here on: local damping 0.3, 0 until then"),
        "{told}"
    );
    // Without gravity no more work is done: what was done stays in the books.
    let energy = &desk.summary("run")["energy"];
    assert_eq!(energy["external_work"], work, "{energy}");
    assert!(
        energy["damping"].as_f64().expect("a number") > 0.0,
        "{energy}"
    );
    // No line where nothing changes.
    let again = desk.run(&second, "run", &["--restart", &checkpoint]);
    assert_eq!(code(&again), 0);
    assert!(
        !stderr(&again).contains("changed from here on"),
        "{}",
        stderr(&again)
    );
    // Loads and planes change as well.
    scene["mesh"]["boundary_conditions"]["plane_Z0"] = serde_json::json!("sliding");
    scene["box_load"] = serde_json::json!([{
        "point_p1": [0.3, 0.1, 0.4], "point_p2": [0.7, 0.4, 0.5], "force": [0.0, 0.0, -500.0]
    }]);
    let loaded = desk.scene("loaded.json", &scene);
    let output = desk.run(&loaded, "run", &["--restart", &checkpoint]);
    let told = stderr(&output);
    assert_eq!(code(&output), 0, "{told}");
    for words in [
        "changed from here on: plane_Z0 sliding, fixed until then",
        "changed from here on: box loads of [0.0, 0.0, -500.0] N in all, no box load until then",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    // What a plane bears is found at the start of a stage: refused with its place.
    scene["mesh"]["boundary_conditions"]["plane_Z0"] = serde_json::json!("absorbing");
    let absorbing = desk.scene("absorbing.json", &scene);
    let output = desk.run(&absorbing, "run", &["--restart", &checkpoint]);
    assert_eq!(code(&output), 2);
    let told = stderr(&output);
    for words in [
        "absorbing.json:",
        "mesh.boundary_conditions.plane_Z0: found \"absorbing\" after \"sliding\" in a restart",
        "accepted: free, sliding and fixed planes alone",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
    // Other changes are named as before.
    scene["time_step"] = serde_json::json!(1e-5);
    let third = desk.scene("third.json", &scene);
    let output = desk.run(&third, "run", &["--restart", &checkpoint]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("begins from a checkpoint by `initial_state`"));
}
