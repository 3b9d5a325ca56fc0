//! Friction of nothing, of a thousand million, and of exactly the slope.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, Simulation};
use proctor_scene::{DomainUpdate, Scene, Shape, TimeStep, Weighting};

use super::trial::{always, apart, elastic, open, pair, run_to, start, worst};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme {
    name: "friction",
    what: "a block on a slope of tan(theta) = 1/2 with friction 0, 1/2 exactly, 1e9 and infinite",
    required: "free of friction it slides with g sin(theta) exactly; at 1/2 it does not run away; above it sticks; forces opposite to the bit",
    cause: None,
    judge: friction,
}];

/// Gravity along and across the slope \[m/s²\].
const ALONG: f64 = 5e-5;
const ACROSS: f64 = 1e-4;
/// Thickness of the base and height of the block \[m\].
const BASE: f64 = 3.0;
const HEIGHT: f64 = 3.0;
/// Time of the run \[s\]: the block swings on its base some ten times in 4 H/c.
const END: f64 = 120.0;

/// A block on a rigid base; Poisson's ratio is zero.
fn slope(friction: f64) -> Scene {
    let mut scene = open([24, 9]).with_gravity([ALONG, -ACROSS, 0.0]);
    let material = scene.add_material(elastic(1.0, 0.0), 1.0);
    scene
        .add_body(Shape::rectangle([1.0, 0.0], [23.0, BASE]), material)
        .motion = Some(always([0.0; 3]));
    let block = Shape::rectangle([6.0, BASE], [12.0, BASE + HEIGHT]);
    scene.add_body(block, material);
    scene.contacts = vec![pair(1, 1, 2, friction)];
    scene
}

/// What was seen of a block.
struct Slid {
    /// Velocity along the slope over that of free sliding, at the end.
    velocity: f64,
    /// Way along the slope over what the block shears by at rest, g_x rho H²/(3 G) in the mean.
    way: f64,
    /// Largest way along the slope over that of free sliding, when it would be as far as the end.
    share: f64,
    /// Largest sum of the forces on base and block, over the largest of them.
    unbalanced: f64,
    /// Largest pull over the largest push.
    pull: f64,
}

fn slide(friction: f64, change: impl Fn(&mut Scene)) -> Result<Slid, Unexpected> {
    let mut scene = slope(friction);
    change(&mut scene);
    // Friction holds from the second step on; a step of MUSL alone would be a fifth of the bound.
    scene.time_step = TimeStep::Multiplier {
        multiplier: 0.2,
        allow_unstable: false,
    };
    // It carries its weight from the start.
    let settled: InitialField = Arc::new(|x| InitialState {
        stress: [
            0.0,
            -ACROSS * (BASE + HEIGHT - x[1]).min(HEIGHT),
            0.0,
            0.0,
            0.0,
            0.0,
        ],
        ..AT_REST
    });
    let mut simulation: Simulation = start(&scene, Some(settled))?;
    let from = simulation.center(1).position[0];
    let [mut unbalanced, mut push, mut pull] = [0.0_f64; 3];
    run_to(&mut simulation, END, |s, _| {
        let (base, block) = (s.contact_force(0), s.contact_force(1));
        unbalanced = worst(unbalanced, apart(&base, &block.map(|f| -f)));
        push = push.max(block[1]);
        pull = pull.max(-block[1]);
    })?;
    let center = simulation.center(1);
    let (x, v) = (center.position, center.velocity);
    let shear = 0.5;
    Ok(Slid {
        velocity: v[0] / (ALONG * simulation.velocity_time()),
        way: (x[0] - from) / (ALONG * HEIGHT * HEIGHT / (3.0 * shear)),
        share: (x[0] - from) / (0.5 * ALONG * END * END),
        unbalanced: unbalanced / push,
        pull: pull / push,
    })
}

fn friction() -> Result<Finding, Unexpected> {
    let [mut free, mut sticks, mut limit, mut unbalanced, mut pull] = [0.0; 5];
    for weighting in [
        Weighting::UniformGimp,
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
        Weighting::QuadraticBSpline,
    ] {
        for scheme in SCHEMES {
            let method = |scene: &mut Scene| {
                (scene.weighting, scene.scheme) = (weighting, scheme);
            };
            let mut note = |slid: &Slid| {
                unbalanced = worst(unbalanced, slid.unbalanced);
                pull = worst(pull, slid.pull);
            };
            let slid = slide(0.0, method)?;
            note(&slid);
            free = worst(free, (slid.velocity - 1.0).abs());
            for friction in [1e9, f64::INFINITY] {
                let slid = slide(friction, method)?;
                note(&slid);
                sticks = worst(sticks, slid.way.abs());
            }
            let slid = slide(0.5, method)?;
            note(&slid);
            limit = worst(limit, slid.share.abs());
        }
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                String::from("friction 0: velocity over g sin(theta) t, less one"),
                free,
                1e-9,
                "the normal of a flat base has no part along it but round-off, and nothing else acts along the slope",
            ),
            Gate::at_most(
                String::from(
                    "friction 1e9 and infinite: way over what the block shears by at rest",
                ),
                sticks,
                2.5,
                "it swings between nothing and twice that, and a quarter for the first layer of cells",
            ),
            Gate::at_most(
                String::from("friction tan(theta): way over that of free sliding"),
                limit,
                2.0 * HEIGHT / (END * 0.5_f64.sqrt()),
                "until the base has felt all of the pull, H/c_s, friction is less than that by half in the mean, and from then on as \
                 much: H/(c_s t) of the free way; twice that for the swings of the weight",
            ),
            Gate::at_most(
                String::from("sum of the forces on base and block, over the push"),
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
        ],
        refusals: vec![],
    })
}
