//! Bodies in contact: friction of nothing, of a thousand million and of exactly the slope, very different masses, and bodies
//! that meet at one node.

use super::prelude::*;
use proctor_scene::simulation::BodyHandle;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("friction", friction)
        .with("a block on a slope of tan(theta) = 1/2 with friction 0, 1/2 exactly, 1e9 and infinite")
        .must("free of friction it slides with g sin(theta) exactly; at 1/2 it does not run away; above it sticks; forces opposite to the bit"),
    Extreme::of("mass-ratio", mass_ratio)
        .with("a block runs into one that is 1e6 times as dense and as stiff")
        .must("forces opposite, momentum to round-off, no pull, the light one thrown back"),
    Extreme::of("one-node", one_node)
        .with("two blocks that meet corner on corner at one node")
        .must("forces opposite, no pull, and each is the mirror image of the other"),
    Extreme::of("ten-bodies", ten_bodies)
        .with("ten wedges of a disc, each in contact with each other, that run together at one node")
        .must("momentum to round-off, forces in balance, no growth of energy, none passes into another"),
    Extreme::of("ten-bodies-mirrored", ten_bodies_mirrored)
        .with("the same with the mean of both normals, seen in a mirror and with the names of master and slave exchanged")
        .must("the mirror image, and the same"),
];

/// Gates of contact on the grid.
fn opposite(name: &str) -> Gate {
    gate(name).at_most(
        1e-13,
        "the force on the one is that on the other, with its sign",
    )
}

fn no_pull() -> Gate {
    gate("pull over push").at_most(1e-13, "contact never pulls")
}

fn touch(name: &str) -> Gate {
    gate(name).at_least(f64::MIN_POSITIVE, "bodies that did not touch show nothing")
}

/// Gravity along and across the slope \[m/s²\].
const ALONG: f64 = 5e-5;
const ACROSS: f64 = 1e-4;
/// Thickness of the base and height of the block \[m\].
const BASE: f64 = 3.0;
const HEIGHT: f64 = 3.0;
/// Time of the run \[s\]: the block swings on its base some ten times in 4 H/c.
const END: f64 = 120.0;

/// A block on a rigid base, which carries its weight from the start; Poisson's ratio is zero.
fn slope(friction: f64) -> Scene {
    let mut scene = open([24, 9]).with_gravity([ALONG, -ACROSS, 0.0]);
    let base = rectangle([1.0, 0.0], [23.0, BASE]);
    let block = rectangle([6.0, BASE], [12.0, BASE + HEIGHT]);
    scene.body(base, elastic(1.0, 0.0), 1.0).motion = Some([0.0; 3].into());
    scene.body(block, elastic(1.0, 0.0), 1.0);
    scene.contacts = pair([1, 2], friction);
    // Friction holds from the second step on; a step of MUSL alone would be a fifth of the bound.
    scene.time_step = multiple(0.2);
    scene
}

fn friction() -> RowVerdict {
    let mut free = gate("friction 0: velocity over g sin(theta) t, less one")
        .at_most(1e-9, "the normal of a flat base has no part along it but round-off, and nothing else acts along the slope");
    let mut sticks = gate("friction 1e9 and infinite: way over what the block shears by at rest")
        .at_most(
            2.5,
            "it swings between nothing and twice that, and a quarter for the first layer of cells",
        );
    let mut limit = gate("friction tan(theta): way over that of free sliding")
        .at_most(2.0 * HEIGHT / (END * 0.5_f64.sqrt()), "until the base has felt all of the pull, H/c_s, friction is less than that by half in the mean, and from then on as \
                 much: H/(c_s t) of the free way; twice that for the swings of the weight");
    let mut unbalanced = opposite("sum of the forces on base and block, over the push");
    let mut pull = no_pull();
    let weight = |y: f64| -ACROSS * (BASE + HEIGHT - y).min(HEIGHT);
    let settled = stressed(move |x| [0.0, weight(x[1]), 0.0, 0.0, 0.0, 0.0]);
    for friction in [0.0, 0.5, 1e9, f64::INFINITY] {
        for scene in each_scheme(&slope(friction), &SAFE) {
            let mut simulation = start(&scene, &settled)?;
            let from = simulation.center(1).position[0];
            let [off, pulled, _] = forces(&mut simulation, END, [0.0, 1.0, 0.0], |_| ())?;
            unbalanced.see(off);
            pull.see(pulled);
            let center = simulation.center(1);
            let way = center.position[0] - from;
            if friction == 0.0 {
                let falling = ALONG * simulation.velocity_time();
                free.see((center.velocity[0] / falling - 1.0).abs());
            } else if friction == 0.5 {
                limit.see((way / (0.5 * ALONG * END * END)).abs());
            } else {
                // What it shears by at rest is g_x rho H²/(3 G) in the mean.
                let shear = 0.5;
                sticks.see((way / (ALONG * HEIGHT * HEIGHT / (3.0 * shear))).abs());
            }
        }
    }
    Ok(Finding::of([free, sticks, limit, unbalanced, pull]))
}

/// Forces of contact up to a time \[s\]: the largest sum of all and the largest pull, each over the largest push, and that
/// push \[N\]; `direction` is that in which contact pushes the second body.
fn forces(
    simulation: &mut Simulation,
    time: f64,
    direction: Vector,
    mut look: impl FnMut(&Simulation),
) -> Result<[f64; 3]> {
    let [mut unbalanced, mut pull, mut push] = [0.0; 3];
    run_to(simulation, time, |s, _| {
        look(s);
        unbalanced = worst(unbalanced, sum_of_forces(s));
        let force = s.contact_force(1);
        let along: f64 = (0..3).map(|axis| force[axis] * direction[axis]).sum();
        push = worst(push, along);
        pull = worst(pull, -along);
    })?;
    Ok([unbalanced / push, pull / push, push])
}

/// Collisions of bodies that nothing else holds: what the worst of them must keep; `after` looks at the end of each.
fn collisions(
    scenes: impl IntoIterator<Item = Scene>,
    time: f64,
    direction: Vector,
    mut after: impl FnMut(&Simulation),
) -> RowVerdict {
    let mut kept = Conservation::named("collision");
    let mut unbalanced = opposite("sum of the forces on all bodies, over the largest push");
    let mut pull = no_pull();
    let mut push = touch("largest push [N], the least of all runs");
    for scene in scenes {
        let mut simulation = kept.start(&scene, &options())?;
        let [off, pulled, pushed] = forces(&mut simulation, time, direction, |s| kept.look(s))?;
        unbalanced.see(off);
        pull.see(pulled);
        push.see(pushed);
        after(&simulation);
    }
    Ok(Finding::of(kept.gates()).and([unbalanced, pull, push]))
}

/// Largest component of the sum of the contact forces on all bodies \[N\].
fn sum_of_forces(simulation: &Simulation) -> f64 {
    let mut sum = [0.0; 3];
    for body in 0..simulation.sets().len() {
        let force = simulation.contact_force(body);
        sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
    }
    apart(&sum, &[0.0; 3])
}

fn mass_ratio() -> RowVerdict {
    const SPEED: f64 = 0.02;
    const RATIO: f64 = 1e6;
    let mut slowest = gate("speed at which they part over that at which they met")
        .at_least(0.75, "a bar leaves a wall with its speed turned round, but for a front that is spread over (h² L)^(1/3), a quarter of it");
    // Between sliding planes and without lateral strain: waves of one dimension, of which nothing stays.
    let mut scene = open([24, 2]).between(1);
    for (left, right, ratio, speed) in [(3.0, 11.0, 1.0, SPEED), (11.3, 15.3, RATIO, -SPEED)] {
        let shape = rectangle([left, 0.0], [right, 2.0]);
        scene.body(shape, elastic(ratio, 0.0), ratio).velocity = [speed, 0.0, 0.0];
    }
    // The heavy one is flat and stiff: the master.
    scene.contacts = pair([2, 1], 0.0);
    // The gap closes in 8 s, and a wave comes back through the block in 16 s.
    let scenes = with_schemes(&scene);
    let collided = collisions(scenes, 60.0, [1.0, 0.0, 0.0], |simulation| {
        let [v, w] = [0, 1].map(|set| simulation.center(set).velocity[0]);
        slowest.see((w - v) / (2.0 * SPEED));
    })?;
    Ok(collided.and([slowest]))
}

fn one_node() -> RowVerdict {
    const SPEED: f64 = 0.02;
    let mut mirrored = gate("mean velocities against those of the mirror image, over the speed")
        .at_most(1e-10, "scene and mesh are their own reflection about the node; round-off, which the swings of the blocks carry along");
    // They meet at (6, 6), a node; the point reflection about it takes each to the other.
    let meeting = |friction| {
        let mut scene = open([12, 12]);
        for (low, speed) in [(3.0, SPEED), (6.0, -SPEED)] {
            let shape = rectangle([low; 2], [low + 3.0; 2]);
            scene.body(shape, elastic(1.0, 0.3), 1.0).velocity = [speed, speed, 0.0];
        }
        scene.add_contact([0, 1].map(BodyHandle::from), friction);
        with_schemes(&scene)
    };
    let scenes = [0.0, 0.3].map(meeting).concat();
    let diagonal = 0.5_f64.sqrt();
    let collided = collisions(scenes, 40.0, [diagonal, diagonal, 0.0], |simulation| {
        let [a, b] = [0, 1].map(|set| simulation.center(set));
        mirrored.see(apart(&a.velocity, &b.velocity.map(|v| -v)) / SPEED);
    })?;
    Ok(collided.and([mirrored]))
}

/// Number of wedges, and the middle of the mesh.
const COUNT: usize = 10;
const CENTER: f64 = 8.0;

/// Ten wedges of a disc with a gap between them that run to its middle, each with each in contact.
fn wedges(scheme: StressScheme, speed: f64, exchanged: bool) -> Scene {
    let mut scene = open([16, 16]).with_scheme(scheme);
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for i in 0..COUNT {
        let at = |share: f64| {
            let (sin, cos) = libm::sincos(TAU * (i as f64 + share) / COUNT as f64);
            [cos, sin, 0.0]
        };
        // Half of the wedge to either side of its middle; out by a tenth of a metre.
        let (middle, low, high) = (at(0.5), at(0.0), at(1.0));
        let place = |r: f64, e: Vector| -> Vector {
            let center = [CENTER, CENTER, 0.0];
            std::array::from_fn(|k| center[k] + 0.1 * middle[k] + r * e[k])
        };
        let points = vec![place(0.0, middle), place(5.0, low), place(5.0, high)];
        let mut body = scene.add_body(Shape::Polygon { points }, material);
        body.velocity = middle.map(|c| -speed * c);
        body.particles_per_cell = [4, 4, 1];
    }
    for a in 0..COUNT {
        for b in a + 1..COUNT {
            let bodies = if exchanged { [b, a] } else { [a, b] };
            scene.add_contact(bodies.map(BodyHandle::from), 0.3);
        }
    }
    scene
}

/// Speed at which wedges run to the middle \[m/s\], and time that they are watched \[s\].
const GATHER: f64 = 0.01;
const WATCHED: f64 = 40.0;

fn ten_bodies() -> RowVerdict {
    let mut kept = Conservation::named("run together");
    let mut unbalanced = opposite("sum of the forces on all bodies, over the largest");
    let mut push = touch("largest force [N], the least of all runs");
    let mut middle = gate("way of the middle of each to the edges of its wedge, over the width of a wedge")
        .at_least(0.25, "it is half of the width at the start; wedges that cannot pass into each other stay but for their gaps");
    for scheme in SCHEMES {
        let mut simulation = kept.start(&wedges(scheme, GATHER, false), &options())?;
        let mut strongest = 0.0;
        run_to(&mut simulation, WATCHED, |s, _| {
            kept.look(s);
            unbalanced.see(sum_of_forces(s));
            for body in 0..COUNT {
                strongest = worst(strongest, apart(&s.contact_force(body), &[0.0; 3]));
            }
        })?;
        push.see(strongest);
        for set in 0..COUNT {
            let x = simulation.center(set).position;
            let angle = libm::atan2(x[1] - CENTER, x[0] - CENTER) / TAU * COUNT as f64;
            let off = (angle.rem_euclid(COUNT as f64) - (set as f64 + 0.5)).abs();
            middle.see(0.5 - off);
        }
    }
    unbalanced.value /= push.value;
    Ok(Finding::of(kept.gates()).and([unbalanced, push, middle]))
}

fn ten_bodies_mirrored() -> RowVerdict {
    let mut mirrored = gate("mean places against the mirror image, over a cell").at_most(
        1e-9,
        "scene and mesh are their own mirror image; round-off, which the swings carry along",
    );
    let mut exchanged =
        gate("mean places after masters and slaves have changed their names, over a cell").at_most(
            1e-9,
            "the mean of both normals is the same, whichever body is called the master",
        );
    for scheme in SCHEMES {
        let places = |names: bool| -> Result<[Vector; COUNT]> {
            let simulation = at_time(&wedges(scheme, GATHER, names), &options(), WATCHED)?;
            Ok(std::array::from_fn(|set| simulation.center(set).position))
        };
        let (given, other) = (places(false)?, places(true)?);
        for (set, x) in given.iter().enumerate() {
            // The mirror image about the horizontal through the middle.
            let [a, b, c] = given[COUNT - 1 - set];
            mirrored.see(apart(x, &[a, 2.0 * CENTER - b, c]));
            exchanged.see(apart(x, &other[set]));
        }
    }
    Ok(Finding::of([mirrored, exchanged]))
}
