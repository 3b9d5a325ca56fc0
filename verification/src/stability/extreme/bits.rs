//! Changes that must move no bit: rest, a far origin, threads, particle order, a restart; and numbers so small that the
//! processor has few digits for them.

use std::sync::Arc;

use proctor_kernel::lanes::LaneChoice;
use proctor_laws::NeoHookean;
use proctor_scene::simulation::{InitialField, Options, Simulation};
use proctor_scene::{Damping, Dimension, ParticleSeed, Scene, Shape, Vector};

use super::runs::{
    POISSON, YOUNG, block, count_of, from, methods, momentum_scale, options, particles, rough,
    soft, start, steps, unexpected, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::{AT_REST, cuboid};
use crate::settings::Method;
use crate::stability::nonlinear::METHODS;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "rest",
        what: "nothing moves, nothing is strained, for 100 000 steps",
        required: "no bit of the state changes",
        cause: None,
        judge: rest,
    },
    Extreme {
        name: "origin-1e6",
        what: "the origin of the mesh lies 1e6 m from zero",
        required: "the same bits as at zero",
        cause: None,
        judge: || far(1e6),
    },
    Extreme {
        name: "origin-1e9",
        what: "the origin of the mesh lies 1e9 m from zero",
        required: "the same bits as at zero",
        cause: None,
        judge: || far(1e9),
    },
    Extreme {
        name: "denormals",
        what: "velocities of 1e-310 m/s and stresses of 1e-310 Pa, with and without damping",
        required: "no NaN, momentum to the last denormal digit, positions keep their bits",
        cause: None,
        judge: denormals,
    },
    Extreme {
        name: "same-bits",
        what: "other threads and lanes, particles in another order, a restart half way",
        required: "the same bits",
        cause: None,
        judge: same,
    },
];

/// Steps at rest of the default method; of the others a hundredth.
const AT_REST_FOR: u64 = 100_000;

/// Why bits must be equal.
const NO_FORCE: &str = "without a force nothing may move, not even by round-off";
const LOCAL: &str = "positions are kept from the origin on, and all numbers of the scene are numbers of the machine there";
const ORDER: &str =
    "sums are formed in an order that the places of the particles decide, and nothing else";

/// A count of what should not be.
fn none(name: &str, count: usize, reason: &'static str) -> Gate {
    Gate::at_most(name.to_owned(), count as f64, 0.0, reason)
}

fn rest() -> Result<Finding, Unexpected> {
    let mut changed = 0;
    for method in methods() {
        for law in [soft(), NeoHookean::new(YOUNG, POISSON).into()] {
            let mut scene = with(&block([4, 4], [1.1, 1.3], [2.1, 2.3], law), method);
            // A density whose reciprocal is not a number of the machine.
            scene.materials[0].density = 1234.5;
            let what = method.to_string();
            let mut simulation = start(&what, &scene, &options())?;
            let before = simulation.state_hash();
            let count = match method {
                Method::DEFAULT => AT_REST_FOR,
                _ => AT_REST_FOR / 100,
            };
            steps(&what, &mut simulation, count)?;
            changed += usize::from(simulation.state_hash() != before);
        }
    }
    Ok(Finding {
        gates: vec![none("runs whose state changed", changed, NO_FORCE)],
        refusals: vec![],
    })
}

/// A block with gravity and a rough start; corners are powers of two of a metre, so that they are numbers of the machine
/// at 1e9 m, too.
fn far_block(distance: f64, method: Method) -> (Scene, Options) {
    let mut scene = with(&block([12, 12], [4.25, 5.5], [7.25, 8.0], soft()), method);
    scene.gravity = [1e-4, -2e-4, 0.0];
    let by = [distance, -distance, 0.0];
    let moved = |x: Vector| -> Vector { std::array::from_fn(|axis| x[axis] + by[axis]) };
    scene.mesh.origin = moved(scene.mesh.origin);
    scene.bodies[0].shape = cuboid(moved([4.25, 5.5, 0.0]), moved([7.25, 8.0, 0.0]));
    let near = rough(Dimension::Two, [0.01, 0.005, 0.0], 0.02, 0.01);
    let initial: InitialField =
        Arc::new(move |x| near(&std::array::from_fn(|axis| x[axis] - by[axis])));
    (scene, from(initial))
}

fn far(distance: f64) -> Result<Finding, Unexpected> {
    let run = |distance: f64, method: Method| -> Result<u64, Unexpected> {
        let (scene, options) = far_block(distance, method);
        let what = format!("{method} at {distance} m");
        let mut simulation = start(&what, &scene, &options)?;
        steps(&what, &mut simulation, count_of(method, 100))?;
        Ok(simulation.state_hash())
    };
    let mut other = 0;
    for method in methods() {
        other += usize::from(run(distance, method)? != run(0.0, method)?);
    }
    Ok(Finding {
        gates: vec![none("methods with other bits than at zero", other, LOCAL)],
        refusals: vec![],
    })
}

/// A velocity \[m/s\] and a stress \[Pa\] with few digits left.
const DENORMAL: f64 = 1e-310;

fn denormals() -> Result<Finding, Unexpected> {
    let (mut not_numbers, mut moved, mut off) = (0, 0, 0.0_f64);
    for method in METHODS {
        for damping in [Damping::None, Damping::Local { alpha: 0.5 }] {
            let mut scene = with(&block([8, 8], [2.1, 2.3], [5.1, 5.3], soft()), method);
            scene.damping = damping;
            let initial = rough(Dimension::Two, [DENORMAL, 0.0, 0.0], DENORMAL, DENORMAL);
            let what = method.to_string();
            let mut simulation = start(&what, &scene, &from(initial))?;
            let before = particles(&simulation);
            let momentum = simulation.momentum();
            let scale = momentum_scale(&simulation);
            steps(&what, &mut simulation, 500)?;
            for (old, new) in before.iter().zip(particles(&simulation)) {
                not_numbers += usize::from(new.numbers().any(|x| !x.is_finite()));
                moved += usize::from(old.position != new.position);
            }
            if damping == Damping::None {
                let lost = (0..2).map(|axis| (simulation.momentum()[axis] - momentum[axis]).abs());
                off = lost.fold(off, |most, lost| most.max(lost / scale));
            }
        }
    }
    // Each of 500 steps may round each of the nine nodal shares of a particle by one part in 2e13.
    let digits = 1e-310 / f64::from_bits(1);
    let bound = 500.0 * 9.0 / digits;
    Ok(Finding {
        gates: vec![
            none(
                "particles with a value that is no number",
                not_numbers,
                "small is not wrong",
            ),
            none(
                "particles that moved",
                moved,
                "1e-310 m/s for 500 steps is less than the last digit of a position",
            ),
            Gate::at_most(
                "momentum lost over the sum of its magnitudes".to_owned(),
                off,
                bound,
                "a denormal 1e-310 has 4e-14 of itself as its last digit; 500 steps, nine nodes per particle",
            ),
        ],
        refusals: vec![],
    })
}

/// Particles of a block, with their neighbours in order or not.
fn seeds(turned: bool) -> Vec<ParticleSeed> {
    let mut all: Vec<ParticleSeed> = (0..100)
        .map(|k| ParticleSeed {
            position: [
                3.3 + 0.5 * f64::from(k % 10),
                3.4 + 0.5 * f64::from(k / 10),
                0.0,
            ],
            volume: 0.25,
        })
        .collect();
    if turned {
        // 37 has no factor with 100 in common: every particle once.
        all = (0..100).map(|k| all[(k * 37 + 11) % 100]).collect();
    }
    all
}

/// The state of all particles but for their numbers, in order of their places at the start.
fn by_place(simulation: &Simulation, seeds: &[ParticleSeed]) -> Vec<Vec<u64>> {
    let mut all: Vec<([u64; 3], Vec<u64>)> = particles(simulation)
        .iter()
        .map(|seen| {
            let place = seeds[seen.id as usize].position.map(f64::to_bits);
            (place, seen.numbers().map(f64::to_bits).collect())
        })
        .collect();
    all.sort();
    all.into_iter().map(|(_, state)| state).collect()
}

fn same() -> Result<Finding, Unexpected> {
    let (mut threads, mut lanes, mut order, mut restart) = (0, 0, 0, 0);
    for method in methods() {
        let what = method.to_string();
        let count = count_of(method, 60);
        let mut scene = with(&block([12, 12], [3.0; 2], [8.0; 2], soft()), method);
        let run = |scene: &Scene, options: Options| -> Result<Simulation, Unexpected> {
            let mut simulation = start(&what, scene, &options)?;
            steps(&what, &mut simulation, count)?;
            Ok(simulation)
        };
        let options = || from(rough(Dimension::Two, [0.04, 0.02, 0.0], 0.02, 0.01));
        scene.bodies[0].shape = Shape::Particles(Arc::new(seeds(false)));
        let once = run(&scene, options())?;
        let hash = once.state_hash();
        for several in [2, 3] {
            let more = Options {
                threads: Some(several),
                least_share: Some(1),
                ..options()
            };
            threads += usize::from(run(&scene, more)?.state_hash() != hash);
        }
        let scalar = Options {
            lanes: LaneChoice::Scalar,
            ..options()
        };
        lanes += usize::from(run(&scene, scalar)?.state_hash() != hash);
        let mut turned = scene.clone();
        turned.bodies[0].shape = Shape::Particles(Arc::new(seeds(true)));
        let turned = run(&turned, options())?;
        order += usize::from(by_place(&turned, &seeds(true)) != by_place(&once, &seeds(false)));
        let mut first = start(&what, &scene, &options())?;
        steps(&what, &mut first, count / 2)?;
        let mut second = start(&what, &scene, &from(Arc::new(|_| AT_REST)))?;
        second
            .restore(first.save())
            .map_err(|e| unexpected(&what, e))?;
        steps(&what, &mut second, count - count / 2)?;
        restart += usize::from(second.state_hash() != hash || second.steps() != count);
    }
    Ok(Finding {
        gates: vec![
            none(
                "runs on two and three threads with other bits",
                threads,
                ORDER,
            ),
            none("runs without vector lanes with other bits", lanes, ORDER),
            none(
                "runs of particles in another order with other bits",
                order,
                ORDER,
            ),
            none(
                "runs that were restarted with other bits",
                restart,
                "what a step leaves behind is all that the next one needs",
            ),
        ],
        refusals: vec![],
    })
}
