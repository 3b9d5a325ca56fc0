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

/// Falls of single particles: their place, over their way, and their stress, over Young's modulus.
struct Falls([Gate; 2]);

impl Falls {
    fn new() -> Self {
        Self([
            gate("place against x_0 + v t + g t²/2, over the way")
                .at_most(ROUND_OFF, "velocities half a step before positions make the sum of dt (v_0 + g t) over the steps g t²/2 exactly"),
            gate("stress over Young's modulus")
                .at_most(ROUND_OFF, "the gradients of the weights of a particle sum to zero, so that its own velocity strains it by round-off"),
        ])
    }

    /// A fall of a particle in a scene without bodies.
    fn of(&mut self, mut scene: Scene, at: Vector, volume: f64) -> Result<(), RowFault> {
        const YOUNG: f64 = 1e-4;
        const VELOCITY: Vector = [0.3, 0.2, 0.1];
        const GRAVITY: Vector = [0.01, -0.05, 0.02];
        const END: f64 = 8.0;
        let [place, strained] = &mut self.0;
        let axes = scene.dimension.axes();
        let cut =
            |v: Vector| -> Vector { std::array::from_fn(|k| if k < axes { v[k] } else { 0.0 }) };
        scene.gravity = cut(GRAVITY);
        let mut body = scene.body(listed([(cut(at), volume)]), elastic(YOUNG, 0.3), 1.0);
        (body.velocity, body.particles_per_cell) = (cut(VELOCITY), [1; 3]);
        let mut simulation = start(&scene, &options())?;
        let way = apart(&VELOCITY.map(|v| v * END), &[0.0; 3]);
        run_to(&mut simulation, END, |s, _| {
            let t = s.time();
            let exact: Vector = std::array::from_fn(|k| {
                cut(at)[k] + t * (cut(VELOCITY)[k] + 0.5 * t * cut(GRAVITY)[k])
            });
            place.see(apart(&s.position(0, 0), &exact) / way);
            strained.see(largest_stress(s) / YOUNG);
        })
    }

    /// Particles of three sizes at some shares of a cell, with each method of some weighting functions.
    fn at(&mut self, shares: &[f64], weightings: &[Weighting]) -> Result<(), RowFault> {
        for (weighting, share) in weightings
            .iter()
            .flat_map(|w| shares.iter().map(move |s| (w, s)))
        {
            for scene in each_scheme(&open([10, 8]), [*weighting]) {
                for transfer in TRANSFERS {
                    for volume in [1e-6, 0.25, 1.0] {
                        let scene = scene.clone().with_transfer(Transfer::new(transfer));
                        self.of(scene, [3.0 + share, 4.0 + 0.5 * share, 0.0], volume)?;
                    }
                }
            }
        }
        Ok(())
    }
}

fn one_particle() -> RowVerdict {
    let mut falls = Falls::new();
    falls.at(&[0.0], &WEIGHTINGS[1..])?;
    falls.at(&[1e-9, 0.25, 0.5, 1.0 - 1e-9], &WEIGHTINGS)?;
    for share in [0.0, 0.3] {
        falls.of(open_space([9, 8, 8]), [3.0 + share; 3], 0.1)?;
    }
    Ok(Finding::of(falls.0))
}

fn one_particle_on_node() -> RowVerdict {
    let mut falls = Falls::new();
    falls.at(&[0.0], &WEIGHTINGS[..1])?;
    Ok(Finding::of(falls.0))
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
    for scene in each_scheme(&ring, SAFE) {
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
