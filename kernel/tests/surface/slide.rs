//! The block on the slope: its exact slide, where it starts, and simulations of it.

use crate::surface::slope::Slope;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{ParticleSeed, Scene, Shape};
use std::sync::Arc;

impl Slope {
    /// g (sin 30 - mu cos 30).
    pub fn acceleration(&self) -> f64 {
        let angle = 30.0_f64.to_radians();
        self.gravity * (angle.sin() - self.friction * angle.cos())
    }

    pub fn simulation(&self, threads: usize) -> Simulation {
        start(&self.scene(), threads)
    }
}

pub fn start(scene: &Scene, threads: usize) -> Simulation {
    scene.check().expect("a sound scene");
    let options = Options {
        threads: Some(threads),
        least_share: Some(1),
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("a scene that can start")
}

/// Raises the particles of the block along the normal of the slope \[m\].
pub fn raise(scene: &mut Scene, slope: &Slope, by: f64) {
    let way = slope.normal().map(|n| by * n);
    if let Shape::Particles(seeds) = &mut scene.bodies[0].shape {
        let moved = seeds.iter().map(|seed| ParticleSeed {
            position: std::array::from_fn(|axis| seed.position[axis] + way[axis]),
            ..*seed
        });
        *seeds = Arc::new(moved.collect());
    }
}
