//! Records in the shapes of other tools, by their documentation; `scripts/check-exports` shows them to the tools.

use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::export::{ExportError, Format, text};
use proctor_benchmark::record::{Record, Row};
use proctor_scene::simulation::Options;
use serde_json::Value;
use std::time::Duration;

/// Three runs of 10, 20 and 60 ms, a verdict, a run that failed.
fn record() -> Record {
    let mut record = Record::new(&Options::default());
    for (repetition, ms) in [10, 60, 20].into_iter().enumerate() {
        let time = Duration::from_millis(ms);
        let spent = Spent {
            wall: time,
            cpu: time,
        };
        let mut row = Row::sample("bar/h=1", repetition as u64, 1).timed(spent);
        row.count("error_l2", 0.25);
        row.count("particles", 8.0);
        row.count("steps", 4.0);
        row.label("scheme", "USL, \"quoted\"");
        record.push(row);
    }
    let mut verdict = Row::aggregate("bar", "verdict", 1);
    verdict.count("observed_order_l2", 1.9);
    record.push(verdict);
    let mut failed = Row::sample("bar/h=2", 0, 1);
    failed.fail("inverted");
    record.push(failed);
    record
}

fn json(format: Format) -> Value {
    let text = text(&record(), format, "base").expect("exported");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn bencher_reads_benchmarks_of_measures_of_values() {
    let all = json(Format::Bmf);
    let all = all.as_object().expect("an object");
    let latency = &all["bar/h=1"]["latency"];
    assert_eq!(latency["value"], 2e7);
    assert_eq!(latency["lower_value"], 1e7);
    assert_eq!(latency["upper_value"], 6e7);
    assert_eq!(all["bar/h=1: error_l2"]["error"]["value"], 0.25);
    assert_eq!(
        all["bar verdict: observed_order_l2"]["observed-order"]["value"],
        1.9
    );
    assert!(all.keys().all(|name| !name.contains("h=2")), "failed");
    // https://bencher.dev/bmf.json: objects of objects of objects with a number `value`.
    for measures in all.values() {
        for (name, measure) in measures.as_object().expect("an object") {
            assert!(name.len() <= 64);
            assert!(measure["value"].is_number());
        }
    }
}

#[test]
fn github_action_benchmark_reads_a_list_of_values_with_units() {
    let all = json(Format::Github);
    let all = all.as_array().expect("a list");
    assert_eq!(all[0]["name"], "bar/h=1");
    assert_eq!(
        (&all[0]["value"], &all[0]["unit"]),
        (&20.0.into(), &"ms".into())
    );
    assert_eq!(all[1]["name"], "bar/h=1: error_l2");
    for entry in all {
        assert!(
            entry["name"].is_string() && entry["unit"].is_string() && entry["value"].is_number()
        );
        // Of an order more is better.
        assert!(!entry["name"].as_str().expect("a name").contains("order"));
    }
}

#[test]
fn critcmp_reads_a_baseline_with_its_name() {
    let all = json(Format::Critcmp);
    assert_eq!(all["name"], "base");
    let one = &all["benchmarks"]["bar/h=1"];
    assert_eq!(one["fullname"], "base/bar/h=1");
    assert_eq!(one["criterion_estimates_v1"]["mean"]["point_estimate"], 3e7);
    assert_eq!(
        one["criterion_estimates_v1"]["median"]["point_estimate"],
        2e7
    );
    assert_eq!(one["criterion_benchmark_v1"]["throughput"]["Elements"], 32);
}

#[test]
fn csv_holds_every_row_failed_ones_too() {
    let text = text(&record(), Format::Csv, "").expect("exported");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let heading = reader.headers().expect("a heading").clone();
    let rows: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().expect("rows");
    assert_eq!(rows.len(), 5);
    let at = |row: usize, key: &str| {
        let column = heading.iter().position(|h| h == key).expect("a column");
        rows[row][column].to_owned()
    };
    assert_eq!(at(1, "wall_seconds"), "0.06");
    assert_eq!(at(0, "scheme"), "USL, \"quoted\"");
    assert_eq!(at(0, "error_l2"), "0.25");
    assert_eq!(at(3, "aggregate"), "verdict");
    assert_eq!(at(4, "failure"), "inverted");
    assert_eq!(at(4, "wall_seconds"), "");
}

#[test]
fn nothing_is_not_exported_as_an_empty_file() {
    let mut record = record();
    record.rows.retain(|row| row.error.is_some());
    for format in [Format::Bmf, Format::Github, Format::Critcmp, Format::Junit] {
        assert!(matches!(
            text(&record, format, "a"),
            Err(ExportError::Nothing)
        ));
    }
}

/// The same with two gates, one of which does not hold, though the verdict beside them holds.
fn with_gates() -> Record {
    let mut record = record();
    for (gate, value, side) in [
        ("error of <u> & \"v\"", 0.4, "at most"),
        ("order", 1.9, "at least"),
    ] {
        let mut row = Row::aggregate(format!("bar: {gate}"), "gate", 1);
        row.count("gate_value", value);
        row.count("gate_bound", 0.25);
        row.label("gate_side", side);
        record.push(row);
    }
    record
}

#[test]
fn junit_has_a_test_per_gate_and_says_what_was_found_and_the_bound() {
    let xml = text(&with_gates(), Format::Junit, "").expect("exported");
    for line in [
        "<testsuites name=\"proctor\" tests=\"3\" failures=\"1\" errors=\"1\" time=\"0.090\">",
        "  <testsuite name=\"bar\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\" time=\"0.090\" timestamp=",
        "    <testcase classname=\"bar\" name=\"bar/h=2\" time=\"0\">\n      <error message=\"inverted\">inverted</error>",
        "    <testcase classname=\"bar\" name=\"error of &lt;u&gt; &amp; &quot;v&quot;\" time=\"0\">\n      \
         <failure message=\"found 0.4, bound at most 0.25\">found 0.4\nbound at most 0.25\n</failure>",
        "    <testcase classname=\"bar\" name=\"order\" time=\"0\"/>",
    ] {
        assert!(xml.contains(line), "{line} is not in {xml}");
    }
}

#[test]
fn junit_is_xml_whatever_a_program_wrote() {
    let mut record = with_gates();
    let mut row = Row::sample("precision/bar/peer/guest/h=1", 0, 1);
    row.label("executable", "guest");
    row.label("case", "bar");
    row.fail("\u{1b}[31mred\u{1b}[0m \u{0} <b> ]]> \u{ffff}");
    record.push(row);
    record.set_incomplete(true);
    let xml = text(&record, Format::Junit, "").expect("exported");
    let mut reader = quick_xml::Reader::from_str(&xml);
    let mut names = vec![];
    loop {
        match reader.read_event().expect("XML") {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                names.push(String::from_utf8_lossy(tag.name().as_ref()).into_owned());
            }
            _ => {}
        }
    }
    assert_eq!(names.iter().filter(|name| *name == "testcase").count(), 5);
    assert!(!xml.contains(['\u{1b}', '\u{0}', '\u{ffff}']), "{xml}");
    assert!(xml.contains("the record is incomplete"), "{xml}");
}
