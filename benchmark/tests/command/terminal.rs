//! The output on a terminal: a line per case, the verdict, colour beside symbols, and no PASS of what was interrupted.

use crate::command::support::{Desk, code, command, proctor, stderr, stdout};
use std::process::Output;

const CASES: [&str; 3] = ["verify", "self-weight", "rotation"];

fn verify(more: &[&str]) -> Output {
    let output = proctor(&[&CASES[..], &["--quick"], more].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    output
}

#[test]
fn a_case_is_a_line_with_gates_tightest_gate_error_and_time() {
    let text = stdout(&verify(&[]));
    // Of the machine that the test runs on.
    let busy = |line: &&str| line.starts_with("! the machine was busy");
    let lines: Vec<&str> = text.lines().filter(|line| !busy(line)).collect();
    assert_eq!(lines.len(), 5, "{text}");
    for word in ["nearest: share of its bound", "error: of one finest run"] {
        assert!(lines[0].contains(word), "{word}: {text}");
    }
    for word in ["case", "gates", "nearest", "error of", "time"] {
        assert!(lines[1].contains(word), "{word}: {text}");
    }
    for (line, name) in lines[2..4].iter().zip(&CASES[1..]) {
        assert!(line.starts_with(&format!("✓ {name}  ")), "{line}");
        assert!(line.contains(" of ") && line.contains("L2(u)"), "{line}");
        assert_eq!(line.matches(" %").count(), 2, "{line}");
        assert!(line.ends_with('s'), "{line}");
    }
    assert!(
        lines[4].starts_with("✓ PASS: 5 of 5 gates in 2 cases"),
        "{text}"
    );
    assert!(
        lines.iter().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    assert_eq!(stderr(&verify(&[])), "");
}

#[test]
fn all_of_it_is_told_where_asked_and_the_verdict_alone_where_asked() {
    for long in ["-v", "--verbose"] {
        let all = stdout(&verify(&[long]));
        for word in [
            "relative error of",
            "observed orders",
            "wall",
            "CPU",
            "PASS  ",
            "✓ PASS: 5 of 5",
        ] {
            assert!(all.contains(word), "{word}: {all}");
        }
    }
    for short in ["-q", "--quiet"] {
        let output = verify(&[short]);
        let text = stdout(&output);
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(
            text.starts_with("✓ PASS: 5 of 5 gates in 2 cases"),
            "{text}"
        );
        assert_eq!(stderr(&output), "");
    }
    assert_eq!(code(&proctor(&["verify", "-v", "-q"])), 2);
    // They belong to what is told, not to the program.
    assert_eq!(code(&proctor(&["-q", "schema"])), 2);
}

#[test]
fn colour_is_for_terminals_and_never_alone() {
    let told = |variables: &[(&str, &str)]| {
        let mut command = command(&["verify", "self-weight", "--quick"]);
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        stdout(
            &command
                .envs(variables.iter().copied())
                .output()
                .expect("starts"),
        )
    };
    // In a pipe.
    let plain = told(&[]);
    let forced = told(&[("CLICOLOR_FORCE", "1")]);
    let refused = told(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]);
    assert!(forced.contains("\u{1b}[1m\u{1b}[32m✓"), "{forced:?}");
    for text in [&plain, &refused] {
        assert!(!text.contains('\u{1b}'), "{text:?}");
        assert!(
            text.contains("✓ self-weight") && text.contains("✓ PASS"),
            "{text}"
        );
    }
}

/// The command, stopped by a signal as soon as `begun` is there.
#[cfg(unix)]
fn stopped(desk: &Desk, arguments: &[&str], begun: &str, signal: &str) -> Output {
    use std::time::{Duration, Instant};
    let child = command(arguments)
        .current_dir(desk.path(""))
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("starts");
    let start = Instant::now();
    while !desk.path(begun).exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no {begun}");
        std::thread::sleep(Duration::from_millis(5));
    }
    // It listens to signals before the first run.
    std::thread::sleep(Duration::from_millis(300));
    let killed = std::process::Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(killed.expect("kill runs").success());
    child.wait_with_output().expect("it ends")
}

#[cfg(unix)]
#[test]
fn what_was_interrupted_says_so_and_never_that_it_passed() {
    for (signal, expected) in [("-INT", 130), ("-TERM", 143)] {
        let desk = Desk::new();
        let arguments = ["verify", "boussinesq", "hertz", "--json", "record.json"];
        let output = stopped(&desk, &arguments, "record.json", signal);
        let text = stdout(&output);
        assert_eq!(code(&output), expected, "{text}");
        assert!(text.contains("! INTERRUPTED: "), "{text}");
        assert!(
            text.contains(" of 2 cases; the others were not run"),
            "{text}"
        );
        assert!(text.contains("incomplete record in record.json"), "{text}");
        assert!(!text.contains("PASS"), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn the_main_job_interrupted_says_so_on_its_page_too() {
    let desk = Desk::new();
    let output = stopped(&desk, &[], "target/proctor/record.json", "-INT");
    let text = stdout(&output);
    assert_eq!(code(&output), 130, "{text}{}", stderr(&output));
    assert!(text.contains("! INTERRUPTED: "), "{text}");
    let all = stdout(&proctor(&["verify", "--list"])).lines().count();
    let words = format!(" of {all} cases; the others were not run");
    assert!(text.contains(&words), "{text}");
    assert!(!text.contains("PASS"), "{text}");
    let page = std::fs::read_to_string(desk.path("target/proctor/report.html")).expect("a page");
    assert!(page.contains("<strong>INTERRUPTED</strong>"), "no verdict");
    assert!(!page.contains("<strong>PASS</strong>"));
}
