//! Does clay carry the exact limit load below a circular footing?
//!
//! Source: Eason and Shield 1960 (rough), Cox et al. 1961 (smooth): 6.05 and 5.69 times the strength of ground after Tresca without
//! weight. The scene of *footing*, axisymmetric: nodes at the surface up to the radius a are pressed down from rest to rest, and what
//! they need at the end is its load. Loads come from above, since what moves is up to a cell wider than the footing: the exact load
//! is taken on the area pi (a + h/2)².
//!
//! Particles are one per cell: with four of them cells have more conditions of constant volume than nodes can meet. Linear
//! functions, for the reason of *footing*. `proctor verify circular-footing`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use super::vocabulary::press::Press;

const RADIUS: f64 = 1.0; // Radius of the footing, a [m]
const FAR: f64 = 3.0; // Radius of the ground [m]
const DEEP: f64 = 2.0; // Depth of the ground [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.49;
const DENSITY: f64 = 1.0; // Density [kg/m³]; it sets a time
const STRENGTH: f64 = 1.0; // Strength without friction [Pa]
/// Time of the run, in which a wave of shear goes so many times over the width: as in *footing*.
const TRANSITS: f64 = 60.0;
/// Share of the time at the end over which the load is read.
const LOOK: f64 = 1.0 / 40.0;
const SMOOTH: &str = "smooth";
const ROUGH: &str = "rough";
const LOAD: &str = "load on a + h/2";
const WRONG_STRENGTH: Wrong =
    Wrong::factor("strength", 0.8).breaks(|gate| gate.contains("error of"));

/// The circular footing.
pub static CIRCULAR_FOOTING: Case = Case::new(
    "circular-footing",
    "Does clay carry the exact limit load below a circular footing?",
)
.ladder(Ladder::variants(
    &[SMOOTH, ROUGH],
    " ",
    "a/h",
    RADIUS,
    [&[6], &[4, 8, 16]],
))
.scene(scene)
.solve_by(solve)
.gates_of_variants(&[error(LOAD).at_most_of(
    [0.1, 0.05],
    [
        "five percent at h = B/16 of *footing*, and as much for cells that are larger",
        "five percent, as *footing* at the same cells over its width",
    ],
)])
.tables(&[TableRule::new(
    "circular footing, {variant}, linear, USL, FLIP",
    &[LOAD],
)])
.wrong_references(&[WRONG_STRENGTH])
.refer_by(refer)
.no_study("its load is a limit that one particle per cell decides, which is no setting of a study")
.no_guest("the scenes of other solvers have no axis of revolution");

/// Mean pressure at which the ground gives way \[Pa\].
fn exact(reference: Reference, rung: &Rung) -> f64 {
    let factor = if rung.variant == ROUGH { 6.05 } else { 5.69 };
    factor * reference.of(&WRONG_STRENGTH) * STRENGTH
}

/// Way of the footing \[m\]: three times what elastic ground would let it sink at the exact load.
fn way(rung: &Rung) -> f64 {
    let elastic = FRAC_PI_2 * (1.0 - POISSON * POISSON) * RADIUS / YOUNG;
    3.0 * elastic * exact(Reference::CORRECT, rung)
}

fn time() -> f64 {
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    TRANSITS * 2.0 * RADIUS / (shear / DENSITY).sqrt()
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = revolved_strip(h, [cells(FAR, h), cells(DEEP, h) + 1]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = Scene {
        materials: material("clay", DENSITY, Tresca::new(YOUNG, POISSON, STRENGTH)),
        bodies: vec![body("ground", 1, rectangle([0.0; 2], [FAR, DEEP]))],
        ..plane_scene("circular_footing", mesh, time())
    };
    let method = Method::DEFAULT.with_weighting(Weighting::Linear);
    let mut settings = Settings::new(method);
    settings.particles_per_cell = 1;
    settings.apply(&mut scene);
    scene
}

fn solve(
    rung: &Rung,
    reference: Reference,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let (way, time) = (way(rung), time());
    let press = Press::from_rest(DEEP, rung.cell, [way, time]).up_to(RADIUS);
    let press = Arc::new(press.rough(rung.variant == ROUGH));
    let mut options = options.clone();
    options.conditions.push(press.clone());
    let looks = (1.0 / LOOK) as u32;
    let area = PI * (RADIUS + 0.5 * rung.cell).powi(2);
    let mut solved = simulate(
        scene(rung, &Settings::new(Method::DEFAULT)),
        &options,
        |simulation| {
            let known = exact(Reference::CORRECT, rung);
            let (mut points, mut pressure) = (vec![], f64::NAN);
            let share = |look: u32| f64::from(look) * LOOK;
            let times = (1..=looks).map(|look| share(look) * time);
            press.forces(simulation, times, observer, |force| {
                pressure = force / area;
                let middle = share(points.len() as u32 + 1) - 0.5 * LOOK;
                let sunk = way * smooth(middle)[0] / RADIUS * YOUNG / STRENGTH;
                points.push(CurvePoint::new(sunk, pressure / STRENGTH, known / STRENGTH));
            })?;
            let curve = Curve::new(
                format!("load over settlement, {}", rung.label),
                [
                    "settlement over a, times Young's modulus over strength",
                    "mean pressure over strength",
                ],
                points,
            );
            let load = Quantity::compared(LOAD, pressure, known, "Pa");
            Ok(Measurements::of([load]).drawn(curve))
        },
    )?;
    refer(rung, reference, &mut solved);
    Ok(solved)
}

/// Results do not depend on the reference, but for the exact value beside them.
fn refer(rung: &Rung, reference: Reference, solved: &mut RungResult) {
    for q in &mut solved.quantities {
        *q = Quantity::compared(q.name, q.value, exact(reference, rung), q.unit);
    }
}
