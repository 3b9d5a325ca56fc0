//! The output folder, and files that are whole or not there.

use std::fs;
use std::io;

use proctor_files::output::{OutputError, OutputFolder, atomic};

use super::names;

#[test]
fn a_failing_write_leaves_the_old_file_and_no_temporary() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    atomic::write(&path, |file| file.write_all(b"old")).unwrap();
    let error = atomic::write(&path, |file| {
        file.write_all(&vec![b'x'; 5 << 20])?;
        Err(io::Error::other("disk on fire"))
    })
    .unwrap_err();
    assert!(matches!(&error, OutputError::Write { path: p, .. } if *p == path));
    assert!(
        error.to_string().contains("summary.json") && error.to_string().contains("disk on fire")
    );
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["summary.json"]);
}

#[test]
fn a_write_that_cannot_be_renamed_leaves_no_temporary() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("taken/inside")).unwrap();
    atomic::write(&folder.path().join("taken"), |file| file.write_all(b"new")).unwrap_err();
    assert_eq!(names(folder.path()), ["taken"]);
}

#[cfg(unix)]
#[test]
fn files_are_as_readable_as_any_other() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let [ours, plain] = ["ours", "plain"].map(|name| folder.path().join(name));
    atomic::write(&ours, |file| file.write_all(b"1")).unwrap();
    fs::write(&plain, b"1").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

#[test]
fn the_folder_is_made_and_only_stale_temporaries_go() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("a/b");
    let folder = OutputFolder::create(&path).unwrap();
    assert_eq!(names(folder.path()), [""; 0]);
    for name in [
        ".proctor-k1LLed.tmp",
        ".proctor-notes.txt",
        "particles_000000.vtu",
    ] {
        fs::write(folder.file(name), b"x").unwrap();
    }
    fs::create_dir(folder.file(".proctor-folder.tmp")).unwrap();
    OutputFolder::create(&path).unwrap();
    assert_eq!(
        names(&path),
        [
            ".proctor-folder.tmp",
            ".proctor-notes.txt",
            "particles_000000.vtu"
        ]
    );
}

#[test]
fn a_folder_belongs_to_one_run_as_long_as_that_is_there() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("out");
    let first = OutputFolder::claim(&path).unwrap();
    let copy = first.clone();
    // What the first one is writing is no leftover.
    fs::write(first.file(".proctor-w0rk.tmp"), b"x").unwrap();
    drop(first);
    let error = OutputFolder::claim(&path).unwrap_err();
    assert!(matches!(&error, OutputError::InUse { path: p } if *p == path));
    assert!(error.to_string().contains("is in use"), "{error}");
    assert_eq!(names(&path), [".proctor-w0rk.tmp"]);
    drop(copy);
    OutputFolder::claim(&path).unwrap();
    assert_eq!(names(&path), [""; 0]);
}

#[test]
fn a_folder_that_cannot_be_is_named_with_the_reason() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("file");
    fs::write(&file, b"x").unwrap();
    for path in [file.clone(), file.join("below")] {
        let error = OutputFolder::create(&path).unwrap_err();
        assert!(matches!(error, OutputError::Folder { .. }), "{error:?}");
        assert!(
            error.to_string().contains(path.to_str().unwrap()),
            "{error}"
        );
        assert!(std::error::Error::source(&error).is_some());
    }
    assert_eq!(fs::read(&file).unwrap(), b"x");
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_without_permission_is_refused_before_the_run() {
    use std::os::unix::fs::PermissionsExt;
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("closed");
    fs::create_dir(&path).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o555)).unwrap();
    // The superuser may write anywhere but into the process table, where no file can be made.
    let path = if fs::write(path.join("probe"), b"x").is_ok() {
        "/proc/self".into()
    } else {
        path
    };
    let error = OutputFolder::create(&path).unwrap_err();
    assert!(
        matches!(error, OutputError::NotWritable { .. }),
        "{error:?}"
    );
    assert!(error.to_string().contains("cannot write into"), "{error}");
}
