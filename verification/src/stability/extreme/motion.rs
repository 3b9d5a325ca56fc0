//! Motions that are exact whatever the mesh does: uniform flight, and slow and fast bodies.

use super::prelude::*;
use proctor_scene::Field;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("translation", translation)
        .with("a block flies through nine cells along x and three along y")
        .must("the velocity stays to 1e-13 and no stress, no strain arises"),
    Extreme::of("wave-over-particle-speed", speeds)
        .with("waves from a millionth to ten times as fast as the body")
        .must("the flight is exact, momentum stays, energy within the body does not grow"),
];

/// Velocity of the flight \[m/s\], with waves of 1 m/s.
const FLIGHT: [f64; 3] = [0.9, 0.3, 0.0];

fn translation() -> RowVerdict {
    let gates = |whose: &str| {
        [
            gate(format!("velocity, relative, {whose}")).at_most(
                1e-13,
                "5d: 1e-13 of the speed, about 500 roundings of a weighted mean",
            ),
            gate(format!("position [m], {whose}")).at_most(
                1e-12,
                "each of some 50 to 2000 steps rounds a coordinate of 14 m to 1.8e-15 m",
            ),
            gate(format!("stress over E, {whose}")).at_most(
                1e-12,
                "5d: 1e-12 of E, the gradient of a uniform velocity is round-off",
            ),
            gate(format!("deformation gradient less unity, {whose}"))
                .at_most(1e-12, "a stress of 1e-12 E is a strain of 1e-12"),
        ]
    };
    let mut calm = gates("where light nodes are calm");
    let mut acting = gates("where light nodes act");
    for method in methods() {
        // Round-off at nodes of next to no mass reaches the particles undiminished, and a stiff body would multiply it: there
        // waves are a hundred times slower than the body, so that round-off shows, and is not multiplied.
        let acts = method.scheme == StressScheme::Usl || method.transfer != TransferKind::Flip;
        let young = if acts { 1e-4 * YOUNG } else { YOUNG };
        let law = elastic(young, 0.3);
        let mut scene = with(&block([16, 10], [1.23, 1.24], [4.23, 4.24], law), method);
        scene.bodies[0].velocity = FLIGHT;
        // The deformation gradient is kept where it is written.
        scene.results.print = 1;
        scene.results.fields = vec![Field::DeformationGradient];
        let (simulation, exact) = fallen(&scene, 10.0)?;
        let after = particles(&simulation);
        let [velocity, place, stress, strained] = if acts { &mut acting } else { &mut calm };
        velocity.see(all_apart(&after, &exact, |seen| seen.velocity) / FLIGHT[0]);
        place.see(all_apart(&after, &exact, |seen| seen.position));
        stress.see(largest_stress(&simulation) / young);
        strained.see(strain(&simulation));
    }
    Ok(Finding::of(calm).and(acting))
}

/// Largest component of F - 1.
fn strain(simulation: &Simulation) -> f64 {
    largest((0..simulation.particles()).flat_map(|p| {
        let f = simulation.deformation(0, p).unwrap_or([[f64::NAN; 3]; 3]);
        let of = move |a: usize, b: usize| f[a][b] - if a == b { 1.0 } else { 0.0 };
        (0..3).flat_map(move |a| (0..3).map(move |b| of(a, b)))
    }))
}

/// Energy of the particles beside that of the motion of their centre \[J\].
fn internal_energy(simulation: &Simulation) -> f64 {
    let mean = simulation.center(0).velocity;
    let relative = sum(simulation, |seen| {
        let squares = (0..3).map(|axis| (seen.velocity[axis] - mean[axis]).powi(2));
        0.5 * seen.mass * squares.sum::<f64>()
    });
    relative + simulation.strain_energy()
}

fn speeds() -> RowVerdict {
    let mut lost = gate("momentum lost, over the sum of its magnitudes")
        .at_most(1e-12, "weights sum to one and their gradients to zero, so that only round-off of up to 4000 steps is left");
    let mut drift = gate("centre beside momentum times time over mass [m]").at_most(
        1e-11,
        "the centre moves by the momentum alone; up to 4000 roundings of coordinates of 15 m",
    );
    let mut grown = gate("energy within the body over that at the start")
        .at_most(2.0, "none is given; one factor of two is what cell crossing may lend, an unstable run doubles it again and again");
    for method in METHODS {
        for ratio in [1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0] {
            // The body flies at 1 m/s.
            let young = YOUNG * ratio * ratio;
            let law = elastic(young, 0.3);
            let mut scene = with(&block([20, 10], [1.3, 3.2], [4.3, 6.2], law), method);
            scene.transfer.pic_fraction = 0.0;
            // A thousandth of the speed of the waves, so that strains are small.
            let initial = rough([1.0, 0.1, 0.0], 1e-3 * ratio, 1e-3 * young);
            let mut simulation = start(&scene, &initial)?;
            let (balance, body) = (Balance::of(&simulation), simulation.center(0));
            let mean = simulation.momentum().map(|p| p / body.mass);
            let energy = internal_energy(&simulation);
            // Up to ten cells.
            let mut highest = 0.0_f64;
            while simulation.time() < 10.0 {
                steps(&mut simulation, 1)?;
                if simulation.steps().is_multiple_of(16) {
                    highest = highest.max(internal_energy(&simulation));
                }
            }
            lost.see(balance.lost(&simulation));
            let (t, now) = (simulation.time(), simulation.center(0).position);
            for axis in 0..2 {
                drift.see((now[axis] - body.position[axis] - mean[axis] * t).abs());
            }
            // What round-off of velocities of 1 m/s is worth.
            let least = body.mass * f64::EPSILON * f64::EPSILON * simulation.steps() as f64;
            grown.see(highest / (energy + least));
            trusted(&simulation)?;
        }
    }
    Ok(Finding::of([lost, drift, grown]))
}
