//! The compacted grains.

use super::{failing, holds, solve};
use proctor_verification::case::{Case, Size};
use proctor_verification::cases::{Grains, grain_outlines};

#[test]
fn gates_hold() {
    holds(&Grains::GIVEN);
}

#[test]
fn a_wrong_damping_breaks_the_balances() {
    let wrong = Grains {
        reference_damping: 2.0,
    };
    let verdict = wrong.judge(Size::Quick, &solve(&wrong));
    let failing = failing(&verdict);
    assert_eq!(failing.len(), 2, "{failing:?}");
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
