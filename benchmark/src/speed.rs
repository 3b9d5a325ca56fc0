//! A short measurement of speed: one block of particles, moving over its mesh.

use crate::measure::Stopwatch;
use proctor_kernel::scene::{Scene, SceneError, from_json};
use proctor_kernel::simulation::{Options, Simulation};
use std::path::Path;

/// 64 000 particles; the same as `block_1m.json` with fewer cells.
const BLOCK: &str = include_str!("../../fixtures/scenes/speed/block_64k.json");
/// Rounds; the fastest counts, since whatever else runs on the machine only adds time.
const ROUNDS: usize = 3;

/// What was found for one number of threads.
pub struct Speed {
    /// Threads.
    pub threads: usize,
    /// Particles.
    pub particles: usize,
    /// Steps of a round.
    pub steps: u64,
    /// Clock time per particle and step, of the fastest round \[ns\].
    pub wall: f64,
    /// CPU time per particle and step, of the round with the least \[ns\].
    pub cpu: f64,
    /// Lanes.
    pub lanes: &'static str,
}

/// The scene that is measured.
pub fn block() -> Result<Scene, SceneError> {
    from_json(BLOCK, "block_64k.json", Path::new(""))
}

/// Measures the scene with a number of threads; an error says why it cannot be run.
pub fn measure(scene: &Scene, threads: usize) -> Result<Speed, String> {
    let options = Options {
        threads: Some(threads),
        ..Options::default()
    };
    let mut speed = Speed {
        threads,
        particles: 0,
        steps: 0,
        wall: f64::INFINITY,
        cpu: f64::INFINITY,
        lanes: "",
    };
    for _ in 0..ROUNDS {
        let mut simulation = Simulation::new(scene, &options).map_err(|e| e.to_string())?;
        let mut stopwatch = Stopwatch::default();
        stopwatch
            .time(|| {
                // A constant step ends within half a step of the end time.
                while simulation.time() < scene.time * (1.0 - 1e-9) {
                    simulation.step(scene.time)?;
                }
                Ok(())
            })
            .map_err(|e: proctor_kernel::simulation::StepError| e.to_string())?;
        speed.particles = simulation.particles();
        speed.steps = simulation.steps();
        speed.lanes = simulation.lanes().name();
        let particle_steps = speed.particles as f64 * speed.steps as f64;
        let spent = stopwatch.spent;
        let wall = spent.wall.as_secs_f64() * 1e9 / particle_steps;
        speed.wall = speed.wall.min(wall);
        speed.cpu = spent
            .ns_per(particle_steps)
            .map_or(speed.cpu, |cpu| speed.cpu.min(cpu));
    }
    Ok(speed)
}
