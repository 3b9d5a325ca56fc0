//! Particles and edges exactly on nodes, and a hair's breadth beside them.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("one-particle-on-node", one_particle)
        .with("a single particle exactly on a node, a face, with its edge on a node, and an ulp beside")
        .must("weights sum to one, their gradients to zero, to 4e-16"),
    Extreme::of("particles-on-nodes", on_nodes)
        .with("a block whose particles lie exactly on nodes and faces, and an ulp beside")
        .must("an ulp changes the result by less than 1e-12"),
    Extreme::of("edge-on-node", edge_on_node)
        .with("a block that ends exactly at a node, and an ulp beyond")
        .must("an ulp changes the result by less than 1e-12"),
];

/// Half-length of a particle with two per cell and axis \[m\], a number of the machine.
const HALF: f64 = 0.25;

/// Farthest node that a particle reaches along an axis \[m\].
pub fn reach(weighting: Weighting) -> f64 {
    match weighting {
        Weighting::Linear => 1.0,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) => 1.0 + HALF,
        Weighting::QuadraticBSpline => 1.5,
    }
}

/// Edge of the mesh \[m\].
const EXTENT: f64 = 12.0;

/// A square of particles, `count` per axis, the first at `first` \[m\].
pub fn square(first: [f64; 2], count: u32, method: Method) -> Scene {
    let along = |k: u32, axis: usize| first[axis] + 2.0 * HALF * f64::from(k);
    let places = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
    let seeds = places.map(|(i, j)| ([along(i, 0), along(j, 1), 0.0], 4.0 * HALF * HALF));
    with(&alone([EXTENT as usize; 2], listed(seeds), soft()), method)
}

/// A place, and the numbers next to it on both sides.
fn beside(x: f64) -> [f64; 3] {
    [x, x.next_up(), x.next_down()]
}

/// A stress so small that no place changes by a bit \[Pa\]: what is found is linear in it.
const STRESS: f64 = 1e-30;

/// Sum of the masses of the nodes over that of the particles, less one.
fn off_unity(simulation: &Simulation) -> f64 {
    let sum: f64 = simulation.node_values().iter().map(|node| node.mass).sum();
    (sum / simulation.mass() - 1.0).abs()
}

fn one_particle() -> RowVerdict {
    let mut unity = gate("sum of the weights less one")
        .at_most(4.5e-16)
        .because("5d: 4e-16, two last digits of one");
    let mut at_edge = gate("the same on the boundary planes of the mesh, free, sliding and fixed")
        .at_most(4.5e-16)
        .because("5d: 4e-16; the region beyond a plane with a condition is folded back");
    let mut place = gate("weighted mean of the nodes' places less that of the particle [cells]")
        .at_most(2e-15)
        .because("nine weights with an error of 2e-16 each, at most one and a half cells away");
    let mut gradients = ["smooth", "linear"].map(|whose| {
        gate(format!("sum of the gradients of {whose} functions, by the force of a particle on itself [1/cell]"))
            .at_most(4e-15)
            .because("three by three gradients of at most one per cell, each with an error of 2e-16, of two stresses")
    });
    let initial = stressed(|_| [STRESS, -STRESS, 0.0, 0.0, 0.0, 0.5 * STRESS]);
    for method in methods() {
        let gradient = &mut gradients[usize::from(method.weighting == Weighting::Linear)];
        // On a node, in the middle of a cell, and with its own reach at a node.
        let reach = reach(method.weighting);
        let all = [5.0, 5.5, 4.0 + reach, 6.0 - reach]
            .into_iter()
            .flat_map(beside);
        for [x, y] in all.flat_map(|x| [5.0, 5.3].map(|y| [x, y])) {
            let mut simulation = start(&square([x, y], 1, method), &initial)?;
            let mass = simulation.mass();
            let dt = step(&mut simulation, NEVER)?.dt;
            unity.see(off_unity(&simulation));
            let nodes = simulation.node_values();
            for (axis, x) in [x, y].into_iter().enumerate() {
                let moments = nodes
                    .iter()
                    .map(|node| node.mass * (node.position[axis] - x));
                place.see((moments.sum::<f64>() / mass).abs());
            }
            // A particle alone feels its own stress by the sum of the gradients.
            let speed = largest(particles(&simulation).iter().flat_map(|seen| seen.velocity));
            gradient.see(speed / (dt * STRESS));
        }
        for plane in [
            PlaneCondition::Free,
            PlaneCondition::Sliding,
            PlaneCondition::Fixed,
        ] {
            for x in [0.0, 0.0_f64.next_up(), EXTENT, EXTENT.next_down()] {
                let scene = square([x, 5.0], 1, method).with_planes(plane);
                let mut simulation = start(&scene, &options())?;
                steps(&mut simulation, 1)?;
                at_edge.see(off_unity(&simulation));
            }
        }
    }
    Ok(Finding::of([unity, at_edge, place]).and(gradients))
}

/// Velocity \[m/s\] and stress \[Pa\] of the start, smooth in space.
const START: f64 = 0.01;

fn smooth(x: &Vector) -> InitialState {
    let (a, b) = (x[0] - 5.0, x[1] - 5.0);
    let velocity = [START * (a + 0.3 * b * b), START * (0.5 * a - b), 0.0];
    let gradient = [
        [START, 0.6 * START * b, 0.0],
        [0.5 * START, -START, 0.0],
        [0.0; 3],
    ];
    InitialState {
        stress: [START * a, START * b, 0.0, 0.0, 0.0, START * a * b],
        ..moving(velocity, gradient)
    }
}

/// Largest change of velocity, stress and way after some steps, over their scales, where a block is moved along x or y by an
/// ulp to either side.
fn change(first: [f64; 2], method: Method, count: u64) -> Result<f64, RowFault> {
    let run = |first: [f64; 2]| -> Result<Vec<ParticleState>, RowFault> {
        let mut simulation = start(&square(first, 5, method), &from(smooth))?;
        steps(&mut simulation, count)?;
        Ok(particles(&simulation))
    };
    let here = run(first)?;
    let mut most = 0.0;
    for axis in 0..2 {
        for x in &beside(first[axis])[1..] {
            let mut moved = first;
            moved[axis] = *x;
            let there = run(moved)?;
            most = worst(most, all_apart(&here, &there, |seen| seen.velocity) / START);
            most = worst(most, all_apart(&here, &there, |seen| seen.stress) / START);
            most = worst(most, all_apart(&here, &there, |seen| seen.position));
        }
    }
    Ok(most)
}

/// Reason for which an ulp may not matter.
const CONTINUOUS: &str = "functions and gradients are continuous: an ulp of 9e-16 of a cell is multiplied by slopes of a few per \
                          cell; 5d: 1e-12";

fn on_nodes() -> RowVerdict {
    let mut smooth = gate("smooth functions, particles on nodes")
        .at_most(1e-12)
        .because(CONTINUOUS);
    let mut linear = gate("linear functions, particles a quarter of a cell beside nodes")
        .at_most(1e-12)
        .because("on a node their gradient jumps, which is theirs; beside it they are smooth");
    for method in methods() {
        // Particles on nodes and half way, or on faces only. The block does not end where its functions do.
        let jumps = method.weighting == Weighting::Linear;
        let (offset, gate) = if jumps {
            (3.75, &mut linear)
        } else {
            (4.0, &mut smooth)
        };
        for y in [offset, 4.1] {
            gate.see(change([offset, y], method, count_of(method, 5))?);
        }
    }
    Ok(Finding::of([smooth, linear]))
}

fn edge_on_node() -> RowVerdict {
    let mut gates = vec![];
    for (scheme, transfer) in SCHEMES.into_iter().flat_map(|s| TRANSFERS.map(|t| (s, t))) {
        let of = |weighting| Method {
            weighting,
            scheme,
            transfer,
        };
        let method = of(Weighting::UniformGimp);
        let (scheme, transfer) = (method.scheme_word(), method.transfer_word());
        let mut changed = gate(format!("{scheme} {transfer}: change by an ulp"))
            .at_most(1e-12)
            .because(CONTINUOUS);
        // The gradient of linear functions jumps there.
        for weighting in SAFE {
            // The node 3 is reached by nothing, or by an ulp.
            changed.see(change([3.0 + reach(weighting), 4.1], of(weighting), 5)?);
        }
        gates.push(changed);
    }
    Ok(Finding::of(gates))
}
