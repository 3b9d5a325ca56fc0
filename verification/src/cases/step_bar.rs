//! Does a front run with c, double at a wall, and throw a bar back from one?
//!
//! Source: d'Alembert's waves. A bar held at one end is pressed at the other from t = 0 (`pressed`):
//! the front arrives where and when it should, what it has passed moves with p/(rho c), and the held end feels 2 p. A
//! bar that runs into a driven body at rest (`thrown`) presses on it with rho c v for 2 L/c and leaves with its speed
//! turned round. Strains are 1e-4: nothing crosses cells.
//!
//! Fronts ring and are spread by dispersion of second order over w = (h² L)^(1/3). So what is judged are integrals: speeds
//! from displacements, the held end's pressure from what momentum lacks, the duration as twice the centroid of the force.
//! The front itself is where the stress is a third of the pressure. `proctor verify step-bar`.
//!
//! Expected: the displacement has a kink, which spreads to an L2 error of order 1; the stress a jump, order 1/3; the
//! impact has order 2/3, as the last of the wave's impulse comes late.

use super::prelude::*;
use super::vocabulary::impulse::Impulse;
use crate::exact::bar_impact::MovingBar;
use crate::exact::step_bar::StepBar as Exact;

const LENGTH: f64 = 1.0; // Length [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]; Poisson's ratio is zero
const DENSITY: f64 = 1e3; // Density [kg/m³]; waves run at 31.6 m/s
const STRAIN: f64 = 1e-4; // Pressure over modulus, and speed of the thrown bar over that of waves
const COURANT: f64 = 0.3; // `c dt/h`
const AIR: usize = 2; // Empty cells beyond the free end
const WALL_CELLS: usize = 2; // Thickness of the wall of the thrown bar in cells
/// Time of the comparison of the pressed bar, in transits: the front is on its way in.
const COMPARED: f64 = 0.75;
/// Between these times, in transits, the pressure at the held end is judged: the front is on its way back.
const REFLECTED: [f64; 2] = [1.25, 1.75];
/// Between these times the pressure of the thrown bar is judged.
const PRESSED: [f64; 2] = [0.5, 1.5];
const PARTED: f64 = 3.0; // End of the run of the thrown bar, in transits

const LOADED: &str = "pressed"; // Bar under a pressure
const THROWN: &str = "thrown"; // Bar against a wall

/// Names of the quantities.
const FRONT: &str = "distance of the front";
const SPEED: &str = "speed behind the front";
const HELD: &str = "pressure at the held end";
const DURATION: &str = "duration";
const PRESSURE: &str = "pressure on the wall";
const REBOUND: &str = "speed of the rebound";

/// Error of a simulation without the initial positions, which one that keeps displacements has.
const MISSING: &str = "the simulation kept no initial positions";

const KINK: &str = "a kink over w, with an error of w in the bent function: w^(3/2)";
const FRONT_WITHIN: &str = "a tenth of the width w over which dispersion spreads it";
const MEAN: &str = "ringing averages out, and leaves no more than w²";
const IMPACT: &str = "the last of the wave's impulse comes w late, or never";
const WRONG_STIFFNESS: Wrong = Wrong::factor("stiffness", 1.1).breaks(|gate| {
    ["error of L2(u)", "error of way of", "error of duration"]
        .iter()
        .any(|name| gate.contains(name))
});
const WRONG_LOAD: Wrong = Wrong::factor("load", 1.06).breaks(|gate| {
    ["error of L2(u)", "speed", "pressure"]
        .iter()
        .any(|name| gate.contains(name))
});

const TABLE: &str = "step-bar, {variant}, uGIMP, USL, FLIP"; // Title of the tables

/// The bar.
pub static STEP_BAR: Case = Case::new(
    "step-bar",
    "Does a front run with c, double at a wall, and throw a bar back from one?",
)
.ladder(Ladder::variants(
    &[LOADED, THROWN],
    " ",
    "L/h",
    LENGTH,
    [&[32, 64, 128], &[32, 64, 128, 256]],
))
.method(|_| Settings::new(Method::DEFAULT).courant(COURANT))
.scene(scene)
.displacements()
.run(compare)
.gates_of_variants(&[
    spread(LOADED, DISPLACEMENT, [1.0, 1.5], KINK),
    spread(LOADED, FRONT, [0.1, 1.0], FRONT_WITHIN),
    spread(LOADED, SPEED, [1.0, 2.0], MEAN),
    spread(LOADED, HELD, [1.0, 2.0], MEAN),
    order(DISPLACEMENT)
        .at_least(0.8, "order 1 of a kink, less 0.2")
        .of(LOADED),
    order(STRESS)
        .at_least(0.25, "order 1/3 of a jump, less 0.08")
        .of(LOADED),
    spread(THROWN, DURATION, [0.5, 1.0], IMPACT),
    spread(THROWN, PRESSURE, [1.0, 2.0], MEAN),
    spread(THROWN, REBOUND, [0.5, 1.0], IMPACT),
    order(DURATION)
        .at_least(0.6, "2/3, as the front spreads")
        .of(THROWN),
])
.tables(&[
    TableRule::new(TABLE, &[DISPLACEMENT, FRONT, SPEED, HELD, STRESS]).of(|v| v == LOADED),
    TableRule::new(TABLE, &[DURATION, PRESSURE, REBOUND]).of(|v| v == THROWN),
])
.wrong_references(&[WRONG_STIFFNESS, WRONG_LOAD])
.studies(&[Plan::new(
    Ladder::variants(
        &[LOADED],
        " ",
        "L/h",
        LENGTH,
        [&[16, 32, 64], &[16, 32, 64, 128, 256]],
    ),
    FIELDS,
    1,
)])
.guest(guest);

/// Gate on an error of a variant: at most a share of a power of the width w.
const fn spread(
    variant: &'static str,
    quantity: &'static str,
    share_and_power: [f64; 2],
    reason: &'static str,
) -> GateRule {
    let gate = error(quantity).at_most_spread(LENGTH, share_and_power, reason);
    gate.of(variant)
}

/// The exact bar, as the case refers to it.
fn exact(reference: Reference) -> Exact {
    Exact {
        length: LENGTH,
        modulus: reference.of(&WRONG_STIFFNESS) * YOUNG,
        density: DENSITY,
        pressure: reference.of(&WRONG_LOAD) * STRAIN * YOUNG,
    }
}

/// Time that a wave of the scene takes along the bar \[s\].
fn transit() -> f64 {
    exact(Reference::CORRECT).transit()
}

/// Speed of the thrown bar \[m/s\].
fn speed() -> f64 {
    STRAIN * (YOUNG / DENSITY).sqrt()
}

/// Cross-section of the bar \[m²\]: one cell high, 1 m thick.
fn section(simulation: &Simulation) -> f64 {
    simulation.scene().mesh.cell[1]
}

fn pressed(run: Run<'_>) -> Result<Measurements, Failure> {
    let (exact, simulation, observer) = (exact(run.reference), run.simulation, run.observer);
    run_until(simulation, COMPARED * transit(), observer, |_| ())?;
    let t = simulation.time();
    let mut quantities = errors(
        simulation,
        |x| [exact.displacement(x[0], t), 0.0, 0.0],
        |x| uniaxial(exact.stress(x[0], t)),
    );
    let curve = curve(simulation, &exact, run.rung);
    let (front, at) = (way_of_the_front(simulation)?, exact.wave_speed() * t);
    let (speed, of_exact) = (
        speed_behind_the_front(simulation, t)?,
        exact.speed_behind_the_front(),
    );
    quantities.push(Quantity::compared(FRONT, front, at, "m"));
    quantities.push(Quantity::compared(SPEED, speed, of_exact, "m/s"));
    let [from, to] = REFLECTED.map(|transits| transits * transit());
    let mut sample = |stop| -> Result<[f64; 2], Failure> {
        run_until(simulation, stop, observer, |_| ())?;
        Ok([simulation.velocity_time(), simulation.momentum()[0]])
    };
    let (before, after) = (sample(from)?, sample(to)?);
    // What pressure and wall push together.
    let force = (after[1] - before[1]) / (after[0] - before[0]);
    let held = force / section(simulation) + STRAIN * YOUNG;
    quantities.push(Quantity::compared(HELD, held, 2.0 * exact.pressure, "Pa"));
    Ok(Measurements::of(quantities).drawn(curve))
}

/// Distance from the loaded end at which the stress is a third of the pressure \[m\]: a front that dispersion of third order has
/// spread is an integral of Airy's function, which has a third of its jump where the front would be.
fn way_of_the_front(simulation: &Simulation) -> Result<f64, Failure> {
    let set = &simulation.sets()[0];
    let layers = along(simulation, 0, |p, x| [-set.stress(p)[0], x]).ok_or(MISSING)?;
    let level = STRAIN * YOUNG / 3.0;
    let pair = layers
        .windows(2)
        .find(|pair| pair[0].computed < level && pair[1].computed >= level)
        .ok_or("no stress is a third of the pressure")?;
    let [a, b] = [pair[0], pair[1]];
    let share = (level - a.computed) / (b.computed - a.computed);
    Ok(LENGTH - (a.at + share * (b.at - a.at)))
}

/// Mean speed over the half of the way that is behind the front by most \[m/s\]: displacements over the time since it
/// passed.
fn speed_behind_the_front(simulation: &Simulation, t: f64) -> Result<f64, Failure> {
    let (mut sum, mut mass) = (0.0, 0.0);
    let way = COMPARED * LENGTH;
    for p in 0..simulation.particles() {
        let depth = LENGTH - simulation.initial_position(0, p).ok_or(MISSING)?[0];
        if depth < 0.5 * way {
            let m = simulation.particle_mass(0, p);
            let u = -simulation.displacement(0, p).ok_or(MISSING)?[0];
            sum += m * u / (t * (1.0 - depth / way));
            mass += m;
        }
    }
    Ok(sum / mass)
}

/// Axial stress along the bar against the exact one, over the pressure.
fn curve(simulation: &Simulation, exact: &Exact, rung: &Rung) -> Option<Curve> {
    let (set, t) = (&simulation.sets()[0], simulation.time());
    let points = along(simulation, 0, |p, x| {
        [set.stress(p)[0], exact.stress(x, t)].map(|s| s / (STRAIN * YOUNG))
    })?;
    let title = format!(
        "stress along the bar after {COMPARED} transits, {}",
        rung.label
    );
    Some(Curve::new(title, ["x (m)", "stress / p"], points))
}

fn thrown(run: Run<'_>) -> Result<Measurements, Failure> {
    let (reference, simulation, observer) = (run.reference, run.simulation, run.observer);
    let exact = MovingBar {
        length: LENGTH,
        modulus: reference.of(&WRONG_STIFFNESS) * YOUNG,
        density: DENSITY,
        velocity: -reference.of(&WRONG_LOAD) * speed(),
    }
    .at_a_wall();
    let (mut impulse, mut judged) = (Impulse::of(simulation), [0.0; 2]);
    let [from, to] = PRESSED.map(|transits| transits * transit());
    run_until(simulation, PARTED * transit(), observer, |s| {
        let force = s.contact_force(0)[0];
        let (at, kick) = impulse.add(s, force);
        if (from..to).contains(&at) {
            judged = [judged[0] + force * kick, judged[1] + kick];
        }
    })?;
    let pressure = judged[0] / judged[1] / section(simulation);
    let rebound = simulation.center(0).velocity[0];
    let quantities = vec![
        Quantity::compared(DURATION, impulse.duration(), exact.duration, "s"),
        Quantity::compared(PRESSURE, pressure, exact.stress, "Pa"),
        Quantity::compared(REBOUND, rebound, exact.velocity, "m/s"),
    ];
    Ok(Measurements::of(quantities))
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, thrown) = (rung.cell, rung.variant == THROWN);
    let before = if thrown { WALL_CELLS } else { 0 };
    let start = before as f64 * h;
    let mut mesh = strip(h, [before + cells(LENGTH, h) + AIR, 1]);
    mesh.planes[0][1] = PlaneCondition::Free;
    let transits = if thrown { PARTED } else { REFLECTED[1] };
    let mut scene = plane_scene("step_bar", mesh, transits * transit());
    scene.materials = elastic(DENSITY, YOUNG, 0.0);
    let bar = rectangle([start, 0.0], [start + LENGTH, h]);
    scene.bodies = vec![body("bar", 1, bar)];
    if thrown {
        scene.mesh.planes[0][0] = PlaneCondition::Free;
        scene.bodies[0].velocity[0] = -speed();
        let mut wall = body("wall", 2, rectangle([0.0; 2], [start, h]));
        wall.motion = Some(History {
            times: vec![0.0, scene.time],
            values: vec![[0.0; 3]; 2],
        });
        scene.bodies.push(wall);
        scene.contacts = contact("bar on wall", [2, 1], 0.0, ContactNormal::Collinear);
    } else {
        let pressure = [-STRAIN * YOUNG, 0.0, 0.0];
        scene.tractions = traction([LENGTH, 0.0, 0.0], [LENGTH, h, 0.0], pressure);
    }
    scene.time_step = settings.multiplier();
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    if run.rung.variant == THROWN {
        thrown(run)
    } else {
        pressed(run)
    }
}

fn guest(rung: &Rung) -> Result<Guest, &'static str> {
    if rung.variant != LOADED {
        return Err("only the time for which the thrown bar presses on the wall is known");
    }
    let mut scene = guest::slab(scene(rung, &guest::settings()));
    scene.time = COMPARED * transit();
    let (scene, tractions) = guest::with_nodal_loads(scene);
    let exact = exact(Reference::CORRECT);
    let step = guest::COURANT * rung.cell / exact.wave_speed();
    let scene = guest::prepared(scene, 1, step);
    let moved = move |x: &Vector, t| [exact.displacement(x[0], t), 0.0, 0.0];
    let guest = Guest {
        tractions,
        ..Guest::new(scene, moved).at_the_end()
    };
    Ok(guest.with_stress(move |x, t| uniaxial(exact.stress(x[0], t))))
}
