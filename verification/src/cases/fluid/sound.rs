//! A standing wave of sound that viscosity takes.

use super::{METHOD_ORDER, Problem, WRONG_VISCOSITY};
use crate::cases::prelude::*;
use crate::exact::sound::DampedSound;
use libm::{log, sin};

const LENGTH: f64 = 1.0; // Length between the walls [m]
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const SPEED: f64 = 10.0; // Speed of sound [m/s]
const DECAY: f64 = 0.05; // Decay of the amplitude over the frequency
const AMPLITUDE: f64 = 1e-6; // Largest velocity over the speed of sound at the start
const PERIODS: f64 = 2.0; // Periods until it is looked at, where the velocity is largest
const COURANT: f64 = 0.2; // `c dt/h` with ten cells; it falls with h
const CELLS: f64 = 10.0; // Cells of which it is that
const RATE: &str = "rate of decay"; // Name of the quantity

/// The standing wave.
pub(super) const SOUND: Problem = Problem {
    variant: "sound",
    cells: &[20, 40],
    scene,
    run,
    gates: &[
        error(RATE).at_most(1e-2, "one percent"),
        order(RATE).at_least(1.8, METHOD_ORDER),
    ],
    names: &[RATE],
};

/// Longitudinal viscosity over density \[m²/s\].
fn diffusivity() -> f64 {
    2.0 * DECAY * SPEED * LENGTH / PI
}

/// The velocity at the start, where a rung has one.
pub(super) fn initial(rung: &Rung) -> Option<InitialField> {
    (rung.variant == SOUND.variant).then(|| {
        Arc::new(|x: &Vector| InitialState {
            velocity: [AMPLITUDE * SPEED * sin(PI * x[0] / LENGTH), 0.0, 0.0],
            ..AT_REST
        }) as InitialField
    })
}

fn scene(rung: &Rung) -> Scene {
    let h = rung.cell;
    let mesh = strip(h, [cells(LENGTH, h), 1]);
    let end = PERIODS * 2.0 * LENGTH / SPEED;
    let mut scene = plane_scene("fluid_sound", mesh, end);
    let viscosity = 0.75 * DENSITY * diffusivity();
    let law = Newtonian::new(DENSITY * SPEED * SPEED, viscosity);
    scene.materials = material("fluid", DENSITY, law);
    scene.bodies = vec![body("fluid", 1, rectangle([0.0; 2], [LENGTH, h]))];
    Settings::new(Method::DEFAULT).apply(&mut scene);
    let steps = (end * SPEED / (COURANT * h * CELLS * h / LENGTH)).ceil();
    scene.time_step = equal_steps_of(end / steps);
    scene
}

/// Share of the mode in the velocities.
fn amplitude(simulation: &Simulation) -> Result<f64, Failure> {
    let set = &simulation.sets()[0];
    let (mut sum, mut norm) = (0.0, 0.0);
    for p in 0..set.len() {
        let start = simulation.initial_position(0, p);
        let shape = sin(PI * start.ok_or("no initial positions")?[0] / LENGTH);
        sum += shape * set.velocity(p)[0];
        norm += shape * shape;
    }
    Ok(sum / norm)
}

/// Steps to the end; the decay of the mode in the velocities.
fn run(run: Run<'_>) -> Result<Measurements, Failure> {
    let (simulation, observer) = (run.simulation, run.observer);
    let end = simulation.scene().time;
    let mut all = vec![amplitude(simulation)?];
    observer.phase(Phase::Stepping);
    while simulation.time() < end * (1.0 - 1e-9) {
        step(simulation, end, observer)?;
        all.push(amplitude(simulation)?);
    }
    observer.phase(Phase::Comparing);
    let exact = DampedSound {
        speed: SPEED,
        diffusivity: run.reference.of(&WRONG_VISCOSITY) * diffusivity(),
        wave_number: PI / LENGTH,
    };
    // The first velocity is half a step from the next, all others are a whole one apart.
    let rate = decay(&all[1..], end / simulation.steps() as f64);
    let quantity = Quantity::compared(RATE, rate, exact.decay(), "1/s");
    Ok(Measurements::of([quantity]))
}

/// Rate of decay of a swing by its values `dt` (s) apart (Prony): those a quarter period apart are related by
/// x_(n+1) = a x_n - b x_(n-1) with b = exp(-2 rate quarter), here in the sense of least squares.
fn decay(values: &[f64], dt: f64) -> f64 {
    let quarter = ((values.len() as f64) / (4.0 * PERIODS)).round() as usize;
    let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for n in quarter..values.len().saturating_sub(quarter) {
        let [x, y, z] = [values[n], values[n - quarter], values[n + quarter]];
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
    }
    let b = -(yz * xx - xz * xy) / (xx * yy - xy * xy);
    -log(b) / (2.0 * quarter as f64 * dt)
}
