//! The action for other projects and the workflows: their scripts are ones, they call what is there, take no text of others for a
//! part of a script, and the manual has every input.

use super::{root, text_of};
use std::collections::BTreeSet;
use std::process::Command;

/// Paths of the action and of all workflows.
fn files() -> Vec<String> {
    let folder = root().join(".github/workflows");
    let entries = std::fs::read_dir(folder).expect("workflows");
    let mut files: Vec<String> = entries
        .flatten()
        .map(|entry| format!(".github/workflows/{}", entry.file_name().to_string_lossy()))
        .collect();
    files.push("action.yml".to_owned());
    files.sort();
    files
}

/// The scripts of the steps: what follows `run:`, a line or a block of lines that are further in.
fn scripts(text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let mut all = vec![];
    for (i, line) in lines.iter().enumerate() {
        let Some((_, script)) = line.split_once("run: ") else {
            continue;
        };
        if script != "|" {
            all.push(script.to_owned());
            continue;
        }
        let block = lines[i + 1..].iter();
        let block = block.take_while(|next| next.trim().is_empty() || indent(next) > indent(line));
        all.push(block.copied().collect::<Vec<_>>().join("\n"));
    }
    all
}

#[test]
fn each_script_of_a_workflow_is_one_and_calls_what_is_there() {
    let mut count = 0;
    for file in files() {
        for script in scripts(&text_of(&file)) {
            // Names of branches and titles are text of whoever wrote them.
            for foreign in [
                "github.head_ref",
                "github.base_ref",
                "github.event.",
                "inputs.",
            ] {
                assert!(!script.contains(foreign), "{file}: {foreign} in {script}");
            }
            let checked = Command::new("bash").args(["-n", "-c", &script]).output();
            let checked = checked.expect("bash runs");
            assert!(
                checked.status.success(),
                "{file}: {script}\n{}",
                String::from_utf8_lossy(&checked.stderr)
            );
            for word in script.split(|c: char| c.is_whitespace() || c == '"') {
                let path = word.trim_start_matches("$SOURCES/");
                if path.starts_with("scripts/") || path.starts_with(".ci/") {
                    assert!(root().join(path).is_file(), "{file}: {path}");
                }
            }
            count += 1;
        }
    }
    assert!(count > 25, "{count} scripts");
}

#[test]
fn the_manual_has_every_input_of_the_action() {
    let action = text_of("action.yml");
    let (_, inputs) = action.split_once("\ninputs:\n").expect("inputs");
    let (inputs, _) = inputs.split_once("\noutputs:").expect("outputs");
    let known: BTreeSet<&str> = inputs
        .lines()
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.trim().strip_suffix(':'))
        .collect();
    let manual = text_of("docs/src/howto/ci.md");
    let (_, table) = manual
        .split_once("| input | is | default |\n")
        .expect("a table");
    let told: BTreeSet<&str> = table
        .lines()
        .take_while(|line| line.starts_with('|'))
        .filter_map(|line| line.strip_prefix("| `")?.split('`').next())
        .collect();
    assert_eq!(known, told);
    assert!(known.contains("config") && known.len() >= 7);
}
