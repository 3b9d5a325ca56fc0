//! A half of a body beside a plane of symmetry, on a surface that crosses the plane.

use crate::surface::slope::{H, Slope};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{
    Mesh, ParticleSeed, PlaneCondition, Scene, Shape, StressScheme, Vector, Weighting,
};
use std::sync::Arc;

/// The middle of the block of the slope, across it \[m\].
const MIDDLE: f64 = H;

/// The block on the slope, pulled apart to both sides of its middle, whole or its left half alone.
fn sliding(half: bool) -> Simulation {
    let slope = Slope::new(StressScheme::Usl, 0.5);
    let mut scene: Scene = slope.scene();
    // Particles reach beyond the plane.
    scene.weighting = Weighting::QuadraticBSpline;
    let mesh = &scene.mesh;
    let (origin, cells) = (mesh.origin, mesh.cells);
    let (from, across) = if half {
        (MIDDLE, 4)
    } else {
        (MIDDLE - 4.0 * H, 8)
    };
    scene.mesh = Mesh {
        origin: [origin[0], from, origin[2]],
        cells: [cells[0], across, cells[2]],
        ..mesh.clone()
    };
    if half {
        scene.mesh.planes[1][0] = PlaneCondition::Sliding;
        let Shape::Particles(all) = &scene.bodies[0].shape else {
            unreachable!("the block is a list of particles")
        };
        let kept: Vec<ParticleSeed> = all
            .iter()
            .filter(|seed| seed.position[1] > MIDDLE)
            .copied()
            .collect();
        scene.bodies[0].shape = Shape::Particles(Arc::new(kept));
    }
    let velocity = scene.bodies[0].velocity;
    scene.check().expect("sound");
    let options = Options {
        initial: Some(Arc::new(move |x: &Vector| InitialState {
            velocity: [velocity[0], 4.0 * (x[1] - MIDDLE), velocity[2]],
            velocity_gradient: [[0.0; 3], [0.0, 4.0, 0.0], [0.0; 3]],
            stress: [0.0; 6],
            deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        })),
        ..Options::default()
    };
    Simulation::new(&scene, &options).expect("starts")
}

/// The image of a particle rubs towards the plane as the particle rubs away from it.
#[test]
fn half_a_block_slides_as_the_whole_does() {
    let [mut whole, mut half] = [false, true].map(sliding);
    for _ in 0..4 {
        whole.step(1.0).expect("a step");
        half.step(1.0).expect("a step");
    }
    assert!((whole.time() - half.time()).abs() < 1e-12);
    let all: Vec<(Vector, Vector)> = (0..whole.particles())
        .map(|p| (whole.position(0, p), whole.sets()[0].velocity(p)))
        .collect();
    assert!(
        all.iter().any(|(_, v)| v[1].abs() > 0.1),
        "it is pulled apart"
    );
    for p in 0..half.particles() {
        let (x, v) = (half.position(0, p), half.sets()[0].velocity(p));
        let far = |y: &Vector| (0..3).map(|a| (x[a] - y[a]).powi(2)).sum::<f64>().sqrt();
        let (y, w) = all
            .iter()
            .min_by(|a, b| far(&a.0).total_cmp(&far(&b.0)))
            .expect("particles");
        assert!(far(y) < 1e-9, "{x:?} {y:?}");
        for axis in 0..3 {
            assert!((v[axis] - w[axis]).abs() < 1e-6, "{v:?} {w:?} at {x:?}");
        }
    }
}
