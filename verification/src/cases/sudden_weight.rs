//! Does a column that is let go swing to twice its weight?
//!
//! Gravity acts from t = 0 on a column at rest between rollers. The pressure on its base
//! rises in a straight line to 2 rho g H and falls again, with the period 4 H/c; its top sinks to twice the static
//! displacement. Strains are 1e-4, and no particle crosses a cell. Compared over one period, in which the front that
//! leaves the base passes the column four times.
//!
//! Expected: the stress has a kink at that front, which dispersion of second order spreads over (h² H)^(1/3): an L2 error
//! of order 1 of the stress and 5/3 of the displacement. The base is where two layers of particles are extrapolated to.
//! `proctor verify sudden-weight`.

use super::prelude::*;
use crate::exact::sudden_weight::SuddenWeight as Exact;

const HEIGHT: f64 = 1.0; // Height [m]
const YOUNG: f64 = 10e6; // Young's modulus [Pa]
const POISSON: f64 = 0.25; // Poisson's ratio
const DENSITY: f64 = 2000.0; // Density [kg/m³]
const STRAIN: f64 = 1e-4; // Weight over the confined modulus
const AIR: usize = 2; // Empty cells above the column
const COURANT: f64 = 0.3; // `c dt/h`
const SAMPLES: u64 = 200; // Number of times, about, at which fields are compared

/// Names of the quantities.
const DISPLACEMENT: &str = "L2(u), column and time";
const STRESS: &str = "L2(stress), column and time";
const BASE: &str = "L2(base pressure), time";
const PEAK: &str = "base pressure at 2 H/c";
const TOP: &str = "top displacement at 2 H/c";
const BACK: &str = "top displacement at 4 H/c over that at 2 H/c";

const KINK: &str = "the kink of the stress is spread over w = (h² H)^(1/3), where the stress is off by w: w^(3/2) over all";
const DISPLACED: &str = "w², as the displacement is off by where the kink is";
// The return to zero knows no weight.
const WRONG_GRAVITY: Wrong =
    Wrong::factor("gravity", 1.05).breaks_only(|gate| !gate.contains(BACK));
const WRONG_SPEED: Wrong = Wrong::factor("wave speed", 1.05).breaks(|gate| gate.contains("L2"));

/// The column that is let go.
pub static SUDDEN_WEIGHT: Case = Case::new(
    "sudden-weight",
    "Does a column that is let go swing to twice its weight?",
)
.ladder(cells_over(&[16, 32, 64], &[16, 32, 64, 128]))
.method(|_| Settings::new(Method::DEFAULT).courant(COURANT))
.scene(scene)
.displacements()
.run(compare)
.gates(&[
    error(DISPLACEMENT).at_most_by(
        |finest| libm::pow(spread(finest), 2.5),
        "w² over the width w of the kink: w^(5/2) over all",
    ),
    error(STRESS).at_most_by(|finest| libm::pow(spread(finest), 1.5), KINK),
    error(BASE).at_most_by(|finest| libm::pow(spread(finest), 1.5), KINK),
    error(PEAK).at_most_by(
        |finest| 0.5 * spread(finest),
        "half the width w of the kink, which is the peak itself",
    ),
    error(TOP).at_most_by(|finest| spread(finest) * spread(finest), DISPLACED),
    error(BACK).at_most_by(|finest| spread(finest) * spread(finest), DISPLACED),
    order(DISPLACEMENT).at_least(1.4, "5/3 of a kink in the stress, less 0.3"),
    order(STRESS).at_least(0.8, "1 of a kink, less 0.2"),
])
.tables(&[TableRule::new(
    "sudden-weight, uGIMP, USL, FLIP",
    &[DISPLACEMENT, STRESS, BASE, PEAK, TOP, BACK],
)])
.wrong_references(&[WRONG_GRAVITY, WRONG_SPEED])
.studies(&[Plan::new(
    cells_over(&[16, 32, 64], &[16, 32, 64, 128, 256]),
    &[
        Measure::new("displacement", DISPLACEMENT),
        Measure::new("stress", STRESS),
    ],
    1,
)])
.guest(guest);

const fn cells_over(short: &'static [u32], full: &'static [u32]) -> Ladder {
    Ladder::cells("column", "H/h", HEIGHT, short, full)
}

/// Observations at one time.
#[derive(Clone, Copy, Debug)]
struct Observations {
    time: f64,
    base: f64,
    top: f64,
}

/// Modulus of confined compression \[Pa\].
fn modulus() -> f64 {
    YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
}

/// Gravity of the scene \[m/s²\].
fn gravity() -> f64 {
    STRAIN * modulus() / (DENSITY * HEIGHT)
}

fn exact(reference: Reference) -> Exact {
    Exact {
        height: HEIGHT,
        wave_speed: reference.of(&WRONG_SPEED) * (modulus() / DENSITY).sqrt(),
        gravity: reference.of(&WRONG_GRAVITY) * gravity(),
    }
}

/// The width w over which dispersion spreads the kink on a mesh, over the height.
fn spread(finest: &Rung) -> f64 {
    libm::pow(finest.cell / HEIGHT, 2.0 / 3.0)
}

/// Mean over the layer of particles that began at a height \[m\].
fn layer(
    simulation: &Simulation,
    height: f64,
    value: impl Fn(usize) -> Option<f64>,
) -> Result<f64, Failure> {
    let (mut sum, mut count) = (0.0, 0.0);
    for p in 0..simulation.particles() {
        let y = simulation.initial_position(0, p).ok_or(MISSING)?[1];
        if (y - height).abs() < 1e-3 * simulation.scene().mesh.cell[1] {
            sum += value(p).ok_or(MISSING)?;
            count += 1.0;
        }
    }
    Ok(sum / count)
}

/// Pressure on the base and displacement of the top now.
fn ends(simulation: &Simulation, settings: &Settings) -> Result<Observations, Failure> {
    let depth = 0.5 * simulation.scene().mesh.cell[1] / settings.particles_per_cell as f64;
    let stress = |p: usize| Some(simulation.sets()[0].stress(p)[1]);
    let lowest = layer(simulation, depth, stress)?;
    let next = layer(simulation, 3.0 * depth, stress)?;
    let sunk = |p: usize| Some(simulation.displacement(0, p)?[1]);
    let uppermost = layer(simulation, HEIGHT - depth, sunk)?;
    let below = layer(simulation, HEIGHT - 3.0 * depth, sunk)?;
    Ok(Observations {
        time: simulation.time(),
        base: -(1.5 * lowest - 0.5 * next),
        // The stress at the top is zero, so u = u(H) - b (H - z)², and the second layer is three times as deep.
        top: uppermost + (uppermost - below) / 8.0,
    })
}

/// Error of a simulation without the initial positions, which one that keeps displacements has.
const MISSING: &str = "the simulation kept no initial positions";

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, exact) = (rung.cell, exact(Reference::CORRECT));
    let mut mesh = strip(h, [1, cells(HEIGHT, h) + AIR]);
    mesh.planes[1][1] = PlaneCondition::Free;
    // Half the period is a whole number of steps.
    let (time_step, _) = settings.equal_steps(0.5 * exact.period(), h, exact.wave_speed);
    settings.applied(Scene {
        time_step,
        gravity: [0.0, -exact.gravity, 0.0],
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("column", 1, rectangle([0.0; 2], [h, HEIGHT]))],
        ..plane_scene("sudden_weight", mesh, exact.period())
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, settings, reference) = (run.rung, run.settings, run.reference);
    let (simulation, observer) = (run.simulation, run.observer);
    let of_scene = exact(Reference::CORRECT);
    let (_, half) = settings.equal_steps(0.5 * of_scene.period(), rung.cell, of_scene.wave_speed);
    let exact = exact(reference);
    let every = (2 * half / SAMPLES).max(1);
    let (mut of_u, mut of_stress, mut seen) = (vec![], vec![], vec![]);
    let mut middle = None;
    let end = simulation.scene().time;
    observer.phase(Phase::Stepping);
    while simulation.steps() < 2 * half {
        step(simulation, end, observer)?;
        let now = simulation.steps();
        if !(2 * half - now).is_multiple_of(every) && now != half {
            continue;
        }
        observer.phase(Phase::Comparing);
        let (set, t) = (&simulation.sets()[0], simulation.time());
        for p in 0..set.len() {
            let z = simulation.initial_position(0, p).ok_or(MISSING)?[1];
            let u = simulation.displacement(0, p).ok_or(MISSING)?[1];
            let mass = simulation.particle_mass(0, p);
            of_u.push((mass, [u], [exact.displacement(z, t)]));
            of_stress.push((mass, [set.stress(p)[1]], [exact.stress(z, t, DENSITY)]));
        }
        let ends = ends(simulation, settings)?;
        if now == half {
            middle = Some(ends);
        }
        seen.push(ends);
        observer.progress(now as f64 / (2 * half) as f64);
        observer.phase(Phase::Stepping);
    }
    observer.phase(Phase::Comparing);
    let middle = middle.ok_or(MISSING)?;
    let back = seen.last().ok_or(MISSING)?;
    let pressure = |t: f64| -exact.stress(0.0, t, DENSITY);
    let of_base = seen.iter().map(|s| (1.0, [s.base], [pressure(s.time)]));
    let weight = DENSITY * exact.gravity * HEIGHT;
    let quantities = vec![
        ratio(DISPLACEMENT, relative_l2(of_u)),
        ratio(STRESS, relative_l2(of_stress)),
        ratio(BASE, relative_l2(of_base)),
        Quantity::compared(PEAK, middle.base, 2.0 * weight, "Pa"),
        Quantity::compared(TOP, middle.top, 2.0 * exact.at_rest(HEIGHT), "m"),
        Quantity::of_zero(BACK, back.top / middle.top),
    ];
    let scale = STRAIN * modulus();
    let points = seen.iter().map(|s| {
        let at = s.time * of_scene.wave_speed / HEIGHT;
        CurvePoint::new(at, s.base / scale, pressure(s.time) / scale)
    });
    let title = format!("pressure on the base over time, {}", rung.label);
    let curve = Curve::new(title, ["c t / H", "pressure / (rho g H)"], points);
    Ok(Measurements::of(quantities).drawn(curve))
}

fn guest(rung: &Rung) -> Result<Guest, &'static str> {
    let scene = guest::slab(scene(rung, &guest::settings()));
    let exact = exact(Reference::CORRECT);
    let step = guest::COURANT * rung.cell / exact.wave_speed;
    let scene = guest::prepared(scene, guest::FRAMES, step);
    let sunk = move |x: &Vector, t| [0.0, exact.displacement(x[1], t), 0.0];
    Ok(Guest::new(scene, sunk).with_stress(move |x, t| {
        let vertical = exact.stress(x[1], t, DENSITY);
        let lateral = POISSON / (1.0 - POISSON) * vertical;
        [lateral, vertical, lateral, 0.0, 0.0, 0.0]
    }))
}
