//! Boxes and rectangles.

use crate::bodies::support::{Setting, cases, points, settings};
use proctor_kernel::bodies::HalfLength;
use proctor_scene::{Dimension, Shape, Vector};
use proptest::prelude::*;

fn cuboid(p1: Vector, p2: Vector) -> Shape {
    Shape::Cuboid { p1, p2 }
}

/// (0.4 - 0.1) / 0.1 is 3.0000000000000004: rounded up it is one cell too many.
#[test]
fn a_box_from_0_1_to_0_4_has_three_cells_of_0_1() {
    let setting = Setting::plane(0.1, 6, 2);
    let filled = setting.fill(cuboid([0.1, 0.1, 0.0], [0.4, 0.4, 0.0]));
    let expected: Vec<Vector> = setting
        .centres()
        .into_iter()
        .filter(|x| x[..2].iter().all(|&x| 0.1 < x && x < 0.4))
        .collect();
    assert_eq!(expected.len(), 36);
    assert_eq!(points(&filled), expected);
    assert_eq!(filled.volume[0], filled.exact_volume / 36.0);
    assert!((filled.exact_volume - 0.09).abs() < 1e-16);
    assert_eq!(filled.half_length, HalfLength::Uniform([0.025, 0.025, 0.5]));
}

/// A box that the mesh does not divide has its own lattice: the fewest particles not further apart than h/ppc.
#[test]
fn a_box_between_the_lines_is_divided_by_itself() {
    let setting = Setting::plane(1.0, 4, 2);
    let filled = setting.fill(cuboid([0.3, 1.0, 0.0], [1.4, 1.2, 0.0]));
    // 1.1 m in 3 parts, 0.2 m in one.
    let x: Vec<f64> = vec![0.3 + 1.1 / 6.0, 0.3 + 1.1 / 2.0, 0.3 + 5.5 / 6.0];
    assert_eq!(filled.count(), 3);
    for (p, x) in x.into_iter().enumerate() {
        assert!((filled.x[0][p] - x).abs() < 1e-15);
        assert!((filled.x[1][p] - 1.1).abs() < 1e-15);
    }
    let half = filled.half_length.of(0);
    assert!((half[0] - 1.1 / 6.0).abs() < 1e-15 && (half[1] - 0.1).abs() < 1e-15);
}

/// Between the lines there is nothing to snap to, and 0.43 - 0.13 is still three cells of 0.1.
#[test]
fn a_box_of_whole_cells_between_the_lines_has_no_particle_too_many() {
    for origin in [0.0, -3.7, 1e6] {
        for start in 0..40 {
            let setting = Setting::plane(0.1, 10, 3).at(origin);
            let low = 0.013 + 0.01 * f64::from(start);
            let [p1, p2] = [low, low + 0.3].map(|x| setting.absolute([x, x, 0.0]));
            assert_eq!(
                setting.fill(cuboid(p1, p2)).count(),
                81,
                "from {low} at {origin}"
            );
        }
    }
}

/// Only edges within round-off move: a gap of 1e-6 h is the user's.
#[test]
fn an_edge_is_snapped_by_round_off_only() {
    let setting = Setting::plane(1.0, 4, 1);
    let volume = |gap: f64| {
        setting
            .fill(cuboid([1.0 + gap, 1.0, 0.0], [3.0, 2.0, 0.0]))
            .exact_volume
    };
    assert_eq!(volume(5e-10), 2.0);
    assert!((volume(1e-6) - (2.0 - 1e-6)).abs() < 1e-12);
}

#[test]
fn a_box_thinner_than_a_particle_still_has_one() {
    let setting = Setting::space(0.5, 4, 2);
    let filled = setting.fill(cuboid([0.1, 0.5, 0.5], [0.12, 1.0, 1.0]));
    assert_eq!(filled.count(), 4);
    assert!((filled.half_length.of(0)[0] - 0.01).abs() < 1e-15);
}

/// A box in cells: lower corner and number of cells per axis, within any mesh of `settings`.
fn cell_boxes() -> impl Strategy<Value = ([usize; 3], [usize; 3])> {
    (
        prop::array::uniform3(0..4_usize),
        prop::array::uniform3(1..=2_usize),
    )
}

fn dimensions() -> impl Strategy<Value = Dimension> {
    prop::sample::select(vec![Dimension::Two, Dimension::Three])
}

proptest! {
    #![proptest_config(cases(200))]

    /// Aligned boxes have exactly the sub-cell centres, whatever the origin and the round-off of their edges.
    #[test]
    fn aligned_boxes_are_exact(
        setting in dimensions().prop_flat_map(settings),
        (lower, cells) in cell_boxes(),
        ulps in prop::array::uniform2(-2..=2_i32),
    ) {
        let edge = |axis: usize, line: usize, ulps: i32| {
            let x = setting.origin[axis] + line as f64 * setting.cell[axis];
            x + f64::from(ulps) * f64::EPSILON * x.abs() / 2.0
        };
        let axes = setting.axes();
        let p1 = [0, 1, 2].map(|axis| edge(axis, lower[axis], ulps[0]));
        let p2 = [0, 1, 2].map(|axis| edge(axis, lower[axis] + cells[axis], ulps[1]));
        let filled = setting.fill(cuboid(p1, p2));
        let range = |axis: usize| {
            let first = lower[axis] * setting.ppc[axis];
            first..first + cells[axis] * setting.ppc[axis]
        };
        let mut expected = Vec::new();
        for i in range(0) {
            for j in range(1) {
                let (x, y) = (setting.centre(0, i), setting.centre(1, j));
                if axes == 2 {
                    expected.push([x, y, 0.0]);
                } else {
                    expected.extend(range(2).map(|k| [x, y, setting.centre(2, k)]));
                }
            }
        }
        prop_assert_eq!(points(&filled), expected);
        let volume: f64 = (0..axes).map(|axis| cells[axis] as f64 * setting.cell[axis]).product();
        prop_assert!((filled.exact_volume - volume).abs() < 1e-14 * volume);
    }

    /// Any box: its own lattice, the same at every origin as far as the coordinates of the scene can tell.
    #[test]
    fn boxes_anywhere(
        setting in dimensions().prop_flat_map(settings),
        lower in prop::array::uniform3(0.0..0.5),
        size in prop::array::uniform3(0.01..0.5_f64),
    ) {
        let axes = setting.axes();
        let p2 = [0, 1, 2].map(|axis| lower[axis] + size[axis]);
        let filled = setting.fill(cuboid(setting.absolute(lower), setting.absolute(p2)));
        let at_zero = setting.clone().at(0.0).fill(cuboid(lower, p2));
        prop_assert_eq!(filled.count(), at_zero.count());
        let ulp = 2.0 * f64::EPSILON * setting.origin[0].abs().max(1.0);
        for (a, b) in points(&filled).iter().zip(points(&at_zero)) {
            for axis in 0..axes {
                prop_assert!((a[axis] - b[axis]).abs() <= ulp.max(1e-9 * setting.cell[axis]));
                prop_assert!(lower[axis] - ulp < a[axis] && a[axis] < p2[axis] + ulp);
            }
        }
        let half = filled.half_length.of(0);
        let mut count = 1.0;
        for axis in 0..axes {
            let d = setting.cell[axis] / setting.ppc[axis] as f64;
            prop_assert!(2.0 * half[axis] <= d * (1.0 + 1e-6));
            let n = (size[axis] / (2.0 * half[axis])).round();
            prop_assert!(n == 1.0 || size[axis] / (n - 1.0) > d * (1.0 - 1e-6), "one particle too many");
            count *= n;
        }
        prop_assert_eq!(filled.count() as f64, count);
        let volume: f64 = size[..axes].iter().product();
        prop_assert!((filled.exact_volume - volume).abs() < 1e-6 * volume);
    }
}
