//! Does the error fall beside the axis of a cylinder, where particle domains lie across nodes?
//!
//! Source: a body force that holds u = A (r - r³) in plane strain, from the balance along the radius:
//! rho b = -(lambda + 2 mu) d/dr(u' + u/r) = 8 (lambda + 2 mu) A r. The cylinder of 1 m is held at its rim, where u is zero. Three
//! particles lie on two cells, so every other domain has a node inside it, which tells derivatives with the radius from those of
//! the plane.
//!
//! Expected: order 2 in L2; the largest error within two cells of the axis falls faster, as the displacement falls to zero there.
//! `proctor verify cylinder-core`.

use super::prelude::*;

const RADIUS: f64 = 1.0; // Radius of the cylinder [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const AMPLITUDE: f64 = 1e-6; // Factor A of the displacement [m]
/// Cells from the axis within which the largest error is taken.
const BESIDE: f64 = 2.0;
/// Residual at which the relaxation stops, over the body force.
const RESIDUAL_TARGET: f64 = 1e-9;
const CORE: &str = "largest error of u beside the axis over A";
const RESIDUAL: &str = "residual";
const WRONG_AMPLITUDE: Wrong =
    Wrong::factor("amplitude", 1.05).breaks(|gate| gate.contains("error of L2(u)"));

/// The core of a cylinder.
pub static CYLINDER_CORE: Case = Case::new(
    "cylinder-core",
    "Does the error fall beside the axis of a cylinder, where particle domains lie across nodes?",
)
.ladder(Ladder::cells("core", "R/h", RADIUS, &[8, 16], &[8, 16, 32, 64]))
.method(|_| Settings::new(Method::DEFAULT))
.scene(scene)
.options(start)
.displacements()
.residual()
.compare_after(settle, compare)
.gates(&[
    order(CORE).at_least(
        2.0,
        "the displacement is linear there but for r³; a prototype of the same weights had 2.96",
    ),
    error(DISPLACEMENT).at_most_by(
        |finest| 1e-2 * (16.0 * finest.cell / RADIUS).powi(2),
        "twice what weights take from r³: their variance is h²/5, of which u'' takes a half, 0.6 % at 16 cells",
    ),
    order(DISPLACEMENT).at_least(1.8, "order 2, less 0.2"),
    at_rest(RESIDUAL, 1e-8),
])
.tables(&[TableRule::new(
    "cylinder, three particles on two cells, uGIMP",
    &[DISPLACEMENT, CORE],
)])
.wrong_references(&[WRONG_AMPLITUDE])
.no_study("*thick-cylinder* compares methods at rest, and here the particles are placed by hand")
.no_guest("the scenes of other solvers have no axis of revolution");

/// Modulus of a wave of pressure \[Pa\].
fn modulus() -> f64 {
    let speed = p_wave_speed(YOUNG, POISSON, DENSITY);
    DENSITY * speed * speed
}

fn displacement(amplitude: f64, r: f64) -> f64 {
    amplitude * (r - r * r * r)
}

/// Body force per mass at a radius \[m/s²\].
fn force(r: f64) -> f64 {
    8.0 * modulus() * AMPLITUDE * r / DENSITY
}

/// Square rings, three on two cells along both axes.
fn rings(h: f64) -> Shape {
    let side = 2.0 * h / 3.0;
    let at = |k: usize| (k as f64 + 0.5) * side;
    let seeds = (0..cells(RADIUS, side)).flat_map(|i| {
        (0..3).map(move |k| ParticleSeed {
            position: [at(i), at(k), 0.0],
            volume: TAU * at(i) * side * side,
        })
    });
    Shape::Particles(Arc::new(seeds.collect()))
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = revolved_strip(h, [cells(RADIUS, h), 2]);
    mesh.planes[0][1] = PlaneCondition::Fixed;
    settings.applied(Scene {
        time_step: settings.multiplier(),
        damping: Damping::Kinetic,
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("cylinder", 1, rings(h))],
        ..plane_scene("cylinder_core", mesh, 1.0)
    })
}

fn start(_: &Rung, _: Reference, options: Options) -> Options {
    driven(options, |x, _| [force(x[0]), 0.0, 0.0])
}

fn settle(run: &mut Run<'_>) -> Result<(), Failure> {
    // The integral of rho b over the cylinder, two cells high.
    let height = 2.0 * run.rung.cell;
    let load = DENSITY * force(RADIUS) * height * TAU * RADIUS * RADIUS / 3.0;
    run.relax(load, RESIDUAL_TARGET, RADIUS)
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let amplitude = AMPLITUDE * run.reference.of(&WRONG_AMPLITUDE);
    let (simulation, h) = (&*run.simulation, run.rung.cell);
    let known = |x: Vector| [displacement(amplitude, x[0]), 0.0, 0.0];
    let field = l2(simulation, |p, x| {
        Some((simulation.displacement(0, p)?, known(x)))
    });
    let mut most = 0.0_f64;
    for p in 0..simulation.sets()[0].len() {
        let x = simulation.initial_position(0, p);
        let u = simulation.displacement(0, p);
        let (x, u) = x.zip(u).ok_or("no displacements are kept")?;
        if x[0] < BESIDE * h {
            most = most.max((u[0] - known(x)[0]).abs() / AMPLITUDE);
        }
    }
    let points = run.along(0, |p, r| {
        let found = simulation.displacement(0, p).map_or(f64::NAN, |u| u[0]);
        [found, displacement(amplitude, r)]
    });
    let title = format!("radial displacement, {}", run.rung.label);
    let curve = points.map(|points| Curve::new(title, ["r (m)", "u (m)"], points));
    Ok(Measurements::of([
        ratio(DISPLACEMENT, field),
        ratio(CORE, Some(most)),
        Quantity::balance(RESIDUAL, run.residual, "1"),
    ])
    .drawn(curve))
}
