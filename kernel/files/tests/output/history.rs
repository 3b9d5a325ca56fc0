//! `history.csv`: whole rows, exact numbers, repaired after a kill.

use std::fs;

use proctor_files::output::history::{ContinuedHistory, HISTORY};
use proctor_files::output::{HistoryWriter, OutputError, OutputFolder};

use super::names;

fn columns() -> Vec<String> {
    ["kinetic_energy", "probe \"tip, left\""]
        .map(str::to_owned)
        .to_vec()
}

/// A folder with a history of the times 0, 1, 2.
fn three_rows() -> (tempfile::TempDir, OutputFolder, HistoryWriter) {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let mut history = HistoryWriter::create(&folder, &columns()).unwrap();
    for step in 0..3_u32 {
        history
            .append(f64::from(step), u64::from(step), &[0.1 + 0.2, -1e-300])
            .unwrap();
    }
    (parent, folder, history)
}

fn text(folder: &OutputFolder) -> String {
    fs::read_to_string(folder.file(HISTORY)).unwrap()
}

const HEADER: &str = "time,step,kinetic_energy,\"probe \"\"tip, left\"\"\"\n";

#[test]
fn rows_read_back_to_the_same_bits() {
    let (_parent, folder, mut history) = three_rows();
    history.append(3.0, 3, &[f64::NAN, f64::INFINITY]).unwrap();
    let text = text(&folder);
    assert!(text.starts_with(HEADER), "{text}");
    assert!(
        text.ends_with("2.0,2,0.30000000000000004,-1e-300\n3.0,3,,\n"),
        "{text}"
    );
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let first = reader.records().next().unwrap().unwrap();
    assert_eq!(
        first[2].parse::<f64>().unwrap().to_bits(),
        (0.1 + 0.2_f64).to_bits()
    );
}

#[test]
fn a_restart_takes_off_later_rows_and_half_a_row() {
    let (_parent, folder, history) = three_rows();
    drop(history);
    let whole = text(&folder);
    // Killed inside the write of a row, at any byte.
    let row = "3.0,3,0.5,0.25";
    for cut in 1..=row.len() {
        fs::write(folder.file(HISTORY), format!("{whole}{}", &row[..cut])).unwrap();
        let (mut history, resumed) = HistoryWriter::resume(&folder, &columns(), 1.0).unwrap();
        assert_eq!(
            resumed,
            ContinuedHistory {
                kept: 2,
                dropped: 1,
                half_row: true
            }
        );
        assert_eq!(history.last_time(), Some(1.0));
        history.append(1.5, 7, &[1.0, 2.0]).unwrap();
        let (before, after) = whole.split_at(whole.find("2.0,2").unwrap());
        assert_eq!(text(&folder), format!("{before}1.5,7,1.0,2.0\n"), "{after}");
    }
    assert_eq!(names(folder.path()), [HISTORY]);
}

#[test]
fn a_restart_at_the_end_changes_nothing() {
    let (_parent, folder, history) = three_rows();
    drop(history);
    let whole = text(&folder);
    let (_, resumed) = HistoryWriter::resume(&folder, &columns(), 2.0).unwrap();
    assert_eq!(
        resumed,
        ContinuedHistory {
            kept: 3,
            dropped: 0,
            half_row: false
        }
    );
    assert_eq!(text(&folder), whole);
}

#[test]
fn a_restart_into_an_empty_folder_makes_a_history() {
    let parent = tempfile::tempdir().unwrap();
    let folder = OutputFolder::create(parent.path()).unwrap();
    let (_, resumed) = HistoryWriter::resume(&folder, &columns(), 2.0).unwrap();
    assert_eq!(
        (resumed, text(&folder).as_str()),
        (ContinuedHistory::default(), HEADER)
    );
}

#[test]
fn a_foreign_or_damaged_history_is_refused_and_untouched() {
    let (_parent, folder, history) = three_rows();
    drop(history);
    let mut other = columns();
    other.pop();
    let error = HistoryWriter::resume(&folder, &other, 1.0).unwrap_err();
    assert!(matches!(error, OutputError::Columns { .. }), "{error:?}");
    for (bad, why) in [
        ("1.5,1,2.0\n", "3 cells"),
        ("1.5,1,2.0,abc\n", "'abc' is not a number"),
        ("0.5,1,2.0,1.0\n", "do not increase"),
        (",1,2.0,1.0\n", "no time"),
        ("NaN,1,2.0,1.0\n", "no time"),
    ] {
        let damaged = format!("{HEADER}1.0,0,1.0,1.0\n{bad}3.0,3,1.0,1.0\n");
        fs::write(folder.file(HISTORY), &damaged).unwrap();
        let error = HistoryWriter::resume(&folder, &columns(), 9.0).unwrap_err();
        assert!(
            matches!(error, OutputError::Malformed { line: 3, .. }),
            "{error:?}"
        );
        assert!(error.to_string().contains(why), "{error}");
        assert_eq!(text(&folder), damaged);
    }
    for empty in ["", "time,step"] {
        fs::write(folder.file(HISTORY), empty).unwrap();
        assert!(matches!(
            HistoryWriter::resume(&folder, &columns(), 1.0),
            Err(OutputError::Columns { .. })
        ));
    }
}

#[test]
fn wrong_rows_and_names_are_refused() {
    let (_parent, folder, mut history) = three_rows();
    let whole = text(&folder);
    assert!(matches!(
        history.append(3.0, 3, &[1.0]),
        Err(OutputError::Length {
            expected: 2,
            found: 1,
            ..
        })
    ));
    for time in [2.0, 1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            history.append(time, 3, &[1.0, 1.0]),
            Err(OutputError::Time { .. })
        ));
    }
    for bad in ["", "time", "a\nb"] {
        let error = HistoryWriter::create(&folder, &[bad.to_owned()]).unwrap_err();
        assert!(matches!(error, OutputError::Name { .. }), "{error:?}");
    }
    assert_eq!(text(&folder), whole);
}
