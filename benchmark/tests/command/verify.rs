//! `proctor verify`.

use crate::command::support::{Desk, code, proctor, stderr, stdout};
use serde_json::Value;

#[test]
fn an_unknown_case_is_bad_input_with_the_nearest_name() {
    let output = proctor(&["verify", "businesq"]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert!(message.contains("did you mean `boussinesq`?"), "{message}");
    // Behind two dozens of names nobody would read it.
    let all = message.find("accepted: ").expect("all names");
    let nearest = message.find("did you mean").expect("the nearest");
    assert!(nearest < all, "{message}");
}

#[test]
fn a_record_that_cannot_be_written_is_found_before_the_work() {
    let desk = Desk::new();
    let record = desk.name("no/such/folder/record.json");
    let output = proctor(&["verify", "--quick", "--json", &record]);
    assert_eq!(code(&output), 2);
    assert_eq!(stdout(&output), "");
}

#[test]
fn a_quick_ladder_passes_and_leaves_a_record() {
    let desk = Desk::new();
    let record = desk.name("record.json");
    let output = proctor(&["verify", "boussinesq", "--quick", "--json", &record]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("PASS: 6 of 6 gates in 1 case"));
    let text = std::fs::read_to_string(record).expect("a record");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(record["context"]["schema_version"], 1);
    let rows = record["benchmarks"].as_array().expect("rows");
    assert!(rows.len() >= 3);
    for row in rows {
        for (key, value) in row.as_object().expect("an object") {
            assert!(
                !value.is_null() && !value.is_object() && !value.is_array(),
                "{key}"
            );
        }
    }
    assert!(rows[0]["real_time"].as_f64().is_some_and(|t| t > 0.0));
    assert!(
        rows[0]
            .as_object()
            .is_some_and(|row| row.keys().any(|k| k.starts_with("error_")))
    );
}

#[test]
fn short_runs_are_timed_as_often_as_asked() {
    let desk = Desk::new();
    let record = desk.name("record.json");
    let options = ["--quick", "--repetitions", "3", "--json", &record];
    let output = proctor(&[&["verify", "rotation"], &options[..]].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let text = std::fs::read_to_string(record).expect("a record");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    let rows = record["benchmarks"].as_array().expect("rows");
    let first: Vec<_> = rows
        .iter()
        .filter(|row| row["name"] == rows[0]["name"])
        .collect();
    assert!((3..=30).contains(&first.len()), "{}", first.len());
    for (repetition, row) in first.iter().enumerate() {
        assert_eq!(row["repetition_index"], repetition);
        assert_eq!(row["steps"], first[0]["steps"]);
    }
}

#[test]
fn the_names_of_the_cases_can_be_had() {
    let output = proctor(&["verify", "--list"]);
    assert_eq!(code(&output), 0);
    let all = stdout(&output);
    let names: Vec<&str> = all.lines().collect();
    assert!(names.contains(&"bar") && names.contains(&"hertz"), "{all}");
    let output = proctor(&["verify", "--list", "hertz"]);
    assert_eq!(stdout(&output), "hertz\n");
}

/// Cases on ranks have the errors of one process, bit by bit; those that ranks do not share are left out by name.
#[test]
#[ignore = "takes 17 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn cases_on_ranks_have_the_errors_of_one_process() {
    let desk = Desk::new();
    // Waves, contact of bodies, driven shapes, absorbing planes; then mortar contact, which ranks do not share.
    let shared = [
        "bar",
        "colliding-blocks",
        "inclined-two-blocks",
        "absorbing",
    ];
    let cases = [&shared[..], &["rings"]].concat();
    let run = |ranks: &str, file: &str| {
        let options = ["--quick", "--ranks", ranks, "--json", &desk.name(file)];
        proctor(&[&["verify"], &cases[..], &options[..]].concat())
    };
    let alone = run("1", "alone.json");
    assert_eq!(code(&alone), 0, "{}", stdout(&alone));
    let output = run("2", "shared.json");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(
        stdout(&output).contains("left out: rings: "),
        "{}",
        stdout(&output)
    );
    let record = |file: &str| -> Value {
        let text = std::fs::read_to_string(desk.path(file)).expect("a record");
        serde_json::from_str(&text).expect("JSON")
    };
    let [alone, on_ranks] = ["alone.json", "shared.json"].map(record);
    assert_eq!(on_ranks["context"]["ranks"], 2);
    assert_eq!(alone["context"]["ranks"], Value::Null);
    let errors = |record: &Value, case: &str| -> Vec<Value> {
        let rows = record["benchmarks"].as_array().expect("rows").iter();
        let own = rows.filter(|row| {
            row["name"]
                .as_str()
                .is_some_and(|name| name.starts_with(case))
        });
        let clocks = [
            "real_time",
            "cpu_time",
            "repetition_index",
            "particle_steps_per_second",
        ];
        let without = |row: &Value| {
            let mut row = row.clone();
            let row_keys = row.as_object_mut().expect("a row");
            for key in clocks {
                row_keys.remove(key);
            }
            row
        };
        own.map(without).collect()
    };
    for case in shared {
        let expected = errors(&alone, case);
        assert!(expected.len() > 3, "{case}");
        assert_eq!(errors(&on_ranks, case), expected, "{case}");
    }
}
