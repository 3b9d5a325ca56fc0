//! Overlaps of triangles and quadrature on them, against formulas.

use crate::common::cases;
use proctor_contact::geometry::mortar::space::clip::{GAUSS, PlanePoint, area, overlap, shares};
use proptest::prelude::*;

fn flat(x: f64, y: f64) -> PlanePoint {
    PlanePoint::new(x, y)
}

const UNIT: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

fn unit() -> [PlanePoint; 3] {
    UNIT.map(PlanePoint::from)
}

/// Two triangles that make a star: the hexagon in the middle has two thirds of either area.
#[test]
fn the_overlap_of_a_star_is_a_hexagon() {
    let corner = |turns: f64| {
        let (sin, cos) = (std::f64::consts::TAU * turns).sin_cos();
        flat(cos, sin)
    };
    let one = [0.0, 1.0, 2.0].map(|k| corner(k / 3.0));
    let other = [0.5, 1.5, 2.5].map(|k| corner(k / 3.0));
    let hexagon = overlap(&one, &other);
    assert_eq!(hexagon.corners().len(), 6);
    assert!((hexagon.area() - area(&one) * 2.0 / 3.0).abs() < 1e-15);
}

#[test]
fn special_positions() {
    let t = unit();
    let shifted = |x: f64, y: f64| t.map(|p| p + flat(x, y));
    assert!((overlap(&t, &t).area() - 0.5).abs() < 1e-16);
    // A right triangle with legs 1 - s is left of one that is shifted by s in all along its legs.
    for s in [0.25, 0.5, 0.999] {
        assert!((overlap(&t, &shifted(s, 0.0)).area() - 0.5 * (1.0 - s) * (1.0 - s)).abs() < 1e-15);
    }
    for (x, y) in [(1.0, 0.0), (2.0, 0.0), (-1.0, 0.0), (0.5, 0.5)] {
        assert!(overlap(&t, &shifted(x, y)).area().abs() < 1e-16);
    }
    // Inside, in both orders.
    let small = t.map(|p| p * 0.25 + flat(0.2, 0.2));
    assert!((overlap(&t, &small).area() - 0.5 / 16.0).abs() < 1e-16);
    assert!((overlap(&small, &t).area() - 0.5 / 16.0).abs() < 1e-16);
}

/// Integral of x^i y^j over the unit triangle: i! j! / (i + j + 2)!.
#[test]
fn quadrature_is_exact_for_squares() {
    let exact = [
        [0.5, 1.0 / 6.0, 1.0 / 12.0],
        [1.0 / 6.0, 1.0 / 24.0, 0.0],
        [1.0 / 12.0, 0.0, 0.0],
    ];
    let t = unit();
    let integral = |i: i32, j: i32| -> f64 {
        GAUSS
            .iter()
            .map(|[u, v, w]| {
                let p = t[0] * *u + t[1] * *v + t[2] * *w;
                area(&t) / 3.0 * p.x.powi(i) * p.y.powi(j)
            })
            .sum()
    };
    for (i, j) in [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)] {
        assert!(
            (integral(i, j) - exact[i as usize][j as usize]).abs() < 1e-16,
            "{i} {j}"
        );
    }
    // Cubes are beyond it: 1/20.
    assert!((integral(3, 0) - 0.05).abs() > 1e-4);
}

fn triangle() -> impl Strategy<Value = [PlanePoint; 3]> {
    (prop::array::uniform3(prop::array::uniform2(-1.0..1.0_f64)))
        .prop_map(|t| {
            let t = t.map(PlanePoint::from);
            if area(&t) < 0.0 {
                [t[0], t[2], t[1]]
            } else {
                t
            }
        })
        .prop_filter("has an area", |t| area(t) > 1e-3)
}

proptest! {
    #![proptest_config(cases(256))]

    /// The overlap is the same from both sides, inside both, and what the four children of a triangle have in common with
    /// another adds up to what the triangle has.
    #[test]
    fn overlaps_add_up(a in triangle(), b in triangle()) {
        let whole = overlap(&a, &b);
        prop_assert!((whole.area() - overlap(&b, &a).area()).abs() < 1e-14);
        prop_assert!(whole.corners().len() <= 6);
        for p in whole.corners() {
            for t in [&a, &b] {
                prop_assert!(shares(p, t).iter().all(|s| *s > -1e-11), "{p} {:?}", shares(p, t));
            }
        }
        let mid = |i: usize, j: usize| 0.5 * (a[i] + a[j]);
        let children = [
            [a[0], mid(0, 1), mid(2, 0)],
            [mid(0, 1), a[1], mid(1, 2)],
            [mid(2, 0), mid(1, 2), a[2]],
            [mid(0, 1), mid(1, 2), mid(2, 0)],
        ];
        let sum: f64 = children.iter().map(|c| overlap(c, &b).area()).sum();
        prop_assert!((sum - whole.area()).abs() < 1e-14);
        let fan: f64 = whole.fan().map(|t| area(&t)).sum();
        prop_assert!((fan - whole.area()).abs() < 1e-15);
    }

    #[test]
    fn shares_give_the_point_back(t in triangle(), x in -1.0..1.0_f64, y in -1.0..1.0_f64) {
        let p = flat(x, y);
        let s = shares(&p, &t);
        prop_assert!((s.iter().sum::<f64>() - 1.0).abs() < 1e-12 / area(&t));
        let back = t[0] * s[0] + t[1] * s[1] + t[2] * s[2];
        prop_assert!((back - p).norm() < 1e-12 / area(&t));
    }
}
