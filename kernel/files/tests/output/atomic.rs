//! Names of files that are not yet whole.

use proctor_files::output::atomic::{is_temporary, number_of_waits, without_waiting, write};

#[test]
fn only_our_temporaries_are_recognised() {
    assert!(is_temporary(".proctor-a8Xk2Q.tmp"));
    for name in [
        ".proctor-.tmp",
        ".proctor-notes",
        "proctor-a.tmp",
        ".proctor-my file.tmp",
        "x.proctor-a.tmp",
    ] {
        assert!(!is_temporary(name), "{name}");
    }
}

#[test]
fn a_set_of_files_that_are_thrown_away_waits_for_the_disk_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = || {
        for name in ["a", "b", "c"] {
            write(&folder.path().join(name), |file| file.write_all(b"whole")).expect("written");
        }
    };
    let before = number_of_waits();
    without_waiting(folder.path(), files);
    assert_eq!(number_of_waits() - before, u64::from(cfg!(unix)));
    for name in ["a", "b", "c"] {
        let text = std::fs::read(folder.path().join(name)).expect("a file");
        assert_eq!(text, b"whole");
    }
    // Elsewhere every file and its folder do.
    let before = number_of_waits();
    files();
    assert_eq!(number_of_waits() - before, if cfg!(unix) { 6 } else { 3 });
}
