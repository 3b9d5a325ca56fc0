//! Cases of a record that are done, and the cases that its run was to have.

use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::{CaseState, Record, Row};
use proctor_benchmark::suite::{CaseRun, RanRung};
use proctor_scene::simulation::Options;
use proctor_verification::case::{self, CaseError, Gate, RungResult, Verdict};
use proctor_verification::case::{Case, Size};
use tempfile::TempDir;

fn of(name: &str) -> &'static Case {
    let found = case::all().iter().find(|case| case.name() == name);
    found.expect("there is such a case")
}

/// A record of a case of which so many runs were made, the last of them failed if `fails`; its gate found 1 of `bound`.
fn record(name: &str, runs: usize, fails: bool, bound: f64) -> Record {
    let case = of(name);
    let ladder = case.rungs(Size::Quick);
    let last = ladder.len() - 1;
    let solved = || RungResult {
        particles: 4,
        steps: 2,
        time: 0.1,
        quantities: vec![],
        drawings: vec![],
        curve: None,
    };
    let rungs = ladder
        .into_iter()
        .enumerate()
        .take(runs)
        .map(|(i, rung)| RanRung {
            solved: if fails && i == last {
                Err(CaseError::new(case.name(), &rung, &"a reason".into()))
            } else {
                Ok(solved())
            },
            rung,
            samples: vec![Spent::default()],
        });
    let gate = Gate::at_most("error".to_owned(), 1.0, bound, "a reason");
    let ran = CaseRun {
        case,
        rungs: rungs.collect(),
        verdict: Verdict {
            gates: vec![gate],
            ..Verdict::default()
        },
        faults: vec![],
    };
    let mut record = Record::new(&Options::default());
    record.push_case(&ran, 1);
    record
}

#[test]
fn a_case_is_missing_failed_or_held() {
    let all = of("hertz").rungs(Size::Quick).len();
    let state = |record: &Record| record.case_state(of("hertz"), Size::Quick);
    assert_eq!(state(&record("hertz", all, false, 2.0)), CaseState::Held);
    assert_eq!(state(&record("hertz", all, true, 2.0)), CaseState::Failed);
    assert_eq!(state(&record("hertz", all, false, 0.5)), CaseState::Failed);
    // Interrupted in its midst, or never begun; its short ladder is not its full one.
    assert_eq!(
        state(&record("hertz", all - 1, false, 2.0)),
        CaseState::Missing
    );
    assert_eq!(state(&record("bar", 9, false, 2.0)), CaseState::Missing);
    let full = record("hertz", all, false, 2.0);
    assert_eq!(full.case_state(of("hertz"), Size::Full), CaseState::Missing);
}

#[test]
fn a_case_whose_name_begins_another_is_told_from_it() {
    let mut both = record("hertz", 9, false, 2.0);
    both.rows.extend(record("hertz-slab", 9, false, 0.5).rows);
    assert_eq!(both.case_state(of("hertz"), Size::Quick), CaseState::Held);
    assert_eq!(
        both.case_state(of("hertz-slab"), Size::Quick),
        CaseState::Failed
    );
    assert_eq!(both.gates_of("hertz"), 1);
    assert!(both.holds_more_than(&["hertz"]));
    assert!(!both.holds_more_than(&["hertz", "hertz-slab"]));
    let first = both.rows[0].name.clone();
    both.sort_cases(&["hertz-slab", "hertz"]);
    assert!(both.rows[0].name.starts_with("hertz-slab"));
    both.keep_cases(&["hertz"]);
    assert_eq!(both.rows[0].name, first);
    assert!(!both.holds_more_than(&["hertz"]));
}

/// Records of the files of a folder, read as one.
fn joined(all: &[&Record]) -> Record {
    let folder = TempDir::new().expect("a folder");
    for (number, record) in all.iter().enumerate() {
        let mut record = (*record).clone();
        record.push(Row::sample("bar/h=1", 0, 1));
        let path = folder.path().join(format!("{number}.json"));
        record.write(&path).expect("written");
    }
    Record::read_joined(folder.path()).expect("one record")
}

#[test]
fn what_was_asked_for_is_said_where_it_is_not_all() {
    let mut record = Record::new(&Options::default());
    assert_eq!(record.cases_asked(), None);
    record.set_cases(&["bar"], 1);
    assert_eq!(record.cases_asked(), None);
    record.set_cases(&["bar"], 2);
    assert_eq!(record.cases_asked(), Some(vec!["bar"]));
    let mut other = Record::new(&Options::default());
    other.set_cases(&["hertz", "bar"], 9);
    let both = joined(&[&record, &other]);
    assert_eq!(both.cases_asked(), Some(vec!["bar", "hertz"]));
    let all = Record::new(&Options::default());
    let with_all = joined(&[&record, &other, &all]);
    assert_eq!(with_all.cases_asked(), None);
}
