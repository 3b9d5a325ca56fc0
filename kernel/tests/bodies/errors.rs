//! Bodies that cannot be filled, and their messages.

use crate::bodies::support::Setting;
use proctor_kernel::bodies::FillError;
use proctor_scene::{ParticleSeed, Shape, Vector};
use std::sync::Arc;

fn error(setting: &Setting, shape: Shape) -> FillError {
    setting
        .try_fill(shape)
        .expect_err("this body cannot be filled")
}

fn cuboid(p1: Vector, p2: Vector) -> Shape {
    Shape::Cuboid { p1, p2 }
}

fn ball(center: Vector, radius: f64) -> Shape {
    Shape::Sphere { center, radius }
}

fn list(position: Vector, volume: f64) -> Shape {
    let good = ParticleSeed {
        position: [1.0; 3],
        volume: 1.0,
    };
    Shape::Particles(Arc::new(vec![good, ParticleSeed { position, volume }]))
}

#[test]
fn a_body_between_the_centres_is_empty_and_says_its_size() {
    let setting = Setting::plane(1.0, 4, 2);
    let found = error(&setting, ball([2.0, 2.0, 0.0], 0.125));
    let expected = FillError::Empty {
        size: [0.25; 3],
        spacing: [0.5, 0.5, 1.0],
        axes: 2,
    };
    assert_eq!(found, expected);
    let text = found.to_string();
    assert!(
        text.contains("size is [0.25, 0.25] m") && text.contains("spacing [0.5, 0.5] m"),
        "{text}"
    );
    let found = error(&setting, Shape::Particles(Arc::default()));
    assert_eq!(found, FillError::EmptyList);
}

/// The index is the one the particle would have.
#[test]
fn a_box_beyond_the_mesh_names_its_first_particle_outside() {
    let setting = Setting::space(1.0, 4, 1).at(10.0);
    let outside = |p1: Vector, p2: Vector| match error(&setting, cuboid(p1, p2)) {
        FillError::ParticleOutside {
            index,
            position,
            mesh,
            axes: 3,
        } => {
            assert_eq!(mesh, [[10.0, 14.0]; 3]);
            (index, position)
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(outside([9.0; 3], [12.0; 3]), (0, [9.5; 3]));
    assert_eq!(
        outside([12.0, 12.0, 12.0], [14.0, 14.0, 15.0]),
        (2, [12.5, 12.5, 14.5])
    );
    assert_eq!(
        outside([12.0, 12.0, 12.0], [15.0, 14.0, 14.0]),
        (8, [14.5, 12.5, 12.5])
    );
    assert_eq!(
        outside([12.0, 13.0, 12.0], [14.0, 16.0, 14.0]),
        (2, [12.5, 14.5, 12.5])
    );
    // A box of 1e27 particles is an error at once.
    assert_eq!(outside([12.0; 3], [1e9; 3]).1, [12.5, 12.5, 14.5]);
}

#[test]
fn other_shapes_beyond_the_mesh() {
    let setting = Setting::plane(1.0, 4, 1).at(10.0);
    // Less than a sub-cell too far: the first particle that is outside, after the column at x = 12.5.
    let found = error(&setting, ball([13.5, 12.0, 0.0], 1.3));
    let FillError::ParticleOutside {
        index: 4, position, ..
    } = found
    else {
        panic!("{found:?}")
    };
    assert_eq!(position, [14.5, 11.5, 0.0]);
    assert!(
        found
            .to_string()
            .starts_with("particle 4 at [14.5, 11.5] m lies outside"),
        "{found}"
    );
    let found = error(&setting, ball([12.0, 13.0, 0.0], 1e30));
    assert!(
        matches!(found, FillError::BodyOutside { axis: 0, .. }),
        "{found:?}"
    );
    let found = error(&setting, ball([12.0, 13.5, 0.0], 2.0));
    let expected = FillError::BodyOutside {
        axis: 1,
        body: [11.5, 15.5],
        mesh: [10.0, 14.0],
    };
    assert_eq!(found, expected);
    assert!(
        found
            .to_string()
            .contains("from 11.5 to 15.5 m along axis y"),
        "{found}"
    );
}

#[test]
fn a_list_names_its_particle() {
    let setting = Setting::plane(1.0, 4, 1);
    let found = error(&setting, list([1.0, 4.5, 0.0], 1.0));
    let FillError::ParticleOutside {
        index: 1,
        position,
        mesh,
        axes: 2,
    } = found
    else {
        panic!("{found:?}")
    };
    assert_eq!((position, mesh[1]), ([1.0, 4.5, 0.0], [0.0, 4.0]));
    let found = error(&setting, list([1.0; 3], 0.0)).to_string();
    assert_eq!(found, "the volume of particle 1 is not positive: 0");
    let found = error(&setting, list([1.0; 3], f64::INFINITY)).to_string();
    assert_eq!(found, "the volume of particle 1 is not finite: inf");
    let found = error(&setting, list([1.0, f64::NAN, 0.0], 1.0)).to_string();
    assert_eq!(found, "the position of particle 1 is not finite: NaN");
    // The planes themselves belong to the mesh.
    assert!(setting.try_fill(list([4.0, 0.0, 0.0], 1.0)).is_ok());
}

#[test]
fn numbers_that_are_no_numbers() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let plane = Setting::plane(1.0, 4, 1);
    let space = Setting::space(1.0, 4, 1);
    let corners = |x: f64| Shape::Polygon {
        points: vec![[1.0; 3], [3.0, 1.0, 0.0], [x, 3.0, 0.0]],
    };
    let cylinder = |x: f64| Shape::Cylinder {
        p1: [1.0; 3],
        p2: [x, 1.0, 3.0],
        radius: 0.5,
    };
    for (setting, shape) in [
        (&plane, cuboid([nan, 1.0, 0.0], [2.0; 3])),
        (&plane, cuboid([1.0; 3], [inf, 2.0, 0.0])),
        (&plane, ball([1.0, nan, 0.0], 1.0)),
        (&plane, ball([1.0; 3], inf)),
        (&plane, corners(nan)),
        (&plane, corners(inf)),
        (&space, cylinder(nan)),
        (&space, cylinder(-inf)),
    ] {
        let found = error(setting, shape.clone());
        assert!(
            matches!(found, FillError::NotFinite { .. }),
            "{shape:?}: {found:?}"
        );
    }
    let flat = Shape::Polygon {
        points: vec![[1.0; 3], [2.0; 3], [3.0; 3]],
    };
    let ring = Shape::Ring {
        center: [2.0; 3],
        inner: 1.0,
        outer: 1.0,
    };
    let hole = Shape::Ring {
        center: [2.0; 3],
        inner: -0.5,
        outer: 1.0,
    };
    for shape in [
        flat,
        ring,
        hole,
        ball([2.0; 3], -1.0),
        Shape::Polygon { points: vec![] },
    ] {
        let found = error(&plane, shape.clone());
        assert!(
            matches!(found, FillError::NotPositive { .. }),
            "{shape:?}: {found:?}"
        );
    }
    let found = error(&plane, cuboid([2.0; 3], [1.0; 3]));
    assert!(matches!(found, FillError::Empty { .. }), "{found:?}");
    let none = Setting {
        ppc: [0, 1, 1],
        ..plane
    };
    let found = error(&none, ball([2.0; 3], 1.0));
    assert!(matches!(found, FillError::NotPositive { .. }), "{found:?}");
}

#[test]
fn shapes_of_the_other_dimension() {
    let plane = Setting::plane(1.0, 4, 1);
    let space = Setting::space(1.0, 4, 1);
    let points = vec![[1.0, 1.0], [3.0, 1.0], [1.0, 3.0]];
    let corners = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let extruded = |axis| Shape::ExtrudedPolygon {
        points: points.clone(),
        axis,
        range: [1.0, 2.0],
    };
    let cylinder = Shape::Cylinder {
        p1: [1.0; 3],
        p2: [2.0; 3],
        radius: 0.5,
    };
    let ring = Shape::Ring {
        center: [2.0; 3],
        inner: 0.5,
        outer: 1.0,
    };
    for (setting, shape, text) in [
        (
            &plane,
            extruded(2),
            "there is no extruded polygon in 2 dimensions",
        ),
        (&plane, cylinder, "there is no cylinder in 2 dimensions"),
        (&space, ring, "there is no ring in 3 dimensions"),
        (
            &space,
            Shape::Polygon { points: corners },
            "there is no polygon in 3 dimensions",
        ),
        (
            &space,
            extruded(3),
            "the axis of extrusion is 3, not 0, 1 or 2",
        ),
    ] {
        assert_eq!(error(setting, shape).to_string(), text);
    }
}

#[test]
fn more_particles_than_memory() {
    let setting = Setting {
        cells: [1 << 20; 3],
        ..Setting::space(1.0, 1, 1)
    };
    let found = error(&setting, cuboid([0.0; 3], [1_048_576.0; 3]));
    assert_eq!(
        found,
        FillError::TooMany {
            particles: 2.0_f64.powi(60)
        }
    );
}
