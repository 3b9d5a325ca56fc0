//! Bodies of very different mass that collide, and bodies that meet at one node.

use std::f64::consts::TAU;

use proctor_scene::simulation::Simulation;
use proctor_scene::{Contact, ContactNormal, PlaneCondition, Scene, Shape, StressScheme, Vector};

use super::trial::{Kept, apart, elastic, kept, open, pair, run_to, start, worst};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "mass-ratio",
        what: "a block runs into one that is 1e6 times as dense and as stiff",
        required: "forces opposite, momentum to round-off, no pull, the light one thrown back",
        cause: None,
        judge: mass_ratio,
    },
    Extreme {
        name: "one-node",
        what: "two blocks that meet corner on corner at one node",
        required: "forces opposite, no pull, and each is the mirror image of the other",
        cause: None,
        judge: one_node,
    },
    Extreme {
        name: "ten-bodies",
        what: "ten wedges of a disc, each in contact with each other, that run together at one node",
        required: "momentum to round-off, forces in balance, no growth of energy, none passes into another",
        cause: None,
        judge: ten_bodies,
    },
    Extreme {
        name: "ten-bodies-mirrored",
        what: "the same with the mean of both normals, seen in a mirror and with the names of master and slave exchanged",
        required: "the mirror image, and the same",
        cause: None,
        judge: ten_bodies_mirrored,
    },
];

/// What was seen of a collision.
struct Collision {
    balance: Kept,
    /// Largest sum of the contact forces on all bodies, over the largest force.
    unbalanced: f64,
    /// Largest pull of the first body on the second along a direction, over the largest push.
    pull: f64,
    /// Largest push \[N\].
    push: f64,
}

/// Runs a collision; `direction` is that in which contact pushes the second body.
fn collide(
    simulation: &mut Simulation,
    time: f64,
    direction: &Vector,
) -> Result<Collision, Unexpected> {
    let bodies = simulation.sets().len();
    let mut seen = Collision {
        balance: Kept::of(simulation),
        unbalanced: 0.0,
        pull: 0.0,
        push: 0.0,
    };
    run_to(simulation, time, |s, _| {
        seen.balance.look(s);
        let mut sum = [0.0; 3];
        for body in 0..bodies {
            let force = s.contact_force(body);
            sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
        }
        seen.unbalanced = worst(seen.unbalanced, apart(&sum, &[0.0; 3]));
        let force = s.contact_force(1);
        let along: f64 = (0..3).map(|axis| force[axis] * direction[axis]).sum();
        seen.push = worst(seen.push, along);
        seen.pull = worst(seen.pull, -along);
    })?;
    Ok(seen)
}

/// Gates that every collision must keep.
fn fair(unbalanced: f64, pull: f64, push: f64) -> [Gate; 3] {
    [
        Gate::at_most(
            String::from("sum of the forces on all bodies, over the largest push"),
            unbalanced,
            1e-13,
            "the force on the one is that on the other, with its sign",
        ),
        Gate::at_most(
            String::from("pull over push"),
            pull,
            1e-13,
            "contact never pulls",
        ),
        Gate::at_least(
            String::from("largest push [N], the least of all runs"),
            push,
            f64::MIN_POSITIVE,
            "bodies that did not touch show nothing",
        ),
    ]
}

fn mass_ratio() -> Result<Finding, Unexpected> {
    const SPEED: f64 = 0.02;
    const RATIO: f64 = 1e6;
    let [mut drift, mut grown, mut unbalanced, mut pull] = [0.0; 4];
    let (mut push, mut slowest) = (f64::INFINITY, f64::INFINITY);
    for scheme in SCHEMES {
        // Between sliding planes and without lateral strain: waves of one dimension, of which nothing stays.
        let mut scene = open([24, 2]);
        scene.mesh.planes[1] = [PlaneCondition::Sliding; 2];
        scene.scheme = scheme;
        let light = scene.add_material(elastic(1.0, 0.0), 1.0);
        let heavy = scene.add_material(elastic(RATIO, 0.0), RATIO);
        scene
            .add_body(Shape::rectangle([3.0, 0.0], [11.0, 2.0]), light)
            .velocity = [SPEED, 0.0, 0.0];
        scene
            .add_body(Shape::rectangle([11.3, 0.0], [15.3, 2.0]), heavy)
            .velocity = [-SPEED, 0.0, 0.0];
        // The heavy one is flat and stiff: the master.
        scene.contacts = vec![pair(1, 2, 1, 0.0)];
        let mut simulation = start(&scene, None)?;
        // The gap closes in 8 s, and a wave comes back through the block in 16 s.
        let seen = collide(&mut simulation, 60.0, &[1.0, 0.0, 0.0])?;
        drift = worst(drift, seen.balance.drift);
        grown = worst(grown, seen.balance.grown);
        unbalanced = worst(unbalanced, seen.unbalanced / seen.push);
        pull = worst(pull, seen.pull / seen.push);
        push = push.min(seen.push);
        let [v, w] = [0, 1].map(|set| simulation.center(set).velocity[0]);
        let back = (w - v) / (2.0 * SPEED);
        slowest = if back < slowest || back.is_nan() {
            back
        } else {
            slowest
        };
    }
    let mut gates = kept("collision", drift, grown).to_vec();
    gates.extend(fair(unbalanced, pull, push));
    gates.push(Gate::at_least(
        String::from("speed at which they part over that at which they met"),
        slowest,
        0.75,
        "a bar leaves a wall with its speed turned round, but for a front that is spread over (h² L)^(1/3), a quarter of it",
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

fn one_node() -> Result<Finding, Unexpected> {
    const SPEED: f64 = 0.02;
    // They meet at (6, 6), a node; the point reflection about it takes each to the other.
    let diagonal = 0.5_f64.sqrt();
    let [mut drift, mut grown, mut unbalanced, mut pull, mut mirrored] = [0.0; 5];
    let mut push = f64::INFINITY;
    for scheme in SCHEMES {
        for friction in [0.0, 0.3] {
            let mut scene: Scene = open([12, 12]);
            scene.scheme = scheme;
            let material = scene.add_material(elastic(1.0, 0.3), 1.0);
            scene
                .add_body(Shape::rectangle([3.0, 3.0], [6.0, 6.0]), material)
                .velocity = [SPEED, SPEED, 0.0];
            scene
                .add_body(Shape::rectangle([6.0, 6.0], [9.0, 9.0]), material)
                .velocity = [-SPEED, -SPEED, 0.0];
            scene.contacts = vec![Contact {
                normal: ContactNormal::Collinear,
                ..pair(1, 1, 2, friction)
            }];
            let mut simulation = start(&scene, None)?;
            let seen = collide(&mut simulation, 40.0, &[diagonal, diagonal, 0.0])?;
            drift = worst(drift, seen.balance.drift);
            grown = worst(grown, seen.balance.grown);
            unbalanced = worst(unbalanced, seen.unbalanced / seen.push);
            pull = worst(pull, seen.pull / seen.push);
            push = push.min(seen.push);
            let [a, b] = [0, 1].map(|set| simulation.center(set));
            mirrored = worst(
                mirrored,
                apart(&a.velocity, &b.velocity.map(|v| -v)) / SPEED,
            );
        }
    }
    let mut gates = kept("collision", drift, grown).to_vec();
    gates.extend(fair(unbalanced, pull, push));
    gates.push(Gate::at_most(
        String::from("mean velocities against those of the mirror image, over the speed"),
        mirrored,
        1e-10,
        "scene and mesh are their own reflection about the node; round-off, which the swings of the blocks carry along",
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

/// Number of wedges, and the middle of the mesh.
const COUNT: usize = 10;
const CENTER: f64 = 8.0;

/// Ten wedges of a disc with a gap between them that run to its middle, each with each in contact.
fn wedges(scheme: StressScheme, speed: f64, exchanged: bool) -> Scene {
    let mut scene = open([16, 16]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for i in 0..COUNT {
        let at = |share: f64| {
            let (sin, cos) = libm::sincos(TAU * (i as f64 + share) / COUNT as f64);
            [cos, sin]
        };
        // Half of the wedge to either side of its middle; out by a tenth of a metre.
        let (middle, low, high) = (at(0.5), at(0.0), at(1.0));
        let place = |r: f64, e: [f64; 2]| -> Vector {
            [
                CENTER + 0.1 * middle[0] + r * e[0],
                CENTER + 0.1 * middle[1] + r * e[1],
                0.0,
            ]
        };
        let points = vec![place(0.0, middle), place(5.0, low), place(5.0, high)];
        let mut body = scene.add_body(Shape::Polygon { points }, material);
        body.velocity = [-speed * middle[0], -speed * middle[1], 0.0];
        body.particles_per_cell = [4, 4, 1];
    }
    for a in 1..=COUNT as i64 {
        for b in a + 1..=COUNT as i64 {
            scene.contacts.push(Contact {
                normal: ContactNormal::Collinear,
                ..if exchanged {
                    pair(100 * a + b, b, a, 0.3)
                } else {
                    pair(100 * a + b, a, b, 0.3)
                }
            });
        }
    }
    scene
}

/// Speed at which wedges run to the middle \[m/s\], and time that they are watched \[s\].
const GATHER: f64 = 0.01;
const WATCHED: f64 = 40.0;

fn ten_bodies() -> Result<Finding, Unexpected> {
    let [mut drift, mut grown, mut unbalanced] = [0.0; 3];
    let (mut push, mut middle) = (f64::INFINITY, f64::INFINITY);
    for scheme in SCHEMES {
        let mut simulation = start(&wedges(scheme, GATHER, false), None)?;
        let mut largest = 0.0_f64;
        let mut balance = Kept::of(&simulation);
        run_to(&mut simulation, WATCHED, |s, _| {
            balance.look(s);
            let mut sum = [0.0; 3];
            for body in 0..COUNT {
                let force = s.contact_force(body);
                largest = largest.max(apart(&force, &[0.0; 3]));
                sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
            }
            unbalanced = worst(unbalanced, apart(&sum, &[0.0; 3]));
        })?;
        drift = worst(drift, balance.drift);
        grown = worst(grown, balance.grown);
        push = push.min(largest);
        for set in 0..COUNT {
            let x = simulation.center(set).position;
            let angle = libm::atan2(x[1] - CENTER, x[0] - CENTER) / TAU * COUNT as f64;
            let off = (angle.rem_euclid(COUNT as f64) - (set as f64 + 0.5)).abs();
            middle = middle.min(0.5 - off);
        }
    }
    let mut gates = kept("run together", drift, grown).to_vec();
    gates.extend([
        Gate::at_most(
            String::from("sum of the forces on all bodies, over the largest"),
            unbalanced / push,
            1e-13,
            "the force on the one is that on the other, with its sign",
        ),
        Gate::at_least(
            String::from("largest force [N], the least of all runs"),
            push,
            f64::MIN_POSITIVE,
            "bodies that did not touch show nothing",
        ),
        Gate::at_least(
            String::from("way of the middle of each to the edges of its wedge, over the width of a wedge"),
            middle,
            0.25,
            "it is half of the width at the start; wedges that cannot pass into each other stay but for their gaps",
        ),
    ]);
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

fn ten_bodies_mirrored() -> Result<Finding, Unexpected> {
    let [mut mirrored, mut exchanged] = [0.0; 2];
    for scheme in SCHEMES {
        let places = |names: bool| -> Result<Vec<Vector>, Unexpected> {
            let mut simulation = start(&wedges(scheme, GATHER, names), None)?;
            run_to(&mut simulation, WATCHED, |_, _| ())?;
            Ok((0..COUNT)
                .map(|set| simulation.center(set).position)
                .collect())
        };
        let (given, other) = (places(false)?, places(true)?);
        for (set, x) in given.iter().enumerate() {
            // The mirror image about the horizontal through the middle.
            let [a, b, c] = given[COUNT - 1 - set];
            mirrored = worst(mirrored, apart(x, &[a, 2.0 * CENTER - b, c]));
            exchanged = worst(exchanged, apart(x, &other[set]));
        }
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                String::from("mean places against the mirror image, over a cell"),
                mirrored,
                1e-9,
                "scene and mesh are their own mirror image; round-off, which the swings carry along",
            ),
            Gate::at_most(
                String::from(
                    "mean places after masters and slaves have changed their names, over a cell",
                ),
                exchanged,
                1e-9,
                "the mean of both normals is the same, whichever body is called the master",
            ),
        ],
        refusals: vec![],
    })
}
