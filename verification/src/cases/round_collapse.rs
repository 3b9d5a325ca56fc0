//! Does a round column of sand that is let go run out as far as in experiments?
//!
//! Source: Lube et al. 2004 (J. Fluid Mech. 508, 175). A cylinder of dry sand of the radius r_0 and the height H = a r_0 stands on
//! rough ground and loses its wall at once. In experiments the heap came to r_0 (1 + 1.24 a) where a < 1.7, and to
//! r_0 (1 + 1.6 sqrt(a)) beyond, whatever the sand. That is an experiment, not an exact answer, and shown beside what comes out; judged
//! are the books of `run_out.rs`, and that the front is within half of what experiments found: a volume of the plane, or no hoop force,
//! lets a column go as far as a wall of sand.
//!
//! Sand as in *collapse*. `proctor verify round-collapse`.

use super::prelude::*;
use super::vocabulary::run_out;

const RADIUS: f64 = 1.0; // Radius of the column, r_0 [m]
const GRAVITY: f64 = 9.81; // Gravity [m/s²]
const DENSITY: f64 = 1600.0; // Density [kg/m³]
/// Young's modulus over the stress at the base.
const STIFFNESS: f64 = 200.0;
const POISSON: f64 = 0.3;
const FRICTION: f64 = 30.0; // Angle of friction [°]
/// Time of a run over that of a fall, sqrt(H/g): sand comes to rest after 3.3.
const FALLS: f64 = 6.0;
/// APIC, which does not ring where particles cross cells.
const METHOD: Method = Method::DEFAULT.with_transfer(TransferKind::Apic);
const BEYOND: &str = "run-out over that of experiments";
const CONTINUA: &str = "experiments and continua differ by a third, and fronts are a cell thick";
const WIDE: &str = "a=0.8";
const SLENDER: &str = "a=2";
const WRONG_WORK: Wrong =
    Wrong::factor("work of gravity", 0.5).breaks_only(|gate| gate.contains("energy gained"));

/// The round column.
pub static ROUND_COLLAPSE: Case = Case::new(
    "round-collapse",
    "Does a round column of sand that is let go run out as far as in experiments?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.run(compare)
.gates_of_rungs(&[
    run_out::LOSES_NOTHING,
    run_out::GAINS_NOTHING,
    run_out::GIVES_NOTHING_BACK,
    run_out::STAYS_ON_ITS_PATH,
    run_out::RESTS,
    value(BEYOND).at_most(1.5, CONTINUA),
    value(BEYOND)
        .at_least(0.5, CONTINUA)
        .named("{label}: {quantity}, at least"),
])
.line_of_each(|rung, run| {
    let what = format!("run-out {:.2} of that of experiments", run.value(BEYOND));
    Some(run_out::said(rung, run, &what))
})
.wrong_references(&[WRONG_WORK])
.no_study("nothing exact is known of a heap but balances, which hold whatever the settings")
.no_guest("the scenes of other solvers have no axis of revolution");

fn rungs(size: Size) -> Vec<Rung> {
    let counts: &[u32] = size.pick(&[8], &[16, 32]);
    let of = |variant| Rung::counted(variant, &format!("{variant}, r/h"), RADIUS, counts);
    [WIDE, SLENDER].into_iter().flat_map(of).collect()
}

/// Height over radius.
fn aspect(rung: &Rung) -> f64 {
    if rung.variant == WIDE { 0.8 } else { 2.0 }
}

/// Run-out of experiments beyond the column, over its radius.
fn published(aspect: f64) -> f64 {
    if aspect < 1.7 {
        1.24 * aspect
    } else {
        1.6 * aspect.sqrt()
    }
}

/// Time of a fall \[s\].
fn fall(rung: &Rung) -> f64 {
    (aspect(rung) * RADIUS / GRAVITY).sqrt()
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let height = aspect(rung) * RADIUS;
    // Twice as far as experiments went.
    let long = RADIUS * (1.0 + 2.0 * published(aspect(rung))).ceil();
    let top = (height / h).ceil() as usize + 2;
    let mut mesh = revolved_strip(h, [cells(long, h), top]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let young = STIFFNESS * DENSITY * GRAVITY * height;
    let mut sand = body("column", 1, rectangle([0.0; 2], [RADIUS, height]));
    sand.initial_stress = InitialStress::AtRest {
        ratio: POISSON / (1.0 - POISSON),
        level: height,
        surcharge: 0.0,
    };
    let mut scene = Scene {
        gravity: [0.0, -GRAVITY, 0.0],
        materials: material(
            "sand",
            DENSITY,
            MohrCoulomb::new(young, POISSON, [FRICTION, 0.0, 0.0]),
        ),
        bodies: vec![sand],
        ..plane_scene(&rung.label, mesh, FALLS * fall(rung))
    };
    Settings::new(METHOD).apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, work) = (run.rung, run.reference.of(&WRONG_WORK));
    let mut ran = run_out::run(run.simulation, work, run.observer)?;
    let [front, _] = ran.at_last();
    let over = (front / RADIUS - 1.0) / published(aspect(rung));
    ran.quantities.push(Quantity::figure(BEYOND, over, "1"));
    let points = ran.places.iter().map(|place| {
        let (time, beyond) = (place.time / fall(rung), place.front / RADIUS - 1.0);
        CurvePoint::new(time, beyond, f64::NAN)
    });
    let names = ["time over sqrt(H/g)", "distance of the front over radius"];
    let curve = Curve::new(
        format!("front of the column, {}", rung.label),
        names,
        points,
    );
    Ok(Measurements {
        drawings: vec![ran.drawing],
        ..Measurements::of(ran.quantities).drawn(curve)
    })
}
