//! Times that say whether a machine was busy.

use proctor_benchmark::measure::{Spent, busy};
use std::time::Duration;

fn spent(wall: f64, cpu: f64) -> Spent {
    Spent {
        wall: Duration::from_secs_f64(wall),
        cpu: Duration::from_secs_f64(cpu),
    }
}

#[test]
fn a_busy_machine_is_one_whose_clock_runs_ahead() {
    assert_eq!(busy([spent(1.0, 1.0), spent(2.0, 1.9)]), None);
    assert_eq!(busy([spent(1.0, 0.5), spent(2.0, 1.0)]), Some(2.0));
    // Two threads at work, and what is too short to say anything.
    assert_eq!(busy([spent(1.0, 1.9)]), None);
    assert_eq!(busy([spent(0.01, 0.001)]), None);
    assert_eq!(busy([]), None);
}
