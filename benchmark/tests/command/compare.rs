//! `proctor compare`, `noise` and `export`.

use crate::command::support::{Desk, code, command, proctor, stderr, stdout};
use serde_json::{Value, json};
use std::fs;
use std::time::{Duration, Instant};

/// A record of one case in ten passes of one run each, the least of which times are judged.
fn record(seconds: f64, error: f64) -> Value {
    let row = |pass: u64| {
        json!({
            "name": "bar/h=1", "run_name": "bar/h=1", "run_type": "iteration", "repetition_index": 0,
            "iterations": 1, "threads": 1, "real_time": seconds, "cpu_time": seconds, "time_unit": "s",
            "pass": pass, "error_l2": error
        })
    };
    json!({
        "context": {
            "schema_version": 1, "cpu_model": "one", "lanes": "avx2", "num_cpus": 2,
            "library_build_type": "release", "commit": "0123456789abcdef"
        },
        "benchmarks": (0..10).map(row).collect::<Vec<_>>()
    })
}

fn two(desk: &Desk, base: &Value, head: &Value) -> [String; 2] {
    [desk.scene("base.json", base), desk.scene("head.json", head)]
}

#[test]
fn the_exit_code_is_the_verdict() {
    let desk = Desk::new();
    let mut other = record(1.0, 0.1);
    other["context"]["cpu_model"] = "another".into();
    for (head, expected, word) in [
        (record(1.0, 0.1), 0, "FINE: 1 case compared, no change"),
        (record(1.1, 0.1), 1, "WORSE: 1 case compared, 1 worse"),
        (record(1.0, 0.2), 1, "error_l2 0.1 -> 0.2"),
        (other, 2, "CANNOT COMPARE"),
    ] {
        let [base, head] = two(&desk, &record(1.0, 0.1), &head);
        let output = proctor(&["compare", &base, &head]);
        let text = stdout(&output);
        assert_eq!(code(&output), expected, "{text}{}", stderr(&output));
        assert!(text.contains(word), "{word}: {text}");
        assert!(
            text.lines().all(|line| line.chars().count() <= 100),
            "{text}"
        );
    }
}

#[test]
fn a_record_of_one_pass_is_fine_beside_itself_and_its_times_are_left_out() {
    let desk = Desk::new();
    let once = |seconds: f64, error: f64| {
        let mut record = record(seconds, error);
        record["benchmarks"]
            .as_array_mut()
            .expect("rows")
            .truncate(1);
        record
    };
    for (head, expected, words) in [
        (
            once(1.0, 0.1),
            0,
            "FINE: 1 case compared, no change; times left out",
        ),
        // A time that was measured once says nothing.
        (
            once(9.0, 0.1),
            0,
            "FINE: 1 case compared, no change; times left out",
        ),
        (
            once(1.0, 0.2),
            1,
            "WORSE: 1 case compared, 1 worse; times left out",
        ),
        // Where somebody measured passes, times are meant to be judged.
        (
            record(1.0, 0.1),
            2,
            "1 pass in common, at least 10 are needed",
        ),
    ] {
        let [base, head] = two(&desk, &once(1.0, 0.1), &head);
        let output = proctor(&["compare", &base, &head]);
        let text = stdout(&output);
        assert_eq!(code(&output), expected, "{text}{}", stderr(&output));
        assert!(text.contains(words), "{words}: {text}");
        let told = text.contains("times were measured once") && text.contains("compare-commits");
        assert_eq!(told, expected < 2, "{text}");
    }
    // What only one of them has is never fine.
    let mut less = once(1.0, 0.1);
    less["benchmarks"][0]
        .as_object_mut()
        .expect("a row")
        .remove("error_l2");
    let [base, head] = two(&desk, &once(1.0, 0.1), &less);
    assert_eq!(code(&proctor(&["compare", &base, &head])), 2);
    // Nothing but a time, measured once: nothing to judge.
    let [base, head] = two(&desk, &less, &less);
    let output = proctor(&["compare", &base, &head]);
    assert_eq!(code(&output), 2);
    assert!(
        stdout(&output).contains("nothing to compare"),
        "{}",
        stdout(&output)
    );
}

/// Both parts of the main job: cases with gates and orders, and ladders some of whose runs failed.
#[test]
fn a_record_of_the_command_is_fine_beside_itself() {
    let desk = Desk::new();
    let file = desk.name("record.json");
    let jobs: [(&[&str], bool); 2] = [
        (&["verify", "rotation", "bar", "--quick"], false),
        (&["precision", "self-weight", "--quick"], true),
    ];
    for (job, fails) in jobs {
        let output = proctor(&[job, &["--json", &file]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let record = fs::read_to_string(&file).expect("a record");
        assert_eq!(
            record.contains("\"error_occurred\": true"),
            fails,
            "{job:?}"
        );
        let output = proctor(&["compare", &file, &file]);
        let text = stdout(&output);
        assert_eq!(code(&output), 0, "{text}");
        assert!(text.contains("FINE: "), "{text}");
        // What is equal needs no table.
        assert!(text.lines().count() < 10, "{text}");
    }
}

#[test]
fn the_markdown_is_written_whatever_the_verdict() {
    let desk = Desk::new();
    let [base, head] = two(&desk, &record(1.0, 0.1), &record(1.2, 0.1));
    let file = desk.name("table.md");
    let output = proctor(&["compare", &base, &head, "--markdown", &file]);
    assert_eq!(code(&output), 1);
    let text = fs::read_to_string(file).expect("Markdown");
    assert!(text.starts_with("### WORSE"), "{text}");
    assert!(
        text.contains("| bar/h=1 |") && text.contains("+20.0 %"),
        "{text}"
    );
}

#[test]
fn errors_alone_compare_across_machines() {
    let desk = Desk::new();
    let mut other = record(9.0, 0.1);
    other["context"]["cpu_model"] = "another".into();
    let [base, head] = two(&desk, &record(1.0, 0.1), &other);
    let output = proctor(&["compare", &base, &head, "--ignore-time"]);
    assert_eq!(code(&output), 0, "{}", stdout(&output));
}

#[test]
fn what_is_no_record_is_bad_input() {
    let desk = Desk::new();
    let good = desk.scene("good.json", &record(1.0, 0.1));
    let whole = fs::read_to_string(&good).expect("read");
    for (name, text, words) in [
        ("empty.json", "", "the file is empty"),
        ("cut.json", &whole[..whole.len() / 2], "truncated"),
        (
            "none.json",
            "{\"context\": {}, \"benchmarks\": []}",
            "no benchmarks",
        ),
    ] {
        fs::write(desk.path(name), text).expect("written");
        let bad = desk.name(name);
        let attempts: [&[&str]; 5] = [
            &["compare", &bad, &good],
            &["compare", &good, &bad],
            &["compare", &good, &good, "--noise", &bad],
            &["noise", &good, &bad],
            &["export", "--format", "csv", &bad],
        ];
        for arguments in attempts {
            let output = proctor(arguments);
            assert_eq!(code(&output), 2, "{arguments:?}");
            let message = stderr(&output);
            assert!(
                message.contains(name) && message.contains(words),
                "{message}"
            );
            assert_eq!(stdout(&output), "");
        }
    }
    let output = proctor(&["compare", &good, &desk.name("not_there.json")]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("not_there.json: cannot be read"));
}

#[test]
fn a_folder_holds_a_pass_per_file_or_per_folder() {
    let desk = Desk::new();
    let mut one = record(1.0, 0.1);
    one["benchmarks"].as_array_mut().expect("rows").truncate(1);
    let text = one.to_string();
    for pass in (1..=10).map(|pass| format!("{pass:02}")) {
        fs::create_dir_all(desk.path("deep").join(&pass)).expect("a folder");
        fs::create_dir_all(desk.path("flat")).expect("a folder");
        fs::write(desk.path("flat").join(format!("{pass}.json")), &text).expect("written");
        for repetition in ["a.json", "b.json", "c.txt"] {
            fs::write(desk.path("deep").join(&pass).join(repetition), &text).expect("written");
        }
    }
    let output = proctor(&["compare", &desk.name("flat"), &desk.name("deep")]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let csv = stdout(&proctor(&["export", "--format", "csv", &desk.name("deep")]));
    assert_eq!(csv.lines().count(), 1 + 20, "{csv}");
    // One of another machine does not belong there.
    one["context"]["cpu_model"] = "another".into();
    fs::write(desk.path("flat").join("11.json"), one.to_string()).expect("written");
    let output = proctor(&["compare", &desk.name("flat"), &desk.name("deep")]);
    assert_eq!(code(&output), 2);
    let message = stderr(&output);
    assert!(
        message.contains("11.json") && message.contains("cpu_model"),
        "{message}"
    );
    fs::create_dir(desk.path("bare")).expect("a folder");
    let output = proctor(&["compare", &desk.name("bare"), &desk.name("deep")]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("no record in this folder"));
}

#[test]
fn noise_of_records_is_what_compare_reads() {
    let desk = Desk::new();
    let [first, second] = two(&desk, &record(1.0, 0.1), &record(1.05, 0.1));
    let bands = desk.name("noise.json");
    let output = proctor(&["noise", &first, &second, "--json", &bands]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("5.0 %"), "{}", stdout(&output));
    // Slower by 5 %, which is the noise that was measured.
    assert_eq!(code(&proctor(&["compare", &first, &second])), 1);
    assert_eq!(
        code(&proctor(&["compare", &first, &second, "--noise", &bands])),
        0
    );
    let output = proctor(&["noise", &first]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("two or more"));
}

#[test]
fn an_export_goes_to_a_file_or_to_standard_output() {
    let desk = Desk::new();
    let good = desk.scene("good.json", &record(1.0, 0.1));
    for format in ["bmf", "github", "critcmp", "csv"] {
        let plain = proctor(&["export", "--format", format, &good]);
        assert_eq!(code(&plain), 0, "{format}");
        let file = desk.name("good.out");
        let output = proctor(&["export", "--format", format, &good, "--out", &file]);
        assert_eq!((code(&output), stdout(&output)), (0, String::new()));
        assert_eq!(fs::read_to_string(file).expect("written"), stdout(&plain));
    }
    let output = proctor(&["export", "--format", "xml", &good]);
    assert_eq!(code(&output), 2);
}

#[cfg(unix)]
#[test]
fn an_interrupted_verification_leaves_a_valid_record_marked_incomplete() {
    let desk = Desk::new();
    let file = desk.name("record.json");
    let child = command(&["verify", "boussinesq", "--json", &file])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn();
    let mut child = child.expect("the command starts");
    let begun = Instant::now();
    while !desk.path("record.json").exists() {
        assert!(begun.elapsed() < Duration::from_secs(60), "no record");
        std::thread::sleep(Duration::from_millis(5));
    }
    // The record is made just before the first run begins, and that one is finished.
    std::thread::sleep(Duration::from_millis(300));
    let killed = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.expect("kill runs").success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let text = fs::read_to_string(desk.path("record.json")).expect("a record");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(record["context"]["incomplete"], true);
    assert!(!record["benchmarks"].as_array().expect("rows").is_empty());
    let output = proctor(&["compare", &file, &file]);
    assert_eq!(code(&output), 2);
    assert!(
        stdout(&output).contains("incomplete"),
        "{}",
        stdout(&output)
    );
}
