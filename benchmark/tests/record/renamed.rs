//! Renamed gates and quantities: old records and ledgers are read under the names of today.

use crate::record::read;
use proctor_benchmark::judge::ledger::Ledger;
use proctor_benchmark::judge::{self, Rules, Verdict};
use proctor_benchmark::record::renamed::{RENAMINGS, key_of_row, name};
use proctor_benchmark::record::{Record, key};
use std::path::Path;

/// A record and a ledger with one row of each, as commit 6d162f66 kept them.
const OLD: &str = r#"{"context": {"schema_version": 1, "ladders": "quick"}, "benchmarks": [
    {"name": "round-collapse/a=2/r_h=8", "run_name": "round-collapse/a=2/r_h=8", "run_type": "iteration",
     "error_mass_lost_over_that_of_the_start": 2.5e-16, "value_mass_lost_over_that_of_the_start": 2.5e-16},
    {"name": "round-collapse: a=2, r/h=8: mass lost, over that of the start_gate",
     "run_name": "round-collapse: a=2, r/h=8: mass lost, over that of the start", "run_type": "aggregate",
     "aggregate_name": "gate", "gate_value": 2.5e-16, "gate_bound": 1e-12, "gate_side": "at most"}],
  "details": {"cases": [{"name": "round-collapse", "question": "?", "figures": [], "for_the_record": [],
     "quantities": [["mass_lost_over_that_of_the_start", "mass lost, over that of the start"]],
     "gates": [{"name": "a=2, r/h=8: mass lost, over that of the start", "value": 2.5e-16, "relation": "at most",
                "bound": 1e-12, "reason": "r", "passed": true}]}]}}"#;
const OLD_LEDGER: &str = "ladder,case,number,from,to,what,reason,commit
quick,round-collapse/a=2/r_h=8,error_mass_lost_over_that_of_the_start,1e-16,2.5e-16,worse,a reason,0123456789
";

/// The same record with today's names.
fn new() -> String {
    OLD.replace(
        "mass lost, over that of the start",
        "mass lost over the initial mass",
    )
    .replace(
        "mass_lost_over_that_of_the_start",
        "mass_lost_over_the_initial_mass",
    )
}

#[test]
fn an_old_record_is_read_under_the_names_of_today_and_compares() {
    let (old, new) = (
        read(OLD).expect("a record"),
        read(&new()).expect("a record"),
    );
    assert_eq!(old, new);
    let rules = Rules {
        ignore_time: true,
        strict: true,
        ..Rules::default()
    };
    assert_eq!(judge::compare(&old, &new, &rules).verdict(), Verdict::Fine);
    // A number that moved is still seen to move.
    let moved = read(&new_with("2.5e-16, \"value", "3.5e-2, \"value")).expect("a record");
    assert_eq!(
        judge::compare(&old, &moved, &rules).verdict(),
        Verdict::Worse
    );
}

fn new_with(from: &str, to: &str) -> String {
    let text = new();
    assert!(text.contains(from), "{text}");
    text.replace(from, to)
}

#[test]
fn a_line_of_an_old_ledger_accepts_what_it_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("accepted.csv");
    std::fs::write(&path, OLD_LEDGER).expect("written");
    let ledger = Ledger::read(&path).expect("a ledger");
    let before = read(&new_with(
        "_mass\": 2.5e-16, \"value",
        "_mass\": 1e-16, \"value",
    ));
    let (before, now) = (before.expect("a record"), read(&new()).expect("a record"));
    let judged = |ledger| {
        let rules = Rules {
            ignore_time: true,
            ledger,
            ..Rules::default()
        };
        judge::compare(&before, &now, &rules).verdict()
    };
    assert_eq!(judged(None), Verdict::Worse);
    assert_eq!(judged(Some(&ledger)), Verdict::Fine);
}

/// A part that were a name of today too would rename what is written now; one that holds an older part would be renamed twice.
#[test]
fn no_old_part_is_in_a_name_of_today() {
    for renaming in &*RENAMINGS {
        assert_ne!(renaming.old, renaming.new);
        assert_eq!(name(&renaming.new), renaming.new);
        assert_eq!(key_of_row(&key(&renaming.new)), key(&renaming.new));
        assert_eq!(name(&renaming.old), renaming.new);
        assert_eq!(key_of_row(&key(&renaming.old)), key(&renaming.new));
    }
    let expected = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/expected");
    for kept in ["errors.json", "full.json"] {
        let text = std::fs::read_to_string(expected.join(kept)).expect("the kept record");
        for renaming in &*RENAMINGS {
            assert!(!text.contains(&renaming.old), "{kept}: {}", renaming.old);
        }
        Record::read(&expected.join(kept)).expect("a record");
    }
}

#[test]
fn parts_of_other_words_stay() {
    assert_eq!(key_of_row("error_top_at_2_h_cm"), "error_top_at_2_h_cm");
    assert_eq!(
        key_of_row("error_top_at_2_h_c"),
        "error_top_displacement_at_2_h_c"
    );
    assert_eq!(
        name("rotation: error of L2(u), side/h=8"),
        "rotation: error of L2(u), side/h=8"
    );
}
