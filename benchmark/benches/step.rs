//! Time of a whole step, by weighting function, stress scheme and transfer, on one thread.
//!
//! `cargo bench` or `cargo bench -- uGIMP`. Throughput is in particles: the reciprocal of the time per particle and
//! step. The scene is the 64 000-particle block of the speed fixtures, which moves over its mesh.

use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use proctor_kernel::scene::{
    DomainUpdate, Scene, StressScheme, Transfer, TransferKind, Weighting, from_json,
};
use proctor_kernel::simulation::{Options, Simulation};
use std::path::Path;

const BLOCK: &str = include_str!("../../fixtures/scenes/speed/block_64k.json");

fn block() -> Scene {
    from_json(BLOCK, "block_64k.json", Path::new("")).expect("the fixture is a sound scene")
}

fn steps(c: &mut Criterion) {
    let weightings = [
        ("linear", Weighting::Linear),
        ("uGIMP", Weighting::UniformGimp),
        (
            "cpGIMP",
            Weighting::ContiguousGimp(DomainUpdate::Determinant),
        ),
        ("quadratic B-spline", Weighting::QuadraticBSpline),
    ];
    let methods = [
        ("USL FLIP", StressScheme::Usl, TransferKind::Flip),
        ("MUSL FLIP", StressScheme::Musl, TransferKind::Flip),
        ("USF FLIP", StressScheme::Usf, TransferKind::Flip),
        ("USL APIC", StressScheme::Usl, TransferKind::Apic),
        ("USL TPIC", StressScheme::Usl, TransferKind::Tpic),
    ];
    let mut group = c.benchmark_group("step");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (weighting_name, weighting) in weightings {
        for (method_name, scheme, transfer) in methods {
            let mut scene = block();
            scene.weighting = weighting;
            scene.scheme = scheme;
            scene.transfer = Transfer::new(transfer);
            // One thread: a measure of the work, not of the scheduler.
            let options = Options {
                threads: Some(1),
                ..Options::default()
            };
            let start = || Simulation::new(&scene, &options).expect("the block can be set up");
            let mut simulation = start();
            group.throughput(Throughput::Elements(simulation.particles() as u64));
            group.bench_function(BenchmarkId::new(weighting_name, method_name), |b| {
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

criterion_group!(benches, steps);
criterion_main!(benches);
