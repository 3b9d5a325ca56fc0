//! Does a soft column settle under its own weight to its exact height and stress?
//!
//! Source: the column of AMPLE and of many MPM papers. A neo-Hookean column between rollers,
//! load number S = rho g H/M = 0.4, comes to rest by dynamic relaxation; its top sinks by a sixth of its height, so
//! that most particles have changed their cell when they are judged. Neo-Hookean, because then the answer does not
//! depend on the way.
//!
//! Expected: order 1 or better of GIMP ("approximately linear", AMPLE); 2 of cpGIMP, as its domains stay contiguous.
//! Linear functions need not come to rest at all. `proctor verify self-weight`.

use super::prelude::*;
use crate::exact::self_weight::{Law as ExactLaw, SelfWeightColumn};

const HEIGHT: f64 = 1.0; // Height [m]
const LAW: NeoHookean = NeoHookean::new(25e3, 0.25); // Neo-Hookean; confined modulus 30 kPa
const DENSITY: f64 = 1200.0; // Density [kg/m³]
const GRAVITY: f64 = 10.0; // Gravity [m/s²]
/// Share of gravity for other solvers: strains stay within 4 %, where uGIMP, which most of them have, converges. With the
/// whole of it particles change their cells, and its line ends at 0.4 %.
const LIGHT: f64 = 0.1;
const RESIDUAL: f64 = 1e-7; // Norm of the unbalanced force over the weight at which the column is at rest
const STUDIED: Ladder = cells_along(&[8, 16, 32], &[8, 16, 32, 64, 128]);
const WRONG_GRAVITY: Wrong = Wrong::factor("gravity", 1.04);

/// The column under its own weight.
pub static SELF_WEIGHT: Case = Case::new(
    "self-weight",
    "Does a soft column settle under its own weight to its exact height and stress?",
)
.ladder(cells_along(&[8, 16, 32], &[8, 16, 32, 64]))
.method(|_| {
    Settings::new(Method::DEFAULT.with_weighting(Weighting::ContiguousGimp(DomainUpdate::Stretch)))
})
.scene(scene)
.displacements()
.residual()
.compare_after(
    |run| run.relax(DENSITY * GRAVITY * HEIGHT * run.rung.cell, RESIDUAL, HEIGHT),
    compare,
)
.gates(&[
    error(DISPLACEMENT).at_most_of(
        [2e-2, 1e-2],
        ["one percent at 64 cells, two at 32, as order 1 allows"; 2],
    ),
    order(DISPLACEMENT).at_least(0.9, "GIMP is known to be approximately linear here"),
    order(STRESS).at_least(0.9, "GIMP is known to be approximately linear here"),
])
.tables(&[TableRule::new(
    "self-weight, cpGIMP, USL, FLIP",
    &[DISPLACEMENT, STRESS],
)])
.wrong_references(&[WRONG_GRAVITY])
.studies(&[Plan::new(STUDIED, FIELDS, 1)])
.guest(guest);

const fn cells_along(short: &'static [u32], full: &'static [u32]) -> Ladder {
    Ladder::cells("column", "H/h", HEIGHT, short, full)
}

fn exact(gravity: f64) -> SelfWeightColumn {
    SelfWeightColumn {
        law: ExactLaw::NeoHookean,
        height: HEIGHT,
        density: DENSITY,
        gravity,
        lambda: LAW.elasticity().lambda,
        mu: LAW.elasticity().shear,
    }
}

/// One cell wide: the answer does not vary across the column.
fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [1, cells(HEIGHT, h) + 1]);
    mesh.planes[1][1] = PlaneCondition::Free;
    settings.applied(Scene {
        gravity: [0.0, -GRAVITY, 0.0],
        damping: Damping::Kinetic,
        time_step: settings.multiplier(),
        materials: material("neo-Hookean", DENSITY, LAW),
        bodies: vec![body("column", 1, rectangle([0.0; 2], [h, HEIGHT]))],
        // The end of a relaxation is the rest, not a time.
        ..plane_scene("self_weight", mesh, 1.0)
    })
}

fn guest(rung: &Rung) -> Result<Guest, &'static str> {
    let exact = exact(LIGHT * GRAVITY);
    let speed = (exact.confined_modulus() / DENSITY).sqrt();
    let mut scene = guest::slab(scene(rung, &guest::settings()));
    scene.time = guest::RELAXATION * HEIGHT / speed;
    scene.gravity = scene.gravity.map(|g| LIGHT * g);
    // The column sinks, and its waves get faster.
    let step = 0.5 * guest::COURANT * rung.cell / speed;
    let sunk = move |x: &Vector, _| exact.displacement(x[1]);
    let guest = Guest::new(guest::prepared(scene, 1, step), sunk).at_the_end();
    Ok(guest.with_stress(move |x, _| exact.stress(x[1])))
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let exact = exact(run.reference.of(&WRONG_GRAVITY) * GRAVITY);
    let quantities = run.errors(|x| exact.displacement(x[1]), |x| exact.stress(x[1]));
    let points = run.along(1, |p, y| {
        [run.stress(p)[1] / 1e3, exact.vertical_stress(y) / 1e3]
    });
    let title = format!("vertical stress over the column, {}", run.rung.label);
    let axes = ["initial height (m)", "vertical stress (kPa)"];
    Ok(Measurements::of(quantities).drawn(points.map(|points| Curve::new(title, axes, points))))
}
