//! The files that a run leaves behind, however it ends.

use crate::command::support::{
    Desk, code, column, command, fixture, flying_block, leaving_block, methods, proctor, stderr,
    stdout,
};
use serde_json::{Value, json};
use std::fs;
use std::time::{Duration, Instant};

#[test]
fn a_run_writes_frames_history_and_summary() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for name in [
        "particles.pvd",
        "particles_000008.vtu",
        "history.csv",
        "checkpoint.bin",
    ] {
        assert!(desk.path("out").join(name).is_file(), "{name}");
    }
    let summary = desk.summary("out");
    assert_eq!(summary["status"], "finished");
    assert_eq!(summary["steps"], 200);
    for key in ["wall_seconds", "cpu_seconds", "ns_per_particle_step"] {
        assert!(
            summary[key].as_f64().is_some_and(|x| x >= 0.0),
            "{key}: {summary}"
        );
    }
    let hash = summary["state_hash"].as_str().expect("a text");
    assert!(stdout(&output).contains(hash));
}

/// A scene whose step is above the bound of stability is refused; with `--allow-unstable` it runs.
#[test]
fn a_step_above_the_bound_is_taken_on_demand() {
    let scene = fixture("fixtures/scenes/peers/consolidation.json");
    let refused = proctor(&["run", &scene]);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("critical time step"));
    let run = proctor(&["run", &scene, "--allow-unstable"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    assert!(stdout(&run).contains("finished"));
}

#[test]
fn without_a_folder_nothing_is_written() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &flying_block());
    let output = command(&["run", &scene])
        .current_dir(desk.path(""))
        .output()
        .expect("starts");
    assert_eq!(code(&output), 0);
    assert!(stdout(&output).contains("finished"));
    assert!(
        stdout(&output).contains("nothing was written"),
        "{}",
        stdout(&output)
    );
    let said = format!(
        "nothing will be written; for frames, histories and a summary: proctor run {scene} --out FOLDER"
    );
    assert_eq!(stderr(&output).trim_end(), said);
    assert_eq!(fs::read_dir(desk.path("")).expect("a folder").count(), 1);
}

#[test]
fn a_particle_that_leaves_stops_the_run_and_the_last_good_frame_stays() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &leaving_block());
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 1);
    let message = stderr(&output);
    for word in ["particle", "m left the mesh", "step", "time"] {
        assert!(message.contains(word), "{word}: {message}");
    }
    let summary = desk.summary("out");
    assert_eq!(summary["status"], "failed");
    let error = summary["error"].as_str().expect("a reason");
    assert!(message.contains(error), "{message} {error}");
    // It leaves after 0.26 s: the frame of 0.25 s is there and whole, that of 0.30 s is not.
    let last = fs::read(desk.path("out").join("particles_000005.vtu")).expect("a frame");
    assert!(last.ends_with(b"</VTKFile>\n"));
    assert!(!desk.path("out").join("particles_000006.vtu").exists());
    assert!(desk.path("out").join("checkpoint.bin").is_file());
}

#[test]
fn a_particle_that_may_leave_is_recorded_with_its_mass() {
    let desk = Desk::new();
    let mut scene = leaving_block();
    scene["outside"] = json!("remove");
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let summary = desk.summary("out");
    let events = summary["events"].as_array().expect("events");
    assert!(!events.is_empty());
    let removed: f64 = events
        .iter()
        .map(|event| {
            assert_eq!(event["kind"], "particle_removed");
            event["mass"].as_f64().expect("a mass")
        })
        .sum();
    let left = summary["mass"].as_f64().expect("a mass");
    assert!((removed + left - 120.0).abs() < 1e-10, "{removed} + {left}");
    let text = stdout(&output);
    assert!(text.contains("was removed") && text.contains("all particles have left the mesh"));
}

#[test]
fn the_result_does_not_depend_on_threads_and_lanes() {
    let desk = Desk::new();
    for method in methods() {
        let scene = desk.scene("scene.json", &column(&method));
        let hash = |more: &[&str]| {
            let mut arguments = vec!["run", scene.as_str()];
            arguments.extend(more);
            let output = proctor(&arguments);
            if code(&output) == 2 && stderr(&output).contains("this machine has no") {
                return None;
            }
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            let text = stdout(&output);
            let line = text.lines().find(|line| line.starts_with("state hash"));
            Some(line.expect("a hash").to_owned())
        };
        let one = hash(&["--threads", "1"]);
        assert!(one.is_some());
        for threads in ["2", "3", "5"] {
            assert_eq!(
                hash(&["--threads", threads]),
                one,
                "{threads} threads, {method}"
            );
        }
        for lanes in ["scalar", "avx2", "avx512"] {
            let found = hash(&["--lanes", lanes, "--threads", "2"]);
            assert!(found.is_none() || found == one, "{lanes}, {method}");
            assert!(lanes != "scalar" || found.is_some());
        }
    }
}

/// A scene that would run for minutes.
fn endless() -> Value {
    let mut scene = column(&json!({}));
    scene["time"] = json!(4000.0);
    scene["results"]["print"] = json!(999_999);
    scene
}

/// Waits until a file is there.
fn wait_for(path: &std::path::Path) {
    let start = Instant::now();
    while !path.exists() {
        assert!(
            start.elapsed() < Duration::from_secs(30),
            "{} never came",
            path.display()
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_killed_run_leaves_no_half_file() {
    let desk = Desk::new();
    let scene = desk.scene("scene.json", &endless());
    for wait in [0, 7, 23] {
        let out = desk.path(&format!("out{wait}"));
        let mut child = command(&["run", &scene, "--out", &out.display().to_string()])
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("starts");
        wait_for(&out.join("particles_000003.vtu"));
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().expect("killed");
        child.wait().expect("ended");
        for entry in fs::read_dir(&out).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path
                .file_name()
                .and_then(|n| n.to_str())
                .expect("a name")
                .to_owned();
            let bytes = fs::read(&path).expect("read");
            let kind = path.extension().and_then(|e| e.to_str());
            if matches!(kind, Some("vtu" | "pvd")) {
                assert!(bytes.ends_with(b"</VTKFile>\n"), "{name} is half");
            } else {
                // A temporary is no result; the next run into the folder removes it.
                assert!(
                    ["history.csv", "checkpoint.bin"].contains(&name.as_str())
                        || name.starts_with(".proctor-"),
                    "{name}"
                );
            }
        }
        // The checkpoint is whole: a run whose end lies before it goes on from it, and is over at once.
        let checkpoint = out.join("checkpoint.bin").display().to_string();
        let mut over = endless();
        over["time"] = json!(0.001);
        let over = desk.scene("over.json", &over);
        let output = proctor(&["run", &over, "--restart", &checkpoint]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_says_so() {
    for (signal, expected) in [("-INT", 130), ("-TERM", 143)] {
        let desk = Desk::new();
        let scene = desk.scene("scene.json", &endless());
        let out = desk.path("out");
        let child = command(&["run", &scene, "--out", &out.display().to_string()])
            .stdout(std::process::Stdio::piped())
            .spawn()
            .expect("starts");
        wait_for(&out.join("particles_000001.vtu"));
        let id = child.id().to_string();
        let killed = std::process::Command::new("kill")
            .args([signal, &id])
            .status();
        assert!(killed.expect("kill runs").success());
        let output = child.wait_with_output().expect("ended");
        assert_eq!(code(&output), expected);
        assert_eq!(desk.summary("out")["status"], "interrupted");
        // With what to go on from.
        let checkpoint = out.join("checkpoint.bin");
        assert!(checkpoint.is_file());
        let text = stdout(&output);
        assert!(text.contains("interrupted"), "{text}");
        let words = format!("--restart {}", checkpoint.display());
        assert!(text.contains(&words), "{words}: {text}");
    }
}

#[test]
fn the_manual_box_runs_as_printed() {
    let desk = Desk::new();
    let scene = fixture("fixtures/scenes/manual/boussinesq.json");
    let output = desk.run(&scene, "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let summary = desk.summary("out");
    assert_eq!(summary["particles"], 8000);
    assert_eq!(summary["time"], 0.025);
}

/// The balance closes in the summary, stands in the last row of the history too, and is told with its remainder.
#[test]
fn the_energy_balance_closes_and_is_told_by_channel() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["gravity"] = json!([0, -2]);
    scene["damping"] = json!({ "type": "viscous", "value": 8 });
    scene
        .as_object_mut()
        .expect("an object")
        .remove("time_step");
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let energy = desk.summary("out")["energy"].clone();
    let of = |key: &str| {
        energy[key]
            .as_f64()
            .unwrap_or_else(|| panic!("{key}: {energy}"))
    };
    let start = 0.5 * 0.4 * 0.3 * 1000.0;
    let present = of("kinetic") + of("strain") + of("contact");
    let missing = start + of("external_work") - present;
    assert!(
        (missing - of("dissipated")).abs() < 1e-9 * start,
        "{energy}"
    );
    let channels = [
        "damping",
        "friction",
        "impact",
        "plastic",
        "removed",
        "remainder",
    ]
    .map(of);
    let sum: f64 = channels.iter().sum();
    assert!((sum - of("dissipated")).abs() < 1e-9 * start, "{energy}");
    assert!(
        of("damping") > 0.9 * start && of("remainder").abs() < 1e-3 * start,
        "{energy}"
    );
    let history = fs::read_to_string(desk.path("out").join("history.csv")).expect("a history");
    let cells = |line: Option<&str>| -> Vec<String> {
        line.unwrap_or_default()
            .split(',')
            .map(str::to_owned)
            .collect()
    };
    let (names, row) = (cells(history.lines().next()), cells(history.lines().last()));
    for key in [
        "kinetic",
        "contact",
        "external_work",
        "damping",
        "remainder",
    ] {
        let place = names
            .iter()
            .position(|name| *name == format!("energy_{key}"));
        let value: f64 = row[place.expect("a column")].parse().expect("a number");
        assert_eq!(value, of(key), "{key}");
    }
    let text = stdout(&output);
    assert!(
        text.contains(" J: damping ") && text.contains(", remainder "),
        "{text}"
    );
}

/// A body that is crushed under its own weight is told once, in the summary and on the terminal, with particle, step and
/// time.
#[test]
fn a_crushed_body_is_told_once() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["gravity"] = json!([0, -9.81]);
    scene["time"] = json!(2);
    scene
        .as_object_mut()
        .expect("an object")
        .remove("time_step");
    scene["material"][0]["young"] = json!(1e3);
    scene["body"][0] = json!({
        "type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0], "point_p2": [2, 1]
    });
    scene["mesh"]["boundary_conditions"] = json!({});
    let output = desk.run(&desk.scene("scene.json", &scene), "out", &[]);
    let text = stdout(&output);
    let summary = desk.summary("out");
    let events = summary["events"].as_array().expect("a list");
    let crushed: Vec<&Value> = events
        .iter()
        .filter(|event| event["kind"] == "volume_ratio")
        .collect();
    assert_eq!(crushed.len(), 1, "{summary}");
    assert!(crushed[0]["particle"].is_u64() && crushed[0]["time"].as_f64() > Some(0.0));
    // A long line goes on below its beginning.
    let whole = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(
        whole.matches("of its volume at the start").count(),
        1,
        "{text}"
    );
    let step = format!("step {}, ", crushed[0]["step"]);
    assert!(whole.contains(&step), "{text}");
}

/// Bodies that overlap by more than a quarter of a cell are an event of the summary and one line on the terminal, and a
/// restart keeps the event.
#[test]
fn an_overlap_is_an_event_and_a_line() {
    let desk = Desk::new();
    let mut scene = flying_block();
    scene["time"] = json!(0.02);
    scene["contact_manager"] = json!({ "real_distance_correction_coefficient": 2.5 });
    let block = |id: i64, from: f64, speed: f64| {
        json!({
            "type": "rectangle", "id": id, "material_id": 1, "point_p1": [from, 0.3], "point_p2": [from + 0.4, 0.6],
            "initial_velocity": [speed, 0],
        })
    };
    scene["body"] = json!([block(1, 0.5, 0.5), block(2, 0.9, -0.5)]);
    scene["contact"] = json!([{ "id": 1, "friction": 0, "master_id": 1, "slave_id": 2 }]);
    let file = desk.scene("scene.json", &scene);
    let output = desk.run(&file, "out", &[]);
    let checkpoint = desk.path("out").join("checkpoint.bin");
    let again = desk.run(
        &file,
        "again",
        &["--restart", &checkpoint.to_string_lossy()],
    );
    for (output, folder) in [(output, "out"), (again, "again")] {
        let text = stdout(&output);
        let summary = desk.summary(folder);
        let events = summary["events"].as_array().expect("a list");
        let overlaps = events.iter().filter(|event| event["kind"] == "overlap");
        // Particles are 0.05 m apart where bodies touch at 0.25 m.
        let deep = "bodies 1 and 2, which are in contact, overlap by 2.0000e-1 m";
        assert_eq!(overlaps.count(), 1, "{summary}");
        let whole = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(whole.matches(deep).count(), 1, "{text}");
    }
}
