//! A column of water at rest.

use super::{METHOD_ORDER, Problem, WRONG_FORCE};
use crate::cases::prelude::*;
use crate::exact::self_weight::{Law, SelfWeightColumn};

const HEIGHT: f64 = 1.0; // Height [m]
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const GRAVITY: f64 = 10.0; // Gravity [m/s²]
const BULK: f64 = 1.0e6; // Bulk modulus [Pa]: a hundred times the pressure at the base
/// Damping over that at which the column no longer swings. One that swings has no unbalanced force for a moment in each
/// swing, and would be taken for one at rest.
const OVERDAMPED: f64 = 1.2;
const RESIDUAL: f64 = 1e-7; // Norm of the unbalanced force over the weight at which it is at rest
/// B-splines, which have a stress that varies within a cell.
const METHOD: Method = Method::DEFAULT.with_weighting(Weighting::QuadraticBSpline);
const PRESSURE: &str = "L2(pressure)"; // Name of the quantity

/// The column at rest.
pub(super) const REST: Problem = Problem {
    variant: "rest",
    cells: &[16, 32, 64],
    scene,
    run,
    gates: &[
        error(PRESSURE).at_most(2e-3, "two in a thousand: it is the weight above"),
        error(DISPLACEMENT).at_most(2e-3, "the volume follows from the pressure"),
        order(PRESSURE).at_least(0.9, METHOD_ORDER),
        order(DISPLACEMENT).at_least(0.9, METHOD_ORDER),
    ],
    names: &[PRESSURE, DISPLACEMENT],
};

fn scene(rung: &Rung) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [1, cells(HEIGHT, h) + 1]);
    mesh.planes[1][1] = PlaneCondition::Free;
    let mut scene = plane_scene("fluid_at_rest", mesh, 1.0);
    scene.gravity = [0.0, -GRAVITY, 0.0];
    // The rate of viscous damping is alpha sqrt(K/rho)/h; a quarter wave swings with pi c/2H.
    scene.damping = Damping::Viscous {
        alpha: OVERDAMPED * PI * h / HEIGHT,
    };
    scene.materials = material("water", DENSITY, Newtonian::new(BULK, 0.0));
    scene.bodies = vec![body("column", 1, rectangle([0.0; 2], [h, HEIGHT]))];
    Settings::new(METHOD).apply(&mut scene);
    scene
}

fn run(run: Run<'_>) -> Result<Measurements, Failure> {
    let weight = DENSITY * GRAVITY * HEIGHT * run.rung.cell;
    let most = most_steps(&Settings::new(METHOD), HEIGHT / run.rung.cell);
    relax(run.simulation, weight, RESIDUAL, most, run.observer)?;
    let exact = SelfWeightColumn {
        law: Law::RateElastic,
        height: HEIGHT,
        density: DENSITY,
        gravity: run.reference.of(&WRONG_FORCE) * GRAVITY,
        lambda: BULK,
        mu: 0.0,
    };
    let pressure = |p: usize| {
        let s = run.stress(p);
        -(s[0] + s[1] + s[2]) / 3.0
    };
    let pressures = l2(run.simulation, |p, x| {
        Some(([pressure(p)], [-exact.vertical_stress(x[1])]))
    });
    let displacement = l2(run.simulation, |p, x| {
        let u = [0.0, exact.position(x[1]) - x[1], 0.0];
        Some((run.simulation.displacement(0, p)?, u))
    });
    let points = run.along(1, |p, y| {
        [pressure(p) / 1e3, -exact.vertical_stress(y) / 1e3]
    });
    let title = format!("pressure over the column, {}", run.rung.label);
    let names = ["initial height (m)", "pressure (kPa)"];
    let quantities = [
        ratio(PRESSURE, pressures),
        ratio(DISPLACEMENT, displacement),
    ];
    let curve = points.map(|points| Curve::new(title, names, points));
    Ok(Measurements::of(quantities).drawn(curve))
}
