//! Bodies of one particle, and shells of one layer of particles.

use std::f64::consts::TAU;
use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{ParticleSeed, Scene, Shape, Transfer, Vector, Weighting};

use super::trial::{
    Kept, ROUND_OFF, apart, elastic, kept, off_by_a_quarter_turn, open, open_space, run_to, start,
    worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::stability::map::{SCHEMES, TRANSFERS, WEIGHTINGS};

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "one-particle",
        what: "bodies of one particle in free fall, at nodes, on faces, beside them and between, small and large",
        required: "x = x_0 + v t + g t²/2 exactly with velocities half a step behind, no stress, no force from itself",
        cause: None,
        judge: one_particle,
    },
    Extreme {
        name: "flight-from-node",
        what: "the same with linear functions and the particle exactly on a node at the start",
        required: "the same: the place of a particle within a cell is chance",
        cause: None,
        judge: one_particle_on_node,
    },
    Extreme {
        name: "thin-shell",
        what: "a ring of one layer of particles, a tenth of a cell thick, that flies and breathes",
        required: "flies without stress; breathes with its symmetry, its momentum and no more energy than it had",
        cause: None,
        judge: thin_shell,
    },
];

/// A body of one particle.
fn single(at: Vector, volume: f64) -> Shape {
    Shape::Particles(Arc::new(vec![ParticleSeed {
        position: at,
        volume,
    }]))
}

/// What a particle in free fall misses: its place, over its way, and its stress, over Young's modulus.
fn fall(mut scene: Scene, at: Vector, volume: f64) -> Result<[f64; 2], Unexpected> {
    const YOUNG: f64 = 1e-4;
    const VELOCITY: Vector = [0.3, 0.2, 0.1];
    const GRAVITY: Vector = [0.01, -0.05, 0.02];
    const END: f64 = 8.0;
    let axes = scene.dimension.axes();
    let cut = |v: Vector| -> Vector { std::array::from_fn(|k| if k < axes { v[k] } else { 0.0 }) };
    scene.gravity = cut(GRAVITY);
    let material = scene.add_material(elastic(YOUNG, 0.3), 1.0);
    scene.add_body(single(cut(at), volume), material).velocity = cut(VELOCITY);
    scene.bodies[0].particles_per_cell = [1; 3];
    let mut simulation = start(&scene, None)?;
    let (mut off, mut stress) = (0.0, 0.0);
    run_to(&mut simulation, END, |s, _| {
        let t = s.time();
        let exact: Vector = std::array::from_fn(|k| {
            cut(at)[k] + t * (cut(VELOCITY)[k] + 0.5 * t * cut(GRAVITY)[k])
        });
        off = worst(off, apart(&s.position(0, 0), &exact));
        let set = &s.sets()[0];
        stress = set.stress(0).iter().map(|c| c.abs()).fold(stress, worst);
    })?;
    let way: Vector = std::array::from_fn(|k| VELOCITY[k] * END);
    Ok([off / apart(&way, &[0.0; 3]), stress / YOUNG])
}

/// The worst falls of particles of three sizes at some shares of a cell, with each method of some weighting functions.
fn falls(weightings: &[Weighting], shares: &[f64]) -> Result<[f64; 2], Unexpected> {
    let mut most = [0.0; 2];
    for &weighting in weightings {
        for scheme in SCHEMES {
            for transfer in TRANSFERS {
                for share in shares {
                    for volume in [1e-6, 0.25, 1.0] {
                        let mut scene = open([10, 8]);
                        scene.weighting = weighting;
                        scene.scheme = scheme;
                        scene.transfer = Transfer::new(transfer);
                        let at = [3.0 + share, 4.0 + 0.5 * share, 0.0];
                        most = worst_of(most, fall(scene, at, volume)?);
                    }
                }
            }
        }
    }
    Ok(most)
}

fn worst_of(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [worst(a[0], b[0]), worst(a[1], b[1])]
}

/// Gates of what falls miss.
fn free([off, stress]: [f64; 2]) -> Finding {
    Finding {
        gates: vec![
            Gate::at_most(
                String::from("place against x_0 + v t + g t²/2, over the way"),
                off,
                ROUND_OFF,
                "velocities half a step before positions make the sum of dt (v_0 + g t) over the steps g t²/2 exactly",
            ),
            Gate::at_most(
                String::from("stress over Young's modulus"),
                stress,
                ROUND_OFF,
                "the gradients of the weights of a particle sum to zero, so that its own velocity strains it by round-off",
            ),
        ],
        refusals: vec![],
    }
}

fn one_particle() -> Result<Finding, Unexpected> {
    let beside = [1e-9, 0.25, 0.5, 1.0 - 1e-9];
    let mut most = falls(&WEIGHTINGS[1..], &[0.0])?;
    most = worst_of(most, falls(&WEIGHTINGS, &beside)?);
    for share in [0.0, 0.3] {
        most = worst_of(most, fall(open_space([9, 8, 8]), [3.0 + share; 3], 0.1)?);
    }
    Ok(free(most))
}

fn one_particle_on_node() -> Result<Finding, Unexpected> {
    Ok(free(falls(&WEIGHTINGS[..1], &[0.0])?))
}

fn thin_shell() -> Result<Finding, Unexpected> {
    const COUNT: usize = 48;
    const RADIUS: f64 = 2.7;
    const CENTER: [f64; 2] = [6.0, 6.0];
    let ring = || {
        let mut scene = open([12, 12]);
        let material = scene.add_material(elastic(1.0, 0.3), 1.0);
        let volume = 0.1 * TAU * RADIUS / COUNT as f64;
        let seeds = (0..COUNT).map(|i| {
            let (sin, cos) = libm::sincos(TAU * (i as f64 + 0.5) / COUNT as f64);
            ParticleSeed {
                position: [CENTER[0] + RADIUS * cos, CENTER[1] + RADIUS * sin, 0.0],
                volume,
            }
        });
        let shape = Shape::Particles(Arc::new(seeds.collect()));
        scene.add_body(shape, material).particles_per_cell = [1; 3];
        scene
    };
    let [mut stress, mut turned, mut drift, mut grown] = [0.0; 4];
    for weighting in &WEIGHTINGS[1..] {
        for scheme in SCHEMES {
            let mut scene = ring();
            (scene.weighting, scene.scheme) = (*weighting, scheme);
            let flies: InitialField = Arc::new(|_| InitialState {
                velocity: [0.1, 0.07, 0.0],
                ..AT_REST
            });
            let mut simulation = start(&scene, Some(flies))?;
            run_to(&mut simulation, 20.0, |s, _| {
                let set = &s.sets()[0];
                for p in 0..set.len() {
                    stress = set.stress(p).iter().map(|c| c.abs()).fold(stress, worst);
                }
            })?;
            let breathes: InitialField = Arc::new(|x| InitialState {
                velocity: [1e-3 * (x[0] - CENTER[0]), 1e-3 * (x[1] - CENTER[1]), 0.0],
                ..AT_REST
            });
            let mut simulation = start(&scene, Some(breathes))?;
            let mut balance = Kept::of(&simulation);
            // About five swings of 2 pi R/c.
            run_to(&mut simulation, 80.0, |s, _| balance.look(s))?;
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
            turned = worst(turned, off_by_a_quarter_turn(&simulation, CENTER, 1e-3));
        }
    }
    let mut gates = vec![
        Gate::at_most(
            String::from("flying: stress over Young's modulus"),
            stress,
            ROUND_OFF,
            "a uniform velocity strains nothing, whatever the particles",
        ),
        Gate::at_most(
            String::from("breathing: a quarter turn of the ring against the ring, over its swing"),
            turned,
            1e-9,
            "ring and mesh are the same after a quarter turn; places differ by round-off, which the swings carry along",
        ),
    ];
    gates.extend(kept("breathing", drift, grown));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
