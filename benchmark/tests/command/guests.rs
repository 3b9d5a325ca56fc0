//! Other solvers: what they are handed, what is kept of them, and what the harness finds wrong with them.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// A stand-in for another solver that does one thing wrong; see the file.
fn stand_in(wrong: &str) -> Value {
    let script = fixture("fixtures/bench/flight.awk");
    let wrong = format!("wrong={wrong}");
    json!({ "command": ["awk", "-v", "out={out}", "-v", wrong, "-f", script, "{scene}"] })
}

/// `proctor bench` with one guest on one scene: exit code, text, and the rows of the guest.
fn bench(desk: &Desk, guest: &Value, scene: &str) -> (i32, String, Vec<Value>) {
    let config = desk.scene(
        "bench.json",
        &json!({ "executables": { "guest": guest }, "scenes": scene, "particles": 64, "threads": 1 }),
    );
    let (json, keep) = (desk.name("b.json"), desk.name("kept"));
    let output = proctor(&["bench", &config, "--json", &json, "--keep", &keep]);
    let text = format!("{}{}", stdout(&output), stderr(&output));
    let record = fs::read_to_string(json).unwrap_or_else(|error| panic!("{error}: {text}"));
    let record: Value = serde_json::from_str(&record).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows").clone();
    let of_guest = |row: &Value| {
        row["name"]
            .as_str()
            .is_some_and(|n| n.starts_with("guest/"))
    };
    (
        code(&output),
        text,
        rows.into_iter().filter(of_guest).collect(),
    )
}

/// Reason for which the first row of a guest failed.
fn reason(rows: &[Value]) -> String {
    let failed = rows.iter().find_map(|row| row["error_message"].as_str());
    failed.unwrap_or_else(|| panic!("{rows:?}")).to_owned()
}

/// All files of a name below a folder.
pub fn found(folder: &std::path::Path, name: &str) -> Vec<std::path::PathBuf> {
    let mut files = vec![];
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(found(&path, name));
        } else if path.file_name().is_some_and(|n| n == name) {
            files.push(path);
        }
    }
    files
}

#[test]
fn what_a_guest_says_on_either_output_is_kept_and_told_when_it_fails() {
    let desk = Desk::new();
    let said = "echo warming up >&2; echo five planes have no condition";
    for end in ["exit 1", "exit 0"] {
        let guest = json!({ "command": ["sh", "-c", format!("{said}; {end}"), "{scene}"] });
        let (exit, text, rows) = bench(&desk, &guest, "rest-2d");
        assert_eq!(exit, 1, "{text}");
        let reason = reason(&rows);
        for words in ["five planes have no condition", "warming up"] {
            assert!(reason.contains(words), "{end}: {reason}");
            assert!(text.contains(words), "{end}: {text}");
        }
        let kept = found(&desk.path("kept"), "standard-output.txt");
        let of_guest = kept
            .iter()
            .filter(|path| path.to_string_lossy().contains("guest"));
        let texts: Vec<String> = of_guest
            .map(|path| fs::read_to_string(path).expect("a text"))
            .collect();
        assert!(texts.iter().any(|t| t.contains("five planes")), "{texts:?}");
    }
}

#[test]
fn numbers_in_scenes_for_guests_are_short_decimals() {
    let desk = Desk::new();
    bench(&desk, &stand_in(""), "moving-3d");
    let scenes = found(&desk.path("kept"), "scene.json");
    assert!(!scenes.is_empty());
    for path in scenes {
        let text = fs::read_to_string(&path).expect("a scene");
        let numbers = text.split(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
        for number in numbers {
            let (mantissa, _) = number.split_once(['e', 'E']).unwrap_or((number, ""));
            let digits = mantissa.replace(['.', '-', '+'], "");
            let digits = digits.trim_start_matches('0');
            assert!(digits.len() <= 15, "{number} in {text}");
        }
        assert!(text.contains("0.3"), "{text}");
    }
}

#[test]
fn a_scene_for_guests_says_its_step_in_seconds_and_names_every_plane() {
    let desk = Desk::new();
    let scene = desk.scene(
        "fast.json",
        &json!({
            "dimension": 2, "time": 0.1, "time_step_multiplier": 0.25, "particles_per_cell": 2,
            "mesh": {
                "cells_dimension": [0.1, 0.1], "cells_number": [12, 12],
                "boundary_conditions": { "plane_Yn": "free" }
            },
            "material": [{ "type": "elastic", "id": 1, "young": 1e6, "density": 1000, "poisson": 0.3 }],
            "body": [{
                "type": "cuboid", "id": 1, "material_id": 1, "point_p1": [0.3, 0.3],
                "point_p2": [0.6, 0.6], "initial_velocity": [3.0, 0.0]
            }]
        }),
    );
    let (exit, text, _) = bench(&desk, &stand_in(""), &scene);
    assert_eq!(exit, 0, "{text}");
    let scenes = found(&desk.path("kept/fast"), "scene.json");
    let written = fs::read_to_string(&scenes[0]).expect("a scene");
    let written: Value = serde_json::from_str(&written).expect("JSON");
    assert!(written.get("time_step_multiplier").is_none(), "{written}");
    let dt = written["time_step"].as_f64().expect("a step");
    // 0.25 h/(c + |v|), c² = 1.346e6/1000.
    let bound = 0.25 * 0.1 / (1.346_153_846e3_f64.sqrt() + 3.0);
    assert!(
        dt <= bound * (1.0 + 1e-9) && dt > 0.95 * bound,
        "{dt} {bound}"
    );
    let steps = written["time"].as_f64().expect("a time") / dt;
    assert!((steps - steps.round()).abs() < 1e-6, "{steps} steps");
    let planes = &written["mesh"]["boundary_conditions"];
    for (plane, words) in [
        ("plane_X0", "sliding"),
        ("plane_Xn", "sliding"),
        ("plane_Y0", "sliding"),
        ("plane_Yn", "free"),
    ] {
        assert_eq!(planes[plane], words, "{planes}");
    }
}

#[test]
fn the_error_is_that_at_the_time_of_the_particles_not_at_their_label() {
    let desk = Desk::new();
    let mut guest = stand_in("label");
    guest["time_label"] = json!("one step late");
    let (exit, text, rows) = bench(&desk, &guest, "moving-3d");
    assert_eq!(exit, 0, "{text}");
    let errors: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["error_l2_displacement"].as_f64())
        .collect();
    assert_eq!(errors.len(), 3);
    assert!(errors.iter().all(|&error| error < 1e-9), "{errors:?}");
    // Its last frame is not of the time of ours.
    assert!(
        rows.iter()
            .all(|row| row.get("difference_l2_displacement").is_none())
    );
    assert!(text.contains("frames of different times"), "{text}");
}

#[test]
fn a_label_that_is_no_label_is_bad_input() {
    let desk = Desk::new();
    let mut guest = stand_in("");
    guest["time_label"] = json!("one step lat");
    let config = desk.scene("bench.json", &json!({ "executables": { "guest": guest } }));
    let output = proctor(&["bench", &config]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    for words in [
        "bench.json:",
        "executables.guest.time_label",
        "one step lat",
        "`one step late`",
        "`frame`",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn the_calibration_finds_each_thing_that_a_guest_does_wrong() {
    let desk = Desk::new();
    for (wrong, words) in [
        ("refuse", "five planes have no condition"),
        ("label", "\"time_label\": \"one step late\""),
        ("particles", "42 particles where the scene has 36"),
        ("gravity", "falls with 0 m/s² where `gravity` is -9.81 m/s²"),
        ("velocity", "initial_velocity"),
        ("length", "1000 times the lengths"),
        ("clock", "1000 times the time"),
        ("end", "at 0.03 s where the scene ends at 0.04 s"),
    ] {
        let (exit, text, rows) = bench(&desk, &stand_in(wrong), "moving-2d");
        assert_eq!(exit, 1, "{wrong}: {text}");
        let reason = reason(&rows);
        assert!(reason.starts_with("calibration: "), "{wrong}: {reason}");
        assert!(reason.contains(words), "{wrong}: {reason}");
        // Nothing but the calibration was run.
        assert!(
            rows.iter().all(|row| row["error_occurred"] == true),
            "{wrong}: {rows:?}"
        );
        assert!(!text.contains("panicked"), "{wrong}: {text}");
    }
    let (exit, text, rows) = bench(&desk, &stand_in(""), "moving-2d");
    assert_eq!(exit, 0, "{text}");
    assert!(
        rows.iter().all(|row| row.get("error_occurred").is_none()),
        "{rows:?}"
    );
}

/// `proctor precision` of a case in short with executables: exit code, text, record.
pub fn precision(desk: &Desk, case: &str, executables: &Value) -> (i32, String, Value) {
    let config = desk.scene("guests.json", &json!({ "executables": executables }));
    let [json, csv, svg, keep] = ["p.json", "p.csv", "charts", "kept"].map(|name| desk.name(name));
    let output = proctor(&[
        "precision",
        case,
        "--quick",
        "--repetitions",
        "1",
        "--executables",
        &config,
        "--json",
        &json,
        "--csv",
        &csv,
        "--svg",
        &svg,
        "--keep",
        &keep,
    ]);
    let text = format!("{}{}", stdout(&output), stderr(&output));
    let record = fs::read_to_string(json).unwrap_or_else(|error| panic!("{error}: {text}"));
    (
        code(&output),
        text,
        serde_json::from_str(&record).expect("JSON"),
    )
}

/// `proctor run` behind a script that does something else with the scene or the frames.
fn wrapped(script: &str) -> Value {
    let proctor = env!("CARGO_BIN_EXE_proctor");
    json!({ "command": ["sh", "-c", script, proctor, "{scene}", "{out}"] })
}

/// Errors of an executable on a case, coarse to fine.
pub fn errors(record: &Value, case: &str, name: &str, measure: &str) -> Vec<f64> {
    let start = format!("precision/{case}/peer/{name}/");
    let rows = record["benchmarks"].as_array().expect("rows").iter();
    rows.filter(|row| row["name"].as_str().is_some_and(|n| n.starts_with(&start)))
        .filter_map(|row| row[format!("error_{measure}")].as_f64())
        .collect()
}

#[test]
fn guests_stand_in_chart_and_table_of_a_case_with_their_error_and_time() {
    let desk = Desk::new();
    // The label of each frame is that of one step before its particles.
    let late = "dt=$(sed -n 's/.*\"time_step\": *\\([-+.0-9eE]*\\),*/\\1/p' $1); $0 run $1 --out $2 --threads 1 && \
                awk -v dt=$dt '{ if (match($0, /timestep=\"[^\"]*\"/)) { t = substr($0, RSTART + 10, RLENGTH - 11); \
                printf \"%stimestep=\\\"%.12g\\\"%s\\n\", substr($0, 1, RSTART - 1), t - dt, \
                substr($0, RSTART + RLENGTH) } else print }' $2/particles.pvd > $2/new && \
                mv $2/new $2/particles.pvd";
    let mut labelled = wrapped(late);
    labelled["time_label"] = json!("one step late");
    let (exit, text, record) = precision(
        &desk,
        "sudden-weight",
        &json!({ "same": env!("CARGO_BIN_EXE_proctor"), "late": labelled, "wrong": wrapped(late) }),
    );
    // One of them is not what it says, and only that one is left out.
    assert_eq!(exit, 1, "{text}");
    assert!(text.contains("FAIL  wrong: calibration: "), "{text}");
    assert!(
        text.contains("\"time_label\": \"one step late\" fits"),
        "{text}"
    );
    let own = errors(&record, "sudden-weight", "proctor", "displacement");
    assert_eq!(own.len(), 3, "{text}");
    assert!(own[2] < 0.01 && own[2] < 0.5 * own[0], "{own:?}");
    assert_eq!(
        errors(&record, "sudden-weight", "same", "displacement"),
        own
    );
    let late = errors(&record, "sudden-weight", "late", "displacement");
    for (late, own) in late.iter().zip(&own) {
        assert!((late / own - 1.0).abs() < 1e-4, "{late} {own}");
    }
    assert_eq!(late.len(), 3);
    assert_eq!(
        errors(&record, "sudden-weight", "wrong", "displacement").len(),
        0
    );
    for name in ["proctor (process)", "same (process)", "late (process)"] {
        assert!(text.contains(name), "{name}: {text}");
        let chart = fs::read_to_string(desk.path("charts/sudden-weight-displacement.svg"));
        assert!(chart.expect("a chart").contains(name), "{name}");
    }
    // The second error is that of the stress, of the same frames.
    let chart = fs::read_to_string(desk.path("charts/sudden-weight-stress.svg")).expect("a chart");
    assert!(chart.contains("same (process)"));
    let own = errors(&record, "sudden-weight", "proctor", "stress");
    assert!(own.len() == 3 && own[2] < 0.02, "{own:?}");
    assert_eq!(errors(&record, "sudden-weight", "same", "stress"), own);
    let csv = fs::read_to_string(desk.path("p.csv")).expect("values");
    for measure in ["displacement", "stress"] {
        let of_same = |line: &&str| line.ends_with(",same") && line.contains(measure);
        assert_eq!(csv.lines().filter(of_same).count(), 3, "{measure}");
    }
}

/// Frames of which only some hold stresses are judged by what they hold: a solver without them by its displacements
/// alone.
#[test]
fn a_stress_that_is_off_is_seen_and_one_that_is_missing_is_no_error() {
    let desk = Desk::new();
    let only = |change: &str| {
        wrapped(&format!(
            "case $1 in *calibration*) $0 run $1 --out $2;; *) sed '{change}' $1 > $2/other.json; \
             $0 run $2/other.json --out $2;; esac"
        ))
    };
    let (exit, text, record) = precision(
        &desk,
        "bar",
        &json!({
            "without": only("s/\"stress\"/\"pressure\"/"),
            // Twice as stiff and as dense: the same motion by twice the stress.
            "heavy": only("s/\"young\": 100.0/\"young\": 200.0/; s/\"density\": 1.0/\"density\": 2.0/"),
        }),
    );
    assert_eq!(exit, 0, "{text}");
    let of = |name: &str, measure: &str| errors(&record, "bar", name, measure);
    let (own, own_stress) = (of("proctor", "displacement"), of("proctor", "stress"));
    assert!(own.len() == 3 && own[2] < 0.01, "{own:?}");
    assert!(
        own_stress.len() == 3 && own_stress[2] < 0.04,
        "{own_stress:?}"
    );
    assert_eq!(of("without", "displacement"), own);
    assert!(of("without", "stress").is_empty());
    for (heavy, own) in of("heavy", "displacement").iter().zip(&own) {
        assert!((heavy / own - 1.0).abs() < 1e-6, "{heavy} {own}");
    }
    let off = of("heavy", "stress");
    let is_off = |error: &f64| (error - 1.0).abs() < 0.2;
    assert!(off.len() == 3 && off.iter().all(is_off), "{off:?}");
    let frames = found(&desk.path("kept/bar"), "particles.pvd");
    let finest = |path: &&std::path::PathBuf| {
        let path = path.to_string_lossy();
        path.contains("l_h_32") && path.contains("heavy")
    };
    let frames = frames.iter().find(finest).expect("frames");
    let folder = frames.parent().expect("a folder").display().to_string();
    let output = proctor(&["judge", "bar", &folder]);
    let said = stdout(&output);
    assert_eq!(code(&output), 0, "{said}{}", stderr(&output));
    assert!(
        said.contains("PASS  bar") && said.contains("of the stress"),
        "{said}"
    );
}

#[test]
#[ignore = "takes 10 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn the_cases_that_solvers_know_can_be_handed_over() {
    for (case, measure, bound) in [
        ("step-bar", "displacement", 0.05),
        ("inclined-block", "displacement", 0.01),
        ("base-acceleration", "velocity", 0.02),
    ] {
        let desk = Desk::new();
        let same = json!({ "same": env!("CARGO_BIN_EXE_proctor") });
        let (exit, text, record) = precision(&desk, case, &same);
        assert_eq!(exit, 0, "{case}: {text}");
        let (own, same) = (
            errors(&record, case, "proctor", measure),
            errors(&record, case, "same", measure),
        );
        assert!(own.len() >= 2 && own == same, "{case}: {own:?} {same:?}");
        assert!(own[own.len() - 1] < bound, "{case}: {own:?}");
    }
}

#[test]
fn a_guest_that_fails_on_a_case_is_a_failed_run_with_its_reason() {
    let desk = Desk::new();
    // It passes the calibration, and then takes another mesh, stops early or does not know the load.
    let only = |change: &str| {
        format!(
            "case $1 in *calibration*) $0 run $1 --out $2;; *) sed '{change}' $1 > $2/other.json; \
             $0 run $2/other.json --out $2;; esac"
        )
    };
    let (exit, text, _) = precision(
        &desk,
        "step-bar",
        &json!({
            "refuses": wrapped("case $1 in *calibration*) $0 run $1 --out $2;; *) echo no such load; exit 3;; esac"),
            "early": wrapped(&only("s/\"time\": [0-9.e-]*/\"time\": 0.001/")),
        }),
    );
    assert_eq!(exit, 1, "{text}");
    // A line ends where the table does.
    let words: Vec<&str> = text.split_whitespace().collect();
    let words = words.join(" ");
    for expected in [
        "FAIL refuses, ",
        "on standard output: no such load",
        "FAIL early, ",
        "where the scene ends at 0.02372 s",
    ] {
        assert!(words.contains(expected), "{expected}: {text}");
    }
}

#[test]
fn a_case_that_solvers_cannot_run_says_why() {
    let desk = Desk::new();
    let same = json!({ "same": env!("CARGO_BIN_EXE_proctor") });
    let (exit, text, _) = precision(&desk, "hertz", &same);
    assert_eq!(exit, 0, "{text}");
    assert!(
        text.contains("not for other solvers: only the pressure of the contact is known"),
        "{text}"
    );
}

#[test]
fn a_configuration_without_executables_is_bad_input() {
    let desk = Desk::new();
    let empty = desk.scene("empty.json", &json!({}));
    for file in [desk.name("no-such.json"), empty] {
        let output = proctor(&["precision", "bar", "--quick", "--executables", &file]);
        assert_eq!(code(&output), 2, "{}", stderr(&output));
        assert!(stderr(&output).contains(&file), "{}", stderr(&output));
        assert_eq!(stdout(&output), "");
    }
}
