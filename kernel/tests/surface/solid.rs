//! Shapes as solids: nearest points, sides and normals.

use proctor_scene::{Dimension, Shape, Vector};

fn shapes() -> Vec<(Shape, Dimension)> {
    let hook = vec![
        [0.1, 0.1, 0.0],
        [0.9, 0.2, 0.0],
        [0.8, 0.9, 0.0],
        [0.6, 0.4, 0.0],
        [0.2, 0.7, 0.0],
    ];
    let turned: Vec<Vector> = hook.iter().rev().copied().collect();
    let flat = hook.iter().map(|p| [p[0], p[1]]).collect();
    vec![
        (Shape::rectangle([0.2, 0.3], [0.7, 0.6]), Dimension::Two),
        (Shape::disc([0.5, 0.4], 0.3), Dimension::Two),
        (
            Shape::Ring {
                center: [0.5, 0.5, 0.0],
                inner: 0.2,
                outer: 0.35,
            },
            Dimension::Two,
        ),
        (Shape::Polygon { points: hook }, Dimension::Two),
        (Shape::Polygon { points: turned }, Dimension::Two),
        (
            Shape::Cuboid {
                p1: [0.2, 0.3, 0.1],
                p2: [0.7, 0.6, 0.8],
            },
            Dimension::Three,
        ),
        (
            Shape::Sphere {
                center: [0.5, 0.4, 0.6],
                radius: 0.3,
            },
            Dimension::Three,
        ),
        (
            Shape::Cylinder {
                p1: [0.3, 0.3, 0.3],
                p2: [0.6, 0.5, 0.8],
                radius: 0.2,
            },
            Dimension::Three,
        ),
        (
            Shape::ExtrudedPolygon {
                points: flat,
                axis: 1,
                range: [0.3, 0.6],
            },
            Dimension::Three,
        ),
    ]
}

/// The nearest point is on the surface, and the distance changes by no more than a point moves, and by as much along the
/// normal.
#[test]
fn distances_grow_along_normals_from_points_of_the_surface() {
    for (shape, dimension) in shapes() {
        let axes = dimension.axes();
        let at = |x: &Vector| shape.nearest(dimension, x).expect("a solid");
        let mut sides = [0, 0];
        for i in 0..4000_u32 {
            // Points that fill the unit cube evenly.
            let fill = |base: f64| (0.5 + base * f64::from(i)) % 1.0;
            let mut x = [fill(0.819_172_5), fill(0.671_043_6), fill(0.549_700_5)];
            x[axes..].fill(0.0);
            let found = at(&x);
            sides[usize::from(found.distance < 0.0)] += 1;
            let length = found.normal.iter().map(|c| c * c).sum::<f64>();
            assert!((length - 1.0).abs() < 1e-12, "{shape:?} {x:?}: {found:?}");
            let on = at(&found.point);
            assert!(
                on.distance.abs() < 1e-9,
                "{shape:?} {x:?}: {found:?} {on:?}"
            );
            // Towards the surface the distance falls as fast as a point moves.
            let step = 1e-4;
            let towards = step * found.distance.signum();
            let nearer: Vector = std::array::from_fn(|k| x[k] - towards * found.normal[k]);
            if found.distance.abs() > step {
                let change = at(&nearer).distance - found.distance + towards;
                assert!(change.abs() < 1e-9, "{shape:?} {x:?}: {found:?}, {change}");
            }
            for k in 0..axes {
                let mut aside = x;
                aside[k] += step;
                let change = at(&aside).distance - found.distance;
                assert!(
                    change.abs() < step * (1.0 + 1e-9),
                    "{shape:?} {x:?} {k}: {change}"
                );
            }
        }
        assert!(sides[0] > 0 && sides[1] > 0, "{shape:?}: {sides:?}");
    }
}

/// Over a face the normal is that of the face to the last bit, whatever the point; at a corner it turns.
#[test]
fn faces_have_one_normal_and_corners_turn_it() {
    let wall = Shape::rectangle([-0.1, 0.1], [0.0, 1.7]);
    for y in [0.1, 0.100_01, 0.3, 1.6] {
        for x in [-0.01, 0.0, 0.01, 0.3] {
            let found = wall.nearest(Dimension::Two, &[x, y, 0.0]).expect("a solid");
            if y > 0.11 {
                assert_eq!(found.normal, [1.0, 0.0, 0.0], "{x} {y}");
            }
            assert!((found.distance - x).abs() < 1e-15 || y < 0.11);
        }
    }
    let below = wall
        .nearest(Dimension::Two, &[0.03, 0.06, 0.0])
        .expect("a solid");
    assert!((below.distance - 0.05).abs() < 1e-12);
    assert!((below.normal[0] - 0.6).abs() < 1e-12 && (below.normal[1] + 0.8).abs() < 1e-12);
}

#[test]
fn a_list_of_particles_has_no_surface() {
    let list = Shape::Particles(Vec::new().into());
    assert!(list.nearest(Dimension::Two, &[0.0; 3]).is_none());
}
