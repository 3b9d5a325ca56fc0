//! Histories in time: their integrals.

use proctor_scene::History;
use proctor_scene::simulation::{Displacement, history_value};

/// A velocity with some rows, of which the first lies before, at or after time zero.
fn swinging(rows: usize, begin: f64) -> History {
    let times = (0..rows).map(|row| begin + 0.013 * row as f64 + 0.002 * (row % 3) as f64);
    let times: Vec<f64> = times.collect();
    let value = |t: &f64| [(7.0 * t).sin() + 0.3, t * t - 0.1, 0.25];
    History {
        values: times.iter().map(value).collect(),
        times,
    }
}

/// The integral by a walk over all rows, from the first to the last.
fn by_all_rows(history: &History, time: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let mut from = (0.0, history_value(history, 0.0));
    let inner = history
        .times
        .iter()
        .copied()
        .filter(|t| (0.0..time).contains(t));
    for t in inner.chain(std::iter::once(time)) {
        let to = (t, history_value(history, t));
        for axis in 0..3 {
            sum[axis] += 0.5 * (from.1[axis] + to.1[axis]) * (to.0 - from.0);
        }
        from = to;
    }
    sum
}

/// Integrals that are summed once give the bits of a walk over all rows: between rows, on them, before and after them.
#[test]
fn a_displacement_is_the_integral_of_its_velocity() {
    for rows in [1, 2, 3, 41, 401] {
        for begin in [-0.2, 0.0, 0.05] {
            let history = swinging(rows, begin);
            let way = Displacement::new(&history);
            let steps = (0..500).map(|step| 0.0137 * f64::from(step));
            let on_rows = history.times.iter().copied().filter(|t| *t >= 0.0);
            for time in steps.chain(on_rows) {
                let exact = by_all_rows(&history, time);
                assert_eq!(
                    way.at(time),
                    exact,
                    "{rows} rows from {begin} s, at {time} s"
                );
            }
        }
    }
}

/// A ramp from 1 m/s at 1 s to 3 m/s at 2 s: 1 m, then 1 t + t² in the ramp, then 3 m/s.
#[test]
fn a_ramp_has_its_closed_form() {
    let way = Displacement::new(&History {
        times: vec![1.0, 2.0],
        values: vec![[1.0, 0.0, -1.0], [3.0, 0.0, -3.0]],
    });
    for (time, exact) in [(0.5, 0.5), (1.0, 1.0), (1.5, 1.75), (2.0, 3.0), (4.0, 9.0)] {
        assert_eq!(way.at(time), [exact, 0.0, -exact]);
    }
    assert_eq!(way.mean_velocity(1.0, 1.0), [2.0, 0.0, -2.0]);
}
