//! The scene that the timed benches share.

use criterion::Criterion;
use proctor_benchmark::bench::config::{Method, SceneChoice};
use proctor_benchmark::bench::scenes;
use proctor_scene::Scene;
use proctor_scene::simulation::Options;
use std::time::Duration;

pub const WEIGHTINGS: [&str; 4] = ["linear", "uGIMP", "cpGIMP", "quadratic_bspline"];

/// Particles of the block.
const PARTICLES: usize = 64_000;

/// The moving block with a method, on one thread: a measure of the work, not of the scheduler.
pub fn moving(weighting: &str, scheme: &str, transfer: &str) -> (Scene, Options) {
    let (scene, axes) = scenes::find("moving-3d").expect("a built-in scene");
    let method = Method {
        weighting: Some(weighting.to_owned()),
        scheme: Some(scheme.to_owned()),
        transfer: Some(transfer.to_owned()),
    };
    let scene = SceneChoice::BuiltIn(scene, axes)
        .scene(PARTICLES, &method)
        .expect("a built-in scene is sound");
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    (scene, options)
}

/// Time for a figure: all figures of both benches come within five minutes. Criterion's options set it otherwise.
pub fn within_minutes() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2))
}
