//! A process: its command, its time, its memory.

use super::said;
use super::watch::{self, EndCause};
use crate::bench::config::Executable;
use crate::measure::Spent;
use crate::record::Row;
use crate::show::bytes;
use proctor_files::output::summary::SUMMARY;
use proctor_files::reading::read_to_string;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use wait4::Wait4;

/// Set where the results of a process are read at once and then removed or kept for a look: nothing has to wait for the disk.
pub const SCRATCH: &str = "PROCTOR_SCRATCH";
/// Exit code of a program that cannot run a scene and says so: a package is missing, or a word is not known. That of `automake`
/// and `meson` for a test that is skipped.
const SKIP: i32 = 77;
/// Reason of a run that ended with it.
const SKIPPED: &str = "skipped by its exit code 77";

/// True for the reason of a run that its program skipped, with or without more words around it.
#[must_use]
pub fn is_skip(reason: &str) -> bool {
    let reason = reason.strip_prefix("calibration: ").unwrap_or(reason);
    reason.starts_with(SKIPPED)
}

/// Begin of the reason of a process that was ended by the clock, and of one that was ended for what it wrote.
const ENDLESS: [&str; 2] = ["not done after", "wrote more than"];

/// True for the reason of a run that was ended: a finer one would be, too.
#[must_use]
pub fn is_endless(reason: &str) -> bool {
    ENDLESS.iter().any(|begin| reason.starts_with(begin))
}

/// Resources that a process used.
pub(super) struct ProcessUsage {
    pub spent: Spent,
    /// Largest resident size \[bytes\].
    pub peak_rss: Option<u64>,
}

/// An empty folder for the results, and the scene in its file.
pub(super) fn prepare(out: &Path, scene: &Path, json: &Value) -> Result<(), String> {
    let said = |path: &Path| {
        let path = path.display().to_string();
        move |error: std::io::Error| format!("{path}: {error}")
    };
    if out.exists() {
        fs::remove_dir_all(out).map_err(said(out))?;
    }
    fs::create_dir_all(out).map_err(said(out))?;
    fs::write(scene, format!("{json:#}")).map_err(said(scene))
}

/// Runs a command to its end. What it says is kept in the folder `out`.
pub(super) fn run(
    executable: &Executable,
    scene: &Path,
    threads: usize,
    out: &Path,
    stop: &AtomicBool,
) -> Result<ProcessUsage, String> {
    let absolute = |path: &Path| {
        std::path::absolute(path)
            .map_or_else(|_| path.display().to_string(), |p| p.display().to_string())
    };
    let (scene, out_name) = (absolute(scene), absolute(out));
    let fill = |word: &String| {
        word.replace("{scene}", &scene)
            .replace("{threads}", &threads.to_string())
            .replace("{out}", &out_name)
    };
    let words: Vec<String> = executable.command.iter().map(fill).collect();
    let outputs = said::Outputs::new(out)?;
    let [errors, output] = outputs.handed()?;
    let mut command = Command::new(&words[0]);
    command
        .args(&words[1..])
        .current_dir(executable.folder.as_deref().unwrap_or(out))
        // Most solvers take their number of threads from there.
        .env("OMP_NUM_THREADS", threads.to_string())
        .env(SCRATCH, "1")
        .stdin(Stdio::null())
        .stdout(output)
        .stderr(errors);
    watch::apart(&mut command);
    let clock = Instant::now();
    let mut child = command
        .spawn()
        .map_err(|error| cannot_start(&words[0], &error))?;
    let floods = || outputs.flooded();
    let (used, ended) = watch::until_done(child.id(), executable.timeout, floods, stop, || {
        child.wait4()
    });
    let used = used.map_err(|error| format!("{}: {error}", words[0]))?;
    let wall = clock.elapsed();
    match ended {
        EndCause::TimedOut => {
            return Err(format!(
                "{} {} s, and ended; more is allowed by `timeout`",
                ENDLESS[0],
                executable.timeout.as_secs_f64()
            ));
        }
        EndCause::Flooded => {
            let most = bytes(said::MOST);
            return Err(format!(
                "{} {most} to one output, and was ended",
                ENDLESS[1]
            ));
        }
        EndCause::Itself => {}
    }
    if used.status.code() == Some(SKIP) {
        return Err(SKIPPED.to_owned());
    }
    if !used.status.success() && !stop.load(Ordering::Relaxed) {
        return Err(used.status.to_string());
    }
    Ok(ProcessUsage {
        spent: Spent {
            wall,
            cpu: used.rusage.utime + used.rusage.stime,
        },
        peak_rss: (used.rusage.maxrss > 0).then_some(used.rusage.maxrss),
    })
}

fn cannot_start(program: &str, error: &std::io::Error) -> String {
    let reason = format!("cannot start {program}: {error}");
    if program.bytes().all(|b| b.is_ascii_digit()) {
        format!(
            "{reason} (a number stands for an artifact on GitHub; download it and give its path)"
        )
    } else {
        reason
    }
}

/// Steps and time per step from the `summary.json` that the process left, if it left one. Each key is read by itself: a
/// solver need not write all keys of `proctor run`. A value that is no number above zero is left out.
pub(super) fn take_summary(out: &Path, particles: usize, row: &mut Row) {
    let Some(summary) = read_to_string(&out.join(SUMMARY))
        .ok()
        .and_then(|text| serde_json::from_str::<Value>(&text).ok())
    else {
        return;
    };
    let number = |key: &str| summary[key].as_f64().filter(|x| x.is_finite() && *x > 0.0);
    if let Some(hash) = summary["state_hash"].as_str() {
        row.label("state_hash", hash);
    }
    if let Some(ns) = number("ns_per_particle_step") {
        row.count("cpu_ns_per_particle_step", ns);
    }
    let Some(steps) = number("steps") else {
        return;
    };
    row.count("steps", steps);
    if let Some(wall) = number("wall_seconds") {
        let particle_steps = particles as f64 * steps;
        row.count("wall_ns_per_particle_step", wall * 1e9 / particle_steps);
        row.count("particle_steps_per_second", particle_steps / wall);
    }
}
