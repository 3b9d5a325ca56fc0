//! Two runs beside each other.

use proctor_benchmark::runs::{RunComparison, RunFolder, RunHistory};
use proctor_files::output::Summary;
use std::path::PathBuf;

fn run(times: &[f64], columns: &[(&str, &[f64])]) -> RunFolder {
    RunFolder {
        path: PathBuf::from("run"),
        summary: Summary::default(),
        history: RunHistory {
            times: times.to_vec(),
            columns: columns
                .iter()
                .map(|(name, v)| ((*name).to_owned(), v.to_vec()))
                .collect(),
        },
    }
}

#[test]
fn the_largest_difference_has_its_time() {
    let first = run(
        &[0.0, 1.0, 2.0],
        &[("a", &[0.0, 4.0, 2.0]), ("b", &[1.0; 3]), ("c", &[0.0; 3])],
    );
    let second = run(
        &[0.0, 0.5, 1.5],
        &[("a", &[0.0, 1.0, 1.0]), ("b", &[1.0; 3]), ("d", &[0.0; 3])],
    );
    let found = RunComparison::new(&first, &second);
    assert_eq!(found.times, [0.0, 1.0]);
    assert!(found.is_interpolated);
    assert_eq!(found.alone, [vec!["c".to_owned()], vec!["d".to_owned()]]);
    let a = &found.columns[0];
    assert_eq!((a.name.as_str(), a.most, a.time), ("a", -3.0, 1.0));
    assert_eq!((a.share, a.ends), (0.75, [4.0, 1.0]));
    assert_eq!(found.differing().count(), 1);
    let same = RunComparison::new(&first, &first);
    assert!(!same.is_interpolated && same.differing().count() == 0);
}
