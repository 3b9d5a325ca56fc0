//! The commands that the documents print are run, in their order, in one folder per document.
//!
//! The arguments of each must be such as the command takes. What is no synopsis is run as it stands, but for what takes
//! minutes or needs other programs: that is run on less, or not at all, and [`how`] says why.

use super::found::{PrintedCommand, commands, readings, words};
use super::{documents, root, text_of};
use proctor_benchmark::takes;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use tempfile::TempDir;

/// Mode in which a command is run.
#[derive(Debug, PartialEq, Eq)]
enum RunMode {
    /// The command as it stands.
    AsItStands,
    /// The command with these arguments after its own: the same on less.
    With(&'static [&'static str]),
    /// The command with these arguments in place of its own, which say the same on less.
    Instead(&'static [&'static str]),
    /// Its arguments are checked, and it is not run, for that reason.
    NotRun(&'static str),
}

/// Mode in which a command of this program is run.
fn how(arguments: &[&str]) -> RunMode {
    match arguments {
        ["verify", "--list"]
        | ["verify", "bar" | "self-weight", "--quick", ..]
        | ["bench", "peers.json" | "late.json" | "labelled.json"] => RunMode::AsItStands,
        [] | ["--wrong-references"] => {
            RunMode::NotRun("the main job takes minutes; CI runs it and looks at what it writes")
        }
        ["stability", "--extreme"] => RunMode::With(&["--row", "denormals"]),
        ["stability", ..] => RunMode::NotRun(
            "all methods take minutes; tests/command/stability.rs runs some of them",
        ),
        ["verify"] | ["verify", "--quick"] => {
            RunMode::NotRun("all cases take a minute; tests/cases.rs of the verification runs them")
        }
        ["verify", "--generated", ..] => RunMode::Instead(&["verify", "--generated", "12"]),
        ["verify", "refine", ..] => {
            RunMode::NotRun("the kept ladders are not there; tests/command/refine.rs reads them")
        }
        [
            "refine",
            "earthquake.json" | "fixtures/scenes/ground/quarry.json",
            ..,
        ] => RunMode::NotRun(
            "three meshes of a slope take a quarter of a minute; tests/command/stages.rs refines a column",
        ),
        ["verify", "mill", ..] => {
            RunMode::Instead(&["verify", "mill", "--count", "2", "--seed", "5"])
        }
        // Names and options are looked at; the runs are those of tests/cases.rs.
        ["verify", rest @ ..] if rest.contains(&"--quick") => RunMode::With(&["--list"]),
        ["verify", ..] => RunMode::With(&["--quick", "--list"]),
        ["precision"] => RunMode::NotRun("all studies take minutes"),
        ["precision", "boussinesq", rest @ ..] if rest.contains(&"--executables") => {
            // The solver stays out: the one that is here can do nothing but fall; tests/command/guests.rs hands it cases.
            RunMode::Instead(&["precision", "step-bar", "--quick", "--svg", "charts"])
        }
        ["precision", "boussinesq", ..] => {
            RunMode::Instead(&["precision", "self-weight", "--quick"])
        }
        [
            "bench",
            "fixtures/bench/laws.json" | "fixtures/bench/water.json",
            ..,
        ] => {
            RunMode::NotRun("all laws take a minute; the configuration of speed is one of its kind")
        }
        ["precision" | "bench", ..] if !arguments.contains(&"--quick") => {
            RunMode::With(&["--quick"])
        }
        ["run", scene, ..] if scene.starts_with("fixtures/scenes/speed/") => {
            RunMode::Instead(&["plan", "fixtures/scenes/speed/block_1m.json"])
        }
        ["export", "--format", "book", ..] => RunMode::NotRun(
            "the kept ladders are not there; tests/documents/book.rs compares the pages",
        ),
        ["export", "--format", "problems", ..] => {
            RunMode::NotRun("it runs every open case; tests/command/guest_bounds.rs judges frames")
        }
        ["history", rest @ ..] if rest.contains(&"--git") => {
            RunMode::Instead(&["history", "record.json"])
        }
        _ => RunMode::AsItStands,
    }
}

/// Arguments of this program in a command of a document: after `proctor` or `cargo run --release --`, or those that begin
/// with a verb; none for other programs.
fn own(words: &[String]) -> Option<Vec<&str>> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["proctor", ref arguments @ ..]
        | [_, "|", "proctor", ref arguments @ ..]
        | ["cargo", "run", "--release", "--", ref arguments @ ..] => Some(arguments.to_vec()),
        ["cargo", "run", "--release"] => Some(vec![]),
        ["cargo" | "sed", ..] => None,
        [script, ..] if script.starts_with("scripts/") => None,
        ref arguments => Some(arguments.to_vec()),
    }
}

/// A folder in which the commands of a document find what they name.
fn desk() -> TempDir {
    let desk = TempDir::new().expect("a folder");
    let at = |name: &str| desk.path().join(name);
    // What a checkout has; files that are written go into the folder.
    for folder in ["scenes", "bench", "records", "surfaces"] {
        let folder = format!("fixtures/{folder}");
        copy(&root().join(&folder), &at(&folder));
    }
    copy(&root().join("fixtures/bench"), desk.path());
    // A hundredth of the work.
    for (name, whole, less) in [
        ("rings", "30000000", "300000"),
        ("ranks", "5120000", "51200"),
        ("speed", "5120000", "51200"),
    ] {
        let file = at(&format!("fixtures/bench/{name}.json"));
        let text = fs::read_to_string(&file).expect("a configuration");
        let changed = text.replace(whole, less).replace("64000", "8000");
        assert_ne!(text, changed);
        fs::write(&file, changed).expect("a configuration");
    }
    copy(&root().join("fixtures/scenes"), &at("scenes"));
    fs::copy(at("fixtures/bench/peers.json"), at("peer.json")).expect("a configuration");
    // What the tutorials have their reader copy.
    for name in ["soil_element.json", "triaxial_path.csv"] {
        fs::copy(at("scenes").join(name), at(name)).expect("a scene");
    }
    for name in ["record.json", "base.json", "head.json"] {
        fs::write(at(name), record()).expect("a record");
    }
    desk
}

/// A record of the bar, which is made once for all desks.
fn record() -> &'static [u8] {
    static RECORD: OnceLock<Vec<u8>> = OnceLock::new();
    RECORD.get_or_init(|| {
        let folder = TempDir::new().expect("a folder");
        let command = ["verify", "bar", "--quick", "--json", "record.json"];
        run(folder.path(), &command, 0).expect("a record");
        fs::read(folder.path().join("record.json")).expect("a record")
    })
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").flatten() {
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &to);
        } else {
            fs::copy(&path, &to).expect("a file");
        }
    }
}

/// Runs this program in a folder, with a scene on standard input; its output, once it has ended with that exit code.
fn run(folder: &Path, arguments: &[&str], exit: i32) -> Result<String, String> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_proctor"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| error.to_string())?;
    if let Some(mut input) = child.stdin.take() {
        let scene = fs::read(folder.join("column.json")).unwrap_or_default();
        // Who does not read it closes it.
        let _ = input.write_all(&scene);
    }
    let output = child
        .wait_with_output()
        .map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    if output.status.code() == Some(exit) {
        return Ok(text);
    }
    Err(format!("{}, expected {exit}: {text}", output.status))
}

/// Lines that a document shows of an output and that are not in it. Blanks count once, and `…` stands for anything.
fn missing(shown: &[String], output: &str) -> Result<(), String> {
    let tidy = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let lines: Vec<String> = output.lines().map(tidy).collect();
    let is_in = |line: &str, shown: &str| {
        let mut rest = line;
        shown.split('…').map(str::trim).all(|part| {
            let found = rest.find(part);
            rest = found.map_or("", |at| &rest[at + part.len()..]);
            found.is_some()
        })
    };
    for shown in shown.iter().map(|line| tidy(line)) {
        if !lines.iter().any(|line| is_in(line, &shown)) {
            return Err(format!("its output has no line `{shown}`:\n{output}"));
        }
    }
    Ok(())
}

/// Fault of a command of a document.
fn fault(printed: &PrintedCommand, desk: &Path) -> Result<(), String> {
    let all = words(&printed.line);
    if own(&all).is_none() {
        return other(&printed.line, &all, desk);
    }
    if printed.is_synopsis() {
        for reading in readings(&printed.line) {
            let arguments = own(&reading).ok_or("no command of this program")?;
            takes(&arguments)?;
        }
        return Ok(());
    }
    let mut arguments = own(&all).ok_or("no command of this program")?;
    takes(&arguments)?;
    let how = how(&arguments);
    if how != RunMode::AsItStands && !printed.output.is_empty() {
        return Err("its output is shown, and it is not run as it stands".to_owned());
    }
    match how {
        RunMode::NotRun(_) => return Ok(()),
        RunMode::AsItStands => {}
        RunMode::With(more) => arguments.extend(more),
        RunMode::Instead(others) => arguments = others.to_vec(),
    }
    missing(&printed.output, &run(desk, &arguments, printed.exit)?)
}

/// Commands of other programs: scripts of the repository, cargo, and `sed` that writes a changed scene.
fn other(line: &str, words: &[String], desk: &Path) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["cargo", "test", ref options @ ..] => targets(options),
        ["cargo", "bench", ref options @ ..] => benches(options),
        [
            "cargo",
            "build" | "clippy" | "doc" | "fmt" | "install" | "mutants",
            ..,
        ] => Ok(()),
        [
            "cargo",
            "run",
            "--release",
            "--package",
            package,
            "--example",
            name,
        ] => {
            let known = TESTED.iter().find(|(named, _)| *named == package);
            let (_, folder) = known.ok_or_else(|| format!("there is no package {package}"))?;
            exists(&format!("{folder}/examples/{name}.rs"))
        }
        ["sed", ..] => {
            let mut shell = Command::new("sh");
            let done = shell.args(["-c", line]).current_dir(desk).status();
            match done {
                Ok(status) if status.success() => Ok(()),
                found => Err(format!("{found:?}")),
            }
        }
        ["cargo", ..] => Err("nothing is known of this command".to_owned()),
        [script, ref arguments @ ..] => {
            exists(script)?;
            let text = fs::read_to_string(root().join(script)).map_err(|e| e.to_string())?;
            for option in arguments {
                let option = option.trim_matches(|c| "[]".contains(c));
                if option.starts_with("--") && !text.contains(option) {
                    return Err(format!("{script} does not know {option}"));
                }
            }
            // The one that needs nothing and takes no time; the others need builds, browsers or half an hour, and CI runs
            // those that it can.
            if script == "scripts/check-imports" && python() {
                let done = Command::new(root().join(script))
                    .current_dir(root())
                    .status();
                return match done {
                    Ok(status) if status.success() => Ok(()),
                    found => Err(format!("{script}: {found:?}")),
                };
            }
            Ok(())
        }
        [] => Err("nothing".to_owned()),
    }
}

/// Options of `cargo bench` name a bench that there is, or are one of criterion's.
fn benches(options: &[&str]) -> Result<(), String> {
    match options {
        [] | ["--", "--save-baseline", _] => Ok(()),
        ["--bench", name, ..] => exists(&format!("benchmark/benches/{name}.rs"))
            .or_else(|_| exists(&format!("benchmark/benches/{name}/main.rs"))),
        _ => Err("nothing is known of these options".to_owned()),
    }
}

/// Packages that have tests, and their folders.
const TESTED: [(&str, &str); 4] = [
    ("proctor-kernel", "kernel"),
    ("proctor-files", "kernel/files"),
    ("proctor-verification", "verification"),
    ("proctor-benchmark", "benchmark"),
];

/// Options of `cargo test` name a package and a test program that there are, and then tests by their modules.
fn targets(options: &[&str]) -> Result<(), String> {
    let own = options.split(|word| *word == "--").next();
    let mut own = own.unwrap_or_default().iter();
    let mut folders: Vec<&str> = TESTED.iter().map(|(_, folder)| *folder).collect();
    while let Some(&option) = own.next() {
        let mut value = || own.next().ok_or(format!("{option} wants a name"));
        match option {
            "-p" | "--package" => {
                let package = value()?;
                folders = TESTED
                    .iter()
                    .filter(|(name, _)| name == package)
                    .map(|(_, folder)| *folder)
                    .collect();
                if folders.is_empty() {
                    return Err(format!("there is no package {package}"));
                }
            }
            "--test" => {
                let name = value()?;
                folders.retain(|folder| exists(&format!("{folder}/tests/{name}.rs")).is_ok());
                if folders.is_empty() {
                    return Err(format!("there is no test program {name}"));
                }
            }
            filter => {
                let modules = filter.trim_end_matches("::").replace("::", "/");
                let places = folders.iter().flat_map(|folder| {
                    ["", ".rs", "/mod.rs"].map(|end| format!("{folder}/tests/{modules}{end}"))
                });
                if !places.into_iter().any(|place| root().join(place).exists()) {
                    return Err(format!("there is no module {filter}"));
                }
            }
        }
    }
    Ok(())
}

fn exists(path: &str) -> Result<(), String> {
    let found = root().join(path).is_file();
    found.then_some(()).ok_or(format!("there is no {path}"))
}

fn python() -> bool {
    let version = Command::new("python3").arg("--version").output();
    version.is_ok_and(|output| output.status.success())
}

#[test]
#[ignore = "takes 36 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn every_command_of_the_documents_runs() {
    let mut faults = vec![];
    let (mut checked, mut shown) = (0, 0);
    let mut measured = BTreeSet::new();
    for document in documents() {
        let commands = commands(&text_of(&document));
        if commands.is_empty() {
            continue;
        }
        if document.starts_with("docs/src/verification/cases/") {
            // Each case by its name; tests/cases.rs of the verification runs them.
            for printed in commands {
                let all = words(&printed.line);
                let arguments = own(&all).unwrap_or_default();
                if let Err(fault) = takes(&arguments) {
                    faults.push(format!("{document}: {}\n  {fault}", printed.line));
                }
            }
            continue;
        }
        let desk = desk();
        for printed in commands {
            checked += 1;
            shown += printed.output.len();
            // What measures leaves nothing that a document needs further down: once is enough for all.
            let measures = ["bench", "precision"]
                .iter()
                .any(|verb| printed.line.contains(verb));
            if measures && printed.output.is_empty() && !measured.insert(printed.line.clone()) {
                continue;
            }
            if let Err(fault) = fault(&printed, desk.path()) {
                faults.push(format!("{document}: {}\n  {fault}", printed.line));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked > 150, "only {checked} commands were found");
    assert!(shown > 60, "only {shown} lines of output are shown");
}

#[test]
fn commands_that_there_are_not_are_found() {
    let desk = desk();
    for line in [
        "proctor frobnicate x",
        "proctor keys frobnication",
        "proctor run column.json --speed 2",
        "proctor verify barr",
        "cargo run --release -- verify --fast",
        "cargo test -p proctor-benchmark --test judges",
        "cargo test --test judges",
        "cargo test --test kernel judge::",
        "cargo test -p proctor-files --test kernel",
        "cargo bench --bench instruction",
        "cargo bench -- --save-baselines NAME",
        "cargo frobnicate",
        "cargo test -p proctor-kernel frobnication",
        "scripts/frobnicate",
        "scripts/full-ladders --frobnicate",
        "stability [SCENE] [--rows NAME]",
    ] {
        assert!(
            fault(&PrintedCommand::of(line), desk.path()).is_err(),
            "{line}"
        );
    }
}

#[test]
fn outputs_that_there_are_not_are_found() {
    let output = "particles  800\nstepping 44.6 ms wall, 44.6 ms CPU\n";
    let shown = |line: &str| missing(&[line.to_owned()], output);
    for line in ["particles 800", "stepping … wall, … CPU", "…", "", "  800"] {
        assert!(shown(line).is_ok(), "{line}");
    }
    for line in ["particles 801", "stepping … CPU, … wall", "steps 800"] {
        assert!(shown(line).is_err(), "{line}");
    }
    let desk = desk();
    let printed = |exit: i32| PrintedCommand {
        exit,
        ..PrintedCommand::of("proctor plan nothing.json")
    };
    assert!(fault(&printed(2), desk.path()).is_ok());
    assert!(fault(&printed(0), desk.path()).is_err());
}

#[test]
fn the_first_scene_leaves_what_paraview_is_told_to_open() {
    let text = text_of("README.md");
    let (_, scene) = text.split_once("## A first scene").expect("a first scene");
    let (scene, _) = scene.split_once("\n## ").expect("more sections");
    let desk = desk();
    for printed in commands(scene) {
        fault(&printed, desk.path()).expect("it runs");
    }
    let list = fs::read_to_string(desk.path().join("column/particles.pvd")).expect("a list");
    let (_, file) = list.split_once("file=\"").expect("a frame");
    let (file, _) = file.split_once('"').expect("a name");
    let frame = fs::read(desk.path().join("column").join(file)).expect("a frame");
    let frame = String::from_utf8_lossy(&frame);
    let shown = scene.split('`').skip(1).step_by(2);
    let columns: Vec<&str> = shown
        .filter(|word| word.starts_with(char::is_uppercase))
        .collect();
    assert!(columns.len() >= 2, "{columns:?}");
    for column in columns {
        assert!(frame.contains(&format!("Name=\"{column}\"")), "{column}");
    }
}
