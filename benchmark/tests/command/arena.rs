//! The arena: solvers by case in one table, picture and page, and guests that misbehave in every way.

use crate::command::support::{Desk, code, fixture, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;
use std::process::Output;

/// `proctor run` by a script: the free fall as it should be, and something else with the scene `$1` in the folder `$2` of a case.
fn toy(otherwise: &str) -> Value {
    let script = format!("case $1 in *calibration*) $0 run $1 --out $2;; *) {otherwise};; esac");
    let proctor = env!("CARGO_BIN_EXE_proctor");
    json!({ "command": ["sh", "-c", script, proctor, "{scene}", "{out}"] })
}

/// The arena in short on some cases, with a configuration.
fn arena(desk: &Desk, config: &Value, arguments: &[&str]) -> Output {
    let config = desk.scene("arena.json", config);
    let mut all = vec!["arena", &config];
    all.extend(arguments);
    all.push("--quick");
    proctor(&all)
}

/// The record that was written.
fn record(desk: &Desk) -> Value {
    let text = fs::read_to_string(desk.path("a.json")).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

/// The rows of a record of a case and a solver that say what an accuracy costs.
fn cost(record: &Value, case: &str, solver: &str) -> Value {
    let rows = record["benchmarks"].as_array().expect("rows");
    let is_it = |row: &&Value| {
        row["name"]
            .as_str()
            .is_some_and(|n| n.starts_with("arena/"))
            && row["case"] == case
            && row["solver"] == solver
    };
    rows.iter().find(is_it).cloned().unwrap_or_default()
}

#[test]
fn solvers_stand_by_case_in_table_picture_record_and_page() {
    let desk = Desk::new();
    let same = json!({
        "command": [env!("CARGO_BIN_EXE_proctor"), "run", "{scene}", "--out", "{out}"],
        "method": "B-spline MUSL APIC",
        "scene": {
            "shape_function": "quadratic_bspline", "stress_scheme_update": "MUSL", "transfer": "APIC",
        },
    });
    let config = json!({
        "executables": { "same": same },
        "methods": ["uGIMP USL FLIP", "quadratic_bspline MUSL APIC"],
    });
    let (json, svg, page) = (desk.name("a.json"), desk.name("a.svg"), desk.name("a.html"));
    let cases = ["step-bar", "sudden-weight", "--json", &json, "--svg", &svg];
    let output = arena(&desk, &config, &cases);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let own = text
        .lines()
        .position(|l| l.contains("proctor: uGIMP USL FLIP"));
    let other = text
        .lines()
        .position(|l| l.contains("same: B-spline MUSL APIC"));
    assert!(own.is_some() && own < other, "{text}");
    for case in ["step-bar", "sudden-weight"] {
        assert!(
            text.lines().any(|line| line.trim() == case),
            "{case}: {text}"
        );
    }
    // The keys of an executable take the place of those of the scene: two ways to say one method.
    let record = record(&desk);
    let [same, own, base] = ["same", "proctor quadratic_bspline MUSL APIC", "proctor"]
        .map(|solver| cost(&record, "sudden-weight", solver)["smallest_error"].clone());
    assert_eq!(same, own, "{text}");
    assert!(same.is_f64() && same != base, "{text}");
    let svg = fs::read_to_string(svg).expect("a picture");
    for words in ["step-bar", "sudden-weight", "same", "CPU time"] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(code(&proctor(&["report", &json, "--out", &page])), 0);
    let page = fs::read_to_string(page).expect("a page");
    let section = page.find("id=\"arena\"").expect("a section");
    let first = page.find("<section aria-labelledby").expect("sections");
    assert!(section > first && !page[first + 9..section].contains("<section"));
    assert!(page.contains("sudden-weight, same: B-spline MUSL APIC"));
}

#[test]
#[ignore = "takes 8 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn each_guest_that_misbehaves_is_a_row_with_its_reason_and_the_rest_goes_on() {
    let desk = Desk::new();
    let nan = "$0 run $1 --out $2 >&2; cd $2; n=$(grep -ao 'NumberOfPoints=\"[0-9]*' $(ls *.vtu | head -1) | grep -o '[0-9]*$'); \
               rows=$(yes 'nan nan nan' | head -$n); for f in *.vtu; do echo '<VTKFile type=\"UnstructuredGrid\">\
               <UnstructuredGrid><Piece><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">' $rows \
               '</DataArray></Points><PointData><DataArray type=\"Float64\" Name=\"Displacement\" NumberOfComponents=\"3\" \
               format=\"ascii\">' $rows '</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>' > $f; done";
    let half =
        "sed 's/\"print\": 20/\"print\": 10/' $1 > $2/half.json; $0 run $2/half.json --out $2";
    let huge = "$0 run $1 --out $2; cd $2; for f in *.vtu; do truncate -s 2G $f; done";
    let script = fixture("fixtures/bench/flight.awk");
    let awk = |wrong: &str| {
        let wrong = format!("wrong={wrong}");
        json!({ "command": ["awk", "-v", "out={out}", "-v", wrong, "-f", script, "{scene}"] })
    };
    let mut hangs = toy("sleep 60");
    hangs["timeout"] = 5.into();
    let config = json!({ "executables": {
        "hangs": hangs,
        "floods": toy("yes an error in every line"),
        "nan": toy(nan),
        "half": toy(half),
        "huge": toy(huge),
        "deletes": toy("rm -rf \"$2\""),
        "blind": toy("sed 's/-0[.]6/-0.06/' $1 > $2/s.json; $0 run $2/s.json --out $2"),
        "skips": toy("echo 'error: no such weight' >&2; exit 77"),
        "units": awk("length"),
        "lacks": { "command": ["sh", "-c", "echo 'error: this solver needs numpy' >&2; exit 77", "{scene}"] },
        "same": toy("$0 run $1 --out $2"),
    }});
    // A file beside the folders of the solvers, which none of them has to do with.
    fs::write(desk.path("bystander"), "untouched").expect("written");
    let json = desk.name("a.json");
    let output = arena(&desk, &config, &["sudden-weight", "--json", &json]);
    assert_eq!(
        fs::read_to_string(desk.path("bystander")).ok().as_deref(),
        Some("untouched")
    );
    let text = stdout(&output);
    assert_eq!(code(&output), 1, "{text}{}", stderr(&output));
    // Lines are filled, so that a reason may be broken anywhere.
    let words: Vec<&str> = text.split_whitespace().collect();
    let flat = words.join(" ");
    for reason in [
        "FAIL hangs: not done after 5 s, and ended",
        "FAIL floods: wrote more than 64.0 MiB to one output, and was ended",
        "FAIL nan: a field that is not finite",
        "FAIL half: 10 frames after the start where `print` asks for 20",
        "a frame of 2.0 GiB; at most 1.0 GiB are read",
        "FAIL deletes: no .vtu frame below",
        "skip skips: skipped by its exit code 77; on standard error: error: no such weight",
        "note blind: its error does not fall with the cells",
        "FAIL units: calibration: its positions are 1000 times the lengths",
        "skip lacks: calibration: skipped by its exit code 77; on standard error: error: this solver needs numpy",
    ] {
        assert!(flat.contains(reason), "{reason}: {text}");
    }
    let record = record(&desk);
    let same = cost(&record, "sudden-weight", "same")["smallest_error"].clone();
    let own = cost(&record, "sudden-weight", "proctor")["smallest_error"].clone();
    assert!(same.is_f64() && same == own, "{text}");
    assert!(
        cost(&record, "sudden-weight", "nan")
            .get("smallest_error")
            .is_none()
    );
    // The record of skips and failures is one that can be read.
    let page = desk.name("a.html");
    assert_eq!(code(&proctor(&["report", &json, "--out", &page])), 0);
}

#[test]
fn an_arena_without_a_guest_that_takes_part_compares_nothing() {
    let desk = Desk::new();
    let lacks =
        json!({ "command": ["sh", "-c", "echo error: no package >&2; exit 77", "{scene}"] });
    let config = json!({ "executables": { "lacks": lacks } });
    let output = arena(&desk, &config, &["step-bar"]);
    assert_eq!(code(&output), 2, "{}", stdout(&output));
    assert!(stdout(&output).contains("no other solver took part"));
}

#[test]
fn bad_input_of_an_arena_is_told_before_anything_runs() {
    let desk = Desk::new();
    let same = json!({ "command": "proctor {scene}" });
    let with = |key: &str, value: Value| {
        let mut solver = same.clone();
        solver[key] = value;
        json!({ "executables": { "same": solver } })
    };
    let plain = json!({ "executables": { "same": same } });
    let mut methods = plain.clone();
    methods["methods"] = json!(["uGIMP MUSL"]);
    let mut word = plain.clone();
    word["methods"] = json!("uGIMP MUSL APICC");
    for (config, case, words) in [
        (plain.clone(), "step-barr", "did you mean `step-bar`?"),
        (
            plain.clone(),
            "yielding-column",
            "yielding-column: not for other solvers: its answer depends on the way",
        ),
        (plain.clone(), "hertz", "hertz: not for other solvers: "),
        (json!({}), "step-bar", "executables: found none"),
        (
            with("scene", json!({ "time": 3 })),
            "step-bar",
            "executables.same.scene.time",
        ),
        (
            with("scenes", json!({})),
            "step-bar",
            "did you mean `scene`?",
        ),
        (
            methods,
            "step-bar",
            "weighting function, stress scheme and transfer",
        ),
        (word, "step-bar", "did you mean `APIC`?"),
    ] {
        let output = arena(&desk, &config, &[case]);
        assert_eq!(code(&output), 2, "{config}");
        assert!(
            stderr(&output).contains(words),
            "{words}: {}",
            stderr(&output)
        );
        assert_eq!(stdout(&output), "");
    }
}

#[test]
fn the_speed_problem_is_measured_by_the_further_steps_of_a_longer_run() {
    let desk = Desk::new();
    let config = json!({
        "executables": { "same": env!("CARGO_BIN_EXE_proctor") },
        "methods": ["uGIMP USL FLIP"], "particles": 8000,
    });
    let json = desk.name("a.json");
    let output = arena(&desk, &config, &["--speed", "--json", &json]);
    let text = stdout(&output);
    assert_eq!(code(&output), 0, "{text}{}", stderr(&output));
    let record = record(&desk);
    let rows = record["benchmarks"].as_array().expect("rows");
    let speeds: Vec<f64> = rows
        .iter()
        .filter(|row| {
            row["name"]
                .as_str()
                .is_some_and(|n| n.starts_with("arena-speed/"))
        })
        .filter_map(|row| row["cpu_ns_per_particle_step"].as_f64())
        .collect();
    assert_eq!(speeds.len(), 2, "{text}");
    // A loose bound: the machine may be busy.
    assert!(
        speeds.iter().all(|ns| (5.0..5000.0).contains(ns)),
        "{speeds:?}"
    );
    assert!(text.contains("8 000"), "{text}");
}
