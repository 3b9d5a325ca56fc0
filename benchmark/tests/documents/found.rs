//! Commands in the text of a document.

use proctor_benchmark::verbs;

/// A command as a document prints it, on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrintedCommand {
    pub line: String,
    /// The exit code that the comment beside it names, else 0.
    pub exit: i32,
    /// Lines of its output that the document shows below it.
    pub output: Vec<String>,
}

impl PrintedCommand {
    /// A command that ends well, without its output.
    pub fn of(line: &str) -> Self {
        Self {
            line: line.to_owned(),
            exit: 0,
            output: vec![],
        }
    }

    /// True if it has words that stand for others, or parts that may be left out.
    pub fn is_synopsis(&self) -> bool {
        let stands_for_others = |word: &str| {
            let word = word.trim_matches(|c| "[]….".contains(c));
            let letters = word.chars().filter(char::is_ascii_alphabetic);
            let first = word.split([',', '.']).next().unwrap_or_default();
            letters.count() > 0 && first.chars().all(|c| c.is_ascii_uppercase())
        };
        self.line.contains(['[', '|', '…']) && !self.line.contains("| proctor")
            || self.line.split_whitespace().any(stands_for_others)
    }
}

/// Reading of a line of a document.
#[derive(Clone, Copy)]
enum Block {
    /// Prose, or a command where it is indented.
    None,
    /// A line of the output of the last command.
    Output,
    /// Not at all: a file or a program.
    File,
    /// A command.
    Commands,
}

/// All commands of a text, in their order: lines of indented blocks and words between backticks that begin with `proctor`,
/// `cargo`, `sed`, a script, or a verb that is followed by something. A block of ```` ```text ```` below a command shows its
/// output; what is left out there is `…`.
pub fn commands(text: &str) -> Vec<PrintedCommand> {
    let mut all: Vec<PrintedCommand> = vec![];
    let mut prose = String::new();
    let mut block = Block::None;
    for line in text.lines() {
        if let Some(kind) = line.strip_prefix("```") {
            all.extend(between_backticks(&std::mem::take(&mut prose)));
            block = match (block, kind.trim()) {
                (Block::None, "text") => Block::Output,
                (Block::None, "json" | "rust") => Block::File,
                (Block::None, _) => Block::Commands,
                _ => Block::None,
            };
            continue;
        }
        let command = match (block, line.strip_prefix("    ")) {
            (Block::None, Some(command)) => command,
            (Block::Commands, _) => line,
            (Block::Output, _) => {
                let last = all.last_mut().expect("an output stands below a command");
                last.output.push(line.to_owned());
                continue;
            }
            (Block::File, _) => continue,
            (Block::None, None) => {
                prose.push_str(line);
                prose.push('\n');
                continue;
            }
        };
        all.extend(between_backticks(&std::mem::take(&mut prose)));
        let (command, comment) = command.split_once(" #").unwrap_or((command, ""));
        let exit = comment.split("exit code ").nth(1).unwrap_or_default();
        let exit = exit.split(|c: char| !c.is_ascii_digit()).next();
        let exit = exit.and_then(|code| code.parse().ok()).unwrap_or(0);
        all.extend(command_of(command).map(|printed| PrintedCommand { exit, ..printed }));
    }
    all.extend(between_backticks(&prose));
    all
}

fn between_backticks(prose: &str) -> Vec<PrintedCommand> {
    let parts = prose.split('`').skip(1).step_by(2);
    parts.filter_map(command_of).collect()
}

fn command_of(text: &str) -> Option<PrintedCommand> {
    let words: Vec<String> = text
        .split_whitespace()
        .map(|word| word.replace("\\|", "|"))
        .collect();
    let first = words.first()?;
    let known = match first.as_str() {
        "proctor" | "cargo" | "sed" => words.len() > 1,
        script if script.starts_with("scripts/") => script != "scripts/",
        verb => words.len() > 1 && verbs().iter().any(|known| known == verb),
    };
    let piped = words.windows(2).any(|pair| pair == ["|", "proctor"]);
    (known || piped).then(|| PrintedCommand::of(&words.join(" ")))
}

/// The words of a command line; what stands between quotes is one.
pub fn words(line: &str) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    for (number, part) in line.split('"').enumerate() {
        if number % 2 == 1 {
            all.push(part.to_owned());
        } else {
            all.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    all
}

/// Commands that a synopsis stands for: the needed words alone, and with each part in brackets. Words that stand for others are
/// put in.
pub fn readings(synopsis: &str) -> Vec<Vec<String>> {
    let (mut needed, mut parts, mut part) = (String::new(), vec![], None::<String>);
    for c in synopsis.replace("...", "…").chars() {
        match (c, &mut part) {
            ('[', _) => part = Some(String::new()),
            (']', _) => parts.extend(part.take()),
            ('…', _) => {}
            (c, Some(part)) => part.push(c),
            (c, None) => needed.push(c),
        }
    }
    let read = |text: &str| {
        words(text)
            .iter()
            .map(|word| put_in(word))
            .collect::<Vec<_>>()
    };
    let mut all = vec![read(&needed)];
    all.extend(parts.iter().map(|part| {
        let mut one = read(&needed);
        one.extend(read(part));
        one
    }));
    all
}

/// An example of what a word stands for.
fn put_in(word: &str) -> String {
    match word {
        "N" => "2".to_owned(),
        "N,N" => "1,2".to_owned(),
        "L" => "auto".to_owned(),
        word => word.split('|').next().unwrap_or_default().to_owned(),
    }
}

#[test]
fn commands_are_found_in_blocks_and_between_backticks() {
    let text = "Say `proctor\nrun a.json` or `keys`.\n\n    proctor plan a.json   # why\n    make | proctor run -\n    no command\n\n\
                | `export --format a\\|b RECORD` | `scripts/x` | `verify --quick` | `u + v` |\n";
    let found: Vec<String> = commands(text).into_iter().map(|c| c.line).collect();
    assert_eq!(
        found,
        [
            "proctor run a.json",
            "proctor plan a.json",
            "make | proctor run -",
            "export --format a|b RECORD",
            "scripts/x",
            "verify --quick"
        ]
    );
}

#[test]
fn a_synopsis_is_read_with_each_of_its_parts() {
    for (line, synopsis) in [
        ("run SCENE [--out DIR]", true),
        ("compare BASE HEAD", true),
        ("proctor run column.json --out results", false),
        ("proctor keys cpGIMP", false),
        ("make | proctor run -", false),
    ] {
        assert_eq!(PrintedCommand::of(line).is_synopsis(), synopsis, "{line}");
    }
    assert_eq!(
        readings("bench [CONFIG.json] [--threads N,N]"),
        [
            vec!["bench"],
            vec!["bench", "CONFIG.json"],
            vec!["bench", "--threads", "1,2"]
        ]
    );
    assert_eq!(
        readings("export --format bmf|csv RECORD"),
        [["export", "--format", "bmf", "RECORD"]]
    );
}

#[test]
fn exit_codes_and_outputs_belong_to_the_command_above_them() {
    let text = "    proctor plan a.json   # bad input: exit code 2\n\n```text\nplan … of a\n```\n\n```json\n{ \"a\": `keys x` }\n```\n\n`keys y`\n";
    let first = PrintedCommand {
        exit: 2,
        output: vec!["plan … of a".to_owned()],
        ..PrintedCommand::of("proctor plan a.json")
    };
    assert_eq!(commands(text), [first, PrintedCommand::of("keys y")]);
}
