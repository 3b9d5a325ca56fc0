//! Names of files that are not yet whole.

use proctor_files::output::atomic::is_temporary;

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
