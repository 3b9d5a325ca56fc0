//! Recorded run times of the ladders of the cases, for the first estimate of progress.

use proctor_verification::case::Size;

const SHORT: &str = include_str!("../../../fixtures/expected/short-ladders.csv");
const FULL: &str = include_str!("../../../fixtures/expected/full-ladders.csv");

/// Time of a case that was never kept \[s\], and the least of any.
const UNKNOWN: f64 = 2.0;
const LEAST: f64 = 0.05;

/// CPU time of the ladder of a case \[s\], on the machine on which it was kept.
pub fn seconds(case: &str, size: Size) -> f64 {
    let table = match size {
        Size::Quick => SHORT,
        Size::Full => FULL,
    };
    let found = table.lines().find_map(|line| {
        let (name, seconds) = line.split_once(',')?;
        (name == case).then(|| seconds.trim().parse::<f64>().ok())?
    });
    found.unwrap_or(UNKNOWN).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proctor_verification::case;

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
}
