//! The rule of error bars, its windows in time and its gate, on made-up data whose answer is known.

use approx::assert_relative_eq;
use proctor_verification::refine::calibration::{
    CHOSEN_ON, Calibration, Coverage, HELD_OUT, Ladder, triples,
};
use proctor_verification::refine::rule::order;
use proctor_verification::refine::series::Histories;
use proctor_verification::refine::{Rule, Verdict};

/// Values `1 + h^p` on these cells.
fn values(cells: [f64; 3], p: f64) -> [f64; 3] {
    cells.map(|h| 1.0 + h.powf(p))
}

fn differences([a, b, c]: [f64; 3]) -> [f64; 2] {
    [a - b, b - c]
}

#[test]
fn the_order_of_powers_is_found_for_any_ratio() {
    for cells in [[0.4, 0.2, 0.1], [0.3, 0.2, 0.1], [0.5, 0.125, 0.1]] {
        for p in [0.3, 0.5, 1.0, 1.7, 2.0, 3.0] {
            let seen = order(cells, differences(values(cells, p))).expect("an order");
            assert_relative_eq!(seen, p, max_relative = 1e-9);
        }
    }
    assert_eq!(order([4.0, 2.0, 1.0], [1.0, -0.5]), None);
    assert_eq!(order([4.0, 2.0, 1.0], [0.0, 0.0]), None);
    assert_relative_eq!(
        order([4.0, 2.0, 1.0], [1.0, 1.0]).unwrap(),
        0.0,
        epsilon = 1e-6
    );
    assert!(order([4.0, 2.0, 1.0], [1.0, 2.0]).unwrap() < 0.0);
}

#[test]
fn widths_at_ratio_two_are_those_of_the_design() {
    let cells = [4.0, 2.0, 1.0];
    for (d, width, verdict) in [
        // Orders 2, 1, 0.5, 2.5, 0.3, and a swing.
        ([4.0, 1.0], 0.82, Verdict::Asymptotic),
        ([2.0, 1.0], 1.5, Verdict::Asymptotic),
        ([1.415, 1.0], 3.62, Verdict::Asymptotic),
        ([5.7, 1.0], 1.5 * 1.425, Verdict::TooFast),
        ([1.2, 1.0], 7.24, Verdict::TooSlow),
        ([-1.2, 1.0], 7.24, Verdict::Swings),
    ] {
        let bar = Rule::VALUE.estimate(cells, d, 100.0);
        assert_eq!(bar.verdict, verdict, "{d:?}");
        assert_relative_eq!(bar.width, width, max_relative = 0.01);
    }
    assert!(!Verdict::Swings.claims() && !Verdict::TooSlow.claims());
    let same = Rule::VALUE.estimate(cells, [1e-8, -1e-8], 100.0);
    assert_eq!(same.verdict, Verdict::Same);
}

#[test]
fn a_difference_that_is_zero_by_chance_is_guarded_by_the_coarse_pair() {
    let bar = Rule::VALUE.estimate([4.0, 2.0, 1.0], [1.0, 0.0], 100.0);
    assert_eq!(bar.verdict, Verdict::TooFast);
    assert_relative_eq!(bar.width, 1.5 * 0.25);
}

#[test]
fn extrapolation_and_cost_follow_the_order() {
    let cells = [0.4, 0.2, 0.1];
    let [a, b, c] = values(cells, 2.0);
    let bar = Rule::VALUE.estimate(cells, [a - b, b - c], 1.0);
    assert_relative_eq!(c + bar.to_limit.unwrap(), 1.0, max_relative = 1e-12);
    // The error is h²: 4e-4 at h = 0.02.
    let h = bar.cell_for(0.1, 4e-4).unwrap();
    assert_relative_eq!(h, 0.02, max_relative = 1e-9);
}

/// A swing on three meshes whose error is an amplitude that falls with an order, of either sign in time.
fn swing(p: f64) -> (Vec<f64>, [Vec<f64>; 3]) {
    let times: Vec<f64> = (0..=100).map(|k| 0.01 * f64::from(k)).collect();
    let of = |h: f64| {
        let error = move |t: f64| h.powf(p) * t * (30.0 * t).cos();
        times.iter().map(|&t| (6.0 * t).sin() + error(t)).collect()
    };
    (times.clone(), [0.4, 0.2, 0.1].map(of))
}

#[test]
fn windows_hold_where_differences_pass_through_zero() {
    let (times, [a, b, c]) = swing(1.0);
    let histories = Histories {
        cells: [0.4, 0.2, 0.1],
        times: &times,
        values: [&a, &b, &c],
    };
    let bars = histories.by_time();
    assert_eq!(bars.len(), times.len());
    for ((bar, t), found) in bars.iter().zip(&times).zip(&c).skip(1) {
        assert_eq!(bar.verdict, Verdict::Asymptotic);
        assert!((found - (6.0 * t).sin()).abs() <= bar.width, "{t}");
    }
    assert!(histories.gate(1.0).passed());
    assert_relative_eq!(histories.gate(1.0).order.unwrap(), 1.0, max_relative = 1e-6);
}

#[test]
fn the_gate_says_until_when_a_history_settles() {
    let times: Vec<f64> = (0..=100).map(|k| 0.01 * f64::from(k)).collect();
    let of = |h: f64| -> Vec<f64> {
        let grows = |t: f64| (t - 0.5).max(0.0) / h;
        times.iter().map(|&t| h * h * t + grows(t)).collect()
    };
    let [a, b, c] = [0.4, 0.2, 0.1].map(of);
    let gate = Histories {
        cells: [0.4, 0.2, 0.1],
        times: &times,
        values: [&a, &b, &c],
    }
    .gate(1.0);
    assert!(!gate.passed());
    let until = gate.until.unwrap();
    assert!((0.5..0.53).contains(&until), "{until}");
}

fn ladder(case: &str, exact: impl Fn(f64) -> f64, value: impl Fn(f64) -> f64) -> Ladder {
    let of = |h: f64| [h, value(h), exact(h)];
    Ladder {
        case: case.to_owned(),
        name: format!("{case}/one"),
        quantity: "u".to_owned(),
        meshes: [0.1, 0.4, 0.2, 0.05].map(of).to_vec(),
    }
}

#[test]
fn triples_are_neighbours_and_what_scales_with_a_cell_is_divided() {
    let plain = triples(&[ladder("new", |_| 2.0, |h| 2.0 + h)]);
    assert_eq!(plain.len(), 2);
    assert_eq!(plain[0].cells, [0.4, 0.2, 0.1]);
    assert_relative_eq!(plain[1].error, 0.05, max_relative = 1e-9);
    let scaled = triples(&[ladder("new", |h| h, |h| h * (1.0 + h))]);
    assert_relative_eq!(scaled[0].values[2], 1.1, max_relative = 1e-9);
    assert!(triples(&[ladder("element", |_| 2.0, |h| 2.0 + h)]).is_empty());
    assert!(triples(&[ladder("new", |_| 2.0, |h| 2.0 + 1e-12 * h)]).is_empty());
}

#[test]
fn a_new_case_joins_and_a_bar_that_is_too_narrow_fails() {
    let good = Calibration::new(&[ladder("new", |_| 2.0, |h| 2.0 + h)]);
    assert!(
        good.gates()
            .iter()
            .any(|gate| gate.name.starts_with("all") && gate.passed())
    );
    // Order 2 on these meshes, and an error that they cannot show.
    let bad = Calibration::new(&[ladder("new", |_| 1.0, |h| 2.0 + h * h)]);
    let coverage = Coverage::of(bad.kept(), Rule::VALUE);
    assert_eq!(coverage.by_case, 0.0);
    assert!(
        bad.gates()
            .iter()
            .any(|gate| gate.name.starts_with("all") && !gate.passed())
    );
    assert_eq!(bad.misses().len(), 2);
}

#[test]
fn no_case_both_tunes_and_judges() {
    assert!(CHOSEN_ON.iter().all(|case| !HELD_OUT.contains(case)));
    for case in CHOSEN_ON.iter().chain(&HELD_OUT) {
        assert!(proctor_verification::case::find(case).is_some(), "{case}");
    }
}
