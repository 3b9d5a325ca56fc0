//! Instruction counts that a record lacks, or that were made with other sources.

use super::sources::{COMPILER, workspace, write};
use proctor_benchmark::bench::counted::{Earlier, Item, features, scenes_and_parts};
use proctor_benchmark::bench::sources::KeptDigests;
use proctor_benchmark::record::{Record, Row};
use proctor_scene::simulation::Options;
use std::path::{Path, PathBuf};

fn items() -> Vec<Item> {
    let features = features().into_iter().flat_map(|group| group.features);
    let all = scenes_and_parts().expect("scenes");
    all.into_iter().chain(features).collect()
}

/// A record of all counts of these sources but for some, with its digests.
fn kept(root: &Path, but: &[&str]) -> PathBuf {
    let path = root.join("instructions.json");
    let now = Earlier::read(root, COMPILER, None).expect("sources");
    let mut record = Record::new(&Options::default());
    let mut digests = KeptDigests::default();
    for item in items() {
        digests.keep(item.row(), now.count(&item).0);
        if !but.contains(&&*item.name) {
            let mut row = Row::sample(item.row(), 0, 1);
            row.count("instructions", 1.0);
            record.push(row);
        }
    }
    record.write(&path).expect("written");
    digests.write(&KeptDigests::beside(&path)).expect("written");
    path
}

fn uncounted(root: &Path, record: &Path) -> Vec<String> {
    let earlier = Earlier::read(root, COMPILER, Some(record)).expect("read");
    earlier.uncounted().expect("scenes")
}

#[test]
fn unchanged_sources_need_no_count() {
    let root = workspace();
    let record = kept(root.path(), &[]);
    assert_eq!(uncounted(root.path(), &record), Vec::<String>::new());
    // Another compiler makes other code.
    let other = Earlier::read(root.path(), "rustc 1.2.4", Some(&record)).expect("read");
    assert_eq!(other.uncounted().expect("scenes").len(), items().len());
}

#[test]
fn a_count_that_a_record_lacks_is_named() {
    let root = workspace();
    let lacking = ["contact-3d/step", "feature/far-plane"];
    let record = kept(root.path(), &lacking);
    assert_eq!(uncounted(root.path(), &record), lacking);
}

#[test]
fn scenes_that_reach_a_changed_source_are_named() {
    let root = workspace();
    let record = kept(root.path(), &[]);
    write(root.path(), "kernel/contact/src/mortar/pair.rs", "other");
    let changed = uncounted(root.path(), &record);
    assert!(
        changed.contains(&"mortar-3d/step".to_owned()),
        "{changed:?}"
    );
    assert!(!changed.contains(&"rest-3d/step".to_owned()));
    assert!(!changed.contains(&"contact-3d/step".to_owned()));
    write(root.path(), "kernel/stages/src/grid.rs", "other");
    assert_eq!(uncounted(root.path(), &record).len(), items().len());
}
