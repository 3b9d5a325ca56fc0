//! Nodes of next to no mass, and bodies of next to no thickness.

use super::places::{reach, square};
use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("nodes-of-no-mass", nodes_of_no_mass)
        .with("nodes with 1e-12 of the mass of a full one")
        .must("no node faster than the particles, momentum to round-off, no energy from nowhere"),
    Extreme::of("slivers", slivers)
        .with("a block that fills a millionth of a cell at its edge, and a body that is a millionth of a cell thick")
        .must("free fall is exact, momentum stays, no energy from nowhere"),
];

/// Bodies left to themselves: energy over that at the start, and momentum over its scale.
struct Left([Gate; 2]);

impl Left {
    fn new() -> Self {
        Self([
            gate("highest energy over that at the start")
                .at_most(2.0)
                .because("none is given; kinetic energy that is half a step old and cell crossing may lend a factor of two, an unstable run doubles \
                     it again and again"),
            gate("momentum lost, over the sum of its magnitudes")
                .at_most(1e-13)
                .because("weights sum to one and their gradients to zero at each node, however light: only round-off of the steps is left"),
        ])
    }

    /// A run of 500 steps, with a method that has a safe step.
    fn alone(&mut self, scene: &Scene, initial: &Options, method: Method) -> Result<(), RowFault> {
        if !method.has_safe_step() {
            return Ok(());
        }
        let [grown, lost] = &mut self.0;
        let mut simulation = start(scene, initial)?;
        let (begin, momentum) = (energy(&simulation), simulation.momentum());
        let scale = scale_of_speeds(&simulation);
        for _ in 0..50 {
            steps(&mut simulation, 10)?;
            grown.see(energy(&simulation) / begin);
        }
        lost.see(apart(&simulation.momentum(), &momentum) / scale);
        trusted(&simulation)
    }
}

fn nodes_of_no_mass() -> RowVerdict {
    let mut left = Left::new();
    let mut lightest = gate("mass of the lightest node over that of a full one")
        .at_most(1e-12)
        .because("so that the scene is what it claims to be");
    let mut flip = gate("fastest node over fastest particle, components, FLIP")
        .at_most(1.0 + 1e-14)
        .because("the velocity of a node is a mean of those of its particles, however light it is");
    let mut affine = gate("fastest node over fastest particle, components, APIC and TPIC")
        .at_most(7.0)
        .because("a mean of v + grad v (x_I - x_p): a gradient of at most 2 v/h along each of two axes, over 1.5 cells");
    for method in methods() {
        // How far beyond the reach a particle has 1e-12 of itself on the next node.
        let beyond = match method.weighting {
            Weighting::Linear => 1e-12,
            Weighting::UniformGimp | Weighting::ContiguousGimp(_) => 1e-6,
            Weighting::QuadraticBSpline => 2.0_f64.sqrt() * 1e-6,
        };
        let first = 3.0 + reach(method.weighting) - beyond;
        let scene = square([first, 4.1], 5, method);
        // So slow that no place changes by a bit, and without stress: the first step shows what was mapped.
        let mut simulation = start(&scene, &rough([0.0; 3], 1e-20, 0.0))?;
        let fastest = largest(particles(&simulation).iter().flat_map(|seen| seen.velocity));
        steps(&mut simulation, 1)?;
        let nodes = simulation.node_values();
        let masses = nodes.iter().map(|node| node.mass);
        lightest.see(masses.fold(f64::INFINITY, f64::min));
        let calm = method.transfer == TransferKind::Flip;
        let speed = if calm { &mut flip } else { &mut affine };
        speed.see(largest(nodes.iter().flat_map(|node| node.velocity)) / fastest);
        left.alone(&scene, &rough([0.0; 3], 0.01, 0.0), method)?;
    }
    Ok(Finding::of([lightest, flip, affine]).and(left.0))
}

/// Thickness of a sliver \[cells\].
const SLIVER: f64 = 1e-6;

fn slivers() -> RowVerdict {
    let mut left = Left::new();
    let mut fall = gate("fall beside x + g t²/2, per step [m]")
        .at_most(4e-15)
        .because("each step rounds a coordinate below 16 m, whose last digit is 1.8e-15 m, and a velocity below it");
    for method in methods() {
        let body = |low, high| with(&block([12, 12], low, high, soft()), method);
        let edge = body([4.0, 4.0], [7.0 + SLIVER, 7.0 + SLIVER]);
        left.alone(&edge, &rough([0.0; 3], 0.01, 0.01), method)?;
        for scene in [edge, body([4.0, 8.0], [4.0 + SLIVER, 10.0])] {
            let mut simulation = start(&scene.with_gravity([0.0, -0.5]), &options())?;
            let mut exact = particles(&simulation);
            to_time(&mut simulation, 1.0)?;
            let t = simulation.time();
            for seen in &mut exact {
                seen.position[1] -= 0.25 * t * t;
            }
            let off = all_apart(&particles(&simulation), &exact, |seen| seen.position);
            fall.see(off / simulation.steps() as f64);
        }
    }
    Ok(Finding::of(left.0).and([fall]))
}
