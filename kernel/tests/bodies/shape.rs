//! Sizes of shapes.

use crate::bodies::support::Setting;
use proctor_kernel::bodies::{expected, fill};
use proctor_scene::{Dimension, ParticleSeed, Shape};
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

/// The estimate before a body is filled is near its number of particles: the volume over that of a sub-cell.
#[test]
fn the_particles_of_a_shape_are_known_before_it_is_filled() {
    let (two, three) = (Setting::plane(0.1, 20, 3), Setting::space(0.1, 20, 2));
    let corners = [[0.2, 0.2], [1.7, 0.3], [0.9, 1.6]];
    let plane = [
        Shape::rectangle([0.2, 0.3], [1.2, 1.6]),
        Shape::disc([1.0, 1.0], 0.7),
        Shape::Ring {
            center: [1.0, 1.0, 0.0],
            inner: 0.3,
            outer: 0.8,
        },
        Shape::Polygon {
            points: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
        },
    ];
    let space = [
        Shape::Cuboid {
            p1: [0.2; 3],
            p2: [1.2, 1.5, 0.7],
        },
        Shape::Sphere {
            center: [1.0; 3],
            radius: 0.7,
        },
        Shape::Cylinder {
            p1: [0.4, 0.5, 0.6],
            p2: [1.4, 1.5, 1.2],
            radius: 0.3,
        },
        Shape::ExtrudedPolygon {
            points: corners.to_vec(),
            axis: 1,
            range: [0.3, 1.1],
        },
    ];
    let all = plane.map(|shape| (shape, &two)).into_iter();
    for (shape, setting) in all.chain(space.map(|shape| (shape, &three))) {
        let (mesh, axes) = (setting.mesh(), setting.axes());
        let filled = fill(&shape, setting.ppc, &mesh, setting.dimension).expect("it is sound");
        let found = expected(&shape, setting.ppc, &mesh, axes);
        let ratio = found / filled.count() as f64;
        assert!(
            (0.97..1.03).contains(&ratio),
            "{shape:?}: {found} {}",
            filled.count()
        );
    }
}
