//! Files of Google Benchmark.

use super::read;
use proctor_benchmark::record::Kind;

/// Record as version 1.9 of the library writes it.
const GOOGLE: &str = r#"{
  "context": {
    "date": "2025-03-01T12:00:00+00:00", "executable": "./a", "num_cpus": 8, "mhz_per_cpu": 3000,
    "caches": [{"type": "Data", "level": 1, "size": 32768, "num_sharing": 1}],
    "load_avg": [0.5, 0.4, 0.3], "library_build_type": "release", "json_schema_version": 1
  },
  "benchmarks": [
    {"name": "BM/8", "family_index": 0, "per_family_instance_index": 0, "run_name": "BM/8",
     "run_type": "iteration", "repetitions": 2, "repetition_index": 1, "threads": 1, "iterations": 1000000,
     "real_time": 12.5, "cpu_time": 12.25, "time_unit": "ns", "items_per_second": 8.0e7},
    {"name": "BM/9", "run_type": "iteration", "iterations": 10, "real_time": 3.0, "cpu_time": 2.0,
     "time_unit": "us"},
    {"name": "BM/10", "run_type": "iteration", "iterations": 1, "real_time": 0.5, "cpu_time": 0.25,
     "time_unit": "s", "label": "note"},
    {"name": "BM/8_cv", "run_name": "BM/8", "run_type": "aggregate", "aggregate_name": "cv",
     "aggregate_unit": "percentage", "threads": 1, "iterations": 2, "real_time": 0.01, "cpu_time": 0.02,
     "time_unit": "ns"},
    {"name": "BM/8_mean", "run_name": "BM/8", "run_type": "aggregate", "aggregate_name": "mean",
     "aggregate_unit": "time", "threads": 1, "iterations": 2, "real_time": 20.0, "cpu_time": 20.0,
     "time_unit": "ns"},
    {"name": "BM/11", "run_type": "iteration", "skipped": true, "skip_message": "no such device",
     "iterations": 0, "real_time": 0.0, "cpu_time": 0.0, "time_unit": "ns"}
  ]
}"#;

#[test]
fn times_come_in_seconds_whatever_their_unit() {
    let record = read(GOOGLE).expect("a record");
    let near = |a: Option<f64>, b: f64| (a.expect("a time") - b).abs() <= 1e-15 * b.max(1e-6);
    // Less than the nanosecond of a clock, but a million times.
    assert!(near(record.rows[0].wall(), 12.5e-9));
    assert!(near(record.rows[0].cpu(), 12.25e-9));
    assert!(near(record.rows[1].wall(), 3.0e-6));
    assert!(near(record.rows[2].wall(), 0.5));
    assert!(near(record.rows[4].wall(), 20.0e-9));
}

#[test]
fn rows_are_samples_aggregates_and_failures() {
    let rows = read(GOOGLE).expect("a record").rows;
    assert_eq!(rows[0].kind, Kind::Sample { repetition: 1 });
    assert_eq!(rows[0].counters["items_per_second"], 8.0e7);
    assert_eq!(rows[2].labels["label"], "note");
    let name = "cv".to_owned();
    assert_eq!(rows[3].kind, Kind::Aggregate { name });
    assert_eq!(rows[3].name, "BM/8");
    assert!(rows[3].spent.is_none(), "a share is no time");
    assert_eq!(rows[5].error.as_deref(), Some("no such device"));
    assert!(rows[5].wall().is_none());
}
