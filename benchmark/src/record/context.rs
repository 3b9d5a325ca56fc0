//! Where and how a record was measured.

use proctor_kernel::lanes::Selected;
use proctor_kernel::simulation::Options;
use serde_json::{Value, json};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// Version of the shape; raised when a key changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// The context of what is measured now, on this machine.
#[must_use]
pub fn now(options: &Options) -> Value {
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
        "lanes": lanes.name(),
    });
    for (key, value) in [("cpu_model", cpu_model()), ("commit", commit())] {
        if let Some(value) = value {
            context[key] = value.into();
        }
    }
    context
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
}
