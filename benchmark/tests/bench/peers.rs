//! Other solvers: their last frame against the exact solution and against ours.

use proctor_benchmark::bench::children::{difference, error};
use proctor_benchmark::bench::scenes::Exact;
use proctor_benchmark::frames::Frame;
use std::collections::BTreeMap;

/// Particles that began at these places and moved.
fn frame(moved: &[([f64; 3], [f64; 3])]) -> Frame {
    let mut frame = Frame::default();
    let mut flat = vec![];
    for (x, u) in moved {
        frame
            .points
            .push(std::array::from_fn(|axis| x[axis] + u[axis]));
        flat.extend(u);
    }
    frame.arrays.insert("displacement".into(), (3, flat));
    frame
}

const STARTS: [[f64; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.5], [0.3, 0.2, 0.1]];

#[test]
fn the_error_is_relative_and_uses_where_particles_began() {
    let exact: Exact = Box::new(|x, t| [t * x[0], 0.0, 2.0 * t]);
    let truth = |x: &[f64; 3]| exact(x, 0.5);
    let right: Vec<_> = STARTS.iter().map(|x| (*x, truth(x))).collect();
    assert!(error(&frame(&right), &exact, 0.5).expect("defined") < 1e-15);
    let wrong: Vec<_> = STARTS
        .iter()
        .map(|x| (*x, truth(x).map(|u| 1.01 * u)))
        .collect();
    let found = error(&frame(&wrong), &exact, 0.5).expect("defined");
    assert!((found - 0.01).abs() < 1e-14, "{found}");
}

#[test]
fn particles_are_matched_by_where_they_began_whatever_their_order() {
    let u = |x: &[f64; 3]| [0.1 + x[0], x[1], -x[2]];
    let ours: Vec<_> = STARTS.iter().map(|x| (*x, u(x))).collect();
    let mut theirs: Vec<_> = STARTS
        .iter()
        .map(|x| (*x, u(x).map(|u| 0.98 * u)))
        .collect();
    theirs.reverse();
    let found = difference(&frame(&theirs), &frame(&ours), 0.1, 0.01).expect("comparable");
    assert!((found - 0.02).abs() < 1e-12, "{found}");
}

#[test]
fn what_cannot_be_compared_is_said() {
    let ours = frame(&STARTS.map(|x| (x, [1.0; 3])));
    let fewer = frame(&[(STARTS[0], [1.0; 3])]);
    assert!(
        difference(&fewer, &ours, 0.1, 0.01)
            .expect_err("fewer")
            .contains("1 particles")
    );
    let mut elsewhere = ours.clone();
    elsewhere.points[1][0] += 0.01;
    let reason = difference(&elsewhere, &ours, 0.1, 0.01).expect_err("other places");
    assert!(reason.contains("no particle of the reference"), "{reason}");
    let bare = Frame {
        arrays: BTreeMap::new(),
        ..ours
    };
    let exact: Exact = Box::new(|_, _| [1.0; 3]);
    assert!(
        error(&bare, &exact, 1.0)
            .expect_err("no displacements")
            .contains("Displacement")
    );
}

#[test]
fn frames_of_different_times_are_refused() {
    let at = |time| Frame {
        time,
        ..frame(&STARTS.map(|x| (x, [1.0; 3])))
    };
    let reason = difference(&at(Some(0.11)), &at(Some(0.1)), 0.1, 0.01).expect_err("a step apart");
    for words in ["frames of different times", "0.11 s", "0.1 s"] {
        assert!(reason.contains(words), "{reason}");
    }
    // What is printed with six digits is not another time, and what is not known is not judged.
    for (ours, theirs) in [(Some(0.1), Some(0.100_000_4)), (None, Some(0.2))] {
        assert!(difference(&at(theirs), &at(ours), 0.1, 0.01).expect("comparable") < 1e-15);
    }
}
