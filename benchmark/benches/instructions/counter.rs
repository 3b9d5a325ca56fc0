//! Counts of instructions by valgrind, of what changed since a record.

use crate::Request;
use proctor_benchmark::bench::counted::{Earlier, Group, Item, TIMES};
use proctor_benchmark::bench::sources::{Digest, KeptDigests};
use proctor_benchmark::record::{Record, Row};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Makes the C library fill and copy memory with vector instructions. By itself it takes one string instruction for what is
/// large, of which valgrind counts every byte, so that a count would tell which of the two the compiler called.
const NO_STRING_INSTRUCTIONS: (&str, &str) = (
    "GLIBC_TUNABLES",
    "glibc.cpu.x86_rep_stosb_threshold=1000000000:glibc.cpu.x86_rep_movsb_threshold=1000000000",
);

/// The example, built as the program is: where tests were built, nothing is left to build.
fn build() -> Result<PathBuf, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let built = Command::new(env!("CARGO"))
        // The whole workspace, since what packages ask of a dependency together decides how it is built.
        .args(["build", "--release", "--quiet", "--workspace"])
        .args(["--example", "counted"])
        .current_dir(&root)
        .status()?;
    if !built.success() {
        return Err("the example `counted` could not be built".into());
    }
    Ok(target.join("release/examples/counted"))
}

/// An error that crosses threads.
type Failure = Box<dyn Error + Send + Sync>;

/// Counts instructions of a binary.
struct Counter {
    binary: PathBuf,
    folder: tempfile::TempDir,
}

/// Output of a run.
pub struct Count {
    instructions: u64,
    pub particles: u64,
    pub hash: String,
}

impl Count {
    pub fn per_particle(&self) -> f64 {
        self.instructions as f64 / (self.particles as f64 * TIMES as f64)
    }
}

impl Counter {
    /// Counts one item; its place keeps its file apart from those of others that are counted beside it.
    fn count(&self, place: usize, item: &Item) -> Result<Count, Failure> {
        let file = self.folder.path().join(format!("scene-{place}.json"));
        std::fs::write(&file, item.scene.to_string())?;
        let output = Command::new("valgrind")
            .args([
                "--tool=callgrind",
                "--callgrind-out-file=/dev/null",
                "--toggle-collect=*played*",
            ])
            .arg(&self.binary)
            .arg(&file)
            .args([item.what, &TIMES.to_string()])
            .env(NO_STRING_INSTRUCTIONS.0, NO_STRING_INSTRUCTIONS.1)
            .output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            return Err(format!("{}: {said}", item.name).into());
        }
        let collected = said.lines().find_map(|line| line.split_once("Collected :"));
        let instructions: u64 = collected
            .and_then(|(_, number)| number.split_whitespace().next()?.parse().ok())
            .filter(|&n| n > 0)
            .ok_or("valgrind counted nothing")?;
        let words = String::from_utf8_lossy(&output.stdout).into_owned();
        let (particles, hash) = words
            .trim()
            .split_once(' ')
            .ok_or("the example said nothing")?;
        Ok(Count {
            instructions,
            particles: particles.parse()?,
            hash: hash.to_owned(),
        })
    }
}

/// Counts of this run, and those taken from the earlier record.
pub struct Counts {
    /// Counts by the name of the item.
    pub counted: BTreeMap<String, Count>,
    /// The first item once more.
    pub again: Option<(String, Count)>,
    /// Rows by their name.
    pub kept: BTreeMap<String, (Row, Digest)>,
    /// Digests of all items, and of the parts of the sources.
    pub digests: KeptDigests,
}

impl Counts {
    /// Counts the items and features whose sources changed, and what a feature that changed is compared with.
    pub fn of(
        asked: &Request,
        record: &Record,
        items: &[Item],
        groups: &[Group],
    ) -> Result<Self, Box<dyn Error>> {
        let compiler = record.context["rustc"].as_str().unwrap_or_default();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let earlier = Earlier::read(&root, compiler, asked.since.as_deref())?;
        let mut digests = KeptDigests::default();
        for (part, digest) in earlier.sources().parts() {
            digests.keep(format!("part {part}"), digest);
        }
        let mut kept = BTreeMap::new();
        let mut has_changed = |item: &&Item| {
            let (digest, row) = earlier.count(item);
            digests.keep(item.row(), digest);
            if let Some(row) = row {
                kept.insert(item.row(), (row.clone(), digest));
            }
            row.is_none()
        };
        let mut changed: Vec<&Item> = items.iter().filter(&mut has_changed).collect();
        for group in groups {
            let features: Vec<&Item> = group.features.iter().filter(&mut has_changed).collect();
            if !features.is_empty() {
                changed.push(&group.base);
                changed.extend(features);
            }
        }
        let mut counts = Self {
            counted: BTreeMap::new(),
            again: None,
            kept,
            digests,
        };
        if let Some(&first) = changed.first() {
            let counter = Counter {
                binary: build()?,
                folder: tempfile::tempdir()?,
            };
            let mut all = counter.all(&[&changed[..], &[first]].concat())?;
            // That the counts repeat is seen on the first; all of them twice would only take longer.
            counts.again = all.pop().map(|count| (first.name.clone(), count));
            let names = changed.iter().map(|item| item.name.clone());
            counts.counted = names.zip(all).collect();
        }
        Ok(counts)
    }
}

impl Counter {
    /// Counts items, as many at a time as there are processors: a count is the same whatever runs beside it.
    fn all(&self, items: &[&Item]) -> Result<Vec<Count>, Box<dyn Error>> {
        let next = AtomicUsize::new(0);
        let (found, results) = mpsc::channel();
        thread::scope(|scope| {
            for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
                let (next, found) = (&next, found.clone());
                scope.spawn(move || {
                    loop {
                        let place = next.fetch_add(1, Ordering::Relaxed);
                        let Some(item) = items.get(place) else { break };
                        // The receiver waits for the end of all threads.
                        let _ = found.send((place, self.count(place, item)));
                    }
                });
            }
        });
        drop(found);
        let mut all: Vec<_> = results.into_iter().collect();
        all.sort_by_key(|(place, _)| *place);
        all.into_iter()
            .map(|(_, count)| count.map_err(|error| error as Box<dyn Error>))
            .collect()
    }
}
