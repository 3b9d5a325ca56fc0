//! Checks of vertices and edges.

use proctor_contact::geometry::surface::{Point, Surface, SurfaceError, SurfaceErrorKind};

const A: Point = [0.0, 0.0, 0.0];
const B: Point = [1.0, 0.0, 0.0];
const C: Point = [0.0, 1.0, 0.0];
const D: Point = [1.0, 1.0, 0.0];
const E: Point = [0.0, 0.0, 1.0];

fn fault(corners: &[[Point; 3]]) -> SurfaceErrorKind {
    Surface::new(corners).expect_err("a fault").kind
}

#[test]
fn corners_are_welded_and_open_edges_counted() {
    let near = B.map(|x| x + 2e-8);
    let surface = Surface::new(&[[A, B, C], [C, near, D]]).expect("a square");
    assert_eq!((surface.vertex_count(), surface.triangle_count()), (4, 2));
    let open = surface.open_edges().expect("a square has a rim");
    assert_eq!((open.count, open.triangle, open.first), (4, 1, [A, B]));
    let far = B.map(|x| x + 1e-6);
    let cut = Surface::new(&[[A, B, C], [C, far, D]]).expect("two triangles");
    assert_eq!(cut.open_edges().map(|o| o.count), Some(6));
}

#[test]
fn a_closed_surface_is_told_from_an_open_one() {
    let faces = [[A, C, B], [A, B, E], [B, C, E], [C, A, E]];
    let closed = Surface::new(&faces).expect("a tetrahedron");
    assert!(closed.open_edges().is_none());
    assert_eq!(closed.require_closed(), Ok(()));
    let open = Surface::new(&faces[..3]).expect("three of its faces");
    assert_eq!(
        open.require_closed().expect_err("a face is missing").kind,
        SurfaceErrorKind::Open {
            edges: 3,
            triangle: 1,
            edge: [A, C],
        }
    );
}

#[test]
fn no_triangle() {
    assert_eq!(fault(&[]), SurfaceErrorKind::Empty);
}

#[test]
fn coordinates_that_are_not_finite() {
    let bad = [A, B, [0.0, f64::INFINITY, 0.0]];
    assert!(matches!(
        fault(&[[A, B, C], bad]),
        SurfaceErrorKind::NotFinite { triangle: 2, corners } if corners == bad
    ));
    assert!(matches!(
        fault(&[[A, [f64::NAN; 3], C]]),
        SurfaceErrorKind::NotFinite { triangle: 1, .. }
    ));
}

#[test]
fn triangles_without_area() {
    let on_a_line = [A, B, [3.0, 0.0, 0.0]];
    let point = [B, B, C];
    for bad in [on_a_line, point, [A, B, [0.5, 1e-8, 0.0]]] {
        assert_eq!(
            fault(&[[A, B, C], bad]),
            SurfaceErrorKind::Degenerate {
                triangle: 2,
                corners: bad,
            }
        );
    }
    // Coordinates whose squares overflow.
    assert!(matches!(
        fault(&[[A, [1e200, 0.0, 0.0], [0.0, 1e200, 0.0]]]),
        SurfaceErrorKind::Degenerate { .. }
    ));
}

#[test]
fn neighbours_turned_against_each_other() {
    assert_eq!(
        fault(&[[A, B, C], [B, C, D]]),
        SurfaceErrorKind::Orientation {
            triangles: [1, 2],
            edge: [B, C],
        }
    );
}

#[test]
fn edges_of_three_triangles_and_triangles_that_are_there_twice() {
    assert_eq!(
        fault(&[[A, B, C], [B, A, E], [B, A, [0.0, -1.0, 0.0]]]),
        SurfaceErrorKind::NonManifold {
            triangles: vec![1, 2, 3],
            edge: [A, B],
        }
    );
    for twin in [[A, B, C], [A, C, B]] {
        assert!(matches!(
            fault(&[[A, B, C], twin]),
            SurfaceErrorKind::NonManifold { triangles, .. } if triangles == [1, 2]
        ));
    }
}

#[test]
fn a_message_names_place_and_way_out() {
    let text = SurfaceError::from(fault(&[[A, B, C], [B, C, D]])).to_string();
    assert_eq!(
        text,
        "found triangles 1 and 2 turned against each other at the edge from (1, 0, 0) to (0, 1, 0) m; accepted: \
         neighbours that run through their common edge in opposite directions"
    );
}
