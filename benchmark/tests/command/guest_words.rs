//! Solvers that read over a word, and solvers of two dimensions or of thick slabs.

use crate::command::guests::{errors, precision};
use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;

/// `proctor run` of a scene that a script of `sed` has changed.
fn changed(script: &str) -> Value {
    let run =
        format!("sed '{script}' $1 > $2/changed.json && exec $0 run $2/changed.json --out $2");
    let proctor = env!("CARGO_BIN_EXE_proctor");
    json!({ "command": ["sh", "-c", run, proctor, "{scene}", "{out}"] })
}

/// The arena in short on a case: its text with blanks for line ends, and its exit code.
fn arena(case: &str, executables: &Value) -> (i32, String) {
    let desk = Desk::new();
    let config = json!({ "executables": executables, "methods": ["uGIMP USL FLIP"] });
    let config = desk.scene("arena.json", &config);
    let output = proctor(&["arena", &config, case, "--quick"]);
    let text = format!("{}{}", stdout(&output), stderr(&output));
    let words: Vec<&str> = text.split_whitespace().collect();
    (code(&output), words.join(" "))
}

#[test]
fn a_word_that_a_solver_reads_over_is_named_and_the_cases_with_it_are_not_run() {
    let same = changed("");
    for (case, guests) in [
        (
            "step-bar",
            vec![
                (
                    "forceless",
                    "s/^ *20.0,$/0.0,/",
                    "not every `nodal_point_load` acts: two of them along x",
                ),
                (
                    "slippery",
                    "s/\"fixed\"/\"sliding\"/",
                    "`fixed` does not act: a body at such a plane goes 0.01 m",
                ),
                (
                    "sticky",
                    "s/\"sliding\"/\"fixed\"/",
                    "`sliding` does not act",
                ),
            ],
        ),
        (
            "self-weight",
            vec![(
                "undamped",
                "s/\"kinetic\"/\"none\"/",
                "`damping` of the type `kinetic` does not act",
            )],
        ),
        (
            "base-acceleration",
            vec![(
                "still",
                "s/\"active\": true/\"active\": false/",
                "`earthquake` does not act",
            )],
        ),
        (
            "inclined-block",
            vec![(
                "welded",
                "s/\"contact\": \\[/\"contact_manager\": {\"active\": false}, \"contact\": [/",
                "`contact` does not act",
            )],
        ),
    ] {
        let mut executables = json!({ "same": same });
        for (name, script, _) in &guests {
            executables[name] = changed(script);
        }
        let (exit, text) = arena(case, &executables);
        assert_eq!(exit, 1, "{case}: {text}");
        for (name, _, words) in guests {
            let told = format!("FAIL {name}: calibration of words: ");
            assert!(text.contains(&told), "{case}, {told}: {text}");
            assert!(text.contains(words), "{case}, {words}: {text}");
            // Once for the case, not for each mesh.
            assert_eq!(text.matches(&told).count(), 1, "{case}: {text}");
        }
        assert!(!text.contains("FAIL same"), "{case}: {text}");
    }
}

/// A case whose scene lacks the word is run as ever.
#[test]
fn a_solver_that_lacks_a_word_still_runs_the_cases_without_it() {
    let desk = Desk::new();
    let undamped = json!({ "undamped": changed("s/\"kinetic\"/\"none\"/") });
    let (exit, text, record) = precision(&desk, "sudden-weight", &undamped);
    assert_eq!(exit, 0, "{text}");
    assert_eq!(
        errors(&record, "sudden-weight", "undamped", "displacement").len(),
        3,
        "{text}"
    );
}

#[test]
fn problems_in_the_plane_are_had_in_two_dimensions_and_as_thick_slabs() {
    let desk = Desk::new();
    let proctor = env!("CARGO_BIN_EXE_proctor");
    let command = json!([proctor, "run", "{scene}", "--out", "{out}"]);
    let executables = json!({
        "flat": { "command": command, "dimension": 2 },
        "thick": { "command": command, "thickness": 3 },
    });
    let (exit, text, record) = precision(&desk, "step-bar", &executables);
    assert_eq!(exit, 0, "{text}");
    let [own, flat, thick] =
        ["proctor", "flat", "thick"].map(|name| errors(&record, "step-bar", name, "displacement"));
    assert_eq!(own.len(), 3, "{text}");
    // Nothing differs along z, so that all three are one problem.
    for others in [flat, thick] {
        assert_eq!(others.len(), 3, "{text}");
        for (other, own) in others.iter().zip(&own) {
            assert!((other / own - 1.0).abs() < 1e-6, "{others:?} {own:?}");
        }
    }
    let scene = |shape: &str| -> Value {
        let scenes = super::guests::found(&desk.path("kept/step-bar"), "scene.json");
        let path = scenes
            .iter()
            .find(|path| path.to_string_lossy().contains(shape));
        let path = path.unwrap_or_else(|| panic!("{shape}: {scenes:?}"));
        serde_json::from_str(&fs::read_to_string(path).expect("a scene")).expect("JSON")
    };
    assert_eq!(scene("plane")["dimension"], 2);
    assert_eq!(
        scene("plane")["mesh"]["cells_number"]
            .as_array()
            .map(Vec::len),
        Some(2)
    );
    let slab = scene("slab-3");
    assert_eq!(slab["mesh"]["cells_number"][2], 3);
    // The same force over the area: a third each within, a sixth at both sides.
    let loads = slab["nodal_point_load"].as_array().expect("loads");
    let force = |i: usize| loads[i][1][0].as_f64().expect("a force");
    assert!((force(1) / force(0) - 2.0).abs() < 1e-9, "{loads:?}");
}

#[test]
fn a_solver_of_two_dimensions_skips_what_is_not_in_the_plane() {
    let proctor = env!("CARGO_BIN_EXE_proctor");
    let flat = json!({ "flat": {
        "command": [proctor, "run", "{scene}", "--out", "{out}"], "dimension": 2,
    }});
    let (exit, text) = arena("base-acceleration", &flat);
    assert_eq!(exit, 0, "{text}");
    let told =
        "skip flat: a problem in three dimensions, and its `dimension` is 2 (base-acceleration)";
    assert!(text.contains(told), "{text}");
    let desk = Desk::new();
    let (exit, text, _) = precision(&desk, "base-acceleration", &flat);
    assert_eq!(exit, 0, "{text}");
    assert!(
        text.contains("skip  flat: a problem in three dimensions"),
        "{text}"
    );
}

#[test]
fn a_shape_that_there_is_not_is_bad_input() {
    for (key, value, words) in [
        (
            "dimension",
            json!(4),
            "executables.flat.dimension: found 4; accepted: 2 or 3",
        ),
        (
            "thickness",
            json!(0),
            "executables.flat.thickness: found 0; accepted: a whole number from 1 to 16",
        ),
        ("dimenson", json!(2), "did you mean `dimension`?"),
    ] {
        let desk = Desk::new();
        let mut flat = json!({ "command": "proctor {scene}" });
        flat[key] = value;
        let config = desk.scene("guests.json", &json!({ "executables": { "flat": flat } }));
        let output = proctor(&["precision", "step-bar", "--executables", &config]);
        assert_eq!(code(&output), 2, "{}", stdout(&output));
        assert!(
            stderr(&output).contains(words),
            "{words}: {}",
            stderr(&output)
        );
    }
}

/// Keys of a summary that a solver writes itself, and what the environment says of the disk.
#[test]
fn a_solver_may_state_its_own_time_per_particle_and_step() {
    let desk = Desk::new();
    let log = desk.name("scratch");
    let script = format!(
        "echo $PROCTOR_SCRATCH > {log}; $0 run $1 --out $2 && \
         echo '{{\"steps\": 10, \"ns_per_particle_step\": 123.5, \"state_hash\": 7, \"time\": \"none\"}}' > $2/summary.json"
    );
    let guest = json!({ "command": ["sh", "-c", script, env!("CARGO_BIN_EXE_proctor"), "{scene}", "{out}"] });
    let config = json!({
        "executables": { "says": guest }, "scenes": "rest-2d", "particles": 64, "threads": 1,
    });
    let (config, json) = (desk.scene("bench.json", &config), desk.name("b.json"));
    let output = proctor(&["bench", &config, "--json", &json]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let record: Value =
        serde_json::from_str(&fs::read_to_string(json).expect("a record")).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let row = rows
        .iter()
        .find(|row| row["executable"] == "says" && row["stage"] == "process");
    let row = row.expect("a row");
    assert_eq!(row["cpu_ns_per_particle_step"], 123.5);
    assert_eq!(row["steps"], 10.0);
    assert_eq!(fs::read_to_string(log).expect("a text").trim(), "1");
}
