//! The machine as far as its system tells it in files (Linux); elsewhere the keys are left out.

use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Folder in which the system describes its processors.
const PROCESSORS: &str = "/sys/devices/system/cpu";

/// Adds what is known of the machine to a context, under the keys of Google Benchmark where it has one.
pub(super) fn describe(context: &mut Value) {
    let Some(context) = context.as_object_mut() else {
        return;
    };
    let processors = processors();
    put(context, "cpu_model", cpu_info("model name"));
    put(context, "cores_physical", cores(&processors));
    put(context, "mhz_per_cpu", frequency());
    put(context, "cpu_scaling_enabled", scaling(&processors));
    put(context, "caches", caches());
    put(context, "load_avg", load());
}

fn put(context: &mut Map<String, Value>, key: &str, value: Option<impl Into<Value>>) {
    if let Some(value) = value {
        context.insert(key.to_owned(), value.into());
    }
}

/// A value of the first processor in `/proc/cpuinfo`.
fn cpu_info(key: &str) -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

fn frequency() -> Option<u64> {
    let mhz: f64 = cpu_info("cpu MHz")?.parse().ok()?;
    Some(mhz.round() as u64)
}

/// One folder per processor.
fn processors() -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(PROCESSORS) else {
        return vec![];
    };
    let is_processor = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.and_then(|name| name.strip_prefix("cpu"));
        number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(is_processor).collect()
}

/// Physical cores: pairs of package and core.
fn cores(processors: &[PathBuf]) -> Option<usize> {
    let cores: BTreeSet<(String, String)> = processors
        .iter()
        .filter_map(|path| {
            let topology = path.join("topology");
            let package = read(&topology.join("physical_package_id"))?;
            Some((package, read(&topology.join("core_id"))?))
        })
        .collect();
    (!cores.is_empty()).then_some(cores.len())
}

/// True if the clock of a processor may be changed to save power.
fn scaling(processors: &[PathBuf]) -> Option<bool> {
    let governors: Vec<String> = processors
        .iter()
        .filter_map(|path| read(&path.join("cpufreq/scaling_governor")))
        .collect();
    (!governors.is_empty()).then(|| governors.iter().any(|governor| governor != "performance"))
}

/// Caches of the first processor.
fn caches() -> Option<Value> {
    let folder = Path::new(PROCESSORS).join("cpu0/cache");
    let caches: Vec<Value> = (0..)
        .map(|index| folder.join(format!("index{index}")))
        .map_while(|path| {
            let shared = read(&path.join("shared_cpu_list"));
            Some(json!({
                "type": read(&path.join("type"))?,
                "level": read(&path.join("level"))?.parse::<u32>().ok()?,
                "size": size(&read(&path.join("size"))?)?,
                "num_sharing": shared.map_or(1, |list| listed(&list)),
            }))
        })
        .collect();
    (!caches.is_empty()).then(|| caches.into())
}

/// Bytes of a size such as `32K`; none where it is no such size.
#[must_use]
pub fn size(text: &str) -> Option<u64> {
    let (number, unit) = match text.as_bytes().last()? {
        b'K' => (&text[..text.len() - 1], 1 << 10),
        b'M' => (&text[..text.len() - 1], 1 << 20),
        _ => (text, 1),
    };
    Some(number.parse::<u64>().ok()? * unit)
}

/// Number of processors that a list such as `0-3,8` names.
#[must_use]
pub fn listed(list: &str) -> u64 {
    list.split(',')
        .map(|part| match part.split_once('-') {
            Some((first, last)) => match (first.parse::<u64>(), last.parse::<u64>()) {
                (Ok(first), Ok(last)) if last >= first => last - first + 1,
                _ => 1,
            },
            None => 1,
        })
        .sum()
}

/// Load over the last 1, 5 and 15 minutes.
fn load() -> Option<Vec<f64>> {
    let text = fs::read_to_string("/proc/loadavg").ok()?;
    let load: Vec<f64> = text.split(' ').take(3).flat_map(str::parse).collect();
    (load.len() == 3).then_some(load)
}

fn read(path: &Path) -> Option<String> {
    Some(fs::read_to_string(path).ok()?.trim().to_owned())
}
