//! The compacted grains.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::grains_apart::{Polyline, Room, beyond, inside, smallest};
use proctor_verification::cases::{Grains, grain_outlines};

#[test]
fn gates_hold() {
    holds(&Grains::GIVEN);
}

/// The damping carries 7 % of the plate's force at the end of the short run.
#[test]
fn a_wrong_damping_breaks_the_balances() {
    let wrong = Grains {
        reference_damping: 1.5,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 2, "{failing:?}");
    let of = |name: &str| failing.iter().any(|line| line.contains(name));
    assert!(of("momentum that no impulse") && of("plate less floor"));
}

/// Two squares of which one comes nearer, and a room.
#[test]
fn what_lies_in_another_grain_or_beyond_a_side_is_counted() {
    let square = |x: f64, y: f64| {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        corners.map(|[a, b]| [x + a, y + b, 0.0]).to_vec()
    };
    let room = Room {
        x: [0.0, 10.0],
        y: [0.0, 10.0],
    };
    let at = |x, y| vec![square(2.0, 2.0), square(x, y)];
    let all = |grains: &[Polyline]| {
        (
            inside(grains),
            beyond(grains, &room),
            smallest(grains, &room, 0.5),
        )
    };
    let near = |(a, b, c): (usize, usize, f64), (d, e, f): (usize, usize, f64)| {
        assert_eq!((a, b), (d, e));
        assert!((c - f).abs() < 1e-12, "{c} {f}");
    };
    near(all(&at(5.0, 5.0)), (0, 0, 0.5));
    near(all(&at(3.03, 3.04)), (0, 0, 0.05));
    near(all(&at(2.9, 2.8)), (2, 0, -0.1));
    // No deeper than a ten thousandth of a side.
    near(all(&at(2.9999, 2.5)), (2, 0, -1e-4));
    for (x, y) in [(-0.01, 5.0), (9.01, 5.0), (5.0, -0.01), (5.0, 9.01)] {
        near(all(&at(x, y)), (0, 2, -0.01));
    }
    near(all(&at(8.9, 5.0)), (0, 0, 0.1));
}

#[test]
fn some_grains_are_concave_and_all_are_apart() {
    let outlines = grain_outlines(4);
    assert_eq!(outlines.len(), 16);
    let concave = outlines.iter().filter(|outline| {
        let n = outline.len();
        (0..n).any(|k| {
            let [a, b, c] = [outline[k], outline[(k + 1) % n], outline[(k + 2) % n]];
            (b[0] - a[0]) * (c[1] - b[1]) < (b[1] - a[1]) * (c[0] - b[0])
        })
    });
    assert!((4..16).contains(&concave.count()));
    for (k, outline) in outlines.iter().enumerate() {
        let place = [(k % 4) as f64 * 2.5, (k / 4) as f64 * 3.25];
        for point in outline {
            assert!((place[0] + 0.09..place[0] + 2.41).contains(&point[0]));
            assert!((place[1] + 0.22..place[1] + 3.03).contains(&point[1]));
        }
    }
}
