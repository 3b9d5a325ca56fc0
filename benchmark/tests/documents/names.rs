//! Names in the documents: keys with a value are keys of scenes, identifiers are in the sources, and paths lead to files.

use super::{documents, files_below, has_ending, root, text_of};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// Folders of the sources, in which names and files are looked for.
const SOURCES: [&str; 5] = ["kernel", "verification", "benchmark", "fixtures", "scripts"];

/// Words between backticks, outside of blocks.
fn quoted(text: &str) -> Vec<String> {
    let mut prose = String::new();
    let mut inside = false;
    for line in text.lines() {
        if line.starts_with("```") {
            inside = !inside;
        } else if !inside && !line.starts_with("    ") {
            prose.push_str(line);
            prose.push('\n');
        }
    }
    let parts = prose.split('`').skip(1).step_by(2);
    parts.map(str::to_owned).collect()
}

/// Keys of `"key": value`, and the value where it is a word.
fn keys(quoted: &str) -> Vec<&str> {
    let Some((key, value)) = quoted.split_once("\": ") else {
        return vec![];
    };
    let key = key.trim_start_matches(['{', ' ', '"']);
    let value = value.trim_matches(['"', '}', ' ']);
    let is_word = value.chars().all(|c| c.is_ascii_lowercase() || c == '_');
    if is_word && !["true", "false"].contains(&value) {
        vec![key, value]
    } else {
        vec![key]
    }
}

/// Names of the sources, which have an underscore; columns of a body or a probe are made by a run.
fn is_identifier(word: &str) -> bool {
    word.contains('_')
        && word.starts_with(|c: char| c.is_ascii_alphabetic())
        && !word.ends_with('_')
        && !["body1", "body2", "momentum", "top"]
            .contains(&word.split('_').next().unwrap_or_default())
        && word
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

fn is_source(path: &str) -> bool {
    has_ending(Path::new(path), &["rs"])
}

fn is_path(word: &str) -> bool {
    let (first, _) = word.split_once('/').unwrap_or_default();
    let in_sources = SOURCES.contains(&first) || [".github", ".ci", "docs"].contains(&first);
    let plain = !word.contains(['*', ' ', '{', '<']) && !word.contains("NAME");
    plain && (in_sources || word.contains('/') && is_source(word))
}

/// True if `proctor keys` has an answer for a word.
fn is_known(word: &str) -> bool {
    let mut command = Command::new(env!("CARGO_BIN_EXE_proctor"));
    let output = command.args(["keys", word]).output().expect("an answer");
    output.status.success()
}

#[test]
fn keys_with_a_value_are_keys_of_scenes() {
    let (mut faults, mut checked) = (vec![], 0);
    let mut known = BTreeMap::new();
    for document in documents() {
        for text in quoted(&text_of(&document)) {
            for word in keys(&text) {
                checked += 1;
                if !*known
                    .entry(word.to_owned())
                    .or_insert_with(|| is_known(word))
                {
                    faults.push(format!("{document}: {text}: {word}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked > 20, "only {checked} keys were found");
}

#[test]
fn identifiers_and_paths_are_in_the_sources() {
    let files: Vec<String> = SOURCES
        .iter()
        .flat_map(|folder| files_below(folder, &["rs", "json", "py", "awk", "csv", "md", "toml"]))
        .collect();
    let mut words = BTreeSet::new();
    for file in files
        .iter()
        .filter(|f| is_source(f) || f.contains("/templates/"))
    {
        let text = text_of(file);
        let all = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        words.extend(all.filter(|word| is_identifier(word)).map(str::to_owned));
    }
    let (mut faults, mut checked) = (vec![], 0);
    for document in documents() {
        for word in quoted(&text_of(&document)) {
            let found = if is_path(&word) {
                root().join(&word).exists()
                    || files.iter().any(|f| f.ends_with(&format!("/{word}")))
            } else if is_identifier(&word) {
                words.contains(&word)
            } else {
                continue;
            };
            checked += 1;
            if !found {
                faults.push(format!("{document}: {word}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked > 50, "only {checked} names were found");
}

#[test]
fn names_are_told_from_prose() {
    let text = "Say `\"friction\": 0.6`, `time_step` and `kernel/src`.\n\n    not `this`\n";
    let found = quoted(text);
    assert_eq!(found, ["\"friction\": 0.6", "time_step", "kernel/src"]);
    assert_eq!(keys(&found[0]), ["friction"]);
    assert_eq!(keys("\"tension\": \"none\""), ["tension", "none"]);
    assert!(is_known("tension") && !is_known("frobnication"));
    assert!(is_identifier("time_step") && !is_identifier("time") && !is_identifier("T_s"));
    assert!(is_path("kernel/src") && is_path("mortar/ties.rs") && !is_path("a/b.json"));
}
