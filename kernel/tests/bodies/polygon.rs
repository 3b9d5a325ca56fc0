//! Polygons, flat and extruded.

use crate::bodies::support::{Setting, cases, image, points, settings};
use proctor_scene::{Dimension, Shape, Vector};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn polygon(setting: &Setting, corners: &[[f64; 2]]) -> Shape {
    let points = corners
        .iter()
        .map(|&[x, y]| setting.absolute([x, y, 0.0]))
        .collect();
    Shape::Polygon { points }
}

/// Positive inside, by the winding number: another method than the one under test.
fn winding_depth(x: Vector, corners: &[[f64; 2]]) -> f64 {
    let mut angle = 0.0;
    for (corner, a) in corners.iter().enumerate() {
        let b = corners[(corner + 1) % corners.len()];
        let (u, v) = ([a[0] - x[0], a[1] - x[1]], [b[0] - x[0], b[1] - x[1]]);
        angle += (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]);
    }
    (angle / TAU).abs() - 0.5
}

/// The hypotenuse runs through n centres: they are on the surface, and belong to neither triangle.
#[test]
fn two_triangles_share_no_particle_of_their_common_edge() {
    for origin in [0.0, -3.7, 1e6] {
        let setting = Setting::plane(0.1, 12, 2).at(origin);
        let n = 20;
        let lower = setting.fill(polygon(&setting, &[[0.1, 0.1], [1.1, 0.1], [0.1, 1.1]]));
        let upper = setting.fill(polygon(&setting, &[[1.1, 1.1], [1.1, 0.1], [0.1, 1.1]]));
        assert_eq!(lower.count(), n * (n - 1) / 2);
        assert_eq!(
            image(&lower, |x| x),
            image(&upper, |x| [1.2 - x[0], 1.2 - x[1], 0.0])
        );
        assert!((lower.exact_volume - 0.5).abs() < 1e-9);
    }
}

/// All four sides of a diamond run through centres, and rows of centres through its corners: exactly so with
/// cells of 1 m, within round-off with cells of 0.1 m.
#[test]
fn a_diamond_is_symmetric() {
    for (h, origin) in [(1.0, 0.0), (0.1, -3.7), (0.1, 1e6)] {
        // |i| + |j| <= 6 about a centre, and |i + 1/2| + |j + 1/2| <= 6 about a node.
        for (middle, count) in [(10.5 * h, 2 * 6 * 7 + 1), (10.0 * h, 2 * 6 * 7)] {
            let setting = Setting::plane(h, 20, 1).at(origin);
            let [low, high] = [middle - 7.0 * h, middle + 7.0 * h];
            let corners = [[low, middle], [middle, high], [high, middle], [middle, low]];
            let filled = setting.fill(polygon(&setting, &corners));
            assert_eq!(filled.count(), count);
            let same = image(&filled, |x| x);
            assert_eq!(same, image(&filled, |x| [2.0 * middle - x[0], x[1], 0.0]));
            assert_eq!(same, image(&filled, |x| [x[1], x[0], 0.0]));
        }
    }
}

/// Corners, edges and the tips of notches on rows of centres: the half-open rule alone would take the left
/// and the lower edge and leave the others.
#[test]
fn edges_and_tips_on_centres_are_outside() {
    let setting = Setting::plane(1.0, 10, 1);
    // From centre to centre, with a notch from the right and one from the left that end on centres.
    let corners = [
        [0.5, 0.5],
        [8.5, 0.5],
        [8.5, 2.5],
        [5.5, 4.5],
        [8.5, 6.5],
        [8.5, 8.5],
        [0.5, 8.5],
        [3.5, 4.5],
    ];
    let filled = setting.fill(polygon(&setting, &corners));
    let taken = points(&filled);
    assert_eq!(
        image(&filled, |x| x),
        image(&filled, |x| [x[0], 9.0 - x[1], 0.0])
    );
    for on_edge in [
        [0.5, 3.5],
        [4.5, 0.5],
        [4.5, 8.5],
        [8.5, 1.5],
        [5.5, 4.5],
        [3.5, 4.5],
    ] {
        assert!(
            !taken.contains(&[on_edge[0], on_edge[1], 0.0]),
            "{on_edge:?}"
        );
    }
    // Row by row from the bottom, by hand: 7 in the rows below both notches, then fewer.
    let row = |y: f64| taken.iter().filter(|x| x[1] == y).count();
    assert_eq!([1.5, 2.5, 3.5, 4.5].map(row), [7, 6, 4, 1]);
}

#[test]
fn an_l_shape_either_way_round() {
    let setting = Setting::plane(0.1, 10, 3).at(1e6);
    let mut corners = [
        [0.1, 0.1],
        [0.8, 0.1],
        [0.8, 0.3],
        [0.4, 0.3],
        [0.4, 0.9],
        [0.1, 0.9],
    ];
    let filled = setting.fill(polygon(&setting, &corners));
    assert_eq!(filled.count(), (7 * 2 + 3 * 6) * 9);
    assert!((filled.exact_volume - 0.32).abs() < 1e-9);
    corners.reverse();
    assert_eq!(setting.fill(polygon(&setting, &corners)).x, filled.x);
}

/// The same rectangle as polygon, extruded along each axis, and as box.
#[test]
fn an_extruded_rectangle_is_a_box() {
    for origin in [0.0, -3.7, 1e6] {
        let setting = Setting {
            cell: [0.1, 0.2, 0.25],
            ppc: [2, 3, 1],
            ..Setting::space(0.1, 8, 1)
        }
        .at(origin);
        let (p1, p2) = (
            setting.absolute([0.2, 0.4, 0.5]),
            setting.absolute([0.6, 1.4, 1.75]),
        );
        let cuboid = setting.fill(Shape::Cuboid { p1, p2 });
        assert_eq!(cuboid.count(), (4 * 2) * (5 * 3) * 5);
        for (axis, [a, b]) in [[1, 2], [0, 2], [0, 1]].into_iter().enumerate() {
            let points = vec![
                [p1[a], p1[b]],
                [p2[a], p1[b]],
                [p2[a], p2[b]],
                [p1[a], p2[b]],
            ];
            let range = [p1[axis], p2[axis]];
            let extruded = setting.fill(Shape::ExtrudedPolygon {
                points,
                axis,
                range,
            });
            assert_eq!(extruded.x, cuboid.x);
            assert!((extruded.exact_volume - 0.5).abs() < 1e-9);
        }
    }
}

/// Stars: radii at increasing angles, simple and in general not convex.
fn stars() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(0.1..0.45_f64, 5..30).prop_map(|radii| {
        let n = radii.len() as f64;
        let corner = |(k, r): (usize, f64)| {
            let angle = TAU * (k as f64 + 0.3) / n;
            [0.5 + r * angle.cos(), 0.5 + r * angle.sin()]
        };
        radii.into_iter().enumerate().map(corner).collect()
    })
}

/// Shoelace formula \[m²\].
fn shoelace(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    0.5 * corners
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum::<f64>()
        .abs()
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn stars_as_by_winding_number(setting in settings(Dimension::Two), corners in stars()) {
        prop_assume!(setting.centres().into_iter().any(|x| winding_depth(x, &corners) > 0.0));
        let filled =
            setting.fill_as_searched(polygon(&setting, &corners), |x| winding_depth(x, &corners));
        prop_assert!((filled.exact_volume - shoelace(&corners)).abs() < 1e-8);
    }

    #[test]
    fn extruded_stars(
        setting in settings(Dimension::Three),
        corners in stars(),
        axis in 0..3_usize,
        range in prop::array::uniform2(0.05..0.45_f64),
    ) {
        let range = [range[0], 0.5 + range[1]];
        let plane = [[1, 2], [0, 2], [0, 1]][axis];
        let depth = |x: Vector| {
            let along = (x[axis] - range[0]).min(range[1] - x[axis]);
            winding_depth([x[plane[0]], x[plane[1]], 0.0], &corners).min(along)
        };
        prop_assume!(setting.centres().into_iter().any(|x| depth(x) > 0.0));
        let o = setting.origin;
        let shape = Shape::ExtrudedPolygon {
            points: corners.iter().map(|&[a, b]| [o[plane[0]] + a, o[plane[1]] + b]).collect(),
            axis,
            range: range.map(|x| o[axis] + x),
        };
        let filled = setting.fill_as_searched(shape, depth);
        let volume = shoelace(&corners) * (range[1] - range[0]);
        prop_assert!((filled.exact_volume - volume).abs() < 1e-8);
    }
}
