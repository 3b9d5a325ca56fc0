//! Whether two records were measured under the same conditions.

use crate::record::Record;
use serde_json::Value;

/// Keys of a context that decide the machine code.
const BUILD: [(&str, &str); 3] = [
    ("library_build_type", "build type"),
    ("target", "target"),
    ("target_features_compiled", "target features"),
];
/// Keys of a context that decide how fast it runs.
const MACHINE: [(&str, &str); 4] = [
    ("cpu_model", "processor"),
    ("lanes", "lanes"),
    ("num_cpus", "number of logical processors"),
    ("cores_physical", "number of cores"),
];

/// Why two records cannot be compared in full; `times` if their times matter.
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
        obstacles.extend(differences(base, head, &MACHINE[1..2], "another machine"));
    }
    obstacles
}

/// What else differs and may explain a change.
#[must_use]
pub fn notes(base: &Record, head: &Record) -> Vec<String> {
    let mut notes = differences(
        base,
        head,
        &[("rustc", "compiler"), ("features", "features")],
        "note",
    );
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

/// Keys whose values differ, or which only one of the two has.
fn differences(base: &Record, head: &Record, keys: &[(&str, &str)], what: &str) -> Vec<String> {
    let said = |value: &Value| match value {
        Value::Null => "unknown".to_owned(),
        Value::String(word) if word.is_empty() => "none".to_owned(),
        Value::String(word) => word.clone(),
        other => other.to_string(),
    };
    keys.iter()
        .map(|(key, word)| (word, &base.context[*key], &head.context[*key]))
        .filter(|(_, base, head)| base != head)
        .map(|(word, base, head)| {
            format!(
                "{what}: {word} {} in BASE, {} in HEAD",
                said(base),
                said(head)
            )
        })
        .collect()
}
