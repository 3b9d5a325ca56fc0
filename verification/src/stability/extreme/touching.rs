//! Bodies of very different mass that collide, and bodies that meet at one node.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
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

/// Collisions of bodies that nothing else holds, and what the worst of several must keep.
struct Collisions {
    kept: Conservation,
    unbalanced: Gate,
    pull: Gate,
    push: Gate,
}

impl Collisions {
    fn new() -> Self {
        Self {
            kept: Conservation::named("collision"),
            unbalanced: gate("sum of the forces on all bodies, over the largest push")
                .at_most(1e-13)
                .because("the force on the one is that on the other, with its sign"),
            pull: gate("pull over push")
                .at_most(1e-13)
                .because("contact never pulls"),
            push: gate("largest push [N], the least of all runs")
                .at_least(f64::MIN_POSITIVE)
                .because("bodies that did not touch show nothing"),
        }
    }

    /// Runs one; `direction` is that in which contact pushes the second body.
    fn run(&mut self, scene: &Scene, time: f64, direction: Vector) -> Result<Simulation, RowFault> {
        let mut simulation = self.kept.start(scene, &options())?;
        let [mut unbalanced, mut pull, mut push] = [0.0; 3];
        run_to(&mut simulation, time, |s, _| {
            self.kept.look(s);
            unbalanced = worst(unbalanced, sum_of_forces(s));
            let force = s.contact_force(1);
            let along: f64 = (0..3).map(|axis| force[axis] * direction[axis]).sum();
            push = worst(push, along);
            pull = worst(pull, -along);
        })?;
        self.unbalanced.see(unbalanced / push);
        self.pull.see(pull / push);
        self.push.see(push);
        Ok(simulation)
    }

    fn finding(self) -> Finding {
        Finding::of(self.kept.gates()).and([self.unbalanced, self.pull, self.push])
    }
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
    let mut collisions = Collisions::new();
    let mut slowest = gate("speed at which they part over that at which they met")
        .at_least(0.75)
        .because("a bar leaves a wall with its speed turned round, but for a front that is spread over (h² L)^(1/3), a quarter of it");
    for scheme in SCHEMES {
        // Between sliding planes and without lateral strain: waves of one dimension, of which nothing stays.
        let mut scene = open([24, 2]).with_scheme(scheme).between(1);
        for (left, right, ratio, speed) in [(3.0, 11.0, 1.0, SPEED), (11.3, 15.3, RATIO, -SPEED)] {
            let shape = rectangle([left, 0.0], [right, 2.0]);
            scene.body(shape, elastic(ratio, 0.0), ratio).velocity = [speed, 0.0, 0.0];
        }
        // The heavy one is flat and stiff: the master.
        scene.contacts = vec![pair(1, 2, 1, 0.0)];
        // The gap closes in 8 s, and a wave comes back through the block in 16 s.
        let simulation = collisions.run(&scene, 60.0, [1.0, 0.0, 0.0])?;
        let [v, w] = [0, 1].map(|set| simulation.center(set).velocity[0]);
        slowest.see((w - v) / (2.0 * SPEED));
    }
    Ok(collisions.finding().and([slowest]))
}

fn one_node() -> RowVerdict {
    const SPEED: f64 = 0.02;
    let mut collisions = Collisions::new();
    let mut mirrored = gate("mean velocities against those of the mirror image, over the speed")
        .at_most(1e-10)
        .because("scene and mesh are their own reflection about the node; round-off, which the swings of the blocks carry along");
    // They meet at (6, 6), a node; the point reflection about it takes each to the other.
    let diagonal = 0.5_f64.sqrt();
    for scheme in SCHEMES {
        for friction in [0.0, 0.3] {
            let mut scene = open([12, 12]).with_scheme(scheme);
            for (low, speed) in [(3.0, SPEED), (6.0, -SPEED)] {
                let shape = rectangle([low; 2], [low + 3.0; 2]);
                scene.body(shape, elastic(1.0, 0.3), 1.0).velocity = [speed, speed, 0.0];
            }
            scene.contacts = vec![collinear(1, 1, 2, friction)];
            let simulation = collisions.run(&scene, 40.0, [diagonal, diagonal, 0.0])?;
            let [a, b] = [0, 1].map(|set| simulation.center(set));
            mirrored.see(apart(&a.velocity, &b.velocity.map(|v| -v)) / SPEED);
        }
    }
    Ok(collisions.finding().and([mirrored]))
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
    for a in 1..=COUNT as i64 {
        for b in a + 1..=COUNT as i64 {
            let (master, slave) = if exchanged { (b, a) } else { (a, b) };
            scene
                .contacts
                .push(collinear(100 * a + b, master, slave, 0.3));
        }
    }
    scene
}

/// Speed at which wedges run to the middle \[m/s\], and time that they are watched \[s\].
const GATHER: f64 = 0.01;
const WATCHED: f64 = 40.0;

fn ten_bodies() -> RowVerdict {
    let mut kept = Conservation::named("run together");
    let mut unbalanced = gate("sum of the forces on all bodies, over the largest")
        .at_most(1e-13)
        .because("the force on the one is that on the other, with its sign")
        .found(0.0);
    let mut push = gate("largest force [N], the least of all runs")
        .at_least(f64::MIN_POSITIVE)
        .because("bodies that did not touch show nothing");
    let mut middle = gate("way of the middle of each to the edges of its wedge, over the width of a wedge")
        .at_least(0.25)
        .because("it is half of the width at the start; wedges that cannot pass into each other stay but for their gaps");
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
    let mut mirrored = gate("mean places against the mirror image, over a cell")
        .at_most(1e-9)
        .because(
            "scene and mesh are their own mirror image; round-off, which the swings carry along",
        );
    let mut exchanged =
        gate("mean places after masters and slaves have changed their names, over a cell")
            .at_most(1e-9)
            .because("the mean of both normals is the same, whichever body is called the master");
    for scheme in SCHEMES {
        let places = |names: bool| -> Result<Vec<Vector>, RowFault> {
            let mut simulation = start(&wedges(scheme, GATHER, names), &options())?;
            to_time(&mut simulation, WATCHED)?;
            let all = 0..COUNT;
            Ok(all.map(|set| simulation.center(set).position).collect())
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
