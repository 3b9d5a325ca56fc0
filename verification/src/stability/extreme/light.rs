//! Nodes of next to no mass, and bodies of next to no thickness.

use proctor_scene::simulation::{InitialField, Simulation};
use proctor_scene::{Dimension, Scene, TransferKind, Weighting};

use super::places::{reach, square};
use super::runs::{
    apart, block, from, largest, methods, momentum_scale, options, particles, rough, soft, start,
    steps, to_time, unexpected, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "nodes-of-no-mass",
        what: "nodes with 1e-12 of the mass of a full one",
        required: "no node faster than the particles, momentum to round-off, no energy from nowhere",
        cause: None,
        judge: nodes_of_no_mass,
    },
    Extreme {
        name: "slivers",
        what: "a block that fills a millionth of a cell at its edge, and a body that is a millionth of a cell thick",
        required: "free fall is exact, momentum stays, no energy from nowhere",
        cause: None,
        judge: slivers,
    },
];

/// Energy over what was given, momentum over its scale, whether the run is doubted: of a body left to itself.
struct Left {
    energy: f64,
    momentum: f64,
    violation: Option<String>,
}

fn leave_alone(
    what: &str,
    scene: &Scene,
    initial: InitialField,
    count: u64,
) -> Result<Left, Unexpected> {
    let mut simulation = start(what, scene, &from(initial))?;
    let energy = |s: &Simulation| s.kinetic_energy() + s.strain_energy();
    let (begin, momentum, scale) = (
        energy(&simulation),
        simulation.momentum(),
        momentum_scale(&simulation),
    );
    let mut highest = 0.0_f64;
    for _ in 0..count / 10 {
        steps(what, &mut simulation, 10)?;
        highest = largest([highest, energy(&simulation)]);
    }
    let lost = (0..2).map(|axis| simulation.momentum()[axis] - momentum[axis]);
    Ok(Left {
        energy: highest / begin,
        momentum: largest(lost) / scale,
        violation: simulation
            .invariants()
            .violation
            .map(|violation| format!("{what}: {violation}")),
    })
}

/// Why energy and momentum must hold.
const GIVEN: &str = "none is given; kinetic energy that is half a step old and cell crossing may lend a factor of two, an unstable run doubles \
     it again and again";
const KEPT: &str = "weights sum to one and their gradients to zero at each node, however light: only round-off of the steps is left";

fn nodes_of_no_mass() -> Result<Finding, Unexpected> {
    let (mut lightest, mut speeds) = (0.0_f64, [0.0_f64; 2]);
    let (mut energy, mut momentum) = (0.0_f64, 0.0_f64);
    let mut doubts = vec![];
    for method in methods() {
        let what = method.to_string();
        // How far beyond the reach a particle has 1e-12 of itself on the next node.
        let beyond = match method.weighting {
            Weighting::Linear => 1e-12,
            Weighting::UniformGimp | Weighting::ContiguousGimp(_) => 1e-6,
            Weighting::QuadraticBSpline => 2.0_f64.sqrt() * 1e-6,
        };
        let first = 3.0 + reach(method.weighting) - beyond;
        let scene = square([first, 4.1], 5, method);
        // So slow that no place changes by a bit, and without stress: the first step shows what was mapped.
        let slow = rough(Dimension::Two, [0.0; 3], 1e-20, 0.0);
        let mut simulation = start(&what, &scene, &from(slow))?;
        let fastest = largest(particles(&simulation).iter().flat_map(|seen| seen.velocity));
        steps(&what, &mut simulation, 1)?;
        let nodes = simulation.node_values();
        let least = nodes
            .iter()
            .map(|node| node.mass)
            .fold(f64::INFINITY, f64::min);
        lightest = lightest.max(least);
        let speed = &mut speeds[usize::from(method.transfer != TransferKind::Flip)];
        *speed = speed.max(largest(nodes.iter().flat_map(|node| node.velocity)) / fastest);
        if method.has_safe_step() {
            let left = leave_alone(
                &what,
                &scene,
                rough(Dimension::Two, [0.0; 3], 0.01, 0.0),
                500,
            )?;
            energy = energy.max(left.energy);
            momentum = momentum.max(left.momentum);
            doubts.extend(left.violation);
        }
    }
    if let Some(violation) = doubts.first() {
        return Err(unexpected("a sound run is doubted", violation));
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                "mass of the lightest node over that of a full one".to_owned(),
                lightest,
                1e-12,
                "so that the scene is what it is said to be",
            ),
            Gate::at_most(
                "fastest node over fastest particle, components, FLIP".to_owned(),
                speeds[0],
                1.0 + 1e-14,
                "the velocity of a node is a mean of those of its particles, however light it is",
            ),
            Gate::at_most(
                "fastest node over fastest particle, components, APIC and TPIC".to_owned(),
                speeds[1],
                7.0,
                "a mean of v + grad v (x_I - x_p): a gradient of at most 2 v/h along each of two axes, over 1.5 cells",
            ),
            Gate::at_most(
                "highest energy over that at the start".to_owned(),
                energy,
                2.0,
                GIVEN,
            ),
            Gate::at_most(
                "momentum lost, over the sum of its magnitudes".to_owned(),
                momentum,
                1e-13,
                KEPT,
            ),
        ],
        refusals: vec![],
    })
}

/// Thickness of a sliver \[cells\].
const SLIVER: f64 = 1e-6;

fn slivers() -> Result<Finding, Unexpected> {
    let (mut energy, mut momentum, mut fall) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut doubts = vec![];
    for method in methods() {
        let what = method.to_string();
        let edge = with(
            &block([12, 12], [4.0, 4.0], [7.0 + SLIVER, 7.0 + SLIVER], soft()),
            method,
        );
        if method.has_safe_step() {
            let left = leave_alone(
                &what,
                &edge,
                rough(Dimension::Two, [0.0; 3], 0.01, 0.01),
                500,
            )?;
            energy = energy.max(left.energy);
            momentum = momentum.max(left.momentum);
            doubts.extend(left.violation);
        }
        let alone = with(
            &block([12, 12], [4.0, 8.0], [4.0 + SLIVER, 10.0], soft()),
            method,
        );
        for mut scene in [edge, alone] {
            scene.gravity = [0.0, -0.5, 0.0];
            let mut simulation = start(&what, &scene, &options())?;
            let before = particles(&simulation);
            to_time(&what, &mut simulation, 1.0)?;
            let t = simulation.time();
            let exact: Vec<[f64; 3]> = before
                .iter()
                .map(|seen| [seen.position[0], seen.position[1] - 0.25 * t * t, 0.0])
                .collect();
            let after = particles(&simulation);
            fall = fall.max(
                apart(after.iter().map(|seen| &seen.position), &exact) / simulation.steps() as f64,
            );
        }
    }
    if let Some(violation) = doubts.first() {
        return Err(unexpected("a sound run is doubted", violation));
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                "highest energy over that at the start".to_owned(),
                energy,
                2.0,
                GIVEN,
            ),
            Gate::at_most(
                "momentum lost, over the sum of its magnitudes".to_owned(),
                momentum,
                1e-13,
                KEPT,
            ),
            Gate::at_most(
                "fall beside x + g t²/2, per step [m]".to_owned(),
                fall,
                4e-15,
                "each step rounds a coordinate below 16 m, whose last digit is 1.8e-15 m, and a velocity below it",
            ),
        ],
        refusals: vec![],
    })
}
