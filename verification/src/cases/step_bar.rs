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
    error(DISPLACEMENT)
        .at_most_spread(LENGTH, [1.0, 1.5], KINK)
        .on(is_loaded),
    error(FRONT)
        .at_most_spread(
            LENGTH,
            [0.1, 1.0],
            "a tenth of the width w over which dispersion spreads it",
        )
        .on(is_loaded),
    error(SPEED)
        .at_most_spread(LENGTH, [1.0, 2.0], MEAN)
        .on(is_loaded),
    error(HELD)
        .at_most_spread(LENGTH, [1.0, 2.0], MEAN)
        .on(is_loaded),
    order(DISPLACEMENT)
        .at_least(0.8, "order 1 of a kink, less 0.2")
        .on(is_loaded),
    order(STRESS)
        .at_least(0.25, "order 1/3 of a jump, less 0.08")
        .on(is_loaded),
    error(DURATION)
        .at_most_spread(LENGTH, [0.5, 1.0], IMPACT)
        .on(is_thrown),
    error(PRESSURE)
        .at_most_spread(LENGTH, [1.0, 2.0], MEAN)
        .on(is_thrown),
    error(REBOUND)
        .at_most_spread(LENGTH, [0.5, 1.0], IMPACT)
        .on(is_thrown),
    order(DURATION)
        .at_least(0.6, "2/3, as the front spreads")
        .on(is_thrown),
])
.tables(&[
    TableRule::new(
        "step-bar, {variant}, uGIMP, USL, FLIP",
        &[DISPLACEMENT, FRONT, SPEED, HELD, STRESS],
    )
    .of(|variant| variant == LOADED),
    TableRule::new(
        "step-bar, {variant}, uGIMP, USL, FLIP",
        &[DURATION, PRESSURE, REBOUND],
    )
    .of(|variant| variant == THROWN),
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

fn is_loaded(rung: &Rung) -> bool {
    rung.variant == LOADED
}

fn is_thrown(rung: &Rung) -> bool {
    rung.variant == THROWN
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

fn pressed(
    reference: Reference,
    rung: &Rung,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<Measurements, Failure> {
    let exact = exact(reference);
    run_until(simulation, COMPARED * transit(), observer, |_| ())?;
    let t = simulation.time();
    let mut quantities = errors(
        simulation,
        |x| [exact.displacement(x[0], t), 0.0, 0.0],
        |x| [exact.stress(x[0], t), 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let curve = curve(simulation, &exact, rung);
    quantities.push(Quantity::compared(
        FRONT,
        way_of_the_front(simulation)?,
        exact.wave_speed() * t,
        "m",
    ));
    quantities.push(Quantity::compared(
        SPEED,
        speed_behind_the_front(simulation, t)?,
        exact.speed_behind_the_front(),
        "m/s",
    ));
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
    Some(Curve::new(
        format!(
            "stress along the bar after {COMPARED} transits, {}",
            rung.label
        ),
        ["x (m)", "stress / p"],
        points,
    ))
}

fn thrown(
    reference: Reference,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<Measurements, Failure> {
    let exact = MovingBar {
        length: LENGTH,
        modulus: reference.of(&WRONG_STIFFNESS) * YOUNG,
        density: DENSITY,
        velocity: -reference.of(&WRONG_LOAD) * speed(),
    }
    .at_a_wall();
    let (mut impulse, mut moment, mut judged) = (0.0, 0.0, [0.0; 2]);
    let mut kicked = simulation.velocity_time();
    let mut force_at = simulation.time();
    let [from, to] = PRESSED.map(|transits| transits * transit());
    run_until(simulation, PARTED * transit(), observer, |s| {
        // The force is that at the positions before the step; it kicks velocities from half step to half step.
        let kick = s.velocity_time() - kicked;
        let force = s.contact_force(0)[0];
        impulse += force * kick;
        moment += force * kick * force_at;
        if (from..to).contains(&force_at) {
            judged = [judged[0] + force * kick, judged[1] + kick];
        }
        (kicked, force_at) = (s.velocity_time(), s.time());
    })?;
    let pressure = judged[0] / judged[1] / section(simulation);
    let rebound = simulation.center(0).velocity[0];
    let quantities = vec![
        Quantity::compared(DURATION, 2.0 * moment / impulse, exact.duration, "s"),
        Quantity::compared(PRESSURE, pressure, exact.stress, "Pa"),
        Quantity::compared(REBOUND, rebound, exact.velocity, "m/s"),
    ];
    Ok(Measurements::of(quantities))
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, thrown) = (rung.cell, rung.variant == THROWN);
    let cells = (LENGTH / h).round() as usize;
    let start = if thrown { WALL_CELLS as f64 * h } else { 0.0 };
    let before = if thrown { WALL_CELLS } else { 0 };
    let mut mesh = Mesh::new(
        Dimension::Two,
        [0.0; 3],
        [h; 3],
        [before + cells + AIR, 1, 1],
    );
    mesh.planes[0][1] = PlaneCondition::Free;
    let transits = if thrown { PARTED } else { REFLECTED[1] };
    let mut scene = plane_scene("step_bar", mesh, transits * transit());
    scene.materials = elastic(DENSITY, YOUNG, 0.0);
    scene.bodies = vec![body(
        "bar",
        1,
        cuboid([start, 0.0, 0.0], [start + LENGTH, h, 0.0]),
    )];
    if thrown {
        scene.mesh.planes[0][0] = PlaneCondition::Free;
        scene.bodies[0].velocity[0] = -speed();
        let mut wall = body("wall", 2, rectangle([0.0; 2], [start, h]));
        wall.motion = Some(History {
            times: vec![0.0, scene.time],
            values: vec![[0.0; 3]; 2],
        });
        scene.bodies.push(wall);
        scene.contacts = vec![Contact {
            name: "bar on wall".to_owned(),
            id: 1,
            friction: 0.0,
            master: 2,
            slave: 1,
            normal: ContactNormal::Collinear,
        }];
    } else {
        scene.tractions = vec![Traction {
            p1: [LENGTH, 0.0, 0.0],
            p2: [LENGTH, h, 0.0],
            traction: [-STRAIN * YOUNG, 0.0, 0.0].into(),
        }];
    }
    scene.time_step = settings.multiplier();
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, reference) = (run.rung, run.reference);
    let (simulation, observer) = (run.simulation, run.observer);
    if rung.variant == THROWN {
        thrown(reference, simulation, observer)
    } else {
        pressed(reference, rung, simulation, observer)
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
