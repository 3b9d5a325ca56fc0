//! The rows of the stiff and extreme scenes, and how they are judged.

use proctor_verification::case::Gate;
use proctor_verification::stability::extreme::{Ending, Finding, all};
use std::collections::BTreeSet;

#[test]
fn each_row_has_a_name_of_its_own() {
    let rows = all();
    let names: BTreeSet<&str> = rows.iter().map(|row| row.name).collect();
    assert_eq!(names.len(), rows.len());
    for row in rows {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(row.name.chars().all(plain), "{}", row.name);
        assert!(
            !row.what.is_empty() && !row.required.is_empty(),
            "{}",
            row.name
        );
    }
}

/// Rows that take milliseconds; the command runs all of them.
#[test]
fn some_rows_end_as_they_must() {
    for (name, ending) in [
        ("translation", Ending::Held),
        ("origin-1e9", Ending::Held),
        ("one-cell-across", Ending::Held),
        ("domain-exit", Ending::Held),
        ("step-too-long", Ending::Held),
        ("not-finite-state", Ending::Held),
        ("not-finite-input", Ending::Refused),
        ("impossible-constants", Ending::Refused),
    ] {
        let row = all().into_iter().find(|row| row.name == name);
        let finding = (row.expect("a row").judge)().unwrap_or_else(|e| panic!("{name}: {e}"));
        let failed: Vec<&Gate> = finding.gates.iter().filter(|gate| !gate.passed()).collect();
        assert_eq!(finding.ending(), ending, "{name}: {failed:?}");
    }
}

#[test]
fn a_row_fails_with_one_gate_and_by_saying_nothing() {
    let gate = |value| Gate::at_most("a gate".to_owned(), value, 1.0, "so that it can fail");
    let finding = |values: &[f64], refusals: &[&str]| Finding {
        gates: values.iter().map(|&value| gate(value)).collect(),
        refusals: refusals.iter().map(|&text| text.to_owned()).collect(),
    };
    assert_eq!(finding(&[], &[]).ending(), Ending::Failed);
    assert_eq!(finding(&[0.5], &[]).ending(), Ending::Held);
    assert_eq!(finding(&[0.5], &["no"]).ending(), Ending::Held);
    assert_eq!(finding(&[], &["no"]).ending(), Ending::Refused);
    assert_eq!(finding(&[0.5, 2.0], &["no"]).ending(), Ending::Failed);
    assert_eq!(finding(&[f64::NAN], &[]).ending(), Ending::Failed);
}
