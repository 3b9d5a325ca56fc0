//! Tells the program how it was built (compiler, features, commit), for the context of its records.

use std::env;
use std::path::Path;
use std::process::Command;

/// Sources that decide the machine code, below the folder of the workspace. The commit of a binary is that of these.
const SOURCES: [&str; 15] = [
    "Cargo.toml",
    "Cargo.lock",
    "kernel/Cargo.toml",
    "kernel/src",
    "kernel/contact",
    "kernel/files",
    "kernel/geometry",
    "kernel/laws",
    "kernel/scene",
    "kernel/stages",
    "verification/Cargo.toml",
    "verification/src",
    "benchmark/Cargo.toml",
    "benchmark/src",
    "benchmark/build.rs",
];

fn main() {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = output(Command::new(rustc).arg("--version"));
    tell(
        "RUSTC",
        version.as_deref().unwrap_or("rustc of unknown version"),
    );
    let compiled_in = env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    tell("TARGET_FEATURES", &compiled_in);
    let mut features: Vec<String> = env::vars()
        .filter_map(|(key, _)| Some(key.strip_prefix("CARGO_FEATURE_")?.to_lowercase()))
        .map(|feature| feature.replace('_', "-"))
        .collect();
    features.sort();
    tell("FEATURES", &features.join(","));
    for source in SOURCES {
        println!("cargo::rerun-if-changed=../{source}");
    }
    // Changes with every commit and checkout. Where there is no history, nothing has to be watched.
    // The path that git prints is absolute or from the folder of the workspace.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"])
        .map(|log| Path::new("..").join(log))
        .filter(|log| log.exists())
    {
        println!("cargo::rerun-if-changed={}", log.display());
    }
    let commit = git(&["rev-parse", "HEAD"]).unwrap_or_default();
    tell("COMMIT", &commit);
    let changed = git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat());
    let dirty = changed.map_or_else(String::new, |changed| (!changed.is_empty()).to_string());
    tell("DIRTY", &dirty);
}

/// Sets `PROCTOR_key` for the crate.
fn tell(key: &str, value: &str) {
    println!("cargo::rustc-env=PROCTOR_{key}={value}");
}

/// Output of git on the workspace; `None` without git or without a repository.
fn git(arguments: &[&str]) -> Option<String> {
    output(Command::new("git").arg("-C").arg("..").args(arguments))
}

/// Standard output of a command that succeeds.
fn output(command: &mut Command) -> Option<String> {
    let output = command.output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
