//! Does water at rest stay at rest where the porosity of the ground jumps?
//!
//! Source: hydrostatics. A column of 1 m with a porosity of 0.3 below and 0.5 above, both phases under their weight, begins
//! with the pressure of water at rest and the effective stress of the buoyant weight. Nothing may move: a method that
//! maps the pressure with the porosity of particles is off by a seventh of the pressure at once, and its water flows
//! for ever.
//!
//! Expected: rest to round-off; a prototype had 4e-17 m/s and 5e-11 of 9875 Pa. `proctor verify hydrostatic-jump`.

use super::prelude::*;

/// Bulk modulus of the water over the modulus of the skeleton.
const STIFF: [(&str, f64); 2] = [("K_w/E_c=20", 20.0), ("K_w/E_c=200", 200.0)];
const POROSITIES: [f64; 2] = [0.3, 0.5]; // Below and above the middle
const CONDUCTIVITY: f64 = 1e-4; // Hydraulic conductivity [m/s]
const GRAVITY: f64 = 10.0; // Gravity [m/s²]
const STEPS: [f64; 2] = [2000.0, 20_000.0]; // Steps of the short ladder and of the full one
const FLOW: &str = "largest velocity of the water in the soil";
const PRESSURE: &str = "max(p off hydrostatic), over that at the base";
const WRONG_GRAVITY: Wrong =
    Wrong::factor("gravity", 1.001).breaks_only(|gate| gate.contains(PRESSURE));

/// The column that rests.
pub static HYDROSTATIC_JUMP: Case = Case::new(
    "hydrostatic-jump",
    "Does water at rest stay at rest where the porosity of the ground jumps?",
)
.ladder(Ladder::made(|size| {
    let of = |(variant, stiff): (&'static str, f64)| {
        let label = format!("{variant} H/h=16");
        Rung::labelled(label, variant, HEIGHT / 16.0).with((stiff, STEPS[size as usize]))
    };
    STIFF.map(of).to_vec()
}))
.method(|_| Settings::new(Method::DEFAULT).courant(WET_COURANT))
.scene(scene)
.options(|_, _, options| {
    starting(options, |x| InitialState {
        stress: [0.0, -effective(x[1]), 0.0, 0.0, 0.0, 0.0],
        ..AT_REST
    })
})
.compare(compare)
.gates_of_rungs(&[
    value(FLOW).at_most(1e-12, "round-off of forces, over the drag"),
    error(PRESSURE).at_most(1e-9, "round-off of the steps"),
])
.wrong_references(&[WRONG_GRAVITY])
.no_study("nothing moves, with any mesh")
.no_guest("no other solver of the protocol knows pore water");

/// Effective stress by the buoyant weight above a height \[Pa\].
fn effective(y: f64) -> f64 {
    let weight = |n: f64, depth: f64| (1.0 - n) * (GRAINS - WATER) * GRAVITY * depth;
    let middle = 0.5 * HEIGHT;
    weight(POROSITIES[1], HEIGHT - y.max(middle)) + weight(POROSITIES[0], middle - y.min(middle))
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, &(stiff, steps)) = (rung.cell, rung.problem::<(f64, f64)>());
    let waters = POROSITIES.map(|n| PoreWater {
        bulk: stiff * SKELETON,
        ..pore_water(n, CONDUCTIVITY)
    });
    let fastest = waters.iter().map(fast_speed).fold(0.0, f64::max);
    let end = steps * settings.courant_or_automatic() * h / fastest;
    let mut scene = wet_column("hydrostatic_jump", h, settings, waters[0], end);
    scene.time_step = settings.equal_steps(end, h, fastest).0;
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.pore_water = waters.map(Some).to_vec();
    scene.materials = [1, 2]
        .map(|id| Material {
            id,
            name: format!("soil {id}"),
            ..elastic(GRAINS, SKELETON, 0.0).remove(0)
        })
        .to_vec();
    scene.bodies = [(0, 0.0), (1, 0.5 * HEIGHT)]
        .map(|(material, low)| Body {
            material,
            ..body(
                format!("soil {}", material + 1),
                material as i64 + 1,
                rectangle([0.0, low], [h, low + 0.5 * HEIGHT]),
            )
        })
        .to_vec();
    // One box for each row of particles.
    let row = h / settings.particles_per_cell as f64;
    let rows = (HEIGHT / row).round() as usize;
    scene.initial_pressures = (0..rows)
        .map(|i| InitialPressure::Box {
            p1: [0.0, i as f64 * row, 0.0],
            p2: [h, (i + 1) as f64 * row, 0.0],
            pressure: WATER * GRAVITY * (HEIGHT - (i as f64 + 0.5) * row),
        })
        .collect();
    settings.applied(scene)
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let simulation = &*run.simulation;
    let gravity = run.reference.of(&WRONG_GRAVITY) * GRAVITY;
    let (mut flow, mut off) = (0.0_f64, 0.0_f64);
    for (body, set) in simulation.sets().iter().enumerate() {
        for p in 0..set.len() {
            flow = flow.max(seeping(simulation, body, p).abs());
            let exact = WATER * gravity * (HEIGHT - set.position(p)[1]);
            let p = pore_pressure(simulation, body, p);
            off = off.max((p - exact).abs() / (WATER * gravity * HEIGHT));
        }
    }
    Ok(Measurements::of([
        Quantity::balance(FLOW, flow, "m/s"),
        ratio(PRESSURE, Some(off)),
    ]))
}
