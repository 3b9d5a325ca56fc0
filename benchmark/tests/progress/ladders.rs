//! Recorded run times of the ladders.

use proctor_benchmark::progress::ladders::{UNKNOWN, seconds};
use proctor_verification::case;
use proctor_verification::case::Size;

const SHORT: &str = include_str!("../../../fixtures/expected/short-ladders.csv");
const FULL: &str = include_str!("../../../fixtures/expected/full-ladders.csv");

#[test]
fn every_case_was_kept_in_both_sizes() {
    for case in case::all() {
        for table in [SHORT, FULL] {
            let name = format!("\n{},", case.name());
            assert!(table.contains(&name), "{}", case.name());
        }
    }
}

#[test]
fn what_was_never_kept_is_expected_to_take_something() {
    assert_eq!(seconds("no-such-case", Size::Quick), UNKNOWN);
    assert!(seconds("tilted-incline", Size::Full) > 100.0);
    assert!(seconds("bar", Size::Full) > 0.0);
}
