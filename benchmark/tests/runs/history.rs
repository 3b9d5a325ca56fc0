//! Histories of runs, read back.

use proctor_benchmark::runs::RunHistory;
use tempfile::TempDir;

/// Reads a history from the text of a file; the line of the fault where it is none.
fn read(text: &str) -> Result<RunHistory, usize> {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("history.csv");
    std::fs::write(&path, text).expect("written");
    RunHistory::read(&path).map_err(|error| {
        let named = format!("{}:", path.display());
        let line = error
            .strip_prefix(&named)
            .and_then(|rest| rest.split(':').next());
        line.and_then(|line| line.parse().ok())
            .expect("the file and a line")
    })
}

#[test]
fn a_history_reads_back_without_half_a_row() {
    let history = read("time,step,a\n0,0,1\n2,1,\n4,2,3\n5,3,").expect("rows");
    assert_eq!(history.times, [0.0, 2.0, 4.0]);
    let a = history.column("a").expect("a column");
    assert!(a[1].is_nan() && a[2] == 3.0);
    let steps = history.column("step").expect("a column");
    assert_eq!(history.at(steps, 1.0), Some(0.5));
    assert_eq!(history.at(steps, 4.0), Some(2.0));
    assert_eq!(history.at(steps, 4.5), None);
    assert_eq!(history.at(steps, -1.0), None);
}

#[test]
fn what_is_no_history_is_told_with_its_line() {
    for (text, line) in [
        ("", 1),
        ("step,time\n", 1),
        ("time,a\n0,1\n1,x\n", 3),
        ("time,a\n0,1\n0,1\n", 3),
        ("time,a\n0\n", 2),
    ] {
        assert_eq!(read(text), Err(line), "{text}");
    }
}
