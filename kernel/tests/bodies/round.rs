//! Spheres, discs, rings and cylinders.

use crate::bodies::support::{Setting, cases, image, origins, settings};
use proctor_scene::{Dimension, Shape, Vector};
use proptest::prelude::*;
use std::f64::consts::PI;

fn ball(center: Vector, radius: f64) -> Shape {
    Shape::Sphere { center, radius }
}

fn cylinder(p1: Vector, p2: Vector, radius: f64) -> Shape {
    Shape::Cylinder { p1, p2, radius }
}

fn distance(a: Vector, b: Vector) -> f64 {
    [0, 1, 2]
        .map(|axis| (a[axis] - b[axis]).powi(2))
        .iter()
        .sum::<f64>()
        .sqrt()
}

/// Depth of `x` below the surface of a cylinder \[m\].
fn cylinder_depth(x: Vector, p1: Vector, p2: Vector, radius: f64) -> f64 {
    let length = distance(p1, p2);
    let s: f64 = (0..3)
        .map(|axis| (x[axis] - p1[axis]) * (p2[axis] - p1[axis]) / length)
        .sum();
    let foot = [0, 1, 2].map(|axis| p1[axis] + s * (p2[axis] - p1[axis]) / length);
    s.min(length - s).min(radius - distance(x, foot))
}

#[test]
fn a_disc_counted_by_hand() {
    // Radius 2 about a node: of the four centres at (1/2, 3/2)² per quadrant only (3/2, 3/2) is outside.
    let filled = Setting::plane(1.0, 6, 1).fill(ball([3.0, 3.0, 0.0], 2.0));
    assert_eq!(filled.count(), 12);
    assert!((filled.exact_volume - 4.0 * PI).abs() < 1e-14);
    // Radius sqrt(1/2) exactly through four centres: those on the surface are outside, all of them.
    let error = Setting::plane(1.0, 6, 1).try_fill(ball([3.0, 3.0, 0.0], 0.5_f64.sqrt()));
    assert!(error.is_err(), "{error:?}");
}

/// Ties on the surface (3-4-5 triangles about a centre) must not depend on round-off.
#[test]
fn symmetric_shapes_have_symmetric_particles() {
    for origin in [0.0, -3.7, 1e6] {
        for middle in [1.0, 1.05, 0.95] {
            let setting = Setting::plane(0.1, 20, 1).at(origin);
            let center = setting.absolute([middle, middle, 0.0]);
            let ring = Shape::Ring {
                center,
                inner: 0.25,
                outer: 0.5,
            };
            for shape in [ball(center, 0.5), ring] {
                let filled = setting.fill(shape);
                let same = image(&filled, |x| x);
                assert_eq!(same, image(&filled, |x| [2.0 * middle - x[0], x[1], 0.0]));
                assert_eq!(same, image(&filled, |x| [x[1], x[0], 0.0]));
            }
            let setting = Setting::space(0.1, 20, 1).at(origin);
            let sphere = setting.fill(ball(setting.absolute([middle; 3]), 0.5));
            let same = image(&sphere, |x| x);
            assert_eq!(same, image(&sphere, |x| x.map(|x| 2.0 * middle - x)));
            assert_eq!(same, image(&sphere, |x| [x[1], x[2], x[0]]));
            assert_eq!(same, image(&sphere, |x| [x[1], x[0], x[2]]));
        }
    }
}

/// Along an axis a cylinder is its disc, layer by layer, and the three directions are one body turned.
#[test]
fn cylinders_along_the_axes_are_stacked_discs() {
    let disc = Setting::plane(0.1, 12, 2)
        .fill(ball([0.6, 0.57, 0.0], 0.43))
        .count();
    let along = |axis: usize| {
        let turn = |[a, b, c]: Vector| {
            let mut x = [0.0; 3];
            (x[(axis + 1) % 3], x[(axis + 2) % 3], x[axis]) = (a, b, c);
            x
        };
        let shape = cylinder(turn([0.6, 0.57, 0.2]), turn([0.6, 0.57, 0.9]), 0.43);
        let filled = Setting::space(0.1, 12, 2).fill(shape);
        assert_eq!(filled.count(), 14 * disc);
        assert!((filled.exact_volume - PI * 0.43 * 0.43 * 0.7).abs() < 1e-14);
        image(&filled, |x| [x[(axis + 1) % 3], x[(axis + 2) % 3], x[axis]])
    };
    assert_eq!(along(0), along(2));
    assert_eq!(along(1), along(2));
}

/// A cylinder along a diagonal, with centres on its end faces; turned about it end for end it is the same body.
#[test]
fn a_diagonal_cylinder_is_the_same_from_either_end() {
    let setting = Setting::space(0.1, 20, 1).at(-3.7);
    let [a, b] = [0.55, 1.45].map(|x| setting.absolute([x; 3]));
    let there = setting.fill(cylinder(a, b, 0.3));
    assert_eq!(
        image(&there, |x| x),
        image(&setting.fill(cylinder(b, a, 0.3)), |x| x)
    );
    assert_eq!(image(&there, |x| x), image(&there, |x| x.map(|x| 2.0 - x)));
    assert_eq!(image(&there, |x| x), image(&there, |x| [x[2], x[0], x[1]]));
}

/// Tilted so little that the search along z nearly follows the axis, with a face and a side just cut.
#[test]
fn nearly_upright_cylinders_lose_no_particle() {
    for tilt in [1e-14, 1e-10, 1e-6, 1e-3] {
        let setting = Setting::space(0.1, 12, 3);
        for turned in [false, true] {
            let swap = |x: Vector| if turned { [x[2], x[1], x[0]] } else { x };
            let (p1, p2) = (swap([0.6, 0.6, 0.11]), swap([0.6 + tilt, 0.6, 1.09]));
            setting.fill_as_searched(cylinder(p1, p2, 0.333), |x| {
                cylinder_depth(x, p1, p2, 0.333)
            });
        }
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn discs_and_rings(
        setting in settings(Dimension::Two),
        center in prop::array::uniform2(0.45..0.55),
        inner in 0.0..0.25_f64,
        width in 0.15..0.19_f64,
    ) {
        let c = [center[0], center[1], 0.0];
        let outer = inner.max(0.05) + width;
        let center = setting.absolute(c);
        setting.fill_as_searched(ball(center, outer), |x| outer - distance(x, c));
        // Narrow rings on coarse meshes may miss every centre, which is an error and tested as such.
        let depth = |x| (outer - distance(x, c)).min(distance(x, c) - inner);
        prop_assume!(setting.centres().into_iter().any(|x| depth(x) > 0.0));
        let ring = setting.fill_as_searched(Shape::Ring { center, inner, outer }, depth);
        let area = PI * (outer * outer - inner * inner);
        prop_assert!((ring.exact_volume - area).abs() < 1e-14);
    }

    #[test]
    fn spheres(
        setting in settings(Dimension::Three),
        c in prop::array::uniform3(0.4..0.6),
        radius in 0.2..0.39_f64,
    ) {
        let shape = ball(setting.absolute(c), radius);
        let sphere = setting.fill_as_searched(shape, |x| radius - distance(x, c));
        prop_assert!((sphere.exact_volume - 4.0 / 3.0 * PI * radius.powi(3)).abs() < 1e-15);
    }

    #[test]
    fn oblique_cylinders(
        setting in settings(Dimension::Three),
        p1 in prop::array::uniform3(0.3..0.7),
        p2 in prop::array::uniform3(0.3..0.7),
        radius in 0.1..0.29,
    ) {
        prop_assume!(distance(p1, p2) > 0.2);
        let depth = |x| cylinder_depth(x, p1, p2, radius);
        prop_assume!(setting.centres().into_iter().any(|x| depth(x) > 0.0));
        let shape = cylinder(setting.absolute(p1), setting.absolute(p2), radius);
        let filled = setting.fill_as_searched(shape, depth);
        let volume = PI * radius * radius * distance(p1, p2);
        prop_assert!((filled.exact_volume - volume).abs() < 1e-8 * volume);
    }

    /// Aligned with the mesh, so that edges and ties abound: every origin gives the same bits.
    #[test]
    fn origin_does_not_matter(origin in origins(), half_cells in 3..12_usize) {
        let radius = 0.05 * half_cells as f64;
        let fill = |origin: f64| {
            let setting = Setting::plane(0.1, 20, 2).at(origin);
            setting.fill(ball(setting.absolute([1.0, 1.0, 0.0]), radius)).x
        };
        prop_assert_eq!(fill(origin), fill(0.0));
    }
}
