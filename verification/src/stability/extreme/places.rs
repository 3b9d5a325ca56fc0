//! Particles and edges exactly on nodes, and a hair's breadth beside them.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{Dimension, ParticleSeed, PlaneCondition, Scene, Shape, Weighting};

use super::runs::{
    NEVER, Seen, apart, count_of, filled, from, largest, methods, open, options, particles, soft,
    start, steps, unexpected, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::settings::Method;
use crate::stability::map::{SCHEMES, TRANSFERS, WEIGHTINGS};

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "one-particle-on-node",
        what: "a single particle exactly on a node, a face, with its edge on a node, and an ulp beside",
        required: "weights sum to one, their gradients to zero, to 4e-16",
        cause: None,
        judge: one_particle,
    },
    Extreme {
        name: "particles-on-nodes",
        what: "a block whose particles lie exactly on nodes and faces, and an ulp beside",
        required: "an ulp changes the result by less than 1e-12",
        cause: None,
        judge: on_nodes,
    },
    Extreme {
        name: "edge-on-node",
        what: "a block that ends exactly at a node, and an ulp beyond",
        required: "an ulp changes the result by less than 1e-12",
        cause: None,
        judge: edge_on_node,
    },
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
    let mut seeds = vec![];
    for i in 0..count {
        for j in 0..count {
            let along = |k: u32, axis: usize| first[axis] + 2.0 * HALF * f64::from(k);
            seeds.push(ParticleSeed {
                position: [along(i, 0), along(j, 1), 0.0],
                volume: 4.0 * HALF * HALF,
            });
        }
    }
    let mut scene = open(Dimension::Two, [EXTENT as usize; 3], soft());
    scene.bodies = vec![filled(Dimension::Two, 1, Shape::Particles(Arc::new(seeds)))];
    with(&scene, method)
}

/// A place, and the numbers next to it on both sides.
fn beside(x: f64) -> [f64; 3] {
    [x, x.next_up(), x.next_down()]
}

/// A stress so small that no place changes by a bit \[Pa\]: what is found is linear in it.
const STRESS: f64 = 1e-30;

fn one_particle() -> Result<Finding, Unexpected> {
    let (mut unity, mut place, mut gradients) = (0.0_f64, 0.0_f64, [0.0_f64; 2]);
    for method in methods() {
        // On a node, in the middle of a cell, and with its own reach at a node.
        let reach = reach(method.weighting);
        for at in [5.0, 5.5, 4.0 + reach, 6.0 - reach] {
            for x in beside(at) {
                for y in [5.0, 5.3] {
                    let what = format!("{method} at {x:?}, {y}");
                    let scene = square([x, y], 1, method);
                    let initial: InitialField = Arc::new(|_| InitialState {
                        stress: [STRESS, -STRESS, 0.0, 0.0, 0.0, 0.5 * STRESS],
                        ..AT_REST
                    });
                    let mut simulation = start(&what, &scene, &from(initial))?;
                    let mass = simulation.mass();
                    let info = simulation.step(NEVER).map_err(|e| unexpected(&what, e))?;
                    let nodes = simulation.node_values();
                    let sum: f64 = nodes.iter().map(|node| node.mass).sum();
                    unity = unity.max((sum / mass - 1.0).abs());
                    for (axis, x) in [x, y].into_iter().enumerate() {
                        let moment: f64 = nodes
                            .iter()
                            .map(|node| node.mass * (node.position[axis] - x))
                            .sum();
                        place = place.max((moment / mass).abs());
                    }
                    // A particle alone feels its own stress by the sum of the gradients.
                    let speed =
                        largest(particles(&simulation).iter().flat_map(|seen| seen.velocity));
                    let gradient =
                        &mut gradients[usize::from(method.weighting == Weighting::Linear)];
                    *gradient = gradient.max(speed / (info.dt * STRESS));
                }
            }
        }
    }
    let mut at_edge = 0.0_f64;
    for method in methods() {
        for plane in [
            PlaneCondition::Free,
            PlaneCondition::Sliding,
            PlaneCondition::Fixed,
        ] {
            for x in [0.0, 0.0_f64.next_up(), EXTENT, EXTENT.next_down()] {
                let what = format!("{method} at {x:?}, planes {plane:?}");
                let scene = square([x, 5.0], 1, method).with_planes(plane);
                let mut simulation = start(&what, &scene, &options())?;
                steps(&what, &mut simulation, 1)?;
                let sum: f64 = simulation.node_values().iter().map(|node| node.mass).sum();
                at_edge = at_edge.max((sum / simulation.mass() - 1.0).abs());
            }
        }
    }
    let gradient = |whose: &str, value| {
        Gate::at_most(
            format!(
                "sum of the gradients of {whose}, by the force of a particle on itself [1/cell]"
            ),
            value,
            4e-15,
            "three by three gradients of at most one per cell, each with an error of 2e-16, of two stresses",
        )
    };
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                "sum of the weights less one".to_owned(),
                unity,
                4.5e-16,
                "5d: 4e-16, two last digits of one",
            ),
            Gate::at_most(
                "the same on the boundary planes of the mesh, free, sliding and fixed".to_owned(),
                at_edge,
                4.5e-16,
                "5d: 4e-16; what lies beyond a plane with a condition is folded back",
            ),
            Gate::at_most(
                "weighted mean of the nodes' places less that of the particle [cells]".to_owned(),
                place,
                2e-15,
                "nine weights with an error of 2e-16 each, at most one and a half cells away",
            ),
            gradient("smooth functions", gradients[0]),
            gradient("linear functions", gradients[1]),
        ],
        refusals: vec![],
    })
}

/// Velocity \[m/s\] and stress \[Pa\] of the start, smooth in space.
const START: f64 = 0.01;

fn smooth() -> InitialField {
    Arc::new(|x| {
        let (a, b) = (x[0] - 5.0, x[1] - 5.0);
        InitialState {
            velocity: [START * (a + 0.3 * b * b), START * (0.5 * a - b), 0.0],
            velocity_gradient: [
                [START, 0.6 * START * b, 0.0],
                [0.5 * START, -START, 0.0],
                [0.0; 3],
            ],
            stress: [START * a, START * b, 0.0, 0.0, 0.0, START * a * b],
            ..AT_REST
        }
    })
}

/// Largest change of velocity, stress and way after some steps, over their scales, where a block is moved along x or y by an
/// ulp to either side.
fn change(first: [f64; 2], method: Method, count: u64) -> Result<f64, Unexpected> {
    let run = |first: [f64; 2]| -> Result<Vec<Seen>, Unexpected> {
        let what = format!("{method} at {first:?}");
        let scene = square(first, 5, method);
        let mut simulation = start(&what, &scene, &from(smooth()))?;
        steps(&what, &mut simulation, count)?;
        Ok(particles(&simulation))
    };
    let here = run(first)?;
    let mut worst = 0.0_f64;
    for axis in 0..2 {
        for x in &beside(first[axis])[1..] {
            let mut moved = first;
            moved[axis] = *x;
            let there = run(moved)?;
            let pairs = || (here.iter(), there.iter());
            let (a, b) = pairs();
            worst = worst.max(apart(a.map(|s| &s.velocity), b.map(|s| &s.velocity)) / START);
            let (a, b) = pairs();
            worst = worst.max(apart(a.map(|s| &s.stress), b.map(|s| &s.stress)) / START);
            let (a, b) = pairs();
            worst = worst.max(apart(a.map(|s| &s.position), b.map(|s| &s.position)));
        }
    }
    Ok(worst)
}

/// Why an ulp may not matter.
const CONTINUOUS: &str = "functions and gradients are continuous: an ulp of 9e-16 of a cell is multiplied by slopes of a few per \
                          cell; 5d: 1e-12";

fn on_nodes() -> Result<Finding, Unexpected> {
    let (mut smooth, mut linear) = (0.0_f64, 0.0_f64);
    for method in methods() {
        // Particles on nodes and half way, or on faces only. The block does not end where its functions do.
        let offset = match method.weighting {
            Weighting::QuadraticBSpline | Weighting::UniformGimp | Weighting::ContiguousGimp(_) => {
                4.0
            }
            Weighting::Linear => 3.75,
        };
        for y in [offset, 4.1] {
            let found = change([offset, y], method, count_of(method, 5))?;
            if method.weighting == Weighting::Linear {
                linear = linear.max(found);
            } else {
                smooth = smooth.max(found);
            }
        }
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                "smooth functions, particles on nodes".to_owned(),
                smooth,
                1e-12,
                CONTINUOUS,
            ),
            Gate::at_most(
                "linear functions, particles a quarter of a cell beside nodes".to_owned(),
                linear,
                1e-12,
                "on a node their gradient jumps, which is theirs; beside it they are smooth",
            ),
        ],
        refusals: vec![],
    })
}

fn edge_on_node() -> Result<Finding, Unexpected> {
    let mut gates = vec![];
    for scheme in SCHEMES {
        for transfer in TRANSFERS {
            let mut worst = 0.0_f64;
            for weighting in WEIGHTINGS {
                // The gradient of linear functions jumps there.
                if weighting == Weighting::Linear {
                    continue;
                }
                let method = Method {
                    weighting,
                    scheme,
                    transfer,
                };
                // The node 3 is reached by nothing, or by an ulp.
                worst = worst.max(change([3.0 + reach(weighting), 4.1], method, 5)?);
            }
            let method = Method {
                scheme,
                transfer,
                ..Method::DEFAULT
            };
            let name = format!(
                "{} {}: change by an ulp",
                method.scheme_word(),
                method.transfer_word()
            );
            gates.push(Gate::at_most(name, worst, 1e-12, CONTINUOUS));
        }
    }
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
