//! Files that are no record are refused with file, line and reason.

use super::read;
use proctor_benchmark::record::Record;
use std::path::Path;

/// The message of the refusal, without the folder.
fn refusal(text: &str) -> String {
    let error = read(text).expect_err("no record").to_string();
    let at = error.find("record.json").expect("the file is named");
    error[at..].to_owned()
}

/// A record with one row in line 2.
fn with_row(row: &str) -> String {
    format!("{{\"context\": {{\"schema_version\": 1}},\n \"benchmarks\": [{row}]}}")
}

#[test]
fn every_reason_has_its_words_and_its_line() {
    let good = with_row(r#"{"name": "a"}"#);
    assert!(read(&good).is_ok());
    let cases = [
        (String::new(), "record.json: the file is empty"),
        (" \n\n".to_owned(), "record.json: the file is empty"),
        (
            good[..good.len() - 4].to_owned(),
            "record.json:2: truncated",
        ),
        (
            "{\n oops".to_owned(),
            "record.json:2: not JSON: key must be a string",
        ),
        (
            format!("{good} x"),
            "record.json:2: not JSON: trailing characters",
        ),
        (
            "[]".to_owned(),
            "record.json:1: invalid type: sequence, expected a record",
        ),
        (
            "3".to_owned(),
            "record.json:1: invalid type: integer `3`, expected a record",
        ),
        ("{}".to_owned(), "record.json:1: `context` is missing"),
        (
            r#"{"context": {}}"#.to_owned(),
            "record.json:1: `benchmarks` is missing",
        ),
        (
            r#"{"scene": 1}"#.to_owned(),
            "record.json:1: found the key `scene`; a record has",
        ),
        (
            r#"{"context": 3, "benchmarks": []}"#.to_owned(),
            "record.json:1: `context`: found 3; accepted: an object",
        ),
        (
            r#"{"context": {}, "benchmarks": []}"#.to_owned(),
            "record.json: the record holds no benchmarks",
        ),
        (
            r#"{"context": {}, "benchmarks": {}}"#.to_owned(),
            "record.json:1: invalid type: map, expected `benchmarks` as a list",
        ),
        (
            r#"{"context": {"schema_version": 2}, "benchmarks": [{"name": "a"}]}"#.to_owned(),
            "record.json: found schema version 2; this program reads version 1",
        ),
        (
            r#"{"context": {"schema_version": "1"}, "benchmarks": [{"name": "a"}]}"#.to_owned(),
            "record.json: found schema version \"1\"",
        ),
    ];
    for (text, words) in cases {
        let message = refusal(&text);
        assert!(
            message.starts_with(words),
            "{message}\nbut expected: {words}"
        );
    }
}

#[test]
fn a_row_of_wrong_types_is_named_by_line_and_key() {
    let cases = [
        ("7", "expected a row"),
        ("{}", "a row without `name`"),
        (r#"{"name": 3}"#, "`name`: found 3; accepted: a word"),
        (
            r#"{"name": "a", "x": null}"#,
            "`x`: found null; accepted: a number or a word",
        ),
        (r#"{"name": "a", "x": [1]}"#, "`x`: found a list"),
        (r#"{"name": "a", "x": true}"#, "`x`: found true"),
        (
            r#"{"name": "a", "x": 1, "x": 2}"#,
            "the key `x` is given twice",
        ),
        (
            r#"{"name": "a", "real_time": "fast"}"#,
            "`real_time`: found \"fast\"; accepted: a number",
        ),
        (
            r#"{"name": "a", "real_time": -1}"#,
            "`real_time`: found -1; accepted: a time from 0",
        ),
        (r#"{"name": "a", "real_time": 1}"#, "must be given together"),
        (
            r#"{"name": "a", "threads": 1.5}"#,
            "`threads`: found 1.5; accepted: a whole number",
        ),
        (
            r#"{"name": "a", "time_unit": "h"}"#,
            "found `time_unit` \"h\"; accepted: ns, us, ms, s",
        ),
        (
            r#"{"name": "a", "run_type": "b"}"#,
            "found `run_type` \"b\"",
        ),
        (
            r#"{"name": "a", "run_type": "aggregate"}"#,
            "without `aggregate_name`",
        ),
        (
            r#"{"name": "a", "error_occurred": 1}"#,
            "`error_occurred`: found 1; accepted: true or false",
        ),
    ];
    for (row, words) in cases {
        let message = refusal(&with_row(row));
        assert!(message.starts_with("record.json:2: "), "{message}");
        assert!(message.contains(words), "{message}\nbut expected: {words}");
    }
}

#[test]
fn a_number_that_is_none_is_not_json() {
    let message = refusal(&with_row("{\"name\": \"a\", \"x\": NaN}"));
    assert!(message.starts_with("record.json:2: not JSON"), "{message}");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = Record::read(Path::new("no/such/record.json")).expect_err("not there");
    let message = error.to_string();
    assert!(
        message.starts_with("no/such/record.json: cannot be read"),
        "{message}"
    );
}
