//! A body that ends at a node, and an ulp beside: a node that a domain touches by round-off alone has nothing.

use crate::common::{IDENTITY, body, elastic, empty, material, options};
use proctor_kernel::scene::{
    Dimension, ParticleSeed, Shape, StressScheme, Transfer, TransferKind, Vector, Weighting,
};
use proctor_kernel::simulation::{InitialState, Options, Simulation};
use std::sync::Arc;

/// Scale of velocity \[m/s\] and stress \[Pa\] at the start.
const START: f64 = 0.01;

type Method = (Weighting, StressScheme, TransferKind);

/// Velocity and stress of each particle of a square of five by five after five steps, the first of them at `first` \[m\].
fn after_five_steps(first: [f64; 2], (weighting, scheme, kind): Method) -> Vec<(Vector, [f64; 6])> {
    let mut scene = empty(Dimension::Two, [12, 12, 1], 1.0);
    let mut soft = material(elastic(1.0, 0.3));
    soft.density = 1.0;
    scene.materials = vec![soft];
    let seed = |k: u32| ParticleSeed {
        position: [
            first[0] + 0.5 * f64::from(k / 5),
            first[1] + 0.5 * f64::from(k % 5),
            0.0,
        ],
        volume: 0.25,
    };
    let seeds: Vec<ParticleSeed> = (0..25).map(seed).collect();
    scene.bodies = vec![body(1, Shape::Particles(seeds.into()))];
    (scene.weighting, scene.scheme) = (weighting, scheme);
    scene.transfer = Transfer::new(kind);
    let options = Options {
        initial: Some(Arc::new(|x: &Vector| {
            let (a, b) = (x[0] - 5.0, x[1] - 5.0);
            InitialState {
                velocity: [START * (a + 0.3 * b * b), START * (0.5 * a - b), 0.0],
                velocity_gradient: [
                    [START, 0.6 * START * b, 0.0],
                    [0.5 * START, -START, 0.0],
                    [0.0; 3],
                ],
                stress: [START * a, START * b, 0.0, 0.0, 0.0, START * a * b],
                deformation: IDENTITY,
            }
        })),
        ..options()
    };
    let mut simulation = Simulation::new(&scene, &options).expect("sound");
    for _ in 0..5 {
        simulation.step(f64::INFINITY).expect("a step");
    }
    let set = &simulation.sets()[0];
    let mut order: Vec<usize> = (0..set.len()).collect();
    order.sort_by_key(|p| set.id[*p]);
    order
        .iter()
        .map(|p| (set.velocity(*p), set.stress(*p)))
        .collect()
}

/// With a mass of d² and a force of d, a node that is reached by d had a velocity of 1/d, and particles a strain that did not go
/// to zero with d: with USL, and with TPIC and any scheme, an ulp changed the stress.
#[test]
fn an_ulp_at_the_end_of_a_body_changes_nothing() {
    for (weighting, reach) in [
        (Weighting::UniformGimp, 1.25),
        (Weighting::QuadraticBSpline, 1.5),
    ] {
        for scheme in [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl] {
            for kind in [TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic] {
                let method = (weighting, scheme, kind);
                let at: f64 = 3.0 + reach;
                let here = after_five_steps([at, 4.1], method);
                for beside in [at.next_up(), at.next_down()] {
                    let there = after_five_steps([beside, 4.1], method);
                    for (a, b) in here.iter().zip(&there) {
                        let speeds = a.0.iter().zip(&b.0);
                        let values = speeds.chain(a.1.iter().zip(&b.1));
                        let off = values.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / START;
                        assert!(off < 1e-12, "{method:?}: {off}");
                    }
                }
            }
        }
    }
}
