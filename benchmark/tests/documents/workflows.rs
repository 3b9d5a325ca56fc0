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

/// The recipe of the container builds the program as the release does, and takes it from where it is then.
#[test]
fn the_recipe_of_the_container_and_the_release_build_one_program() {
    let recipe = text_of("Containerfile");
    let release = text_of(".github/workflows/release.yml");
    let build = "cargo build --release --locked --bin proctor";
    assert!(recipe.contains(&format!("\nRUN {build}\n")), "{recipe}");
    assert!(release.contains(&format!("run: {build} ")), "{release}");
    let built = "COPY --from=build /sources/target/release/proctor /usr/local/bin/proctor\n";
    assert!(recipe.contains(built), "{recipe}");
    assert!(recipe.contains("\nENTRYPOINT [\"proctor\"]\n"), "{recipe}");
    let program = text_of("benchmark/Cargo.toml");
    assert!(program.contains("name = \"proctor\""), "{program}");
    // Whoever reads the manual knows what was not run.
    let manual = text_of("docs/src/howto/ci.md");
    for words in ["`Containerfile`", "the container was not built"] {
        assert!(manual.contains(words), "{words}");
    }
}

/// Verbs that workflows, the action and scripts call are those of the program, with their options.
#[test]
fn workflows_and_scripts_call_verbs_and_options_that_there_are() {
    let help = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_proctor"));
        let output = command.args(arguments).arg("--help").output();
        let output = output.expect("help");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        output.status.success().then_some(text)
    };
    let mut checked = BTreeSet::new();
    let scripts = files().into_iter();
    for file in
        scripts.chain(["scripts/judge-solver", "scripts/compare-commits"].map(str::to_owned))
    {
        // A call may go on behind the end of a line.
        let text = text_of(&file).replace("\\\n", " ");
        for line in text.lines().filter(|line| !line.trim().starts_with('#')) {
            let called = ["release/proctor ", "\"$proctor\" ", "$image:$TAG\" "];
            let called = called.iter().find_map(|name| line.split_once(name));
            let Some((_, call)) = called else { continue };
            let words: Vec<&str> = call.split_whitespace().collect();
            let Some(verb) = words
                .first()
                .filter(|verb| verb.chars().all(|c| c.is_ascii_lowercase()))
            else {
                continue;
            };
            let mut text = help(&[verb]).unwrap_or_else(|| panic!("{file}: {verb}"));
            // `verify mill` has options of its own.
            text.push_str(&help(&[verb, words.get(1).unwrap_or(verb)]).unwrap_or_default());
            for option in words.iter().filter(|word| word.starts_with("--")) {
                let option = option.trim_end_matches([')', '"', ';']);
                assert!(text.contains(option), "{file}: {verb} {option}");
                checked.insert(format!("{verb} {option}"));
            }
        }
    }
    assert!(checked.len() >= 8, "{checked:?}");
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
