//! The table of what users are promised: each line names tests, and each of them is there.

use super::{files_below, text_of};
use std::collections::BTreeMap;

/// Between backticks, what names a test: its modules and its function.
fn tests(line: &str) -> Vec<(&str, &str)> {
    let quoted = line.split('`').skip(1).step_by(2);
    quoted.filter_map(|name| name.rsplit_once("::")).collect()
}

#[test]
fn each_promise_has_its_tests() {
    let readme = text_of("benchmark/README.md");
    let (_, table) = readme
        .split_once("\n## What users are promised\n")
        .expect("a section");
    let lines: Vec<&str> = table
        .lines()
        .filter(|line| line.starts_with("| "))
        .skip(1)
        .collect();
    assert!(lines.len() > 30, "{} lines", lines.len());
    let sources =
        ["benchmark", "verification", "kernel"].map(|folder| files_below(folder, &["rs"]));
    let mut known: BTreeMap<String, String> = BTreeMap::new();
    for line in lines {
        let named = tests(line);
        assert!(!named.is_empty(), "no test: {line}");
        for (modules, function) in named {
            // `a::b::test` stands in a file `…/a/b.rs`.
            let file = format!("/{}.rs", modules.replace("::", "/"));
            let found = sources
                .iter()
                .flatten()
                .filter(|path| path.ends_with(&file));
            let held = found.into_iter().any(|path| {
                let text = known.entry(path.clone()).or_insert_with(|| text_of(path));
                let head = format!("fn {function}() {{");
                text.split_once(&head).is_some_and(|(before, _)| {
                    let above = before.lines().map(str::trim).rev();
                    // A long one is ignored, too.
                    above
                        .filter(|line| !line.is_empty())
                        .take_while(|line| line.starts_with("#["))
                        .any(|line| line == "#[test]")
                })
            });
            assert!(held, "{modules}::{function} is no test of a file {file}");
        }
    }
}
