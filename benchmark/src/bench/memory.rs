//! Peak memory of this process, where the system tells it.

/// Sets the peak back to what the process holds now, so that the next reading is of what comes after. False where the
/// system has no such thing (Linux has: proc(5), clear_refs, value 5).
pub fn reset_peak() -> bool {
    std::fs::write("/proc/self/clear_refs", "5").is_ok()
}

/// Largest resident size since the last reset \[bytes\].
#[must_use]
pub fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib * 1024)
}
