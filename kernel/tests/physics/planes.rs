//! Antisymmetric planes: a layer between them shears as an endless one.

use crate::common::{SCHEMES, WEIGHTINGS, body, cuboid, elastic, empty, material, simulation_from};
use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Dimension, PlaneCondition, Scene, Vector, Weighting};
use std::f64::consts::PI;
use std::sync::Arc;

const CELL: f64 = 0.05;
const HIGH: usize = 20;
const SPEED: f64 = 1.0e-4;

/// A layer 1 m high on a fixed floor under a fixed roof, four cells long between antisymmetric planes.
fn layer(dimension: Dimension, weighting: Weighting) -> Scene {
    let axes = dimension.axes();
    let mut scene = empty(dimension, [4, if axes == 2 { HIGH } else { 2 }, HIGH], CELL);
    scene.weighting = weighting;
    let up = axes - 1;
    scene.mesh.planes = [[PlaneCondition::Sliding; 2]; 3];
    scene.mesh.planes[0] = [PlaneCondition::Antisymmetric; 2];
    scene.mesh.planes[up] = [PlaneCondition::Fixed; 2];
    let mut upper: Vector = std::array::from_fn(|axis| scene.mesh.cells[axis] as f64 * CELL);
    upper[axes..].fill(0.0);
    if axes == 2 {
        scene.mesh.planes[2] = [PlaneCondition::Free; 2];
    }
    let mut one = body(1, cuboid([0.0; 3], upper));
    one.particles_per_cell[axes..].fill(1);
    scene.bodies = vec![one];
    scene.materials = vec![material(elastic(1.0e6, 0.3))];
    scene
}

/// A standing shear wave, v = V sin(pi y/H) along the layer: after half a period it goes the other way, everywhere alike
/// along the layer, and nothing moves across it.
#[test]
fn a_layer_swings_in_shear_alone() {
    let shear = 1.0e6 / 2.6;
    let half_period = 1.0 / (shear / 1000.0_f64).sqrt();
    for dimension in [Dimension::Two, Dimension::Three] {
        let up = dimension.axes() - 1;
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                let mut scene = layer(dimension, weighting);
                scene.scheme = scheme;
                let swings = Arc::new(move |x: &Vector| InitialState {
                    velocity: [SPEED * (PI * x[up]).sin(), 0.0, 0.0],
                    ..InitialState::default()
                });
                let mut simulation = simulation_from(&scene, swings);
                simulation.run_until(half_period).expect("a step");
                let set = &simulation.sets()[0];
                for p in 0..set.len() {
                    let (x, v) = (set.position(p), set.velocity(p));
                    let exact = -SPEED * (PI * x[up]).sin();
                    assert!(
                        (v[0] - exact).abs() < 0.02 * SPEED,
                        "{dimension:?} {weighting:?} {scheme:?}: {v:?} at {x:?}, not {exact}"
                    );
                    for across in &v[1..] {
                        assert!(
                            across.abs() < 1e-5 * SPEED,
                            "{weighting:?} {scheme:?} {v:?}"
                        );
                    }
                }
            }
        }
    }
}

/// The region beyond a plane mirrors the inside, and is not counted again.
#[test]
fn nodes_have_the_kinetic_energy_of_the_body() {
    const SPEED: f64 = 0.5;
    for dimension in [Dimension::Two, Dimension::Three] {
        for weighting in WEIGHTINGS {
            let axes = dimension.axes();
            let mut scene = empty(dimension, [8; 3], CELL);
            scene.weighting = weighting;
            scene.mesh.planes = [[PlaneCondition::Free; 2]; 3];
            scene.mesh.planes[axes - 1][0] = PlaneCondition::Sliding;
            let (mut lower, mut upper) = ([2.0 * CELL; 3], [5.0 * CELL; 3]);
            (lower[axes - 1], upper[axes - 1]) = (0.0, 3.0 * CELL);
            lower[axes..].fill(0.0);
            upper[axes..].fill(0.0);
            let mut one = body(1, cuboid(lower, upper));
            one.particles_per_cell[axes..].fill(1);
            one.velocity = [SPEED, 0.0, 0.0];
            scene.bodies = vec![one];
            scene.materials = vec![material(elastic(1.0e6, 0.3))];
            let options = Options {
                measure: true,
                ..crate::common::options()
            };
            let mut simulation = Simulation::new(&scene, &options).expect("the scene is sound");
            let info = simulation.step(1.0).expect("a step");
            let (kinetic, _) = info.measured.expect("it was asked for");
            let exact = 0.5 * simulation.mass() * SPEED * SPEED;
            assert!(
                (kinetic / exact - 1.0).abs() < 1e-12,
                "{dimension:?} {weighting:?}: {kinetic} J, not {exact}"
            );
        }
    }
}
