//! What was measured, as JSON in the shape of Google Benchmark: a context, and one flat row per run.
//!
//! There is no NaN and no null: a counter without a finite value is left out.

use crate::suite::{Ran, RanRung};
use proctor_kernel::lanes::Selected;
use proctor_kernel::output::{OutputError, atomic};
use proctor_kernel::simulation::Options;
use serde_json::{Map, Value, json};
use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// Version of the shape; raised when a key changes its meaning.
const SCHEMA_VERSION: u32 = 1;

/// A record of one invocation.
pub struct Record {
    context: Value,
    rows: Vec<Value>,
}

impl Record {
    /// A record without rows.
    pub fn new(options: &Options) -> Self {
        let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let lanes = Selected::new(options.lanes).unwrap_or_else(|_| Selected::any());
        let mut context = json!({
            "schema_version": SCHEMA_VERSION,
            "executable": "proctor",
            "proctor_version": env!("CARGO_PKG_VERSION"),
            "date": date(SystemTime::now()),
            "num_cpus": processors,
            "rustc": env!("PROCTOR_RUSTC"),
            "library_build_type": if cfg!(debug_assertions) { "debug" } else { "release" },
            "target": format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
            "threads": options.threads.unwrap_or(processors),
            "lanes": lanes.name(),
        });
        for (key, value) in [("cpu_model", cpu_model()), ("commit", commit())] {
            if let Some(value) = value {
                context[key] = value.into();
            }
        }
        Self {
            context,
            rows: vec![],
        }
    }

    /// Adds a row per run of a case, and one for its verdict.
    pub fn push(&mut self, ran: &Ran) {
        let threads = self.context["threads"].clone();
        for rung in &ran.rungs {
            let mut row = run_row(ran.case.name(), rung);
            row.insert("threads".into(), threads.clone());
            self.rows.push(row.into());
        }
        self.rows.push(verdict_row(ran).into());
    }

    /// Writes the record, atomically.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let record = json!({ "context": self.context, "benchmarks": self.rows });
        atomic::write(path, |file| writeln!(file, "{record:#}"))
    }
}

/// Times and counters of one run.
fn run_row(case: &str, ran: &RanRung) -> Map<String, Value> {
    let name = format!("{case}/{}", ran.rung.label);
    let mut row = Map::new();
    row.insert("name".into(), name.clone().into());
    row.insert("run_name".into(), name.into());
    row.insert("run_type".into(), "iteration".into());
    row.insert("iterations".into(), 1.into());
    row.insert("time_unit".into(), "ms".into());
    number(&mut row, "real_time", ran.spent.wall.as_secs_f64() * 1e3);
    number(&mut row, "cpu_time", ran.spent.cpu.as_secs_f64() * 1e3);
    number(&mut row, "cell_size", ran.rung.cell);
    match &ran.solved {
        Ok(solved) => {
            row.insert("particles".into(), solved.particles.into());
            row.insert("steps".into(), solved.steps.into());
            number(&mut row, "time", solved.time);
            let particle_steps = solved.particles as f64 * solved.steps as f64;
            let rate = particle_steps / ran.spent.wall.as_secs_f64();
            number(&mut row, "particle_steps_per_second", rate);
            for q in &solved.quantities {
                let key = key(q.name);
                number(&mut row, &format!("value_{key}"), q.value);
                for (kind, value) in [("exact", q.exact), ("error", q.error)] {
                    if let Some(value) = value {
                        number(&mut row, &format!("{kind}_{key}"), value);
                    }
                }
            }
        }
        Err(error) => {
            row.insert("error_occurred".into(), true.into());
            row.insert("error_message".into(), error.to_string().into());
        }
    }
    row
}

/// Gates and observed orders of a case.
fn verdict_row(ran: &Ran) -> Map<String, Value> {
    let mut row = Map::new();
    row.insert("name".into(), format!("{}/verdict", ran.case.name()).into());
    row.insert("run_name".into(), ran.case.name().into());
    row.insert("run_type".into(), "aggregate".into());
    row.insert("aggregate_name".into(), "verdict".into());
    let failed = ran.verdict.gates.iter().filter(|g| !g.passed()).count();
    row.insert("gates".into(), ran.verdict.gates.len().into());
    row.insert("gates_failed".into(), failed.into());
    for (title, table) in &ran.verdict.tables {
        let Some(last) = table.rows().len().checked_sub(1) else {
            continue;
        };
        for (index, quantity) in table.quantities().iter().enumerate() {
            if let Some(order) = table.order(index, last) {
                let key = key(&format!("{title} {quantity}"));
                number(&mut row, &format!("observed_order_{key}"), order);
            }
        }
    }
    if !ran.passed() {
        row.insert("error_occurred".into(), true.into());
        let names: Vec<&str> = ran
            .verdict
            .gates
            .iter()
            .filter(|gate| !gate.passed())
            .map(|gate| gate.name.as_str())
            .collect();
        let message = match names.as_slice() {
            [] => "a run failed, or nothing was compared".to_owned(),
            names => format!("gates failed: {}", names.join("; ")),
        };
        row.insert("error_message".into(), message.into());
    }
    row
}

/// Inserts a number if it is finite.
fn number(row: &mut Map<String, Value>, key: &str, value: f64) {
    if value.is_finite() {
        row.insert(key.to_owned(), value.into());
    }
}

/// A name as part of a key: lower case, everything but letters and digits one underscore.
fn key(name: &str) -> String {
    let words: Vec<String> = name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect();
    words.join("_")
}

/// A time as ISO 8601, UTC, to the second.
fn date(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    // Days since 0000-03-01, in eras of 400 years; years begin in March so that the leap day is the last.
    let day = days + 719_468;
    let (era, of_era) = (day / 146_097, day % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    let year = era * 400 + year + carry;
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}+00:00")
}

/// Name of the processor, where the system tells it in a file.
fn cpu_model() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Commit of the working folder, where there is one.
fn commit() -> Option<String> {
    let output = Command::new("git")
        .args(["rev-parse", "HEAD"])
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    let hash = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (!hash.is_empty()).then_some(hash)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn dates_are_those_of_the_calendar() {
        let at = |seconds| date(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00+00:00");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00+00:00");
        assert_eq!(at(1_735_689_599), "2024-12-31T23:59:59+00:00");
    }

    #[test]
    fn keys_are_flat_words() {
        assert_eq!(key("L2(u), r >= 0.2 m"), "l2_u_r_0_2_m");
        assert_eq!(key("u_z at (.5,.5,.5)"), "u_z_at_5_5_5");
    }

    #[test]
    fn what_is_not_finite_is_left_out() {
        let mut row = Map::new();
        number(&mut row, "a", f64::NAN);
        number(&mut row, "b", 1.5);
        assert_eq!(Value::from(row), json!({ "b": 1.5 }));
    }
}
