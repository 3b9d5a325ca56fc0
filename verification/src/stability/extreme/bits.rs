//! Changes that must move no bit: rest, a far origin, threads, particle order, a restart; and numbers so small that the
//! processor has few digits for them.

use super::prelude::*;
use proctor_kernel::lanes::LaneChoice;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("rest", rest)
        .with("nothing moves, nothing is strained, for 100 000 steps")
        .must("no bit of the state changes"),
    Extreme::of("origin-1e6", || far(1e6))
        .with("the origin of the mesh lies 1e6 m from zero")
        .must("the same bits as at zero"),
    Extreme::of("origin-1e9", || far(1e9))
        .with("the origin of the mesh lies 1e9 m from zero")
        .must("the same bits as at zero"),
    Extreme::of("denormals", denormals)
        .with("velocities of 1e-310 m/s and stresses of 1e-310 Pa, with and without damping")
        .must("no NaN, momentum to the last denormal digit, positions keep their bits"),
    Extreme::of("same-bits", same)
        .with("other threads and lanes, particles in another order, a restart half way")
        .must("the same bits"),
];

/// Steps at rest of the default method; of the others a hundredth.
const AT_REST_FOR: u64 = 100_000;

/// Reason for which bits must be equal.
const ORDER: &str =
    "sums are formed in an order that the places of the particles decide, and nothing else";

/// A block of soft material, with a method.
fn soft_block(cells: usize, low: [f64; 2], high: [f64; 2], method: Method) -> Scene {
    with(&block([cells; 2], low, high, soft()), method)
}

fn rest() -> RowVerdict {
    let mut changed = gate("runs whose state changed")
        .none("without a force nothing may move, not even by round-off");
    for method in methods() {
        for law in [soft(), NeoHookean::new(YOUNG, POISSON).into()] {
            let mut scene = with(&block([4, 4], [1.1, 1.3], [2.1, 2.3], law), method);
            // A density whose reciprocal is not a number of the machine.
            scene.materials[0].density = 1234.5;
            let mut simulation = start(&scene, &options())?;
            let before = simulation.state_hash();
            let share = if method == Method::DEFAULT { 1 } else { 100 };
            steps(&mut simulation, AT_REST_FOR / share)?;
            changed.count(simulation.state_hash() != before);
        }
    }
    Ok(Finding::of([changed]))
}

/// Hash of a block with gravity and a rough start after some steps; corners are powers of two of a metre, so that they are
/// numbers of the machine at 1e9 m, too.
fn hash_at(distance: f64, method: Method) -> Result<u64> {
    let by = [distance, -distance, 0.0];
    let moved = |x: Vector| -> Vector { std::array::from_fn(|axis| x[axis] + by[axis]) };
    let mut scene = soft_block(12, [4.25, 5.5], [7.25, 8.0], method);
    scene.gravity = [1e-4, -2e-4, 0.0];
    scene.mesh.origin = moved(scene.mesh.origin);
    scene.bodies[0].shape = cuboid(moved([4.25, 5.5, 0.0]), moved([7.25, 8.0, 0.0]));
    let near = rough_state([0.01, 0.005, 0.0], 0.02, 0.01);
    let initial = from(move |x| near(&std::array::from_fn(|axis| x[axis] - by[axis])));
    Ok(after(&scene, &initial, count_of(method, 100))?.state_hash())
}

fn far(distance: f64) -> RowVerdict {
    let mut other = gate("methods with other bits than at zero")
        .none("positions are kept from the origin on, and all numbers of the scene are numbers of the machine there");
    for method in methods() {
        other.count(hash_at(distance, method)? != hash_at(0.0, method)?);
    }
    Ok(Finding::of([other]))
}

/// A velocity \[m/s\] and a stress \[Pa\] with few digits left.
const DENORMAL: f64 = 1e-310;

fn denormals() -> RowVerdict {
    let mut not_numbers =
        gate("particles with a value that is no number").none("small is not wrong");
    let mut moved = gate("particles that moved")
        .none("1e-310 m/s for 500 steps is less than the last digit of a position");
    // Each of 500 steps may round each of the nine nodal shares of a particle by one part in 2e13.
    let digits = 1e-310 / f64::from_bits(1);
    let mut off = gate("momentum lost over the sum of its magnitudes")
        .at_most(500.0 * 9.0 / digits, "a denormal 1e-310 has 4e-14 of itself as its last digit; 500 steps, nine nodes per particle");
    for method in METHODS {
        for damping in [Damping::None, Damping::Local { alpha: 0.5 }] {
            let scene = soft_block(8, [2.1, 2.3], [5.1, 5.3], method).with_damping(damping);
            let initial = rough([DENORMAL, 0.0, 0.0], DENORMAL, DENORMAL);
            let mut simulation = start(&scene, &initial)?;
            let before = particles(&simulation);
            let momentum = simulation.momentum();
            // Speeds are summed before they are multiplied, so that they keep their digits.
            let speed = |seen: &ParticleState| seen.velocity.iter().map(|c| c.abs()).sum::<f64>();
            let scale: f64 = before.iter().map(|seen| seen.mass * speed(seen)).sum();
            steps(&mut simulation, 500)?;
            for (old, new) in before.iter().zip(particles(&simulation)) {
                not_numbers.count(new.numbers().any(|x| !x.is_finite()));
                moved.count(old.position != new.position);
            }
            if damping == Damping::None {
                off.see(apart(&simulation.momentum(), &momentum) / scale);
            }
        }
    }
    Ok(Finding::of([not_numbers, moved, off]))
}

/// Places of the particles of a block, with their neighbours in order or not.
fn places(turned: bool) -> Vec<(Vector, f64)> {
    let along = |first, k| first + 0.5 * f64::from(k);
    let place = |k: i32| [along(3.3, k % 10), along(3.4, k / 10), 0.0];
    // 37 has no factor with 100 in common: every particle once.
    let number = |k: i32| if turned { (k * 37 + 11) % 100 } else { k };
    (0..100).map(|k| (place(number(k)), 0.25)).collect()
}

/// The state of all particles but for their numbers, in order of their places at the start.
fn by_place(simulation: &Simulation, places: &[(Vector, f64)]) -> Vec<Vec<u64>> {
    let mut seen = particles(simulation);
    seen.sort_by_key(|seen| places[seen.id as usize].0.map(f64::to_bits));
    let bits = |seen: &ParticleState| seen.numbers().map(f64::to_bits).collect();
    seen.iter().map(bits).collect()
}

fn same() -> RowVerdict {
    let other = |which: &str, reason| gate(format!("runs {which} with other bits")).none(reason);
    let mut threads = other("on two and three threads", ORDER);
    let mut lanes = other("without vector lanes", ORDER);
    let mut order = other("of particles in another order", ORDER);
    let whole = "the state after a step is all that the next one needs";
    let mut restart = other("that were restarted", whole);
    for method in methods() {
        let count = count_of(method, 60);
        let run = |scene: &Scene, options: &Options| after(scene, options, count);
        let options = || rough([0.04, 0.02, 0.0], 0.02, 0.01);
        let mut scene = soft_block(12, [3.0; 2], [8.0; 2], method);
        scene.bodies[0].shape = listed(places(false));
        let once = run(&scene, &options())?;
        let hash = once.state_hash();
        for several in [2, 3] {
            let mut more = options();
            (more.threads, more.least_share) = (Some(several), Some(1));
            threads.count(run(&scene, &more)?.state_hash() != hash);
        }
        let mut scalar = options();
        scalar.lanes = LaneChoice::Scalar;
        lanes.count(run(&scene, &scalar)?.state_hash() != hash);
        let mut turned = scene.clone();
        turned.bodies[0].shape = listed(places(true));
        let turned = run(&turned, &options())?;
        order.count(by_place(&turned, &places(true)) != by_place(&once, &places(false)));
        let mut first = start(&scene, &options())?;
        steps(&mut first, count / 2)?;
        let mut second = start(&scene, &from(|_| AT_REST))?;
        let restored = second.restore(first.save());
        restored.map_err(|e| unexpected(method, e))?;
        steps(&mut second, count - count / 2)?;
        restart.count(second.state_hash() != hash || second.steps() != count);
    }
    Ok(Finding::of([threads, lanes, order, restart]))
}
