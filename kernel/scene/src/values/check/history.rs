//! Check of histories.

use super::collector::Collector;
use proctor_geometry::number::Number;
use proctor_kernel::model::History;

/// Times finite and strictly increasing, one value each.
pub(super) fn check_history(path: &str, history: &History, problems: &mut Collector) {
    if history.times.is_empty() || history.times.len() != history.values.len() {
        problems.add(
            path,
            format!(
                "{} times and {} values",
                history.times.len(),
                history.values.len()
            ),
            "at least one time, and one value for each",
        );
    }
    for (row, value) in history.values.iter().enumerate() {
        problems.vector(format!("{path}[{row}]"), value);
    }
    for (row, time) in history.times.iter().enumerate() {
        if !time.is_finite() {
            problems.add(
                format!("{path}[{row}]"),
                Number(*time).to_string(),
                "a finite time [s]",
            );
        } else if row > 0 && history.times[row - 1] >= *time {
            problems.add(
                format!("{path}[{row}]"),
                format!("the time {time}"),
                format!(
                    "a time after that of the row before, {} [s]",
                    history.times[row - 1]
                ),
            );
        }
    }
}
