//! The figures that the documents print are those of the kept record of the full ladders, or of the short ones where that has none.
//!
//! A table with the headings `case`, `gate`, `found`, `bound` names gates as `proctor verify` does. What it prints must be
//! what the record holds, to the digits it prints.

use proctor_benchmark::record::export::{Format, text};
use proctor_benchmark::record::{Kind, Record, Row};
use std::fs;

use super::{documents, root, text_of};

fn kept() -> Record {
    Record::read(&root().join("fixtures/expected/full.json")).expect("the kept record")
}

/// The kept record of the short ladders.
fn kept_short() -> Record {
    Record::read(&root().join("fixtures/expected/errors.json")).expect("the kept record")
}

fn is_gate(row: &Row) -> bool {
    matches!(&row.kind, Kind::Aggregate { name } if name == "gate")
}

/// A number as printed, and half a unit of its last digit.
fn printed(cell: &str) -> (f64, f64) {
    let (digits, scale) = match cell.strip_suffix('%') {
        Some(percent) => (percent.trim(), 0.01),
        None => (cell.split(' ').next().unwrap_or_default(), 1.0),
    };
    let value: f64 = digits
        .parse()
        .unwrap_or_else(|_| panic!("{cell}: no number"));
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((digits, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let exponent: i32 = exponent.parse().expect("an exponent");
    let half = 0.5 * 10_f64.powi(exponent - decimals as i32);
    (value * scale, half * scale * (1.0 + 1e-9))
}

/// Cells of a line of a table.
fn cells(line: &str) -> Vec<&str> {
    line.trim_matches('|').split(" | ").map(str::trim).collect()
}

fn gate<'a>(record: &'a Record, case: &str, name: &str) -> Option<&'a Row> {
    let wanted = format!("{case}: {name}");
    record
        .rows
        .iter()
        .find(|row| is_gate(row) && row.name == wanted)
}

#[test]
fn tables_print_what_the_kept_record_holds() {
    let records = [kept(), kept_short()];
    let mut checked = 0;
    for document in documents() {
        let text = text_of(&document);
        let mut inside = false;
        for line in text.lines() {
            if !line.starts_with('|') {
                inside = false;
                continue;
            }
            let cells = cells(line);
            if cells == ["case", "gate", "found", "bound"] {
                inside = true;
            } else if inside && !line.starts_with("|---") {
                let [case, name, found, bound] = cells[..] else {
                    panic!("{document}: {line}");
                };
                let row = { records.iter() }
                    .find_map(|record| gate(record, case, name))
                    .unwrap_or_else(|| panic!("{document}: no gate {case}: {name} in the records"));
                for (cell, key) in [(found, "gate_value"), (bound, "gate_bound")] {
                    let (value, half) = printed(cell);
                    let kept = row.counters[key];
                    assert!(
                        (value - kept).abs() <= half,
                        "{document}: {line}\n{key} is {kept}"
                    );
                }
                checked += 1;
            }
        }
    }
    assert!(checked >= 20, "only {checked} figures are printed");
}

#[test]
fn the_list_of_all_gates_is_that_of_the_kept_record() {
    let list = fs::read_to_string(root().join("verification/FIGURES.md")).expect("the list");
    let (_, list) = list.split_once("-->\n\n").expect("a heading");
    let made = text(&kept(), Format::Gates, "").expect("gates");
    assert!(
        list == made,
        "verification/FIGURES.md is not that of fixtures/expected/full.json; scripts/update-expected --full makes it"
    );
}

/// Words such as `668 of 668 gates in 43 cases`; an output of fewer cases is held against the program.
#[test]
fn numbers_of_gates_are_those_of_a_kept_record() {
    let counted = ["errors.json", "full.json"].map(|name| {
        let path = root().join("fixtures/expected").join(name);
        let record = Record::read(&path).expect("a kept record");
        let gates: Vec<&Row> = record.rows.iter().filter(|row| is_gate(row)).collect();
        let case = |row: &&Row| row.name.split(':').next().unwrap_or_default().to_owned();
        let cases: std::collections::BTreeSet<String> = gates.iter().map(case).collect();
        format!("{0} of {0} gates in {1} cases", gates.len(), cases.len())
    });
    let mut seen = 0;
    for document in documents() {
        let text = text_of(&document);
        let words: Vec<&str> = text.split_whitespace().collect();
        for phrase in words
            .windows(7)
            .filter(|w| w[1] == "of" && w[3] == "gates" && w[6].starts_with("cases"))
        {
            let phrase = phrase.join(" ");
            let found = counted.iter().any(|counted| phrase.starts_with(counted));
            assert!(found, "{document}: {phrase}; kept: {counted:?}");
            seen += 1;
        }
    }
    assert!(seen >= 2, "only {seen} numbers of gates are printed");
}

#[test]
fn every_gate_of_the_kept_record_holds() {
    for row in &kept().rows {
        assert_eq!(row.error, None, "{}", row.name);
    }
}

#[test]
fn printed_numbers_have_the_width_of_their_last_digit() {
    let close = |cell: &str, value: f64, half: f64| {
        let found = printed(cell);
        assert!((found.0 - value).abs() < 1e-15, "{cell}: {found:?}");
        assert!((found.1 - half).abs() < 1e-6 * half, "{cell}: {found:?}");
    };
    close("0.398 %", 0.003_98, 5e-6);
    close("2.5e-7", 2.5e-7, 5e-9);
    close("1.90", 1.9, 5e-3);
    close("474 N", 474.0, 0.5);
}
