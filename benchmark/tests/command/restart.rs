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
