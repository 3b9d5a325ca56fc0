//! Boundaries, and lists of vertices that are none; normals and areas.

use crate::mortar::support::{chain, moved, open, point};
use proctor_contact::geometry::mortar::boundary::{Boundary, BoundaryError, BoundarySide};

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn reversed(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().rev().copied().collect()
}

fn error(points: &[[f64; 2]], side: BoundarySide) -> BoundaryError {
    Boundary::new(&[chain(points, side)]).expect_err("is not a boundary")
}

#[test]
fn normals_point_out_of_the_material() {
    let square = Boundary::new(&[chain(&SQUARE, BoundarySide::Outer)]).expect("sound");
    for s in 0..4 {
        let [a, b] = square.segments()[s];
        let middle = 0.5 * (square.points[a] + square.points[b]);
        assert!(square.segment_normal(s).dot(&(middle - point(0.5, 0.5))) > 0.49);
    }
    // Weighted by length: the mean of (0, -3) and (1, -4).
    let bend = open(&[[-3.0, 0.0], [0.0, 0.0], [4.0, 1.0]]);
    assert!((bend.normals()[1] - point(1.0, -7.0).normalize()).norm() < 1e-15);
    // Ends have the normal of their only segment.
    assert!((bend.normals()[0] - point(0.0, -1.0)).norm() < 1e-15);
    assert_eq!(bend.around(0), [None, Some(0)]);
    assert_eq!(bend.around(1), [Some(0), Some(1)]);
    // The corner between edges of 3 and 4 has a normal for each of them, the second after all vertices.
    let corner = open(&[[-3.0, 0.0], [0.0, 0.0], [0.0, 4.0]]);
    assert!((corner.normals()[1] - point(0.0, -1.0)).norm() < 1e-15);
    assert!((corner.normals()[3] - point(1.0, 0.0)).norm() < 1e-15);
    assert_eq!(corner.tributary_lengths(), [1.5, 1.5, 2.0, 2.0]);
}

#[test]
fn a_ring_has_its_area_wherever_it_lies() {
    let inner: Vec<[f64; 2]> = SQUARE
        .iter()
        .map(|p| [0.25 + 0.5 * p[0], 0.25 + 0.5 * p[1]])
        .collect();
    let ring = Boundary::new(&[
        chain(&SQUARE, BoundarySide::Outer),
        chain(&reversed(&inner), BoundarySide::Hole),
    ])
    .expect("sound");
    assert!((ring.area() - 0.75).abs() < 1e-15);
    let far = moved(&ring, 0.0, point(1e6, -1e6));
    assert!((far.area() - 0.75).abs() < 1e-9);
    // In the hole, outward is towards its middle.
    let s = 4;
    let [a, b] = ring.segments()[s];
    let middle = 0.5 * (ring.points[a] + ring.points[b]);
    assert!(ring.segment_normal(s).dot(&(point(0.5, 0.5) - middle)) > 0.0);
}

#[test]
fn wrong_orientation_is_named() {
    assert!(matches!(
        error(&reversed(&SQUARE), BoundarySide::Outer),
        BoundaryError::Orientation { chain: 0, area, .. } if area == -1.0
    ));
    assert!(matches!(
        error(&SQUARE, BoundarySide::Hole),
        BoundaryError::Orientation { side: BoundarySide::Hole, area, .. } if area == 1.0
    ));
    // A line there and back encloses nothing.
    assert!(matches!(
        error(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], BoundarySide::Outer),
        BoundaryError::Orientation { .. }
    ));
}

#[test]
fn crossings_are_named_with_their_segments() {
    // A bow with a large and a small loop, so that it encloses a positive area.
    let bow = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [1.0, -0.5]];
    assert_eq!(
        error(&bow, BoundarySide::Outer),
        BoundaryError::Crossing {
            first: [0, 0],
            second: [0, 2]
        }
    );
    // A vertex on another segment.
    let touching = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert!(matches!(
        error(&touching, BoundarySide::Outer),
        BoundaryError::Crossing { .. }
    ));
    // A spike that runs back on itself.
    let spike = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    assert_eq!(
        error(&spike, BoundarySide::Open),
        BoundaryError::Crossing {
            first: [0, 0],
            second: [0, 1]
        }
    );
    // Two chains.
    let two = Boundary::new(&[
        chain(&SQUARE, BoundarySide::Outer),
        chain(&[[0.5, 0.5], [1.5, 0.5]], BoundarySide::Open),
    ]);
    assert_eq!(
        two.expect_err("they cross"),
        BoundaryError::Crossing {
            first: [0, 1],
            second: [1, 0]
        }
    );
    // Collinear but apart is no crossing.
    assert!(
        Boundary::new(&[
            chain(&[[0.0, 0.0], [1.0, 0.0]], BoundarySide::Open),
            chain(&[[2.0, 0.0], [3.0, 0.0]], BoundarySide::Open),
        ])
        .is_ok()
    );
}

#[test]
fn degenerate_polylines_are_named() {
    assert_eq!(
        error(&SQUARE[..2], BoundarySide::Outer),
        BoundaryError::TooFew { chain: 0, found: 2 }
    );
    assert_eq!(
        error(&SQUARE[..1], BoundarySide::Open),
        BoundaryError::TooFew { chain: 0, found: 1 }
    );
    assert_eq!(
        error(
            &[[0.0, 0.0], [1.0, f64::NAN], [2.0, 0.0]],
            BoundarySide::Open
        ),
        BoundaryError::NotFinite {
            chain: 0,
            vertex: 1
        }
    );
    // The first vertex repeated at the end of a closed polyline.
    let mut closed = SQUARE.to_vec();
    closed.push(SQUARE[0]);
    let found = error(&closed, BoundarySide::Outer);
    assert_eq!(
        found,
        BoundaryError::Repeated {
            chain: 0,
            vertex: 4
        }
    );
    assert!(found.to_string().contains("vertex 4"), "{found}");
}
