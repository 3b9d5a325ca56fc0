//! Cases that are open as reports: a number beside its reference in table, record and page, and frames that are judged by hand.

use crate::command::guests::found;
use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// `proctor run` by a script that changes each scene but that of the free fall.
fn toy(change: &str) -> Value {
    let script = format!(
        "case $1 in *calibration*) $0 run $1 --out $2;; *) sed '{change}' $1 > $2/s.json; $0 run $2/s.json --out $2;; esac"
    );
    let proctor = env!("CARGO_BIN_EXE_proctor");
    json!({ "command": ["sh", "-c", script, proctor, "{scene}", "{out}"] })
}

/// The rows of a record.
fn rows(path: &str) -> Vec<Value> {
    let text = fs::read_to_string(path).expect("a record");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    record["benchmarks"].as_array().expect("rows").clone()
}

#[test]
#[ignore = "takes 17 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn reports_stand_beside_their_references_and_are_no_errors() {
    let desk = Desk::new();
    let config = json!({ "executables": {
        "same": toy(""),
        "without": toy("s/\"stress\"/\"pressure\"/"),
    }, "methods": ["uGIMP USL FLIP"] });
    let config = desk.scene("arena.json", &config);
    let (json, svg, page) = (desk.name("a.json"), desk.name("a.svg"), desk.name("a.html"));
    let keep = desk.name("kept");
    let output = proctor(&[
        "arena",
        &config,
        "collapse",
        "footing",
        "sphere-on-terrain",
        "vortex",
        "--quick",
        "--json",
        &json,
        "--svg",
        &svg,
        "--keep",
        &keep,
    ]);
    let text = stdout(&output);
    // A solver without stresses fails on the case that reads them, and on no other.
    assert_eq!(code(&output), 1, "{text}{}", stderr(&output));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let (errors, reports) = text
        .split_once("\nReports, without a bound")
        .expect("reports");
    assert!(
        errors.contains("vortex") && !errors.contains("collapse\n"),
        "{text}"
    );
    for words in [
        "collapse: run-out over width",
        "footing: load over the exact one",
        "sphere-on-terrain:\n    energy after the bounce over the initial",
    ] {
        assert!(reports.contains(words), "{words}: {text}");
    }
    let flat: Vec<&str> = text.split_whitespace().collect();
    assert!(
        flat.join(" ").contains("no point data `Stress_XX`"),
        "{text}"
    );
    // The same program reports the same number, beside 1.2 H/d of the experiments and 1 of the exact load.
    let rows = rows(&json);
    for (case, word, reference) in [
        ("collapse", "run-out", 0.9),
        ("footing", "load", 1.0),
        ("sphere-on-terrain", "energy", 1.0),
    ] {
        let of = |solver: &str| -> Vec<&Value> {
            let is_it = |row: &&Value| row["case"] == case && row["executable"] == solver;
            rows.iter().filter(is_it).collect()
        };
        let (own, same) = (of("proctor"), of("same"));
        assert_eq!((own.len(), same.len()), (2, 2), "{case}");
        for (own, same) in own.iter().zip(same) {
            let found = &own[format!("value_{word}")];
            assert!(
                found.is_f64() && *found == same[format!("value_{word}")],
                "{case}"
            );
            let due = same[format!("exact_{word}")].as_f64().expect("a reference");
            assert!((due - reference).abs() < 1e-9, "{case}: {due}");
        }
        for row in rows.iter().filter(|row| row["case"] == case) {
            let keys = row.as_object().expect("a row").keys();
            assert!(
                keys.filter(|key| key.starts_with("error_")
                    && *key != "error_message"
                    && *key != "error_occurred")
                    .count()
                    == 0,
                "{row}"
            );
        }
    }
    assert!(
        !fs::read_to_string(svg)
            .expect("a picture")
            .contains("collapse")
    );
    assert_eq!(code(&proctor(&["report", &json, "--out", &page])), 0);
    let page = fs::read_to_string(page).expect("a page");
    assert!(
        page.contains("Reports, without a bound")
            && page.contains("footing: load over the exact one, same")
    );
    by_hand(&desk.path("kept"));
}

/// Frames of a report that lie in a folder: no bound but that of the command.
fn by_hand(kept: &Path) {
    for (case, run) in [
        ("collapse", "1_h_16"),
        ("footing", "b_h_8"),
        ("sphere-on-terrain", "h_0_1"),
    ] {
        let folders = fs::read_dir(kept.join(case)).expect("runs");
        let folder = folders
            .flatten()
            .map(|entry| entry.path())
            .find(|path| path.display().to_string().ends_with(run));
        let folder = folder.expect("the finest run").join("same");
        let folder = folder.display().to_string();
        let judged = |arguments: &[&str]| {
            let output = proctor(&[&["judge", case, &folder][..], arguments].concat());
            (code(&output), stdout(&output))
        };
        let (exit, text) = judged(&[]);
        assert!(
            exit == 0 && text.starts_with(&format!("REPORT  {case}, ")),
            "{text}"
        );
        let (exit, text) = judged(&["--bound", "100%"]);
        assert!(exit == 0 && text.starts_with("PASS  "), "{text}");
        let (exit, text) = judged(&["--bound", "0.0001%"]);
        assert!(exit == 1 && text.starts_with("FAIL  "), "{text}");
    }
}

/// Number of surfaces below a folder that the scene beside them names.
fn stl(folder: &Path) -> usize {
    let scenes = found(folder, "scene.json");
    let named = scenes.iter().filter(|path| {
        let text = fs::read_to_string(path).expect("a scene");
        let scene: Value = serde_json::from_str(&text).expect("JSON");
        let name = scene["terrain_contact"]["stl_mesh"]
            .as_str()
            .expect("a name");
        path.with_file_name(name).is_file()
    });
    named.count()
}

#[test]
fn problems_are_folders_with_scene_values_and_a_readme() {
    let desk = Desk::new();
    let folder = desk.name("problems");
    let export = |cases: &[&str]| {
        proctor(&[&["export", "--format", "problems", &folder][..], cases].concat())
    };
    let output = export(&["sudden-weight", "footing", "vortex", "sphere-on-terrain"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(stdout(&output), format!("9 problems in {folder}\n"));
    for (case, runs, values, words) in [
        (
            "sudden-weight",
            3,
            "exact.csv",
            "bound: `--bound`, else 1 %",
        ),
        (
            "footing",
            2,
            "reference.csv",
            "no bound, but that of `--bound`",
        ),
        (
            "vortex",
            2,
            "exact.csv",
            "the exact displacement (m) and the stress (Pa, tension positive)",
        ),
        (
            "sphere-on-terrain",
            2,
            "reference.csv",
            "`Velocity` (m/s) and `Stress_XX` to `Stress_XY`",
        ),
    ] {
        let path = desk.path("problems").join(case);
        let readmes = found(&path, "README.md");
        assert_eq!(readmes.len(), runs, "{case}");
        assert_eq!(found(&path, "scene.json").len(), runs, "{case}");
        assert_eq!(found(&path, values).len(), runs, "{case}");
        let text = fs::read_to_string(&readmes[0]).expect("a text");
        assert!(text.contains(words) && text.lines().count() <= 11, "{text}");
    }
    // Exact values at each time: those of the particles, and not of the start.
    let table = found(&desk.path("problems/sudden-weight"), "exact.csv");
    let text = fs::read_to_string(&table[0]).expect("a table");
    assert!(
        text.starts_with("time_s,x_m,y_m,z_m,displacement_x,")
            && text.lines().all(|line| line.split(',').count() == 13),
        "{text}"
    );
    // The surface of triangles lies beside the scene that names it.
    assert_eq!(stl(&desk.path("problems/sphere-on-terrain")), 2);
    let times: std::collections::BTreeSet<&str> = text
        .lines()
        .skip(1)
        .filter_map(|line| line.split(',').next())
        .collect();
    assert_eq!(times.len(), 20, "{times:?}");
    for (case, words) in [
        ("step-barr", "did you mean `step-bar`?"),
        ("hertz", "not for other solvers: "),
    ] {
        let output = export(&[case]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}
