//! Counts of instructions that must be made again after a change of the sources.

use proctor_benchmark::bench::sources::{Digest, KeptDigests, Sources};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

pub const COMPILER: &str = "rustc 1.2.3";
const FILES: [&str; 14] = [
    "Cargo.toml",
    "Cargo.lock",
    "benchmark/benches/instructions/main.rs",
    "kernel/Cargo.toml",
    "kernel/stages/src/grid.rs",
    "kernel/scene/src/values/mortar.rs",
    "kernel/laws/src/plastic.rs",
    "kernel/contact/src/pairs/surface.rs",
    "kernel/contact/src/grid/faces.rs",
    "kernel/contact/src/mortar/pair.rs",
    "kernel/contact/src/geometry/mortar/space/clip.rs",
    "kernel/contact/src/geometry/surface/tree.rs",
    "kernel/files/src/json/mod.rs",
    "kernel/files/examples/counted.rs",
];
/// Counting of the scenes of the test.
const HOW: &str = "step 12";

pub fn write(root: &Path, file: &str, text: &str) {
    let path = root.join(file);
    fs::create_dir_all(path.parent().expect("a folder")).expect("made");
    fs::write(path, text).expect("written");
}

/// A workspace of files that are all different.
pub fn workspace() -> TempDir {
    let root = TempDir::new().expect("a folder");
    for file in FILES {
        write(root.path(), file, file);
    }
    root
}

/// A scene without contact, one with contact on the grid, mortar contact, a surface, and a key that nobody knows.
fn scenes() -> [Value; 5] {
    let plain = json!({ "dimension": 3, "material": [{ "type": "elastic" }] });
    let with = |key: &str, value: Value| {
        let mut scene = plain.clone();
        scene[key] = value;
        scene
    };
    [
        plain.clone(),
        with("contact", json!([{ "id": 1, "friction": 0.3 }])),
        with("contact", json!([{ "id": 1, "method": "mortar" }])),
        with("terrain_contact", json!({ "active": true })),
        with("new_key", json!(1)),
    ]
}

fn digests(root: &Path, compiler: &str) -> [Digest; 5] {
    let sources = Sources::read(root, compiler).expect("the files are there");
    scenes().map(|scene| sources.of(&scene, HOW))
}

/// Scenes whose count must be made again after a change.
fn again(change: impl Fn(&Path)) -> [bool; 5] {
    let root = workspace();
    let before = digests(root.path(), COMPILER);
    change(root.path());
    let after = digests(root.path(), COMPILER);
    std::array::from_fn(|i| before[i] != after[i])
}

const ALL: [bool; 5] = [true; 5];
const NONE: [bool; 5] = [false; 5];
const NOT_PLAIN: [bool; 5] = [false, true, true, true, true];
const NOT_ON_THE_GRID: [bool; 5] = [false, false, true, true, true];

#[test]
fn each_file_makes_those_scenes_be_counted_that_can_reach_it() {
    for file in FILES {
        let expected = if file.contains("/mortar/") || file.contains("/surface/") {
            NOT_ON_THE_GRID
        } else if file.contains("/contact/") || file.contains("interactions/grid") {
            NOT_PLAIN
        } else {
            ALL
        };
        let found = again(|root| write(root, file, "changed"));
        assert_eq!(found, expected, "{file} changed");
    }
}

#[test]
fn a_file_that_comes_goes_or_moves_is_a_change() {
    assert_eq!(again(|root| write(root, "kernel/new/src/lib.rs", "")), ALL);
    let removed = again(|root| {
        fs::remove_file(root.join("kernel/stages/src/grid.rs")).expect("it was there");
    });
    assert_eq!(removed, ALL);
    let moved = again(|root| {
        let (from, to) = ("kernel/contact", "kernel/touching");
        fs::rename(root.join(from), root.join(to)).expect("it was there");
    });
    assert_eq!(moved, ALL, "a folder of no known name is of every scene");
}

#[test]
fn what_is_in_no_counted_program_is_no_change() {
    for file in [
        "kernel/README.md",
        "kernel/tests/all.rs",
        "kernel/tests/mortar/pair.rs",
        "kernel/examples/own_law.rs",
        "verification/src/lib.rs",
        "benchmark/src/lib.rs",
        "docs/a.md",
    ] {
        assert_eq!(again(|root| write(root, file, "new")), NONE, "{file}");
    }
}

/// Words make no instruction; in a manifest every line counts.
#[test]
fn comments_are_no_change() {
    let file = "kernel/stages/src/grid.rs";
    let text = file.to_owned();
    let commented = format!("//! The cycle.\n\n  /// A stage.\n{text}\n// Why.\n");
    assert_eq!(again(|root| write(root, file, &commented)), NONE);
    let code = format!("//! The cycle.\n{text} // a word behind code\n");
    assert_eq!(again(|root| write(root, file, &code)), ALL);
    let manifest = "# a word\nCargo.toml";
    assert_eq!(again(|root| write(root, "Cargo.toml", manifest)), ALL);
}

#[test]
fn compiler_scene_and_the_manner_of_counting_are_in_the_digest() {
    let root = workspace();
    let before = digests(root.path(), COMPILER);
    let other = digests(root.path(), "rustc 1.2.4");
    assert!(before.iter().zip(&other).all(|(a, b)| a != b));
    let sources = Sources::read(root.path(), COMPILER).expect("the files are there");
    let [plain, ..] = scenes();
    let mut heavier = plain.clone();
    heavier["gravity"] = json!([0, 0, -10]);
    assert_ne!(sources.of(&plain, HOW), sources.of(&heavier, HOW));
    assert_ne!(sources.of(&plain, HOW), sources.of(&plain, "p2g 12"));
}

#[test]
fn without_what_was_kept_everything_is_counted() {
    let root = workspace();
    let [digest, ..] = digests(root.path(), COMPILER);
    let file = KeptDigests::beside(&root.path().join("instructions.json"));
    assert!(file.ends_with("instructions.sources.csv"));
    let none = KeptDigests::read(&file).expect("no file is nothing kept");
    assert!(!none.has("rest/step", digest));
    let mut kept = KeptDigests::default();
    kept.keep("rest/step", digest);
    kept.write(&file).expect("written");
    let read = KeptDigests::read(&file).expect("written before");
    assert_eq!(read, kept);
    assert!(read.has("rest/step", digest) && !read.has("moving/step", digest));
    write(
        root.path(),
        "instructions.sources.csv",
        "of,digest\nrest/step,0\n",
    );
    let spoilt = KeptDigests::read(&file).expect("a file");
    assert!(!spoilt.has("rest/step", digest));
}

/// Folders that were renamed would leave a part empty, and its scenes would be counted after every change.
#[test]
fn each_part_has_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let sources = Sources::read(&root, COMPILER).expect("the sources are there");
    let parts: Vec<_> = sources.parts().map(|(part, _)| part).collect();
    assert_eq!(parts, ["contact", "cycle", "laws", "mortar", "surfaces"]);
}
