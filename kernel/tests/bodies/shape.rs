//! Sizes of shapes.

use proctor_kernel::scene::{Dimension, ParticleSeed, Shape};
use std::sync::Arc;

#[test]
fn what_rolls_has_a_radius_and_all_have_a_size() {
    let (two, three) = (Dimension::Two, Dimension::Three);
    let disc = Shape::Sphere {
        center: [1.0; 3],
        radius: 0.4,
    };
    let ring = Shape::Ring {
        center: [0.0; 3],
        inner: 0.2,
        outer: 0.5,
    };
    let pillar = Shape::Cylinder {
        p1: [0.0; 3],
        p2: [0.0, 0.0, 0.1],
        radius: 0.3,
    };
    for (shape, radius) in [(&disc, 0.4), (&ring, 0.5), (&pillar, 0.3)] {
        assert_eq!(
            (shape.radius(), shape.half_size(three)),
            (Some(radius), radius)
        );
    }
    // The third axis counts in space alone.
    let slab = Shape::Cuboid {
        p1: [-1.0, 2.0, 0.0],
        p2: [1.0, 3.0, 0.5],
    };
    assert_eq!(
        (slab.radius(), slab.half_size(two), slab.half_size(three)),
        (None, 0.5, 0.25)
    );
    let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]];
    let flat = Shape::Polygon {
        points: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
    };
    assert_eq!(flat.half_size(two), 1.5);
    let prism = Shape::ExtrudedPolygon {
        points: corners.to_vec(),
        axis: 1,
        range: [2.0, 4.0],
    };
    assert_eq!(prism.half_size(three), 1.0);
    let seed = |position| ParticleSeed {
        position,
        volume: 1.0,
    };
    let loose = vec![seed([0.0; 3]), seed([2.0, 1.0, 8.0])];
    assert_eq!(Shape::Particles(Arc::new(loose)).half_size(three), 0.5);
    assert_eq!(
        Shape::Particles(Arc::new(vec![])).half_size(two),
        f64::INFINITY
    );
}
