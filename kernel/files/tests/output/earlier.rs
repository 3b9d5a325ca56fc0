//! The files of an earlier run: taken away where its lists name them, refused where nobody names them.

use std::fs;

use proctor_files::output::summary::SUMMARY;
use proctor_files::output::{Compression, Frame, OutputError, OutputFolder, Series, earlier};

use super::names;

fn frame(time: f64) -> Frame {
    Frame {
        time,
        step: 0,
        points: vec![[0.0; 3]],
        arrays: vec![],
        lines: vec![],
    }
}

/// A folder after a run with so many frames of particles and one of nodes.
fn after_a_run(frames: usize) -> (tempfile::TempDir, OutputFolder) {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let mut series = Series::create(folder.clone(), Compression::None).unwrap();
    for number in 0..frames {
        series.write_frame(&frame(number as f64)).unwrap();
    }
    let mut grid = Series::create_named(folder.clone(), "grid", Compression::None).unwrap();
    grid.write_frame(&frame(0.0)).unwrap();
    fs::write(folder.file(SUMMARY), b"{}").unwrap();
    (parent, folder)
}

#[test]
fn what_the_lists_name_goes_and_nothing_else() {
    let (_parent, folder) = after_a_run(3);
    for name in [
        "notes.txt",
        "particles_1.vtu",
        "particles.csv",
        "other_000000.vtu",
    ] {
        fs::write(folder.file(name), b"mine").unwrap();
    }
    // A run that was killed has written this one and not yet listed it.
    fs::write(folder.file("particles_000003.vtu"), b"whole").unwrap();
    earlier::clear(&folder).unwrap();
    assert_eq!(
        names(folder.path()),
        [
            "notes.txt",
            "other_000000.vtu",
            "particles.csv",
            "particles_1.vtu"
        ]
    );
    earlier::clear(&folder).unwrap();
}

#[test]
fn frames_that_no_list_names_are_refused_and_stay() {
    for stray in [
        "particles_000007.vtu",
        "grid_000005.vtu",
        "boundaries_000004.vtp",
    ] {
        let (_parent, folder) = after_a_run(2);
        fs::write(folder.file(stray), b"somebody's").unwrap();
        let before = names(folder.path());
        let error = earlier::clear(&folder).unwrap_err();
        assert!(matches!(&error, OutputError::Unlisted { first, count: 1, .. } if first == stray));
        assert!(error.to_string().contains(stray), "{error}");
        assert_eq!(names(folder.path()), before);
    }
}

#[test]
fn a_list_of_somebody_else_is_refused() {
    let (_parent, folder) = after_a_run(1);
    fs::write(folder.file("particles.pvd"), b"a list of my own").unwrap();
    let before = names(folder.path());
    let error = earlier::clear(&folder).unwrap_err();
    assert!(matches!(error, OutputError::Malformed { .. }), "{error:?}");
    assert_eq!(names(folder.path()), before);
}

#[test]
fn a_list_reaches_no_file_outside_its_folder() {
    let parent = tempfile::tempdir().unwrap();
    let outside = parent.path().join("particles_000000.vtu");
    fs::write(&outside, b"mine").unwrap();
    let folder = OutputFolder::create(parent.path().join("out")).unwrap();
    let list = "<VTKFile type=\"Collection\">\n<DataSet timestep=\"0\" file=\"../particles_000000.vtu\"/>\n</VTKFile>\n";
    fs::write(folder.file("particles.pvd"), list).unwrap();
    earlier::clear(&folder).unwrap();
    assert!(outside.exists());
}

#[test]
fn frames_behind_a_restart_go_with_their_entries() {
    let (_parent, folder) = after_a_run(5);
    let series = Series::resume(folder.clone(), Compression::None, 1.0).unwrap();
    assert_eq!(series.entries().len(), 2);
    let frames = names(folder.path());
    let frames = frames.iter().filter(|name| name.starts_with("particles_"));
    assert_eq!(
        frames.collect::<Vec<_>>(),
        ["particles_000000.vtu", "particles_000001.vtu"]
    );
}
