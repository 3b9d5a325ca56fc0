//! Tractions that no body carries, all over or in part, are refused by their name.

use crate::common::{DIMENSIONS, WEIGHTINGS, body, cuboid, empty, options, simulation};
use proctor_scene::simulation::{ResultWarning, SetupError, Simulation};
use proctor_scene::{Dimension, ParticleSeed, Scene, Shape, Traction, Vector};
use std::sync::Arc;

fn traction(p1: Vector, p2: Vector) -> Traction {
    Traction {
        p1,
        p2,
        traction: [0.0, -100.0, 0.0].into(),
    }
}

/// A scene with shapes and tractions; the second is the one in question.
fn scene(dimension: Dimension, shapes: &[Shape], p1: Vector, p2: Vector) -> Scene {
    let mut scene = empty(dimension, [20, 12, 12], 0.1);
    let bodies = shapes.iter().zip(1..);
    scene.bodies = bodies.map(|(shape, id)| body(id, shape.clone())).collect();
    let mut all = [traction([0.3, 0.3, 0.3], [0.5, 0.3, 0.5]), traction(p1, p2)];
    if dimension == Dimension::Two {
        for corner in all.iter_mut().flat_map(|t| [&mut t.p1, &mut t.p2]) {
            corner[2] = 0.0;
        }
    }
    scene.tractions = all.into();
    scene
}

fn refused(scene: &Scene) -> Option<String> {
    let error = Simulation::new(scene, &options()).err()?;
    let SetupError::Load { path, reason } = error else {
        panic!("{error}")
    };
    assert_eq!(path, "traction[1]", "{reason}");
    assert!(!reason.contains("nodal load"), "{reason}");
    Some(reason)
}

const BLOCK: [Vector; 2] = [[0.2, 0.2, 0.2], [0.8, 0.6, 0.6]];

#[test]
fn wider_than_its_body() {
    let block = [cuboid(BLOCK[0], BLOCK[1])];
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            let told = |from: f64, to: f64, y: f64| {
                let mut scene = scene(dimension, &block, [from, y, 0.2], [to, y, 0.6]);
                scene.weighting = weighting;
                refused(&scene)
            };
            // On the face, at its ends, and within the body.
            for (from, to, y) in [(0.2, 0.8, 0.6), (0.35, 0.62, 0.6), (0.2, 0.8, 0.45)] {
                assert_eq!(told(from, to, y), None, "{weighting:?} {from} {to}");
            }
            // Far beyond, and by less than a particle; the shares are those of lengths.
            for (from, to, share) in [
                (0.2, 1.4, "50 %"),
                (0.0, 0.8, "25 %"),
                (0.4, 0.81, "2.4 %"),
                (0.16, 0.84, "11.8 %"),
            ] {
                let reason = told(from, to, 0.6).expect("it is wider");
                assert!(reason.contains(share), "{share}: {reason}");
            }
            // Beside the body, above it, below it.
            for (from, to, y) in [(1.0, 1.4, 0.6), (0.3, 0.5, 0.7), (0.3, 0.5, 0.1)] {
                let reason = told(from, to, y).expect("there is nobody");
                assert!(reason.contains("lies over no body"), "{reason}");
            }
        }
    }
}

#[test]
fn wider_than_its_body_along_the_third_axis() {
    let block = [cuboid(BLOCK[0], BLOCK[1])];
    let scene = scene(Dimension::Three, &block, [0.2, 0.6, 0.1], [0.8, 0.6, 0.9]);
    let reason = refused(&scene).expect("it is wider");
    assert!(reason.contains("50 %"), "{reason}");
}

#[test]
fn over_two_bodies() {
    for dimension in DIMENSIONS {
        let two = |gap: f64| {
            [
                cuboid([0.2, 0.2, 0.2], [0.5, 0.6, 0.6]),
                cuboid([0.5 + gap, 0.2, 0.2], [1.1, 0.6, 0.6]),
            ]
        };
        let over = |gap: f64| {
            refused(&scene(
                dimension,
                &two(gap),
                [0.2, 0.6, 0.2],
                [1.1, 0.6, 0.6],
            ))
        };
        assert_eq!(over(0.0), None);
        let reason = over(0.045).expect("a gap");
        assert!(
            reason.contains("from (0.5, 0.6") && reason.contains("to (0.545, 0.6"),
            "{reason}"
        );
        assert!(reason.contains("5 %"), "{reason}");
    }
}

/// Bodies that are no boxes: particles are a staircase there, whose steps are no gaps.
#[test]
fn on_other_shapes() {
    let crest = Shape::Polygon {
        points: vec![
            [0.2, 0.2, 0.0],
            [1.4, 0.2, 0.0],
            [0.93, 0.67, 0.0],
            [0.2, 0.67, 0.0],
        ],
    };
    let on = |to: f64| {
        refused(&scene(
            Dimension::Two,
            std::slice::from_ref(&crest),
            [0.2, 0.67, 0.0],
            [to, 0.67, 0.0],
        ))
    };
    assert_eq!(on(0.93), None);
    assert!(on(1.3).expect("wider").contains("lies over no body from"));
    let seeds = (0..16).map(|k| ParticleSeed {
        position: [
            0.225 + 0.05 * f64::from(k % 8),
            0.225 + 0.05 * f64::from(k / 8),
            0.0,
        ],
        volume: 0.0025,
    });
    let list = [
        Shape::Particles(Arc::new(seeds.collect())),
        cuboid(BLOCK[0].map(|x| x + 0.4), BLOCK[1].map(|x| x + 0.4)),
    ];
    let mut scene = scene(Dimension::Two, &list, [0.2, 0.3, 0.0], [0.6, 0.3, 0.0]);
    assert_eq!(refused(&scene), None);
    scene.tractions[1].p2[0] = 0.9;
    assert!(refused(&scene).is_some());
}

/// A face so little above a node that the first particle of its cell has its centre below.
#[test]
fn a_node_beyond_the_last_particle() {
    let block = [cuboid([0.2, 0.2, 0.2], [0.8, 0.61, 0.6])];
    let mut scene = scene(Dimension::Two, &block, [0.3, 0.61, 0.0], [0.5, 0.61, 0.0]);
    // The row of particles that ends at 0.61 m is 0.046 m high: its centres at 0.587 m do not reach the node at 0.7 m.
    scene.weighting = proctor_scene::Weighting::Linear;
    let reason = refused(&scene).expect("no particle reaches it");
    assert!(reason.contains("no particle reaches"), "{reason}");
}

#[test]
fn a_body_that_leaves_its_traction_is_told_of() {
    for dimension in DIMENSIONS {
        let block = [cuboid(BLOCK[0], BLOCK[1])];
        let mut scene = scene(dimension, &block, [0.2, 0.6, 0.2], [0.4, 0.6, 0.6]);
        scene.tractions.remove(0);
        scene.bodies[0].velocity = [20.0, 0.0, 0.0];
        let mut simulation = simulation(&scene);
        simulation
            .run_until(0.04)
            .expect("the traction acts on nothing");
        let energy = simulation.energy();
        let all = simulation.cautions(&energy);
        let told =
            |caution: &ResultWarning| matches!(caution, ResultWarning::Traction { index: 0, .. });
        assert!(all.iter().any(told), "{all:?}");
        let left = all
            .iter()
            .find(|caution| told(caution))
            .map(ToString::to_string);
        assert!(
            left.is_some_and(|text| text.contains("traction[0]")),
            "{all:?}"
        );
    }
}
