//! Time of a single stage, by weighting function, on one thread; throughput in particles.
//!
//! `cargo bench --bench stage` or `cargo bench --bench stage -- g2p`. Each stage is rehearsed on the same state.

#[path = "common/mod.rs"]
mod common;

use common::{WEIGHTINGS, moving, within_minutes};
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use proctor_scene::simulation::{Part, Simulation};
use std::time::{Duration, Instant};

/// Steps before the rehearsals, so that particles lie as they do in a run.
const WARM_UP: usize = 3;

fn stages(c: &mut Criterion) {
    for part in Part::ALL {
        let mut group = c.benchmark_group(part.name());
        group.sampling_mode(SamplingMode::Flat);
        for weighting in WEIGHTINGS {
            let (scene, options) = moving(weighting, "MUSL", "FLIP");
            let mut simulation = Simulation::new(&scene, &options).expect("a sound scene");
            for _ in 0..WARM_UP {
                simulation.step(f64::INFINITY).expect("a sound step");
            }
            group.throughput(Throughput::Elements(simulation.particles() as u64));
            let mut rehearsal = simulation.rehearse(part).expect("a sound step");
            group.bench_function(BenchmarkId::from_parameter(weighting), |b| {
                b.iter_custom(|plays| {
                    let mut spent = Duration::ZERO;
                    for _ in 0..plays {
                        rehearsal.set().expect("a sound step");
                        let clock = Instant::now();
                        rehearsal.play().expect("a sound step");
                        spent += clock.elapsed();
                    }
                    spent
                });
            });
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = within_minutes();
    targets = stages
}
criterion_main!(benches);
