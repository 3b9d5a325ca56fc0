//! The conditions of two records: differences that make their times incomparable.

use crate::record::Record;
use serde_json::Value;

/// A key of a context that matters.
struct Condition {
    key: &'static str,
    /// Word for people.
    word: &'static str,
    /// True if a record without it cannot be compared with one that has it.
    needed: bool,
}

const fn needed(key: &'static str, word: &'static str) -> Condition {
    Condition {
        key,
        word,
        needed: true,
    }
}

const fn if_known(key: &'static str, word: &'static str) -> Condition {
    Condition {
        key,
        word,
        needed: false,
    }
}

/// Conditions that decide the machine code.
const BUILD: [Condition; 3] = [
    needed("library_build_type", "build type"),
    if_known("target", "target"),
    if_known("target_features_compiled", "target features"),
];
/// Condition that decides the inner loops.
const LANES: Condition = needed("lanes", "lanes");
/// Conditions that decide the speed.
const MACHINE: [Condition; 4] = [
    needed("cpu_model", "processor"),
    LANES,
    needed("num_cpus", "number of logical processors"),
    if_known("cores_physical", "number of cores"),
];
/// Conditions that may explain a change.
const HINTS: [Condition; 2] = [
    if_known("rustc", "compiler"),
    if_known("features", "features"),
];

/// Reasons for which two records cannot be compared in full; `times` if their times matter.
#[must_use]
pub fn obstacles(base: &Record, head: &Record, times: bool) -> Vec<String> {
    let mut obstacles = vec![];
    for (name, record) in [("BASE", base), ("HEAD", head)] {
        if record.incomplete() {
            obstacles.push(format!(
                "{name} is incomplete: its measurement was interrupted"
            ));
        }
    }
    obstacles.extend(differences(base, head, &BUILD, "another build"));
    if times {
        obstacles.extend(differences(base, head, &MACHINE, "another machine"));
    } else if counts_instructions(base) || counts_instructions(head) {
        obstacles.extend(differences(base, head, &[LANES], "another machine"));
    }
    obstacles
}

/// Other differences that may explain a change.
#[must_use]
pub fn notes(base: &Record, head: &Record) -> Vec<String> {
    let mut notes = differences(base, head, &HINTS, "note");
    for (name, record) in [("BASE", base), ("HEAD", head)] {
        if record.context["dirty"] == true {
            notes.push(format!(
                "note: {name} was built from sources that were not committed"
            ));
        }
    }
    notes
}

fn counts_instructions(record: &Record) -> bool {
    let mut keys = record.rows.iter().flat_map(|row| row.counters.keys());
    keys.any(|key| key.starts_with("instructions"))
}

/// Conditions that differ, or are needed and given by only one of the two.
fn differences(base: &Record, head: &Record, conditions: &[Condition], what: &str) -> Vec<String> {
    let said = |value: &Value| match value {
        Value::Null => "unknown".to_owned(),
        Value::String(word) if word.is_empty() => "none".to_owned(),
        Value::String(word) => word.clone(),
        other => other.to_string(),
    };
    let of = |record: &Record, key: &str| record.context[key].clone();
    conditions
        .iter()
        .map(|condition| (condition, of(base, condition.key), of(head, condition.key)))
        .filter(|(condition, base, head)| {
            base != head && (condition.needed || !base.is_null() && !head.is_null())
        })
        .map(|(condition, base, head)| {
            let (word, base, head) = (condition.word, said(&base), said(&head));
            format!("{what}: {word} {base} in BASE, {head} in HEAD")
        })
        .collect()
}
