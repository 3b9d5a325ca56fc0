//! Costs at an error, and which runs none beats in both.

use proctor_benchmark::precision::cost::{At, Cost, cost, pareto};

/// Errors of order p on a path of refinement in d dimensions, `e = T^(-p/(d+1))`.
fn path(order: f64, dimensions: f64, runs: u32) -> Vec<Option<At>> {
    (0..runs)
        .map(|i| {
            let time = 2f64.powf((dimensions + 1.0) * f64::from(i));
            Some(At {
                error: time.powf(-order / (dimensions + 1.0)),
                time,
            })
        })
        .collect()
}

#[test]
fn costs_of_a_power_law_are_exact() {
    let line = path(2.0, 2.0, 5);
    for level in [0.5, 0.01, 0.004] {
        let Cost::Time(time) = cost(&line, level) else {
            panic!("{level} lies inside the line");
        };
        // e = T^(-2/3), so T = e^(-3/2).
        let exact = level.powf(-1.5);
        assert!((time / exact - 1.0).abs() < 1e-12, "{time} {exact}");
    }
}

#[test]
fn nothing_is_extrapolated() {
    let line = path(1.0, 1.0, 3);
    assert_eq!(cost(&line, 0.2), Cost::NotReached);
    assert_eq!(cost(&line, 2.0), Cost::AtMost(1.0));
    assert_eq!(cost(&[], 0.1), Cost::NotReached);
}

#[test]
fn a_failed_run_is_no_end_to_interpolate_from() {
    let at = |error, time| Some(At { error, time });
    let line = [at(0.1, 1.0), None, at(0.005, 16.0)];
    assert_eq!(cost(&line, 0.01), Cost::AtMost(16.0));
    // An error that grows again is not reached by the finer run, but was by the coarser.
    let stalled = [at(0.1, 1.0), at(0.001, 4.0), at(0.1, 16.0), at(0.001, 64.0)];
    assert_eq!(cost(&stalled, 0.01), Cost::Time(2.0));
    assert_eq!(cost(&[at(0.1, 1.0), at(0.0, 4.0)], 0.01), Cost::Time(4.0));
}

#[test]
fn the_front_has_the_points_that_none_beats() {
    let at = |error, time| Some(At { error, time });
    let points = [
        at(0.1, 1.0),
        at(0.2, 2.0),
        at(0.05, 4.0),
        None,
        at(0.05, 3.0),
        at(f64::NAN, 0.1),
        at(0.01, 9.0),
    ];
    assert_eq!(pareto(&points), [0, 4, 6]);
    assert_eq!(pareto(&[]), Vec::<usize>::new());
}
