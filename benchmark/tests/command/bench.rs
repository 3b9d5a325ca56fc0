//! `proctor bench`: tables, records, other solvers, exit codes.

use crate::command::support::{Desk, code, command, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::path::Path;

fn record(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("a record")).expect("JSON")
}

/// The rows of a record that have a word in their name.
fn rows(record: &Value, word: &str) -> Vec<Value> {
    let rows = record["benchmarks"].as_array().expect("rows");
    rows.iter()
        .filter(|row| row["name"].as_str().is_some_and(|name| name.contains(word)))
        .cloned()
        .collect()
}

fn config(desk: &Desk, config: &Value) -> String {
    desk.scene("bench.json", config)
}

#[test]
fn every_sample_is_a_row_and_the_repetitions_are_interleaved() {
    let desk = Desk::new();
    let config = config(
        &desk,
        &json!({
            "scenes": ["rest-2d", "moving-3d"], "particles": 300, "threads": [1, 2],
            "stages": "p2g", "particle_steps": 1000
        }),
    );
    let (json, csv) = (desk.name("b.json"), desk.name("b.csv"));
    let output = proctor(&["bench", &config, "--json", &json, "--csv", &csv]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for line in stdout(&output).lines() {
        assert!(
            line.chars().count() <= 110 || line.starts_with("written"),
            "{line}"
        );
    }
    let record = record(&desk.path("b.json"));
    assert!(record["context"].get("incomplete").is_none());
    let samples = rows(&record, "-");
    assert_eq!(samples.len(), 2 * 2 * 2 * 3);
    let repetitions: Vec<u64> = samples
        .iter()
        .map(|row| row["repetition_index"].as_u64().expect("a number"))
        .collect();
    let mut sorted = repetitions.clone();
    sorted.sort_unstable();
    assert_eq!(
        repetitions, sorted,
        "one repetition of everything after the other"
    );
    let step = &rows(&record, "moving-3d/300/uGIMP/USL/FLIP/threads:2")[0];
    for key in [
        "particles",
        "steps",
        "wall_ns_per_particle_step",
        "cpu_ns_per_particle_step",
        "particle_steps_per_second",
        "bytes_per_particle",
        "ns_p2g_solve",
        "ns_g2p",
        "ns_sort",
        "share_of_bandwidth",
        "share_of_arithmetic",
        "real_time",
        "cpu_time",
    ] {
        assert!(
            step[key].as_f64().is_some_and(|x| x >= 0.0),
            "{key}: {step}"
        );
    }
    // Phases are parts of the whole.
    let names = [
        "contact",
        "time_step",
        "sort",
        "p2g_solve",
        "remap",
        "g2p",
        "finish",
    ];
    let phases: f64 = names
        .iter()
        .map(|phase| step[format!("ns_{phase}")].as_f64().expect("a number"))
        .sum();
    assert!(
        phases
            <= step["wall_ns_per_particle_step"]
                .as_f64()
                .expect("a number")
    );
    let table = std::fs::read_to_string(desk.path("b.csv")).expect("a table");
    assert_eq!(
        table.lines().count(),
        1 + record["benchmarks"].as_array().expect("rows").len()
    );
}

#[test]
fn the_manuals_configuration_runs() {
    let output = proctor(&[
        "bench",
        &fixture("fixtures/bench/benchmark-configuration.json"),
        "--quick",
        "--log",
    ]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("NodalMomentum"));
    assert!(
        stderr(&output).contains("default: global.particleMass"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn another_solver_stands_in_the_same_table_with_its_error() {
    let desk = Desk::new();
    let json = desk.name("peers.json");
    let output = proctor(&[
        "bench",
        &fixture("fixtures/bench/peers.json"),
        "--json",
        &json,
    ]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let record = record(&desk.path("peers.json"));
    for scene in ["moving-3d", "moving-2d"] {
        for executable in ["proctor", "stand-in"] {
            let samples = rows(&record, &format!("{executable}/{scene}"));
            assert_eq!(samples.len(), 2 * 3, "{executable} {scene}");
            for row in samples {
                let error = row["error_l2_displacement"].as_f64().expect("an error");
                assert!(error < 1e-12, "{row}");
                assert!(row["cpu_time"].as_f64().expect("a time") > 0.0, "{row}");
                assert!(
                    row["peak_rss_bytes"].as_f64().expect("memory") > 1e5,
                    "{row}"
                );
            }
        }
        let peer = &rows(&record, &format!("stand-in/{scene}"))[0];
        assert!(
            peer["difference_l2_displacement"]
                .as_f64()
                .expect("a difference")
                < 1e-12
        );
    }
}

#[test]
fn another_proctor_does_the_same_bit_by_bit() {
    let desk = Desk::new();
    let config = config(
        &desk,
        &json!({
            "executables": { "same": env!("CARGO_BIN_EXE_proctor") },
            "scenes": "column-2d", "particles": 256, "threads": 1
        }),
    );
    let output = proctor(&["bench", &config, "--json", &desk.name("b.json")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    let (own, same) = (
        rows(&record, "proctor/column"),
        rows(&record, "same/column"),
    );
    assert_eq!((own.len(), same.len()), (3, 3));
    assert_eq!(own[0]["state_hash"], same[0]["state_hash"]);
    assert_eq!(same[0]["difference_l2_displacement"], 0.0);
    let error = own[0]["error_l2_displacement"].as_f64().expect("an error");
    assert!(error > 0.0 && error < 0.1, "{error}");
}

#[cfg(unix)]
#[test]
fn a_solver_that_does_not_end_is_ended_with_all_that_it_started() {
    let desk = Desk::new();
    let started = desk.name("started");
    // A child of the child, which writes down its number.
    let script = format!("sleep 1000 & echo $! > {started}; wait");
    let config = config(
        &desk,
        &json!({
            "executables": {
                "endless": { "command": ["sh", "-c", script, "{scene}"], "timeout": 0.5 }
            },
            "scenes": "rest-2d", "particles": 64, "threads": 1
        }),
    );
    let begun = std::time::Instant::now();
    let output = proctor(&["bench", &config, "--json", &desk.name("b.json")]);
    assert!(begun.elapsed().as_secs() < 100, "{:?}", begun.elapsed());
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    assert_eq!(rows(&record, "proctor/rest-2d").len(), 3);
    let row = &rows(&record, "endless/")[0];
    assert_eq!(row["error_occurred"], true);
    let said = row["error_message"].as_str().expect("a reason");
    assert!(said.contains("not done after 0.5 s"), "{said}");
    let number = std::fs::read_to_string(started).expect("it started");
    // Nobody waits for it, so it may be a zombie for a while; but it sleeps no more.
    let still = std::process::Command::new("sh")
        .args([
            "-c",
            "case $(ps -o stat= -p $0) in ''|Z*) exit 1;; esac",
            number.trim(),
        ])
        .status()
        .expect("a shell");
    assert!(!still.success(), "{number} still sleeps");
}

#[test]
fn a_timeout_that_is_no_time_is_bad_input() {
    let desk = Desk::new();
    for timeout in [json!(0), json!(-1), json!(1e300), json!("long")] {
        let config = config(
            &desk,
            &json!({
                "executables": { "x": { "command": ["true", "{scene}"], "timeout": timeout } },
                "scenes": "rest-2d", "particles": 64, "threads": 1
            }),
        );
        let output = proctor(&["bench", &config]);
        assert_eq!(code(&output), 2, "{timeout}: {}", stderr(&output));
        assert!(
            stderr(&output).contains("executables.x"),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn counts_beyond_all_measure_are_bad_input() {
    let desk = Desk::new();
    for key in ["particles", "repetitions", "warm_up", "threads"] {
        let mut values = json!({ "scenes": "rest-2d", "particles": 64, "threads": 1 });
        values[key] = json!(u64::MAX);
        let output = proctor(&["bench", &config(&desk, &values)]);
        assert_eq!(code(&output), 2, "{key}: {}", stderr(&output));
        assert!(stderr(&output).contains(key), "{}", stderr(&output));
    }
    let manual = config(
        &desk,
        &json!({ "global": { "numParticles": 1_000_000_000_000_000_u64 } }),
    );
    let output = proctor(&["bench", &manual]);
    assert_eq!(code(&output), 2, "{}", stderr(&output));
    assert!(stderr(&output).contains("PiB"), "{}", stderr(&output));
}

#[test]
fn a_solver_that_fails_is_a_row_with_its_reason_and_the_rest_goes_on() {
    let desk = Desk::new();
    let config = config(
        &desk,
        &json!({
            "executables": {
                "missing": "no/such/proctor",
                "17": "17847226555",
                "angry": { "command": ["sh", "-c", "echo too hot >&2; exit 3", "{scene}"] },
                "lazy": { "command": ["true", "{scene}"] }
            },
            "scenes": "rest-2d", "particles": 64, "threads": 1
        }),
    );
    let output = proctor(&["bench", &config, "--json", &desk.name("b.json")]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    assert_eq!(rows(&record, "proctor/rest-2d").len(), 3);
    for (name, reason) in [
        ("missing/", "cannot start"),
        ("17/", "artifact"),
        ("angry/", "too hot"),
        ("lazy/", "no .vtu frame"),
    ] {
        let row = &rows(&record, name)[0];
        assert_eq!(row["error_occurred"], true, "{name}");
        let said = row["error_message"].as_str().expect("a reason");
        assert!(said.contains(reason), "{name}: {said}");
        assert!(stdout(&output).contains(reason));
    }
}

#[test]
fn bad_input_runs_nothing_and_writes_nothing() {
    let desk = Desk::new();
    let config = config(&desk, &json!({ "scenes": "no/such.json", "threads": 0 }));
    let output = proctor(&["bench", &config, "--json", &desk.name("b.json")]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(
        said.contains("no/such.json") && said.contains("threads: found 0"),
        "{said}"
    );
    assert!(!desk.path("b.json").exists());
    assert_eq!(stdout(&output), "");
    for wrong in [
        &["--threads", "0"],
        &["--repetitions", "2"],
        &["--lanes", "mmx"],
    ] {
        assert_eq!(
            code(&proctor(&["bench", wrong[0], wrong[1]])),
            2,
            "{wrong:?}"
        );
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_valid_record_that_says_it_is_incomplete() {
    let desk = Desk::new();
    let json = desk.name("b.json");
    let config = config(
        &desk,
        &json!({ "scenes": "rest-2d", "particles": 2000, "threads": 1, "particle_steps": 2_000_000, "repetitions": 1000 }),
    );
    let mut child = command(&["bench", &config, "--json", &json])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .expect("the command starts");
    // The record is there, empty, before the first sample; a little later some have been taken.
    while !desk.path("b.json").exists() {
        assert!(
            child.try_wait().expect("a child").is_none(),
            "it ended early"
        );
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert_eq!(record(&desk.path("b.json"))["context"]["incomplete"], true);
    std::thread::sleep(std::time::Duration::from_secs(3));
    let killed = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill");
    assert!(killed.success());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(code(&output), 130);
    let record = record(&desk.path("b.json"));
    assert_eq!(record["context"]["incomplete"], true);
    assert!(rows(&record, "rest-2d").len() < 1000);
    assert!(stdout(&output).contains("interrupted"));
}

/// Scenes with surfaces and particles in other files, as `run` takes them.
#[test]
fn scenes_that_name_files_are_measured() {
    let desk = Desk::new();
    let scenes = ["sphere_on_terrain", "sliding_block", "rolling_ball_3d"]
        .map(|name| fixture(&format!("fixtures/scenes/{name}.json")));
    let values = json!({
        "scenes": scenes, "threads": 1, "particle_steps": 1, "warm_up": 1, "repetitions": 3
    });
    let json = desk.name("b.json");
    let output = proctor(&["bench", &config(&desk, &values), "--json", &json]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    for name in ["sphere_on_terrain", "sliding_block", "rolling_ball_3d"] {
        assert_eq!(rows(&record, name).len(), 3, "{name}");
    }
}

/// An executable gets such a scene in another folder, with names of files that hold there too and without comments.
#[test]
fn a_scene_that_names_files_can_be_handed_over() {
    let desk = Desk::new();
    let scenes = desk.path("scenes");
    std::fs::create_dir(&scenes).expect("a folder");
    std::fs::copy(
        fixture("fixtures/surfaces/plane.stl"),
        scenes.join("plane.stl"),
    )
    .expect("a copy");
    let mut scene: Value = serde_json::from_str(
        &std::fs::read_to_string(fixture("fixtures/scenes/rolling_ball_3d.json")).expect("a scene"),
    )
    .expect("JSON");
    scene["time"] = json!(0.01);
    scene["comment"] = json!("not every program knows this key");
    scene["rigid_surface"]["plane"]["stl_mesh"] = json!("plane.stl");
    desk.scene("scenes/ball.json", &scene);
    let values = json!({
        "executables": { "other": { "command": ["false", "{scene}"] } },
        "scenes": "scenes/ball.json", "threads": 1
    });
    let output = proctor(&[
        "bench",
        &config(&desk, &values),
        "--json",
        &desk.name("b.json"),
    ]);
    // The other one solves nothing; this program, which is handed the same file, does.
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    let own = rows(&record, "proctor/ball");
    assert_eq!(own.len(), 3);
    assert!(
        own.iter().all(|row| row["error_occurred"] != true),
        "{own:?}"
    );
}

/// A method that a scene does not go with is told at its place in the file of the user.
#[test]
fn a_scene_that_does_not_go_with_a_method_is_told_at_its_place() {
    let desk = Desk::new();
    let mut scene = crate::command::support::flying_block();
    scene["shape_function"] = json!("cpGIMP");
    scene["domain_update"] = json!("stretch");
    let name = desk.scene("scene.json", &scene);
    let text = std::fs::read_to_string(&name).expect("a scene");
    let line = 1
        + (text.lines())
            .position(|line| line.contains("domain_update"))
            .expect("it is there");
    let values = json!({ "scenes": "scene.json", "threads": 1, "shape_function": "linear" });
    let output = proctor(&["bench", &config(&desk, &values)]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(said.starts_with(&format!("{name}:{line}:")), "{said}");
}

/// Steps that ranks share are rows of their own; stages are played by one rank, and contact that is not local is a failed row.
#[test]
fn ranks_share_the_steps_of_a_scene() {
    let desk = Desk::new();
    let values = json!({
        "scenes": ["moving-2d", "contact-2d", "mortar-2d"], "particles": 1000, "threads": [1, 2], "ranks": [1, 2],
        "particle_steps": 20000, "warm_up": 1, "repetitions": 3, "stages": ["g2p"]
    });
    let json = desk.name("b.json");
    let output = proctor(&["bench", &config(&desk, &values), "--json", &json]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    let record = record(&desk.path("b.json"));
    for scene in ["moving-2d", "contact-2d", "mortar-2d"] {
        for threads in [1, 2] {
            let own = rows(
                &record,
                &format!("{scene}/1000/uGIMP/USL/FLIP/ranks:2/threads:{threads}"),
            );
            // What fails is not tried again.
            let refused = scene == "mortar-2d";
            assert_eq!(
                own.len(),
                if refused { 1 } else { 3 },
                "{scene} on 2 ranks of {threads}"
            );
            for row in own {
                assert_eq!(row["error_occurred"] == true, refused, "{row}");
            }
        }
    }
    let of_stage = rows(&record, "moving-2d/1000/uGIMP/USL/FLIP/g2p/");
    assert_eq!(of_stage.len(), 6, "on one and two threads");
    assert!(
        stdout(&output).contains("2 ranks of 1"),
        "{}",
        stdout(&output)
    );
    assert!(
        stdout(&output).contains("mortar contact"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn ranks_of_a_benchmark_are_a_count() {
    let desk = Desk::new();
    for (ranks, accepted) in [
        (json!([2, 0]), "a whole number, 1 or more"),
        (json!(1000), "at most 256 ranks"),
    ] {
        let values = json!({ "scenes": ["rest-2d"], "ranks": ranks });
        let output = proctor(&["bench", &config(&desk, &values)]);
        assert_eq!(code(&output), 2, "{}", stderr(&output));
        let told = stderr(&output);
        assert!(told.contains("ranks") && told.contains(accepted), "{told}");
    }
}
