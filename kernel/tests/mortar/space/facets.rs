//! Checks, normals and frames of triangulated boundaries.

use super::support::{ball, floor, of_shape, point};
use nalgebra::Rotation3;
use proctor_contact::geometry::mortar::elements::Elements;
use proctor_contact::geometry::mortar::space::Point;
use proctor_contact::geometry::mortar::space::facets::{Facets, FacetsError};
use proctor_contact::geometry::mortar::space::skin::skin;
use proctor_contact::geometry::surface::SurfaceErrorKind;
use proctor_scene::Shape;

fn cube() -> Shape {
    Shape::Cuboid {
        p1: [0.0; 3],
        p2: [1.0; 3],
    }
}

#[test]
fn a_body_inside_out_is_refused() {
    let mut corners = skin(&cube(), 0.5).expect("has a surface");
    for t in &mut corners {
        t.swap(1, 2);
    }
    let error = Facets::from_corners(&corners).expect_err("is inside out");
    assert!(matches!(error, FacetsError::InsideOut { volume } if (volume + 1.0).abs() < 1e-14));
    assert!(error.to_string().contains("out of the body"), "{error}");
}

#[test]
fn turned_and_missing_triangles_are_named() {
    let mut corners = skin(&cube(), 1.0).expect("has a surface");
    corners[3].swap(0, 1);
    let Err(FacetsError::Surface(error)) = Facets::from_corners(&corners) else {
        panic!("a turned triangle");
    };
    assert!(
        matches!(error.kind, SurfaceErrorKind::Orientation { .. }),
        "{error}"
    );
    // An open surface is allowed, a sheet on the ground for one, whichever its volume would be.
    corners = skin(&cube(), 1.0).expect("has a surface");
    corners.pop();
    assert!(Facets::from_corners(&corners).is_ok());
}

#[test]
fn normals_are_weighted_by_area() {
    // A fold along y: a horizontal strip of width 1, and one that falls by `z` over a width.
    let fold = |width: f64, z: f64| {
        let far = 1.0 + width;
        [
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
            [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            [[1.0, 0.0, 0.0], [far, 0.0, -z], [far, 1.0, -z]],
            [[1.0, 0.0, 0.0], [far, 1.0, -z], [1.0, 1.0, 0.0]],
        ]
    };
    let facets = Facets::from_corners(&fold(2.0, 0.5)).expect("is sound");
    let at = |facets: &Facets, x: [f64; 3]| -> Vec<Point> {
        let here = |vertex: usize| facets.points[vertex] == point(x[0], x[1], x[2]);
        let normals = facets.normals().into_iter().zip(facets.sites().vertices());
        normals.filter(|(_, v)| here(**v)).map(|(n, _)| n).collect()
    };
    assert_eq!(at(&facets, [0.0, 1.0, 0.0]), [point(0.0, 0.0, 1.0)]);
    // One triangle of the first strip and two of the second, and the other way around.
    let [near, far] = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]].map(|x| at(&facets, x));
    assert!((near[0] - point(1.0, 0.0, 5.0).normalize()).norm() < 1e-15);
    assert!((far[0] - point(0.5, 0.0, 4.0).normalize()).norm() < 1e-15);
    assert_eq!((near.len(), far.len(), facets.ridges().len()), (1, 1, 0));
    // A sharp fold has a normal for each side.
    let corners = |z: f64| fold(0.0, z);
    let facets = Facets::from_corners(&corners(2.0)).expect("is sound");
    let both = [point(0.0, 0.0, 1.0), point(1.0, 0.0, 0.0)];
    assert_eq!(at(&facets, [1.0, 0.0, 0.0]), both);
    assert_eq!(facets.ridges().len(), 1);
    // The same fold the other way up has no edge that could meet another.
    assert!(
        Facets::from_corners(&corners(-2.0).map(|[a, b, c]| [a, c, b]))
            .expect("sound")
            .ridges()
            .len()
            == 1
    );
    let concave: Vec<_> = corners(2.0).map(|[a, b, c]| [a, c, b]).to_vec();
    assert!(
        Facets::from_corners(&concave)
            .expect("sound")
            .ridges()
            .is_empty()
    );
}

#[test]
fn sharp_edges_are_listed_and_smooth_ones_not() {
    let cube = of_shape(&cube(), 0.5);
    // Twelve edges of two halves each.
    assert_eq!(cube.ridges().len(), 24);
    assert!(ball([0.0; 3], 1.0, 0.3).ridges().is_empty());
    assert!((cube.tributary_areas().iter().sum::<f64>() - 6.0).abs() < 1e-14);
    // Eight corners with three sides, twelve middles of edges with two, six middles of faces.
    let sites = cube.sites();
    assert_eq!((cube.points.len(), sites.vertices().len()), (26, 54));
    for (triangle, of_triangle) in sites.elements().iter().enumerate() {
        for site in of_triangle {
            let normal = cube.normals()[*site];
            assert!((normal - cube.triangle_normal(triangle)).norm() < 1e-15);
            let [s, t] = cube.tangents(*site, &normal);
            assert!((s.cross(&t) - normal).norm() < 1e-15);
        }
    }
}

#[test]
fn tangents_turn_with_the_surface() {
    let turn = Rotation3::from_euler_angles(0.4, -1.2, 2.0);
    let ball = ball([0.1, 0.2, 0.3], 1.0, 0.4);
    let turned = super::support::moved(&ball, &turn, &point(1.0, 2.0, 3.0));
    for (k, n) in ball.normals().iter().enumerate() {
        let [s, t] = ball.tangents(k, n);
        assert!(s.dot(n).abs() < 1e-15 && (s.norm() - 1.0).abs() < 1e-15);
        assert!((s.cross(&t) - n).norm() < 1e-15);
        let there = turned.tangents(k, &(turn * n));
        assert!((turn * s - there[0]).norm() < 1e-13 && (turn * t - there[1]).norm() < 1e-13);
    }
}

/// A bar through the mesh from wall to wall: its ends lie in the walls and touch nothing.
#[test]
fn faces_in_walls_are_left_out() {
    let bar = of_shape(
        &Shape::Cuboid {
            p1: [0.0, 0.0, 0.5],
            p2: [1.0, 0.25, 0.75],
        },
        0.25,
    );
    let left = bar
        .without_planes(&[(1, 0.0), (1, 0.25)])
        .expect("most is left");
    assert!((left.area() - (bar.area() - 2.0 * 0.25)).abs() < 1e-14);
    for (n, x) in left.normals().iter().zip(&left.points) {
        assert_eq!(n.y, 0.0);
        assert!((n.norm() - 1.0).abs() < 1e-15, "{x}");
    }
    let sheet = floor(&[0.0, 1.0], &[0.0, 1.0], 0.5, |_, _| false);
    assert_eq!(sheet.without_planes(&[(2, 0.5)]), Err(FacetsError::Nothing));
}
