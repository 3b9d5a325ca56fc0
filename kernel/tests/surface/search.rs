//! The nearest triangle: the tree against every triangle, and signs against solids whose inside is known.

use proctor_contact::geometry::surface::{Feature, Point, Surface};
use proptest::prelude::*;

/// A sheet of n x n squares over the unit square, cut into triangles, with the given heights at its vertices.
fn sheet(n: usize, heights: &[f64]) -> Surface {
    let x = |i: usize, j: usize| -> Point {
        let at = |i: usize| i as f64 / n as f64;
        [at(i), at(j), heights[i * (n + 1) + j]]
    };
    let mut corners = vec![];
    for i in 0..n {
        for j in 0..n {
            let (a, b, c, d) = (x(i, j), x(i + 1, j), x(i, j + 1), x(i + 1, j + 1));
            corners.extend([[a, b, d], [a, d, c]]);
        }
    }
    Surface::new(&corners).expect("a sheet")
}

/// The surface of a box, its normals outwards.
fn cuboid(size: [f64; 3]) -> Surface {
    let mut corners = vec![];
    for axis in 0..3 {
        for side in 0..2 {
            let x = |u: usize, v: usize| {
                let mut x = [0.0; 3];
                x[axis] = f64::from(side) * size[axis];
                x[(axis + 1) % 3] = u as f64 * size[(axis + 1) % 3];
                x[(axis + 2) % 3] = v as f64 * size[(axis + 2) % 3];
                x
            };
            let quad = if side == 1 {
                [x(0, 0), x(1, 0), x(1, 1), x(0, 1)]
            } else {
                [x(0, 0), x(0, 1), x(1, 1), x(1, 0)]
            };
            corners.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
        }
    }
    Surface::new(&corners).expect("a box")
}

/// Distance to a box, negative inside (Quilez).
fn to_box(x: &Point, size: &[f64; 3]) -> f64 {
    let q: Point = std::array::from_fn(|i| (x[i] - 0.5 * size[i]).abs() - 0.5 * size[i]);
    let outside = q.map(|c| c.max(0.0));
    let length = outside.iter().map(|c| c * c).sum::<f64>().sqrt();
    length + q[0].max(q[1]).max(q[2]).min(0.0)
}

proptest! {
    #![proptest_config(crate::common::cases(64))]

    #[test]
    fn the_tree_finds_what_brute_force_finds(
        heights in prop::collection::vec(-0.3..0.3_f64, 121),
        points in prop::collection::vec(prop::array::uniform3(-0.5..1.5_f64), 50),
        within in 0.01..2.0_f64,
    ) {
        let surface = sheet(10, &heights);
        for x in &points {
            let found = surface.nearest(x, within);
            prop_assert_eq!(found, surface.nearest_of_all(x, within));
            for guess in [0, 77, 199] {
                prop_assert_eq!(found, surface.nearest_from(guess, x, within));
            }
        }
    }

    /// Points at equal distance from many triangles: the same one of them is found.
    #[test]
    fn ties_do_not_depend_on_the_tree(i in 0..=20_usize, j in 0..=20_usize, z in -1..=1_i32) {
        let surface = sheet(10, &[0.0; 121]);
        let x = [i as f64 / 20.0, j as f64 / 20.0, f64::from(z)];
        let found = surface.nearest(&x, 2.0);
        prop_assert_eq!(found, surface.nearest_of_all(&x, 2.0));
        for guess in 0..200 {
            prop_assert_eq!(found, surface.nearest_from(guess, &x, 2.0));
        }
    }

    #[test]
    fn signed_distance_of_a_box(
        size in prop::array::uniform3(0.5..2.0_f64),
        points in prop::collection::vec(prop::array::uniform3(-1.0..3.0_f64), 50),
    ) {
        let surface = cuboid(size);
        for x in &points {
            let found = surface.nearest(x, 10.0).expect("within ten");
            prop_assert!((found.distance - to_box(x, &size)).abs() < 1e-12);
            // The normal is the gradient of the distance, so the point lies on the line along it.
            for axis in 0..3 {
                let foot = x[axis] - found.distance * found.normal[axis];
                prop_assert!((foot - found.point[axis]).abs() < 1e-12);
            }
            prop_assert!(!found.on_rim);
        }
    }
}

/// A thin roof: beyond its ridge the sign of one face alone would be wrong.
#[test]
fn beyond_a_sharp_ridge_the_sign_is_right() {
    let (left, right) = ([-0.1, -1.0], [0.1, -1.0]);
    let at = |[x, z]: [f64; 2], y: f64| [x, y, z];
    let ridge = [0.0, 0.0];
    let quad = |a, b| {
        [
            [at(a, 0.0), at(b, 0.0), at(b, 1.0)],
            [at(a, 0.0), at(b, 1.0), at(a, 1.0)],
        ]
    };
    let corners: Vec<_> = quad(left, ridge)
        .into_iter()
        .chain(quad(ridge, right))
        .collect();
    let surface = Surface::new(&corners).expect("a roof");
    for x in [[0.05, 0.5, 0.01], [-0.05, 0.5, 0.01], [0.0, 0.5, 0.3]] {
        let found = surface.nearest(&x, 1.0).expect("near");
        assert!(found.distance > 0.0, "{x:?}: {found:?}");
    }
    let inside = surface.nearest(&[0.0, 0.5, -0.5], 1.0).expect("near");
    assert!(inside.distance < 0.0);
}

#[test]
fn beside_the_end_of_a_surface() {
    let surface = sheet(2, &[0.0; 9]);
    let over = surface.nearest(&[0.5, 0.4, 0.1], 1.0).expect("near");
    assert!(!over.on_rim);
    assert_eq!(over.normal, [0.0, 0.0, 1.0]);
    let beside = surface.nearest(&[1.1, 0.4, 0.1], 1.0).expect("near");
    assert!(beside.on_rim);
    let corner = surface.nearest(&[1.1, 1.1, 0.1], 1.0).expect("near");
    assert!(corner.on_rim && matches!(corner.feature, Feature::Vertex(_)));
    assert_eq!(surface.nearest(&[0.5, 0.4, 0.1], 0.1), None);
}

#[test]
fn a_point_on_a_vertex_has_the_pseudo_normal() {
    // A pyramid: at its tip the mean of four normals is the axis.
    let (tip, base) = (
        [0.0, 0.0, 1.0],
        [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
        ],
    );
    let corners: Vec<_> = (0..4).map(|i| [base[i], base[(i + 1) % 4], tip]).collect();
    let surface = Surface::new(&corners).expect("a pyramid");
    let found = surface.nearest(&tip, 1.0).expect("on it");
    assert_eq!(found.distance, 0.0);
    for (n, expected) in found.normal.iter().zip([0.0, 0.0, 1.0]) {
        assert!((n - expected).abs() < 1e-15);
    }
}

/// Whatever way the faces are cut, at a corner of a cube each counts by its right angle.
#[test]
fn a_corner_of_a_cube_points_along_its_diagonal() {
    let cube = cuboid([1.0; 3]);
    for corner in 0..8 {
        let x: Point = std::array::from_fn(|axis| f64::from(corner >> axis & 1));
        let found = cube.nearest(&x, 1.0).expect("on it");
        assert_eq!(found.distance, 0.0);
        for (n, x) in found.normal.iter().zip(&x) {
            let expected = (2.0 * x - 1.0) / 3.0_f64.sqrt();
            assert!((n - expected).abs() < 1e-14, "{:?} at {x:?}", found.normal);
        }
    }
}

/// On an edge the normal is the mean of those of its two triangles, and close to it the sign is theirs, whichever edge of the
/// triangle it is.
#[test]
fn each_edge_of_a_triangle_has_its_own_normal() {
    let [a, b, c, d]: [Point; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.2, 0.9, 0.0], [0.3, 0.2, 0.8]];
    let faces = [[a, c, b], [a, b, d], [b, c, d], [c, a, d]];
    let normal_of = |[a, b, c]: [Point; 3]| -> Point {
        let [u, v]: [Point; 2] = [b, c].map(|p| std::array::from_fn(|i| p[i] - a[i]));
        unit([
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ])
    };
    let mut seen = [false; 3];
    // Each face as the first one, of which the others share an edge, and turned so that each edge is each of its three.
    for first in 0..4 {
        for turn in 0..3 {
            let mut corners: Vec<[Point; 3]> = faces.to_vec();
            corners.swap(0, first);
            corners[0].rotate_left(turn);
            let surface = Surface::new(&corners).expect("a tetrahedron");
            for edge in 0..3 {
                let (p, q) = (corners[0][edge], corners[0][(edge + 1) % 3]);
                let other = corners[1..]
                    .iter()
                    .find(|f| f.contains(&p) && f.contains(&q));
                let (m, n) = (
                    normal_of(corners[0]),
                    normal_of(*other.expect("a neighbour")),
                );
                let mean = unit(std::array::from_fn(|i| m[i] + n[i]));
                let middle: Point = std::array::from_fn(|i| 0.5 * (p[i] + q[i]));
                let on = surface.nearest(&middle, 1.0).expect("near");
                // Either of both triangles is as near.
                let Feature::Edge(found) = on.feature else {
                    panic!("{:?} instead of an edge", on.feature);
                };
                let ends = [0, 1].map(|k| corners[on.triangle][(found + k) % 3]);
                assert!(ends == [p, q] || ends == [q, p], "{first} {turn} {edge}");
                seen[found] = true;
                for i in 0..3 {
                    assert!(
                        (on.normal[i] - mean[i]).abs() < 1e-14,
                        "{first} {turn} {edge}"
                    );
                }
                let outside = std::array::from_fn(|i| middle[i] + 1e-3 * mean[i]);
                let found = surface.nearest(&outside, 1.0).expect("near");
                assert!(
                    (found.distance - 1e-3).abs() < 1e-15,
                    "{first} {turn} {edge}"
                );
            }
        }
    }
}

fn unit(v: Point) -> Point {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}
