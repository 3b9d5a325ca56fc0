//! Tensors that turn with a body.

use approx::assert_relative_eq;
use proctor_verification::exact::turned::{invariants, length, rotation, turn, turned};

const STRESS: [f64; 6] = [3.0, -2.0, 0.5, 0.3, -0.7, 1.1];
const ANGLES: [f64; 4] = [0.1, 1.0, 2.5, 6.0];

/// An axis that is none of the coordinates.
fn skew() -> [f64; 3] {
    [1.0, 2.0, -2.0].map(|x: f64| x / 3.0)
}

/// A rotation keeps its axis and lengths, and turns back by its transpose.
#[test]
fn a_rotation_is_one() {
    for angle in ANGLES {
        let (axis, r) = (skew(), rotation(skew(), angle));
        for i in 0..3 {
            let kept: f64 = (0..3).map(|j| r[i][j] * axis[j]).sum();
            assert_relative_eq!(kept, axis[i], epsilon = 1e-15);
            for j in 0..3 {
                let dot: f64 = (0..3).map(|k| r[k][i] * r[k][j]).sum();
                assert_relative_eq!(dot, f64::from(i == j), epsilon = 1e-15);
            }
        }
        assert_relative_eq!(
            r[0][0] + r[1][1] + r[2][2],
            1.0 + 2.0 * angle.cos(),
            epsilon = 1e-14
        );
    }
}

/// In the plane a tensor turns on Mohr's circle by twice the angle.
#[test]
fn in_the_plane_it_turns_on_mohrs_circle() {
    for angle in ANGLES {
        let s = turned(
            [3.0, -2.0, 0.5, 0.0, 0.0, 1.1],
            &rotation([0.0, 0.0, 1.0], angle),
        );
        let (sin, cos) = (2.0 * angle).sin_cos();
        assert_relative_eq!(s[0], 0.5 + 2.5 * cos - 1.1 * sin, epsilon = 1e-14);
        assert_relative_eq!(s[1], 0.5 - 2.5 * cos + 1.1 * sin, epsilon = 1e-14);
        assert_relative_eq!(s[5], 2.5 * sin + 1.1 * cos, epsilon = 1e-14);
        assert_relative_eq!(s[2], 0.5, epsilon = 1e-15);
    }
}

/// Turns add up, and invariants are those of the principal values.
#[test]
fn turns_add_up_and_keep_invariants() {
    let axis = skew();
    let twice = turned(turned(STRESS, &rotation(axis, 0.4)), &rotation(axis, 0.9));
    let once = turned(STRESS, &rotation(axis, 1.3));
    for (a, b) in twice.iter().zip(once) {
        assert_relative_eq!(*a, b, epsilon = 1e-14);
    }
    let [given, after] = [STRESS, once].map(invariants);
    for (a, b) in given.iter().zip(after) {
        assert_relative_eq!(*a, b, epsilon = 1e-13);
    }
    let of_principal = invariants([2.0, -1.0, 5.0, 0.0, 0.0, 0.0]);
    assert_relative_eq!(of_principal[0], 6.0);
    assert_relative_eq!(of_principal[1], 18.0_f64.sqrt(), epsilon = 1e-15);
    // Deviator 0, -3, 3.
    assert_relative_eq!(of_principal[2], 0.0);
    assert_relative_eq!(length([1.0, 2.0, 2.0, 0.0, 0.0, 0.0]), 3.0);
}

/// The change by a small turn keeps its digits: a - a³/6 beside the diagonal, and -a²/2 + a⁴/24 on it.
#[test]
fn a_small_turn_keeps_its_digits() {
    let a = 1e-6;
    let small = turn([0.0, 0.0, 1.0], a);
    assert_relative_eq!(small[1][0], a - a * a * a / 6.0, max_relative = 1e-15);
    assert_relative_eq!(small[0][0], -0.5 * a * a, max_relative = 1e-12);
    assert_eq!(small[2], [0.0; 3]);
}
