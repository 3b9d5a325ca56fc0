//! The index of scripts: each script once, and no other.

use super::root;
use std::collections::BTreeSet;
use std::fs;

#[test]
fn the_index_of_scripts_is_the_folder() {
    let folder = root().join("scripts");
    let files = folder.read_dir().expect("the folder is there");
    let mut there: BTreeSet<String> = files
        .map(|file| {
            file.expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    assert!(there.remove("README.md"));
    let index = fs::read_to_string(folder.join("README.md")).expect("the index is there");
    let listed: Vec<&str> = index
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once("` | "))
        .map(|(script, does)| {
            assert!(
                does.len() > 10,
                "{script} has a line that says what it does"
            );
            script
        })
        .collect();
    assert!(listed.is_sorted(), "{listed:?}");
    assert_eq!(listed, there.iter().collect::<Vec<_>>());
}
