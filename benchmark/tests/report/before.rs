//! The base of a comparison of the main job.

use proctor_benchmark::judge::Verdict;
use proctor_benchmark::judge::change::Direction;
use proctor_benchmark::record::Record;
use proctor_benchmark::report::before::Before;
use proctor_benchmark::show::paint::Paint;
use std::path::Path;

const KEPT: &str = include_str!("../../../fixtures/expected/errors.json");
const LAST: &str = "last.json";

fn kept() -> Record {
    Record::parse(Path::new("kept"), KEPT.as_bytes()).expect("the kept record")
}

#[test]
fn the_first_run_is_compared_with_the_kept_record_and_the_next_with_the_last() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let before = Before::take(folder.path()).expect("the kept record");
    assert!(!before.is_of_this_folder());
    let since = before.judge(&kept());
    assert_eq!(since.comparison().verdict(), Verdict::Fine);
    let mut told = vec![];
    before.tell(&since, Paint::NONE, &mut told).expect("told");
    let told = String::from_utf8(told).expect("text");
    assert!(told.contains("since the kept record: FINE: "), "{told}");
    // A number that is half as large again in the next run.
    kept()
        .write(&folder.path().join("record.json"))
        .expect("written");
    let before = Before::take(folder.path()).expect("the last record");
    assert!(before.is_of_this_folder() && folder.path().join(LAST).exists());
    assert!(!folder.path().join("record.json").exists());
    let mut worse = kept();
    let row = worse
        .rows
        .iter_mut()
        .find(|row| row.counters.contains_key("error_l2_u"));
    let error = row
        .and_then(|row| row.counters.get_mut("error_l2_u"))
        .expect("an error");
    *error *= 1.5;
    let since = before.judge(&worse);
    assert_eq!(since.comparison().verdict(), Verdict::Worse);
    let changes = since
        .comparison()
        .findings
        .iter()
        .flat_map(|finding| &finding.changes);
    assert_eq!(
        changes
            .filter(|change| change.moved == Direction::Worse)
            .count(),
        1
    );
}

#[test]
fn an_interrupted_record_is_not_kept() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let mut record = kept();
    record.set_incomplete(true);
    record
        .write(&folder.path().join("record.json"))
        .expect("written");
    let before = Before::take(folder.path()).expect("the kept record");
    assert!(!before.is_of_this_folder() && !folder.path().join(LAST).exists());
}
