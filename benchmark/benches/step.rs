//! Time of a whole step, by weighting function, stress scheme and transfer, on one thread.
//!
//! `cargo bench --bench step` or `cargo bench --bench step -- uGIMP`. Throughput is in particles: the reciprocal of the
//! time per particle and step. The scene is the block of `proctor bench` that moves over its mesh.

#[path = "common/mod.rs"]
mod common;

use common::{WEIGHTINGS, moving, within_minutes};
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use proctor_scene::simulation::Simulation;

const METHODS: [(&str, &str); 5] = [
    ("USL", "FLIP"),
    ("MUSL", "FLIP"),
    ("USF", "FLIP"),
    ("USL", "APIC"),
    ("USL", "TPIC"),
];

fn steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group.sampling_mode(SamplingMode::Flat);
    for weighting in WEIGHTINGS {
        for (scheme, transfer) in METHODS {
            let (scene, options) = moving(weighting, scheme, transfer);
            let start = || Simulation::new(&scene, &options).expect("the block can be set up");
            let mut simulation = start();
            group.throughput(Throughput::Elements(simulation.particles() as u64));
            let id = BenchmarkId::new(weighting, format!("{scheme} {transfer}"));
            group.bench_function(id, |b| {
                b.iter(|| {
                    // The block would reach the wall of its mesh after the end time of the scene.
                    if simulation.time() >= scene.time {
                        simulation = start();
                    }
                    simulation
                        .step(f64::INFINITY)
                        .expect("the block stays sound")
                });
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = within_minutes();
    targets = steps
}
criterion_main!(benches);
