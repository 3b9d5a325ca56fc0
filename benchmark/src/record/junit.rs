//! A record as JUnit XML, which GitHub, GitLab, Jenkins and most test viewers show: a suite per case, a test per gate.
//!
//! A gate that does not hold is a failure with what was found and its bound. A run that should have succeeded and did not is a
//! test that ended with an error. Runs that look for the bounds of a method may fail and are left out.

use super::{Kind, Record, Row, gate::GateRow};
use crate::report::escape;
use crate::show::number;
use crate::stability::extreme::ROWS as EXTREME;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// A test of a suite.
struct Test<'a> {
    name: &'a str,
    /// Element and message of what went wrong, and the text inside it.
    fault: Option<(&'static str, String, String)>,
}

/// The tests of a case.
#[derive(Default)]
struct Suite<'a> {
    tests: Vec<Test<'a>>,
    /// Time of its runs by the clock [s].
    seconds: f64,
}

impl Suite<'_> {
    fn count(&self, element: &str) -> usize {
        let faults = self.tests.iter().filter_map(|test| test.fault.as_ref());
        faults.filter(|(of, ..)| *of == element).count()
    }
}

/// The text; none for a record in which nothing is judged.
#[must_use]
pub fn text(record: &Record) -> Option<String> {
    let judged: BTreeSet<&str> = record.gate_rows().map(|gate| gate.case).collect();
    let mut order: Vec<&str> = vec![];
    let mut suites: BTreeMap<&str, Suite<'_>> = BTreeMap::new();
    for row in &record.rows {
        let Some(case) = case_of(row, &judged) else {
            continue;
        };
        let suite = suites.entry(case).or_insert_with(|| {
            order.push(case);
            Suite::default()
        });
        suite.seconds += row.spent.map_or(0.0, |spent| spent.wall.as_secs_f64());
        suite.tests.extend(test(row));
    }
    if record.incomplete() {
        order.push("record");
        let message = "the record is incomplete: its work was interrupted".to_owned();
        let test = Test {
            name: "complete",
            fault: Some(("error", message, String::new())),
        };
        suites.entry("record").or_default().tests.push(test);
    }
    order.retain(|case| !suites[case].tests.is_empty());
    if order.is_empty() {
        return None;
    }
    let told: Vec<&Suite<'_>> = order.iter().map(|case| &suites[case]).collect();
    let sum = |of: &dyn Fn(&Suite<'_>) -> usize| told.iter().map(|suite| of(suite)).sum::<usize>();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"proctor\" tests=\"{}\" failures=\"{}\" \
         errors=\"{}\" time=\"{:.3}\">\n",
        sum(&|suite| suite.tests.len()),
        sum(&|suite| suite.count("failure")),
        sum(&|suite| suite.count("error")),
        told.iter().map(|suite| suite.seconds).sum::<f64>(),
    );
    for case in order {
        write_suite(case, &suites[case], record, &mut xml);
    }
    xml.push_str("</testsuites>\n");
    Some(xml)
}

/// The case of a row that is a gate, a run of a case with gates, or a run of another solver.
fn case_of<'a>(row: &'a Row, judged: &BTreeSet<&str>) -> Option<&'a str> {
    if let Some(gate) = GateRow::of(row) {
        return Some(gate.case);
    }
    if row.labels.contains_key("executable") {
        return Some(row.labels.get("case").map_or("calibration", String::as_str));
    }
    if row.name.starts_with(EXTREME) {
        return Some(&row.name);
    }
    let case = row.name.split('/').next().unwrap_or_default();
    judged.contains(case).then_some(case)
}

/// The test of a gate, of a run of another solver, or of another run that failed.
fn test(row: &Row) -> Option<Test<'_>> {
    if let Some(gate) = GateRow::of(row) {
        let fault = (!gate.holds()).then(|| {
            let told = |value: Option<f64>| value.map_or_else(|| "nothing".to_owned(), number);
            let full =
                |value: Option<f64>| value.map_or_else(|| "nothing".to_owned(), |x| x.to_string());
            let message = format!(
                "found {}, bound {} {}",
                told(gate.value),
                gate.side,
                told(gate.bound)
            );
            let body = format!(
                "found {}\nbound {} {}\n",
                full(gate.value),
                gate.side,
                full(gate.bound)
            );
            ("failure", message, body)
        });
        return Some(Test {
            name: gate.name,
            fault,
        });
    }
    let Kind::Sample { repetition } = &row.kind else {
        return None;
    };
    let fault = row
        .error
        .as_ref()
        .map(|error| ("error", error.clone(), error.clone()));
    let of_guest = row.labels.contains_key("executable") && *repetition == 0;
    (fault.is_some() || of_guest).then_some(Test {
        name: &row.name,
        fault,
    })
}

fn write_suite(case: &str, suite: &Suite<'_>, record: &Record, xml: &mut String) {
    let case = attribute(case);
    let stamp = record.context["date"].as_str().map(|date| {
        let seconds: String = date.chars().take("2026-01-01T00:00:00".len()).collect();
        format!(" timestamp=\"{}\"", attribute(&seconds))
    });
    let _ = writeln!(
        xml,
        "  <testsuite name=\"{case}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{:.3}\"{}>",
        suite.tests.len(),
        suite.count("failure"),
        suite.count("error"),
        suite.seconds,
        stamp.unwrap_or_default(),
    );
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for test in &suite.tests {
        // A viewer takes two tests of one name for one.
        let number = names.entry(test.name).and_modify(|n| *n += 1).or_insert(1);
        let mut name = attribute(test.name);
        if *number > 1 {
            let _ = write!(name, " ({number})");
        }
        let _ = write!(
            xml,
            "    <testcase classname=\"{case}\" name=\"{name}\" time=\"0\""
        );
        match &test.fault {
            None => xml.push_str("/>\n"),
            Some((element, message, body)) => {
                let message = attribute(message);
                let body = allowed(body);
                let _ = writeln!(
                    xml,
                    ">\n      <{element} message=\"{message}\">{}</{element}>\n    </testcase>",
                    escape(&body)
                );
            }
        }
    }
    xml.push_str("  </testsuite>\n");
}

/// Text inside an attribute, in one line.
fn attribute(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    escape(&allowed(&words.join(" ")))
}

/// Text without the characters that XML 1.0 does not allow, such as those of colours of a terminal.
fn allowed(text: &str) -> String {
    let allows = |c: &char| matches!(c, '\t' | '\n' | '\u{20}'..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
    text.chars().filter(allows).collect()
}
