//! write -> read gives the same record.

use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::{Record, Row};
use proctor_scene::simulation::Options;
use proptest::prelude::*;
use std::time::Duration;
use tempfile::TempDir;

fn back(record: &Record) -> Record {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("record.json");
    record.write(&path).expect("written");
    Record::read(&path).expect("read")
}

fn spent() -> impl Strategy<Value = Spent> {
    // Up to eleven days, to the nanosecond; a double holds no more.
    let time = || (0..1_000_000_000_000_000_u64).prop_map(Duration::from_nanos);
    (time(), time()).prop_map(|(wall, cpu)| Spent { wall, cpu })
}

fn row() -> impl Strategy<Value = Row> {
    let number = prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO;
    (
        "[a-z][a-z0-9 /=.\"\\\\é]{0,20}",
        prop::option::of(0..1000_u64),
        1..256_usize,
        prop::option::of(spent()),
        prop::collection::btree_map("error_[a-z_0-9]{1,12}", number, 0..6),
        prop::collection::btree_map("scheme_[a-z]{1,6}", ".{0,12}", 0..4),
        prop::option::of(".{0,30}"),
    )
        .prop_map(
            |(name, repetition, threads, spent, counters, labels, error)| {
                let mut row = match repetition {
                    Some(repetition) => Row::sample(name, repetition, threads),
                    None => Row::aggregate(name, "verdict", threads),
                };
                if let Some(spent) = spent {
                    row = row.timed(spent);
                }
                for (key, value) in counters {
                    row.count(key, value);
                }
                for (key, value) in labels {
                    row.label(key, value);
                }
                if let Some(error) = error {
                    row.fail(error);
                }
                row
            },
        )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]
    #[test]
    fn what_is_written_is_read(rows in prop::collection::vec(row(), 1..8)) {
        let mut record = Record::new(&Options::default());
        for row in rows {
            record.push(row);
        }
        prop_assert_eq!(back(&record), record);
    }
}

#[test]
fn passes_and_the_mark_of_interrupted_work_are_kept() {
    let mut record = Record::new(&Options::default());
    let mut row = Row::sample("a", 2, 1);
    row.set_pass(7);
    record.push(row);
    record.set_incomplete(true);
    let read = back(&record);
    assert!(read.incomplete());
    assert_eq!(read.rows[0].pass(), 7);
    record.set_incomplete(false);
    assert!(!back(&record).incomplete());
    assert_eq!(Row::sample("a", 0, 1).pass(), 0);
}
