//! Memory: what something needs against what there is.
//!
//! A few bytes of input can ask for more memory than a machine has, and an allocation that fails ends the process
//! without a word. So whatever input can size is estimated and compared here before it is made.

use std::fmt;
use std::fs;
use std::path::Path;

/// Memory that something may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    bytes: u64,
}

/// Something needs more memory than there is.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfMemory {
    /// Purpose of the memory.
    pub what: String,
    /// Bytes that it needs; an estimate.
    pub needed: f64,
    /// Bytes that there are.
    pub there_is: u64,
}

impl fmt::Display for OutOfMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} would need {} of memory; accepted: at most the {} that are free",
            self.what,
            words(self.needed),
            words(self.there_is as f64)
        )
    }
}

impl std::error::Error for OutOfMemory {}

impl Memory {
    /// Taken as free where the system does not say in a file how much is \[bytes\]: 16 GiB. That is macOS and Windows;
    /// both hand out memory that they have not got and write it to disk.
    pub const ELSEWHERE: u64 = 16 << 30;

    /// So many bytes.
    #[must_use]
    pub fn of(bytes: u64) -> Self {
        Self { bytes }
    }

    /// Memory that this process can still get: on Linux the least of what the machine has available, what is left to the
    /// control groups that the process is in, what the address space may still grow by (`ulimit -v`) and, where the system
    /// promises no more than it has, what it may still promise; elsewhere [`Memory::ELSEWHERE`].
    #[must_use]
    pub fn of_machine() -> Self {
        Self::of_files(Path::new("/"))
    }

    /// [`Memory::of_machine`], of the files below another root.
    #[must_use]
    pub fn of_files(root: &Path) -> Self {
        let read = |path: &str| fs::read_to_string(root.join(path)).ok();
        let meminfo = read("proc/meminfo").unwrap_or_default();
        let mut least = in_kib(&meminfo, "MemAvailable:");
        let mut bound = |bytes: Option<u64>| {
            least = match (least, bytes) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
        };
        if read("proc/sys/vm/overcommit_memory").is_some_and(|mode| mode.trim() == "2") {
            let limit = in_kib(&meminfo, "CommitLimit:");
            let promised = in_kib(&meminfo, "Committed_AS:");
            bound(
                limit
                    .zip(promised)
                    .map(|(limit, promised)| limit.saturating_sub(promised)),
            );
        }
        let status = read("proc/self/status").unwrap_or_default();
        let address_space = read("proc/self/limits").and_then(|limits| {
            let line = limits
                .lines()
                .find_map(|line| line.strip_prefix("Max address space"))?;
            line.split_whitespace().next()?.parse::<u64>().ok()
        });
        bound(
            address_space
                .map(|limit| limit.saturating_sub(in_kib(&status, "VmSize:").unwrap_or(0))),
        );
        for line in read("proc/self/cgroup").unwrap_or_default().lines() {
            // hierarchy:controllers:path, without controllers in version 2.
            let mut parts = line.splitn(3, ':').skip(1);
            let (Some(controllers), Some(path)) = (parts.next(), parts.next()) else {
                continue;
            };
            let (mount, limit, used) = if controllers.is_empty() {
                ("sys/fs/cgroup", "memory.max", "memory.current")
            } else if controllers.split(',').any(|name| name == "memory") {
                (
                    "sys/fs/cgroup/memory",
                    "memory.limit_in_bytes",
                    "memory.usage_in_bytes",
                )
            } else {
                continue;
            };
            // A limit holds for all groups below; in a container the path may lie outside what is mounted.
            let mut group = path.trim_matches('/').to_owned();
            loop {
                let number = |file: &str| {
                    read(&format!("{mount}/{group}/{file}"))
                        .and_then(|text| text.trim().parse::<u64>().ok())
                };
                bound(
                    number(limit)
                        .map(|limit| limit.saturating_sub(number(used).unwrap_or_default())),
                );
                if group.is_empty() {
                    break;
                }
                group.truncate(group.rfind('/').unwrap_or(0));
            }
        }
        Self {
            bytes: least.unwrap_or(Self::ELSEWHERE),
        }
    }

    /// Number of bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Checks that there are `needed` bytes for `what`. A number too large to be one, infinite or not a number, is too many.
    ///
    /// # Errors
    /// [`OutOfMemory`] with both numbers.
    pub fn require(&self, what: impl Into<String>, needed: f64) -> Result<(), OutOfMemory> {
        if needed <= self.bytes as f64 {
            return Ok(());
        }
        Err(OutOfMemory {
            what: what.into(),
            needed,
            there_is: self.bytes,
        })
    }
}

impl Memory {
    /// [`Memory::require`], and from then on there is so much less.
    ///
    /// # Errors
    /// As [`Memory::require`].
    pub fn take(&mut self, what: impl Into<String>, needed: f64) -> Result<(), OutOfMemory> {
        self.require(what, needed)?;
        self.bytes = self.bytes.saturating_sub(needed.ceil() as u64);
        Ok(())
    }
}

/// The largest of `bytes`, half of it, a quarter and so on that the system hands out in one piece now. Limits that no file
/// tells show here, where an allocation that fails would end the process.
#[must_use]
pub fn in_one_piece(bytes: f64) -> f64 {
    let mut piece = bytes;
    while piece >= 1.0 {
        let mut probe: Vec<u8> = Vec::new();
        // Above the largest number of an address the conversion is to that.
        if probe.try_reserve_exact(piece as usize).is_ok() {
            return piece;
        }
        piece *= 0.5;
    }
    0.0
}

/// Number in a line such as `MemAvailable:    1234 kB`, in bytes.
fn in_kib(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number: u64 = line.split_whitespace().next()?.parse().ok()?;
    number.checked_mul(1024)
}

/// A number of bytes for people: `512 B`, `1.5 GiB`.
#[must_use]
pub fn words(bytes: f64) -> String {
    const UNITS: [&str; 9] = ["B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB", "ZiB", "YiB"];
    let mut value = bytes;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 {
        format!("{value} B")
    } else if value < 1024.0 {
        format!("{value:.1} {}", UNITS[unit])
    } else {
        format!("{value:e} {}", UNITS[unit])
    }
}
