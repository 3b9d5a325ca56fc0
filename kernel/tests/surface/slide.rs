//! How the block on the slope slides, and simulations of it.

use crate::slope::Slope;
use proctor_kernel::scene::Scene;
use proctor_kernel::simulation::{Options, Simulation};

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
        ..Options::default()
    };
    Simulation::new(scene, &options).expect("a scene that can start")
}
