//! The time of a run as the sum of its parts.

use proctor_benchmark::forecast::{RunCost, RunCounts};

/// Each part counts as often as the run has it: doubling one count adds its own cost, and nothing else.
#[test]
fn the_time_of_a_run_is_the_sum_of_its_parts() {
    let cost = RunCost {
        set_up: 0.3,
        step: 1e-3,
        row: 2e-3,
        output: 0.5,
    };
    let counts = RunCounts {
        steps: 1000,
        rows: 100,
        outputs: 4,
        files: 12,
        bytes: 1_000_000_000,
        has_end: false,
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    // Seconds of the set-up, the steps, the rows, the outputs, their files, the bytes.
    assert!(near(cost.of(&counts), 0.3 + 1.0 + 0.2 + 2.0 + 0.018 + 1.0));
    let twice = |change: fn(&mut RunCounts)| {
        let mut other = counts;
        change(&mut other);
        cost.of(&other) - cost.of(&counts)
    };
    assert!(near(twice(|c| c.steps *= 2), 1.0));
    assert!(near(twice(|c| c.rows *= 2), 0.2));
    assert!(near(twice(|c| c.outputs *= 2), 2.0));
    assert!(near(twice(|c| c.files *= 2), 0.018));
    assert!(near(twice(|c| c.bytes *= 2), 1.0));
    // A look at the balance of forces for every 50 steps.
    assert!(near(twice(|c| c.has_end = true), 0.02));
}
