//! Histories of numbers over records, and the points at which they change.

mod divisive;

use proctor_benchmark::history::divisive::CHANCE;
use proctor_benchmark::history::{self, History, Series};
use proctor_benchmark::judge::change::Direction;
use serde_json::json;
use tempfile::TempDir;

/// A history of records of a case with an error and a time [ms]; one whose error is below zero has no number.
fn history(all: impl IntoIterator<Item = (f64, f64)>) -> History {
    let folder = TempDir::new().expect("a folder");
    for (number, (error, ms)) in all.into_iter().enumerate() {
        let row = if error < 0.0 {
            json!({ "run_name": "bar/h=1", "name": "bar/h=1", "iterations": 1, "threads": 1 })
        } else {
            json!({
                "run_name": "bar/h=1", "name": "bar/h=1", "iterations": 1, "threads": 1, "real_time": 2.0 * ms,
                "cpu_time": ms, "time_unit": "ms", "error_l2_u": error, "particles": 8.0,
            })
        };
        let record = json!({ "context": { "schema_version": 1 }, "benchmarks": [row] });
        let path = folder.path().join(format!("{number:03}.json"));
        std::fs::write(path, record.to_string()).expect("written");
    }
    history::of_files(&[folder.path().to_owned()]).expect("a history")
}

#[test]
fn what_is_computed_changes_at_every_other_value_and_a_time_where_it_has_moved() {
    let history = history((0..40).map(|i| {
        let error = if i < 10 {
            0.5
        } else {
            0.25 + f64::from(i / 30)
        };
        let noise = f64::from(i32::from(i % 3 == 0));
        (error, noise + if i < 20 { 100.0 } else { 120.0 })
    }));
    let names: Vec<String> = history.series.iter().map(Series::name).collect();
    assert_eq!(names, ["bar/h=1: error_l2_u", "bar/h=1: cpu_seconds"]);
    let points = history.change_points();
    let told: Vec<(usize, usize, Direction)> =
        points.iter().map(|p| (p.at, p.series, p.moved)).collect();
    assert_eq!(
        told,
        [
            (10, 0, Direction::Better),
            (20, 1, Direction::Worse),
            (30, 0, Direction::Worse)
        ]
    );
    assert_eq!(points[0].loss, -0.5);
    assert!(points[1].chance < CHANCE && (points[1].loss - 0.2).abs() < 0.01);
}

#[test]
fn a_record_that_lacks_a_number_is_no_change_of_it() {
    let history = history([(0.5, 1.0), (-1.0, 1.0), (0.5, 1.0)]);
    assert_eq!(history.change_points(), []);
    assert_eq!(history.new_and_gone(), [[0, 0], [0, 2], [2, 0]]);
}
