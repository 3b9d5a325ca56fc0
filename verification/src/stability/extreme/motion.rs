//! Motions that are exact whatever the mesh does: uniform flight, and slow and fast bodies.

use proctor_scene::simulation::Simulation;
use proctor_scene::{Dimension, Field, StressScheme, TransferKind};

use super::runs::{
    YOUNG, apart, block, from, largest, methods, momentum_scale, options, particles, rough, start,
    steps, to_time, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::elastic_law;
use crate::settings::Method;
use crate::stability::nonlinear::METHODS;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "translation",
        what: "a block flies through nine cells along x and three along y",
        required: "the velocity stays to 1e-13 and no stress, no strain arises",
        cause: None,
        judge: translation,
    },
    Extreme {
        name: "wave-over-particle-speed",
        what: "waves from a millionth to ten times as fast as the body",
        required: "the flight is exact, momentum stays, energy within the body does not grow",
        cause: None,
        judge: speeds,
    },
];

/// Velocity of the flight \[m/s\], with waves of 1 m/s.
const FLIGHT: [f64; 3] = [0.9, 0.3, 0.0];
/// Largest speed of it.
const SPEED: f64 = 0.9;

/// Whether round-off at nodes of next to no mass reaches the particles undiminished, so that a stiff body multiplies it.
fn light_nodes_act(method: Method) -> bool {
    method.scheme == StressScheme::Usl || method.transfer != TransferKind::Flip
}

fn translation() -> Result<Finding, Unexpected> {
    let mut worst = [[0.0_f64; 4]; 2];
    for method in methods() {
        let acts = usize::from(light_nodes_act(method));
        // Waves a hundred times slower than the body where light nodes act: round-off shows, and is not multiplied.
        let young = if acts == 1 { 1e-4 * YOUNG } else { YOUNG };
        let law = elastic_law(young, 0.3);
        let mut scene = with(&block([16, 10], [1.23, 1.24], [4.23, 4.24], law), method);
        scene.bodies[0].velocity = FLIGHT;
        // The deformation gradient is kept where it is written.
        scene.results.print = 1;
        scene.results.fields = vec![Field::DeformationGradient];
        let what = method.to_string();
        let mut simulation = start(&what, &scene, &options())?;
        let before = particles(&simulation);
        to_time(&what, &mut simulation, 10.0)?;
        let after = particles(&simulation);
        let exact = before.iter().map(|seen| {
            let t = simulation.time();
            std::array::from_fn(|axis| seen.position[axis] + FLIGHT[axis] * t)
        });
        let exact: Vec<[f64; 3]> = exact.collect();
        let seen = [
            apart(
                after.iter().map(|s| &s.velocity),
                after.iter().map(|_| &FLIGHT),
            ) / SPEED,
            apart(after.iter().map(|s| &s.position), &exact),
            largest(after.iter().flat_map(|s| s.stress)) / young,
            strain(&simulation),
        ];
        for (worst, seen) in worst[acts].iter_mut().zip(seen) {
            *worst = worst.max(seen);
        }
    }
    let bounds = [
        (
            "velocity, relative",
            1e-13,
            "5d: 1e-13 of the speed, about 500 roundings of a weighted mean",
        ),
        (
            "position [m]",
            1e-12,
            "each of some 50 to 2000 steps rounds a coordinate of 14 m to 1.8e-15 m",
        ),
        (
            "stress over E",
            1e-12,
            "5d: 1e-12 of E, the gradient of a uniform velocity is round-off",
        ),
        (
            "deformation gradient less unity",
            1e-12,
            "a stress of 1e-12 E is a strain of 1e-12",
        ),
    ];
    let whose = ["where light nodes are calm", "where light nodes act"];
    let gates = whose.iter().zip(worst).flat_map(|(whose, worst)| {
        bounds
            .iter()
            .zip(worst)
            .map(move |((what, bound, reason), worst)| {
                Gate::at_most(format!("{what}, {whose}"), worst, *bound, reason)
            })
    });
    Ok(Finding {
        gates: gates.collect(),
        refusals: vec![],
    })
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
    let set = &simulation.sets()[0];
    let kinetic: f64 = (0..set.len())
        .map(|p| {
            let mass = simulation.particle_mass(0, p);
            let v = set.velocity(p);
            0.5 * mass
                * (0..3)
                    .map(|axis| (v[axis] - mean[axis]).powi(2))
                    .sum::<f64>()
        })
        .sum();
    kinetic + simulation.strain_energy()
}

fn speeds() -> Result<Finding, Unexpected> {
    // Of the momentum, the centre [cells], energy within over that at the start.
    let mut worst = [0.0_f64; 3];
    let mut doubted = vec![];
    for method in METHODS {
        for ratio in [1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0] {
            let what = format!("{method}, waves {ratio:e} of the speed");
            // The body flies at 1 m/s.
            let young = YOUNG * ratio * ratio;
            let mut scene = with(
                &block([20, 10], [1.3, 3.2], [4.3, 6.2], elastic_law(young, 0.3)),
                method,
            );
            scene.transfer.pic_fraction = 0.0;
            // A thousandth of the speed of the waves, so that strains are small.
            let initial = rough(Dimension::Two, [1.0, 0.1, 0.0], 1e-3 * ratio, 1e-3 * young);
            let mut simulation = start(&what, &scene, &from(initial))?;
            let (momentum, scale) = (simulation.momentum(), momentum_scale(&simulation));
            let body = simulation.center(0);
            let (mass, center) = (body.mass, body.position);
            let energy = internal_energy(&simulation);
            // Up to ten cells.
            let mut highest = 0.0_f64;
            while simulation.time() < 10.0 {
                steps(&what, &mut simulation, 1)?;
                if simulation.steps().is_multiple_of(16) {
                    highest = highest.max(internal_energy(&simulation));
                }
            }
            let t = simulation.time();
            let after = simulation.center(0).position;
            let drift =
                largest((0..2).map(|axis| after[axis] - center[axis] - momentum[axis] / mass * t));
            let lost = largest((0..2).map(|axis| simulation.momentum()[axis] - momentum[axis]));
            // What round-off of velocities of 1 m/s is worth.
            let least = mass * f64::EPSILON * f64::EPSILON * simulation.steps() as f64;
            let seen = [lost / scale, drift, highest / (energy + least)];
            for (worst, seen) in worst.iter_mut().zip(seen) {
                *worst = if seen.is_nan() {
                    f64::INFINITY
                } else {
                    worst.max(seen)
                };
            }
            if let Some(violation) = simulation.invariants().violation {
                doubted.push(format!("{what}: {violation}"));
            }
        }
    }
    if let Some(violation) = doubted.first() {
        return Err(super::runs::unexpected("a sound run is doubted", violation));
    }
    let [momentum, center, energy] = worst;
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                "momentum lost, over the sum of its magnitudes".to_owned(),
                momentum,
                1e-12,
                "weights sum to one and their gradients to zero, so that only round-off of up to 4000 steps is left",
            ),
            Gate::at_most(
                "centre beside momentum times time over mass [m]".to_owned(),
                center,
                1e-11,
                "the centre moves by the momentum alone; up to 4000 roundings of coordinates of 15 m",
            ),
            Gate::at_most(
                "energy within the body over that at the start".to_owned(),
                energy,
                2.0,
                "none is given; one factor of two is what cell crossing may lend, an unstable run doubles it again and again",
            ),
        ],
        refusals: vec![],
    })
}
