//! Bodies of one particle, and shells of one layer of particles.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("one-particle", one_particle)
        .with("bodies of one particle in free fall, at nodes, on faces, beside them and between, small and large")
        .must("x = x_0 + v t + g t²/2 exactly with velocities half a step behind, no stress, no force from itself"),
    Extreme::of("flight-from-node", one_particle_on_node)
        .with("the same with linear functions and the particle exactly on a node at the start")
        .must("the same: the place of a particle within a cell is chance"),
    Extreme::of("thin-shell", thin_shell)
        .with("a ring of one layer of particles, a tenth of a cell thick, that flies and breathes")
        .must("flies without stress; breathes with its symmetry, its momentum and no more energy than it had"),
];

/// The fall of a particle: the scene without it, its place at the start \[m\] and its volume \[m³\].
type Fall = (Scene, Vector, f64);

/// Falls of particles of three sizes from some shares of a cell beside a node, with each method of some weighting functions.
fn beside(shares: &[f64], weightings: &[Weighting]) -> Vec<Fall> {
    let mut falls = vec![];
    for scene in each_scheme(&open([10, 8]), weightings) {
        for transfer in TRANSFERS {
            for share in shares {
                for volume in [1e-6, 0.25, 1.0] {
                    let scene = scene.clone().with_transfer(Transfer::new(transfer));
                    falls.push((scene, [3.0 + share, 4.0 + 0.5 * share, 0.0], volume));
                }
            }
        }
    }
    falls
}

/// The verdict on falls of single particles: the exact fall, without stress, in the worst of them.
fn judged(falls: Vec<Fall>) -> RowVerdict {
    const YOUNG: f64 = 1e-4;
    const VELOCITY: Vector = [0.3, 0.2, 0.1];
    const GRAVITY: Vector = [0.01, -0.05, 0.02];
    const END: f64 = 8.0;
    let mut place = gate("place against x_0 + v t + g t²/2, over the way")
        .at_most(ROUND_OFF, "velocities half a step before positions make the sum of dt (v_0 + g t) over the steps g t²/2 exactly");
    let mut strained = gate("stress over Young's modulus")
        .at_most(ROUND_OFF, "the gradients of the weights of a particle sum to zero, so that its own velocity strains it by round-off");
    for (mut scene, at, volume) in falls {
        let axes = scene.dimension.axes();
        let cut =
            |v: Vector| -> Vector { std::array::from_fn(|k| if k < axes { v[k] } else { 0.0 }) };
        let [at, velocity, gravity] = [at, VELOCITY, GRAVITY].map(cut);
        scene.gravity = gravity;
        let mut body = scene.body(listed([(at, volume)]), elastic(YOUNG, 0.3), 1.0);
        (body.velocity, body.particles_per_cell) = (velocity, [1; 3]);
        let mut simulation = start(&scene, &options())?;
        let way = apart(&VELOCITY.map(|v| v * END), &[0.0; 3]);
        run_to(&mut simulation, END, |s, _| {
            let t = s.time();
            let exact = std::array::from_fn(|k| at[k] + t * (velocity[k] + 0.5 * t * gravity[k]));
            place.see(apart(&s.position(0, 0), &exact) / way);
            strained.see(largest_stress(s) / YOUNG);
        })?;
    }
    Ok(Finding::of([place, strained]))
}

fn one_particle() -> RowVerdict {
    let mut all = beside(&[0.0], &WEIGHTINGS[1..]);
    all.extend(beside(&[1e-9, 0.25, 0.5, 1.0 - 1e-9], &WEIGHTINGS));
    all.extend([0.0, 0.3].map(|share| (open_space([9, 8, 8]), [3.0 + share; 3], 0.1)));
    judged(all)
}

fn one_particle_on_node() -> RowVerdict {
    judged(beside(&[0.0], &WEIGHTINGS[..1]))
}

fn thin_shell() -> RowVerdict {
    const COUNT: usize = 48;
    const RADIUS: f64 = 2.7;
    const CENTER: [f64; 2] = [6.0, 6.0];
    let mut strained = gate("flying: stress over Young's modulus").at_most(
        ROUND_OFF,
        "a uniform velocity strains nothing, whatever the particles",
    );
    let mut turned = gate("breathing: a quarter turn of the ring against the ring, over its swing")
        .at_most(1e-9, "ring and mesh are the same after a quarter turn; places differ by round-off, which the swings carry along");
    let mut kept = Conservation::named("breathing");
    let volume = 0.1 * TAU * RADIUS / COUNT as f64;
    let place = |i: usize| {
        let (sin, cos) = libm::sincos(TAU * (i as f64 + 0.5) / COUNT as f64);
        [CENTER[0] + RADIUS * cos, CENTER[1] + RADIUS * sin, 0.0]
    };
    let ring = listed((0..COUNT).map(|i| (place(i), volume)));
    let mut ring = alone([12, 12], ring, elastic(1.0, 0.3));
    ring.bodies[0].particles_per_cell = [1; 3];
    let flies = flying(|_| [0.1, 0.07, 0.0]);
    let breathes = flying(|x| [1e-3 * (x[0] - CENTER[0]), 1e-3 * (x[1] - CENTER[1]), 0.0]);
    for scene in each_scheme(&ring, &SAFE) {
        run_to(&mut start(&scene, &flies)?, 20.0, |s, _| {
            strained.see(largest_stress(s));
        })?;
        let mut simulation = kept.start(&scene, &breathes)?;
        // About five swings of 2 pi R/c.
        run_to(&mut simulation, 80.0, |s, _| kept.look(s))?;
        turned.see(off_by_a_quarter_turn(&simulation, CENTER, 1e-3));
    }
    Ok(Finding::of([strained, turned]).and(kept.gates()))
}
