//! Friction of nothing, of a thousand million, and of exactly the slope.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[Extreme::of("friction", friction)
        .with("a block on a slope of tan(theta) = 1/2 with friction 0, 1/2 exactly, 1e9 and infinite")
        .must("free of friction it slides with g sin(theta) exactly; at 1/2 it does not run away; above it sticks; forces opposite to the bit"),];

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
    scene.body(base, elastic(1.0, 0.0), 1.0).motion = Some(always([0.0; 3]));
    scene.body(block, elastic(1.0, 0.0), 1.0);
    scene.contacts = vec![pair(1, 1, 2, friction)];
    // Friction holds from the second step on; a step of MUSL alone would be a fifth of the bound.
    scene.time_step = multiple(0.2);
    scene
}

fn friction() -> RowVerdict {
    let mut free = gate("friction 0: velocity over g sin(theta) t, less one")
        .at_most(1e-9)
        .because("the normal of a flat base has no part along it but round-off, and nothing else acts along the slope");
    let mut sticks = gate("friction 1e9 and infinite: way over what the block shears by at rest")
        .at_most(2.5)
        .because(
            "it swings between nothing and twice that, and a quarter for the first layer of cells",
        );
    let mut limit = gate("friction tan(theta): way over that of free sliding")
        .at_most(2.0 * HEIGHT / (END * 0.5_f64.sqrt()))
        .because("until the base has felt all of the pull, H/c_s, friction is less than that by half in the mean, and from then on as \
                 much: H/(c_s t) of the free way; twice that for the swings of the weight");
    let mut unbalanced = gate("sum of the forces on base and block, over the push")
        .at_most(1e-13)
        .because("the force on the one is that on the other, with its sign");
    let mut pull = gate("pull over push")
        .at_most(1e-13)
        .because("contact never pulls");
    let weight = |y: f64| -ACROSS * (BASE + HEIGHT - y).min(HEIGHT);
    let settled = stressed(move |x| [0.0, weight(x[1]), 0.0, 0.0, 0.0, 0.0]);
    for friction in [0.0, 0.5, 1e9, f64::INFINITY] {
        for scene in each_scheme(&slope(friction), SAFE) {
            let mut simulation = start(&scene, &settled)?;
            let from = simulation.center(1).position[0];
            let [mut off, mut push, mut pulled] = [0.0_f64; 3];
            run_to(&mut simulation, END, |s, _| {
                let (base, block) = (s.contact_force(0), s.contact_force(1));
                off = worst(off, apart(&base, &block.map(|f| -f)));
                push = push.max(block[1]);
                pulled = pulled.max(-block[1]);
            })?;
            unbalanced.see(off / push);
            pull.see(pulled / push);
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
