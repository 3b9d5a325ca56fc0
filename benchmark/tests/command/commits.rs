//! `scripts/compare-commits`: two commits are built side by side and once, and two programs are not built at all.

use crate::command::support::{Desk, code, fixture, stderr, stdout};
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Output};

/// In place of `cargo`: says that it builds, waits until a second one does where two are due, and leaves this program.
const CARGO: &str = "#!/bin/sh
echo $$ >> \"$BUILDS\"
waited=0
while [ $(wc -l < \"$BUILDS\") -lt 2 ]; do
    sleep 0.1; waited=$((waited + 1)); [ $waited -lt 300 ] || exit 3
done
mkdir -p \"$CARGO_TARGET_DIR/release\"
printf '#!/bin/sh\\nexec \"%s\" \"$@\"\\n' \"$PROGRAM\" > \"$CARGO_TARGET_DIR/release/proctor\"
chmod +x \"$CARGO_TARGET_DIR/release/proctor\"
";

fn git(folder: &Path, arguments: &[&str]) -> String {
    let mut git = Command::new("git");
    let names = ["-c", "user.name=n", "-c", "user.email=n@example.org"];
    git.current_dir(folder).args(names).args(arguments);
    let output = git.output().expect("git runs");
    assert_eq!(code(&output), 0, "{arguments:?}: {}", stderr(&output));
    stdout(&output).trim().to_owned()
}

/// A repository of the script and two commits.
fn repository(desk: &Desk) -> [String; 2] {
    let folder = desk.path("repository");
    let scripts = folder.join("scripts");
    fs::create_dir_all(&scripts).expect("a folder");
    fs::copy(
        fixture("scripts/compare-commits"),
        scripts.join("compare-commits"),
    )
    .expect("a copy");
    fs::write(folder.join(".gitignore"), "target\n").expect("written");
    git(&folder, &["init", "-q"]);
    ["one", "two"].map(|text| {
        fs::write(folder.join("text"), text).expect("written");
        git(&folder, &["add", "-A"]);
        git(&folder, &["commit", "-q", "-m", text]);
        git(&folder, &["rev-parse", "HEAD"])
    })
}

fn compare(desk: &Desk, arguments: &[&str]) -> Output {
    let cargo = desk.path("bin/cargo");
    fs::create_dir_all(desk.path("bin")).expect("a folder");
    fs::write(&cargo, CARGO).expect("written");
    fs::set_permissions(&cargo, fs::Permissions::from_mode(0o755)).expect("may run");
    let path = std::env::var("PATH").unwrap_or_default();
    let mut script = Command::new("bash");
    script
        .arg(desk.path("repository/scripts/compare-commits"))
        .args(arguments)
        .args(["--ignore-time", "--cases", "bar"])
        .env("PATH", format!("{}:{path}", desk.path("bin").display()))
        .env("BUILDS", desk.name("builds"))
        .env("PROGRAM", env!("CARGO_BIN_EXE_proctor"))
        .env_remove("CARGO_TARGET_DIR");
    script.output().expect("bash runs")
}

#[test]
fn two_commits_are_built_side_by_side_and_once() {
    let desk = Desk::new();
    let [base, head] = repository(&desk);
    let builds = || fs::read_to_string(desk.path("builds")).map_or(0, |text| text.lines().count());
    // Each build waits until the other one has begun.
    let output = compare(&desk, &[&base, &head]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert_eq!(builds(), 2, "{}", stderr(&output));
    assert!(stdout(&output).contains("no change"), "{}", stdout(&output));
    let output = compare(&desk, &[&base, &head]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(builds(), 2, "what was built is kept: {}", stderr(&output));
}

#[test]
fn two_programs_are_compared_without_a_build() {
    let desk = Desk::new();
    repository(&desk);
    let same = desk.name("same");
    let text = format!(
        "#!/bin/sh\nexec \"{}\" \"$@\"\n",
        env!("CARGO_BIN_EXE_proctor")
    );
    fs::write(&same, text).expect("written");
    fs::set_permissions(&same, fs::Permissions::from_mode(0o755)).expect("may run");
    let output = compare(&desk, &[env!("CARGO_BIN_EXE_proctor"), &same]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(!desk.path("builds").exists());
    // A program that is worse is called so: the same record with an error that is a thousandth larger.
    let record = "for last; do :; done; sed 's/\\(\"error_[a-z0-9_]*\": *\\)\\([0-9.e-]*\\)/\\10.9/' -i $last";
    let text = format!(
        "#!/bin/sh\n\"{}\" \"$@\"; exit=$?\ncase $1 in verify) case \"$*\" in *--json*) {record};; esac;; esac\nexit $exit\n",
        env!("CARGO_BIN_EXE_proctor")
    );
    fs::write(&same, text).expect("written");
    let output = compare(&desk, &[env!("CARGO_BIN_EXE_proctor"), &same]);
    assert_eq!(code(&output), 1, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("WORSE"), "{}", stdout(&output));
}
