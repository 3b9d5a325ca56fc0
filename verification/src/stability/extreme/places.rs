//! Particles and edges exactly on nodes and a hair's breadth beside them, nodes of next to no mass, and bodies of next to no
//! thickness.

use super::prelude::*;
use proctor_scene::simulation::NodeValues;

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
    Extreme::of("nodes-of-no-mass", nodes_of_no_mass)
        .with("nodes with 1e-12 of the mass of a full one")
        .must("no node faster than the particles, momentum to round-off, no energy from nowhere"),
    Extreme::of("slivers", slivers)
        .with("a block that fills a millionth of a cell at its edge, and a body that is a millionth of a cell thick")
        .must("free fall is exact, momentum stays, no energy from nowhere"),
];

/// Half-length of a particle with two per cell and axis \[m\], a number of the machine.
const HALF: f64 = 0.25;

/// Farthest node that a particle reaches along an axis \[m\].
fn reach(weighting: Weighting) -> f64 {
    match weighting {
        Weighting::Linear => 1.0,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_) => 1.0 + HALF,
        Weighting::QuadraticBSpline => 1.5,
    }
}

/// Edge of the mesh \[m\].
const EXTENT: f64 = 12.0;

/// A square of particles, `count` per axis, the first at `first` \[m\].
fn square(first: [f64; 2], count: u32, method: Method) -> Scene {
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
    use PlaneCondition::{Fixed, Free, Sliding};
    let mut unity =
        gate("sum of the weights less one").at_most(4.5e-16, "5d: 4e-16, two last digits of one");
    let mut at_edge = gate("the same on the boundary planes of the mesh, free, sliding and fixed")
        .at_most(
            4.5e-16,
            "5d: 4e-16; the region beyond a plane with a condition is folded back",
        );
    let mut place = gate("weighted mean of the nodes' places less that of the particle [cells]")
        .at_most(
            2e-15,
            "nine weights with an error of 2e-16 each, at most one and a half cells away",
        );
    let mut gradients = ["smooth", "linear"].map(|whose| {
        gate(format!("sum of the gradients of {whose} functions, by the force of a particle on itself [1/cell]"))
            .at_most(4e-15, "three by three gradients of at most one per cell, each with an error of 2e-16, of two stresses")
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
                let moment = |node: &NodeValues| node.mass * (node.position[axis] - x);
                place.see((nodes.iter().map(moment).sum::<f64>() / mass).abs());
            }
            // A particle alone feels its own stress by the sum of the gradients.
            gradient.see(fastest(&simulation) / (dt * STRESS));
        }
        for plane in [Free, Sliding, Fixed] {
            for x in [0.0, 0.0_f64.next_up(), EXTENT, EXTENT.next_down()] {
                let scene = square([x, 5.0], 1, method).with_planes(plane);
                at_edge.see(off_unity(&after(&scene, &options(), 1)?));
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
fn change(first: [f64; 2], method: Method, count: u64) -> Result<f64> {
    let run = |first: [f64; 2]| -> Result<Vec<ParticleState>> {
        let simulation = after(&square(first, 5, method), &from(smooth), count)?;
        Ok(particles(&simulation))
    };
    let here = run(first)?;
    let [[x, right, left], [y, above, below]] = first.map(beside);
    let mut most = 0.0;
    for moved in [[right, y], [left, y], [x, above], [x, below]] {
        let there = run(moved)?;
        most = worst(most, all_apart(&here, &there, |seen| seen.velocity) / START);
        most = worst(most, all_apart(&here, &there, |seen| seen.stress) / START);
        most = worst(most, all_apart(&here, &there, |seen| seen.position));
    }
    Ok(most)
}

/// Reason for which an ulp may not matter.
const CONTINUOUS: &str = "functions and gradients are continuous: an ulp of 9e-16 of a cell is multiplied by slopes of a few per \
                          cell; 5d: 1e-12";

fn on_nodes() -> RowVerdict {
    let mut smooth = gate("smooth functions, particles on nodes").at_most(1e-12, CONTINUOUS);
    let mut linear = gate("linear functions, particles a quarter of a cell beside nodes").at_most(
        1e-12,
        "on a node their gradient jumps, which is theirs; beside it they are smooth",
    );
    for method in methods() {
        // Particles on nodes and half way, or on faces only. The block does not end where its functions do.
        let (offset, gate) = match method.weighting {
            Weighting::Linear => (3.75, &mut linear),
            _ => (4.0, &mut smooth),
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
        let method = Method::DEFAULT.with_scheme(scheme).with_transfer(transfer);
        let (scheme, transfer) = (method.scheme_word(), method.transfer_word());
        let mut changed =
            gate(format!("{scheme} {transfer}: change by an ulp")).at_most(1e-12, CONTINUOUS);
        // The gradient of linear functions jumps there.
        for weighting in SAFE {
            // The node 3 is reached by nothing, or by an ulp.
            let first = [3.0 + reach(weighting), 4.1];
            changed.see(change(first, method.with_weighting(weighting), 5)?);
        }
        gates.push(changed);
    }
    Ok(Finding::of(gates))
}

/// Gates of free bodies that begin with noise of 0.01 m/s and a stress of noise \[Pa\], with methods that have a safe step.
fn left_alone(scenes: &[Scene], stress: f64) -> Result<[Gate; 2]> {
    let mut grown = gate("highest energy over that at the start")
        .at_most(2.0, "none is given; kinetic energy that is half a step old and cell crossing may lend a factor of two, an unstable run doubles \
                 it again and again");
    let mut lost = gate("momentum lost, over the sum of its magnitudes")
        .at_most(1e-13, "weights sum to one and their gradients to zero at each node, however light: only round-off of the steps is left");
    for scene in scenes
        .iter()
        .filter(|scene| method_of(scene).has_safe_step())
    {
        let mut simulation = start(scene, &rough([0.0; 3], 0.01, stress))?;
        let balance = Balance::of(&simulation);
        for _ in 0..50 {
            steps(&mut simulation, 10)?;
            grown.see(balance.grown(&simulation));
        }
        lost.see(balance.lost(&simulation));
        trusted(&simulation)?;
    }
    Ok([grown, lost])
}

fn nodes_of_no_mass() -> RowVerdict {
    let mut scenes = vec![];
    let mut lightest = gate("mass of the lightest node over that of a full one")
        .at_most(1e-12, "so that the scene is what it claims to be");
    let mut flip = gate("fastest node over fastest particle, components, FLIP").at_most(
        1.0 + 1e-14,
        "the velocity of a node is a mean of those of its particles, however light it is",
    );
    let mut affine = gate("fastest node over fastest particle, components, APIC and TPIC")
        .at_most(7.0, "a mean of v + grad v (x_I - x_p): a gradient of at most 2 v/h along each of two axes, over 1.5 cells");
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
        let before = fastest(&simulation);
        steps(&mut simulation, 1)?;
        let nodes = simulation.node_values();
        let masses = nodes.iter().map(|node| node.mass);
        lightest.see(masses.fold(f64::INFINITY, f64::min));
        let calm = method.transfer == TransferKind::Flip;
        let speed = if calm { &mut flip } else { &mut affine };
        speed.see(largest(nodes.iter().flat_map(|node| node.velocity)) / before);
        scenes.push(scene);
    }
    Ok(Finding::of([lightest, flip, affine]).and(left_alone(&scenes, 0.0)?))
}

/// Thickness of a sliver \[cells\].
const SLIVER: f64 = 1e-6;

fn slivers() -> RowVerdict {
    let mut edges = vec![];
    let mut fall = gate("fall beside x + g t²/2, per step [m]")
        .at_most(4e-15, "each step rounds a coordinate below 16 m, whose last digit is 1.8e-15 m, and a velocity below it");
    for method in methods() {
        let body = |low, high| with(&block([12, 12], low, high, soft()), method);
        let edge = body([4.0, 4.0], [7.0 + SLIVER, 7.0 + SLIVER]);
        edges.push(edge.clone());
        for scene in [edge, body([4.0, 8.0], [4.0 + SLIVER, 10.0])] {
            let (simulation, exact) = fallen(&scene.with_gravity([0.0, -0.5]), 1.0)?;
            let off = all_apart(&particles(&simulation), &exact, |seen| seen.position);
            fall.see(off / simulation.steps() as f64);
        }
    }
    Ok(Finding::of(left_alone(&edges, 0.01)?).and([fall]))
}
