//! Triangles that fill polygons.

use nalgebra::Vector2;
use proctor_contact::geometry::mortar::space::refine::fill;

type PlanePoint = Vector2<f64>;

fn area(points: &[PlanePoint], triangles: &[[usize; 3]]) -> f64 {
    triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| points[v]);
            let twice = (b - a).perp(&(c - a));
            assert!(twice > 0.0, "{t:?} has no area or is turned");
            0.5 * twice
        })
        .sum()
}

/// A square with many vertices on straight edges: no triangle without an area, all of it covered, none too large, and
/// its edges as they were.
#[test]
fn a_square_with_vertices_on_its_edges() {
    let n = 8;
    let side = |from: [f64; 2], to: [f64; 2]| {
        (0..n).map(move |k| {
            let s = f64::from(k) / f64::from(n);
            PlanePoint::from(from) * (1.0 - s) + PlanePoint::from(to) * s
        })
    };
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let outline: Vec<PlanePoint> = (0..4)
        .flat_map(|k| side(corners[k], corners[(k + 1) % 4]))
        .collect();
    let (points, triangles) = fill(&outline, 0.125);
    assert_eq!(points[..outline.len()], outline);
    assert!((area(&points, &triangles) - 1.0).abs() < 1e-14);
    for t in &triangles {
        for k in 0..3 {
            let length = (points[t[k]] - points[t[(k + 1) % 3]]).norm();
            assert!(length <= 0.125 * (1.0 + 1e-8), "{length}");
        }
    }
    // Euler's formula for a disc: no vertex hangs on an edge.
    let twice_edges = 3 * triangles.len() + outline.len();
    assert_eq!(2 * (points.len() + triangles.len()), twice_edges + 2);
}

#[test]
fn a_star_is_filled() {
    let star: Vec<PlanePoint> = (0..14)
        .map(|k| {
            let r = if k % 2 == 0 { 1.0 } else { 0.3 };
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 14.0).sin_cos();
            PlanePoint::new(r * cos, r * sin)
        })
        .collect();
    let exact = 7.0 * 0.3 * (std::f64::consts::PI / 7.0).sin();
    for parts in [1, 6] {
        let fine: Vec<PlanePoint> = (0..14 * parts)
            .map(|k| {
                let share = (k % parts) as f64 / parts as f64;
                star[k / parts] * (1.0 - share) + star[(k / parts + 1) % 14] * share
            })
            .collect();
        // Smaller than the edges of the outline: these count.
        let (points, triangles) = fill(&fine, 0.01);
        assert!((area(&points, &triangles) - exact).abs() < 1e-14);
    }
}
