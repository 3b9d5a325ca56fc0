//! Circumstances in which a record was measured.

use super::machine;
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::simulation::Options;
use serde_json::{Value, json};
use std::time::{SystemTime, UNIX_EPOCH};

/// Version of the shape; raised when a key changes its meaning.
pub const SCHEMA_VERSION: u32 = 1;

/// The context of what is measured now, on this machine, with this build.
///
/// Keys of Google Benchmark: `date`, `executable`, `num_cpus` (logical), `mhz_per_cpu`, `cpu_scaling_enabled`, `caches`
/// (size in bytes), `load_avg`, `library_build_type`. Ours: `schema_version`, `proctor_version`, `commit` and `dirty`
/// (of the sources that were built), `rustc`, `target`, `features` (cargo), `target_features_compiled` and
/// `target_features_detected`, `lanes`, `cpu_model`, `cores_physical`. What cannot be known is left out. There is no name
/// of a host or a user.
#[must_use]
pub fn now(options: &Options) -> Value {
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let lanes = SelectedLanes::new(options.lanes).unwrap_or_else(|_| SelectedLanes::any());
    let mut context = json!({
        "schema_version": SCHEMA_VERSION,
        "executable": "proctor",
        "proctor_version": env!("CARGO_PKG_VERSION"),
        "date": date(SystemTime::now()),
        "num_cpus": processors,
        "rustc": env!("PROCTOR_RUSTC"),
        "library_build_type": if cfg!(debug_assertions) { "debug" } else { "release" },
        "target": format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS),
        "target_features_compiled": env!("PROCTOR_TARGET_FEATURES"),
        "target_features_detected": detected().join(","),
        "features": env!("PROCTOR_FEATURES"),
        "lanes": lanes.name(),
    });
    let commit = env!("PROCTOR_COMMIT");
    if !commit.is_empty() {
        context["commit"] = commit.into();
    }
    if let Ok(dirty) = env!("PROCTOR_DIRTY").parse::<bool>() {
        context["dirty"] = dirty.into();
    }
    machine::describe(&mut context);
    context
}

/// Features of the processor that lanes and multiply-add depend on, as found on this machine.
#[cfg(target_arch = "x86_64")]
fn detected() -> Vec<&'static str> {
    let features = [
        ("sse4.2", is_x86_feature_detected!("sse4.2")),
        ("avx", is_x86_feature_detected!("avx")),
        ("fma", is_x86_feature_detected!("fma")),
        ("bmi2", is_x86_feature_detected!("bmi2")),
        ("avx2", is_x86_feature_detected!("avx2")),
        ("avx512f", is_x86_feature_detected!("avx512f")),
        ("avx512dq", is_x86_feature_detected!("avx512dq")),
        ("avx512vl", is_x86_feature_detected!("avx512vl")),
    ];
    let found = features.into_iter().filter(|(_, found)| *found);
    found.map(|(name, _)| name).collect()
}

/// Lanes use no feature of other processors.
#[cfg(not(target_arch = "x86_64"))]
fn detected() -> Vec<&'static str> {
    vec![]
}

/// A time as ISO 8601, UTC, to the second.
#[must_use]
pub fn date(time: SystemTime) -> String {
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
