//! Digests of the sources on which counts of instructions depend: a count whose digest is the kept one would come out
//! the same, and need not be made again.
//!
//! The sources of the kernel and its files fall into parts by their folders. A scene depends on the parts that it can
//! reach; with a key that is not known here, on all of them. A file in no named folder is of the cycle, on which every
//! scene depends. So a folder that moves makes counts be made again, and never left out.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The part of every scene: what is in no folder of [`FOLDERS`], the manifests, the compiler.
const CYCLE: &str = "cycle";
/// The part of every scene with any contact.
const CONTACT: &str = "contact";
/// Folders and the parts that they are; the innermost decides.
const FOLDERS: [(&str, &str); 5] = [
    ("/laws/", "laws"),
    ("/contact/", CONTACT),
    ("/mortar/", "mortar"),
    ("/surface/", "surfaces"),
    ("/surfaces/", "surfaces"),
];
/// Files outside of the kernel's folder that decide the machine code, or how it is counted.
const BESIDE: [&str; 3] = [
    "Cargo.toml",
    "Cargo.lock",
    "kernel/files/examples/counted.rs",
];
/// Folders of sources and manifests.
const BELOW: [&str; 2] = ["kernel", "benchmark/benches/instructions"];
/// Folders within them whose files are in no counted program.
const ELSEWHERE: [&str; 4] = ["tests", "examples", "benches", "target"];
/// Keys of scenes that no contact and no surface reads.
const PLAIN: [&str; 17] = [
    "dimension",
    "time",
    "time_step",
    "particles_per_cell",
    "gravity",
    "results",
    "mesh",
    "material",
    "body",
    "damping",
    "shape_function",
    "stress_scheme_update",
    "transfer",
    "pic_fraction",
    "domain_update",
    "volumetric_strain",
    "nodal_point_load",
];

/// A digest of bytes, FNV-1a of 128 bits: it tells sources apart, and protects from no malice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u128);

impl Digest {
    /// The digest of nothing.
    const NOTHING: Self = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    /// Digits that are shown; two sources agree in them once in 10^14.
    const SHOWN: usize = 12;

    /// The digest of what was before and these bytes, whose number tells them from the next.
    fn with(self, bytes: &[u8]) -> Self {
        let number = (bytes.len() as u64).to_le_bytes();
        let all = number.iter().chain(bytes);
        Self(all.fold(self.0, |digest, &byte| {
            (digest ^ u128::from(byte)).wrapping_mul(0x0100_0000_0000_0000_0000_013b)
        }))
    }

    /// Its first digits, for people.
    #[must_use]
    pub fn short(self) -> String {
        self.to_string()[..Self::SHOWN].to_owned()
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// The sources of today, part by part.
#[derive(Clone, Debug)]
pub struct Sources {
    parts: BTreeMap<&'static str, Digest>,
}

impl Sources {
    /// Reads the sources below the folder of the workspace.
    ///
    /// # Errors
    /// That of a file or folder that cannot be read.
    pub fn read(root: &Path, compiler: &str) -> io::Result<Self> {
        let mut files: Vec<PathBuf> = BESIDE.iter().map(PathBuf::from).collect();
        for folder in BELOW {
            collect(root, Path::new(folder), &mut files)?;
        }
        files.sort();
        let mut parts = BTreeMap::from([(CYCLE, Digest::NOTHING.with(compiler.as_bytes()))]);
        for file in files {
            let name = file.to_string_lossy().replace('\\', "/");
            let digest = parts.entry(part(&name)).or_insert(Digest::NOTHING);
            let bytes = std::fs::read(root.join(&file))?;
            let code = if file.extension().is_some_and(|extension| extension == "rs") {
                without_comments(&bytes)
            } else {
                bytes
            };
            *digest = digest.with(name.as_bytes()).with(&code);
        }
        Ok(Self { parts })
    }

    /// Parts and their digests, in the order of their names.
    pub fn parts(&self) -> impl Iterator<Item = (&'static str, Digest)> + '_ {
        self.parts.iter().map(|(&name, &digest)| (name, digest))
    }

    /// The digest of a count: the scene, how it is counted, and all parts on which it depends.
    #[must_use]
    pub fn of(&self, scene: &Value, how: &str) -> Digest {
        let scene_and_how = Digest::NOTHING
            .with(scene.to_string().as_bytes())
            .with(how.as_bytes());
        let left_out = left_out(scene);
        self.parts()
            .filter(|(part, _)| !left_out.contains(part))
            .fold(scene_and_how, |digest, (part, of_part)| {
                digest
                    .with(part.as_bytes())
                    .with(of_part.to_string().as_bytes())
            })
    }
}

/// Rust source without its blank lines and those that are comments alone: they make no instruction.
fn without_comments(source: &[u8]) -> Vec<u8> {
    let is_code = |line: &&[u8]| {
        let line = line.trim_ascii_start();
        !line.is_empty() && !line.starts_with(b"//")
    };
    let lines = source.split(|byte| *byte == b'\n').filter(is_code);
    let mut code = vec![];
    for line in lines {
        code.extend_from_slice(line);
        code.push(b'\n');
    }
    code
}

/// The part of a file, by its path below the workspace.
fn part(path: &str) -> &'static str {
    let found = FOLDERS
        .iter()
        .filter_map(|(folder, part)| Some((path.rfind(folder)?, *part)));
    found.max().map_or(CYCLE, |(_, part)| part)
}

/// Parts that a scene certainly does not reach.
fn left_out(scene: &Value) -> &'static [&'static str] {
    let Some(keys) = scene.as_object() else {
        return &[];
    };
    let contacts = match scene.get("contact") {
        None => &[],
        Some(Value::Array(contacts)) => contacts.as_slice(),
        Some(_) => return &[],
    };
    let plain = keys
        .keys()
        .all(|key| key == "contact" || PLAIN.contains(&key.as_str()));
    // Contact on the grid is the one that needs no method.
    if !plain
        || contacts
            .iter()
            .any(|contact| contact.get("method").is_some())
    {
        &[]
    } else if contacts.is_empty() {
        &[CONTACT, "mortar", "surfaces"]
    } else {
        &["mortar", "surfaces"]
    }
}

/// Sources and manifests of a folder and those below it.
fn collect(root: &Path, folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in root.join(folder).read_dir()? {
        let entry = entry?;
        let name = entry.file_name();
        let path = folder.join(&name);
        if entry.file_type()?.is_dir() {
            if !ELSEWHERE.iter().any(|elsewhere| name == *elsewhere) {
                collect(root, &path, files)?;
            }
        } else if name == "Cargo.toml" || path.extension().is_some_and(|kind| kind == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// Digests kept beside counts, by the name of what was counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KeptDigests(BTreeMap<String, String>);

impl KeptDigests {
    /// The file of the digests, beside that of the counts.
    #[must_use]
    pub fn beside(counts: &Path) -> PathBuf {
        counts.with_extension("sources.csv")
    }

    /// Reads what is kept; nothing where there is no file, so that everything is counted.
    ///
    /// # Errors
    /// That of a file that is there and cannot be read.
    pub fn read(path: &Path) -> io::Result<Self> {
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::default()),
            text => text?,
        };
        let rows = text.lines().skip(1).filter_map(|line| line.split_once(','));
        Ok(Self(
            rows.map(|(of, digest)| (of.to_owned(), digest.to_owned()))
                .collect(),
        ))
    }

    /// Keeps a digest.
    pub fn keep(&mut self, of: impl Into<String>, digest: Digest) {
        self.0.insert(of.into(), digest.to_string());
    }

    /// True if a digest is that which is kept.
    #[must_use]
    pub fn has(&self, of: &str, digest: Digest) -> bool {
        self.0
            .get(of)
            .is_some_and(|kept| *kept == digest.to_string())
    }

    /// Writes them.
    ///
    /// # Errors
    /// That of the file.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let rows = self.0.iter().map(|(of, digest)| format!("{of},{digest}\n"));
        std::fs::write(path, format!("of,digest\n{}", rows.collect::<String>()))
    }
}
