//! Where does a slope come to rest that fails and softens, and does the mesh decide it?
//!
//! A bank of clay, 5 m high at 45° on rough rigid ground, is cut at once out of ground in which all
//! stresses are those of its weight. It is too steep for its strength, which falls to a third as it is sheared, and runs out.
//! Nothing exact is known of that, and the books of `run_out.rs` are what is judged. Shown is how far it comes against the
//! cell size, and five frames with the cells that are sheared by a half or more.
//!
//! - *local*: the law as it stands. Strain gathers in bands as wide as a cell, so that the energy per band is proportional to
//!   h: not converged, however fine the mesh.
//! - *crack band*: softening scales with the cell, and a band takes the same energy in cells of any size.
//!
//! `proctor verify slope`; `proctor report RECORD` draws the frames.

use super::prelude::*;
use super::vocabulary::run_out::{self, FRONT, TOP};

/// Height of the bank and length of its crest \[m\].
const HEIGHT: f64 = 5.0;
const CREST: f64 = 10.0;
const GROUND: f64 = 40.0; // Length of the ground [m]
const DENSITY: f64 = 1800.0; // Density [kg/m³]
const GRAVITY: f64 = 9.81; // Gravity [m/s²]
/// Young's modulus \[Pa\]: a hundred times the stress at the base.
const YOUNG: f64 = 9e6;
const POISSON: f64 = 0.4;
/// Shear strength at first and at last \[Pa\]. At 45° a bank of constant strength c stands up to a height of 5.5 to 5.9 c/(rho g)
/// (Taylor 1937): this one is 7.4 times as high at first.
const STRENGTH: [f64; 2] = [12e3, 4e3];
/// Plastic strain over which it falls, and width of the band in which it was seen to \[m\].
const SOFTENED: f64 = 0.4;
const WIDTH: f64 = 0.25;
const TIME: f64 = 12.0; // Time [s]

const LOCAL: &str = "local"; // The law as it stands
const CRACK_BAND: &str = "crack band"; // Softening that scales with the cell

const BEYOND: &str = "run-out over height"; // How far the front came beyond the foot of the slope

/// APIC, which does not ring where particles cross cells.
const METHOD: Method = Method::DEFAULT.with_transfer(TransferKind::Apic);

const WRONG_WORK: Wrong =
    Wrong::factor("work of gravity", 0.5).breaks_only(|gate| gate.contains("energy gained"));

/// The slope that fails.
pub static SLOPE: Case = Case::new(
    "slope",
    "Where does a slope come to rest that fails and softens, and does the mesh decide it?",
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
])
.judge_by(judge)
.wrong_references(&[WRONG_WORK])
.no_study("nothing exact is known of where it comes to rest")
.no_guest(
    "its clay softens, a law of this program alone, and no experiment says where it comes to rest",
);

fn law(variant: &str) -> MohrCoulomb {
    let [peak, residual] = STRENGTH;
    let softening = Softening::Linear {
        from: 0.0,
        to: SOFTENED,
    };
    let residual = Residual {
        cohesion: Some(residual),
        ..Residual::default()
    };
    let band = match variant {
        LOCAL => Band::NONE,
        _ => Band::of_width(WIDTH),
    };
    MohrCoulomb::new(YOUNG, POISSON, [0.0, peak, 0.0])
        .softening(softening, residual)
        .in_band(band)
}

fn rungs(size: Size) -> Vec<Rung> {
    let cells: &[f64] = size.pick(&[1.0, 0.5], &[1.0, 0.5, 0.25, 0.125]);
    Rung::ladders(&[(LOCAL, cells), (CRACK_BAND, cells)])
}

/// Run-outs, and those against the cell size, variant by variant.
fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for variant in [LOCAL, CRACK_BAND] {
        let own = runs
            .solved
            .iter()
            .filter(|(rung, _)| rung.variant == variant);
        verdict
            .for_the_record
            .extend(own.clone().map(|(rung, run)| {
                let [far, top] = [BEYOND, TOP].map(|name| run.value(name));
                let what =
                    format!("run-out {far:.2} heights beyond the foot, highest point {top:.2} m");
                run_out::said(rung, run, &what)
            }));
        verdict.for_the_record.push(match variant {
            LOCAL => "local: energy per band is proportional to h: not converged".to_owned(),
            _ => format!("{variant}: a band takes the same energy in cells of any size"),
        });
        let beyond = |run: &RungResult| run.value(FRONT) - CREST - HEIGHT;
        verdict.curves.push(Curve::new(
            format!("run-out against the cell size, {variant}"),
            ["cell size (m)", "run-out beyond the foot (m)"],
            own.rev()
                .map(|(rung, run)| CurvePoint::new(rung.cell, beyond(run), f64::NAN)),
        ));
    }
    verdict
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [cells(GROUND, h), cells(HEIGHT, h) + 2]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = plane_scene(&rung.label, mesh, TIME);
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.materials = material("clay", DENSITY, law(rung.variant));
    let foot = CREST + HEIGHT;
    let corners = [[0.0, 0.0], [foot, 0.0], [CREST, HEIGHT], [0.0, HEIGHT]];
    let shape = Shape::Polygon {
        points: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
    };
    let mut bank = body("bank", 1, shape);
    bank.initial_stress = InitialStress::AtRest {
        ratio: 1.0,
        level: HEIGHT,
        surcharge: 0.0,
    };
    scene.bodies = vec![bank];
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    Settings::new(METHOD).apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let work = run.reference.of(&WRONG_WORK);
    let mut ran = run_out::run(run.simulation, work, run.observer)?;
    let foot = CREST + HEIGHT;
    let points = ran.places.iter();
    let points = points.map(|place| CurvePoint::new(place.time, place.front - foot, f64::NAN));
    let title = format!("front of the slope, {}", run.rung.label);
    let curve = Curve::new(title, ["time (s)", "distance of the front (m)"], points);
    let [front, _] = ran.at_last();
    let beyond = (front - foot) / HEIGHT;
    ran.quantities.push(Quantity::figure(BEYOND, beyond, "1"));
    Ok(Measurements {
        drawings: vec![ran.drawing],
        ..Measurements::of(ran.quantities).drawn(curve)
    })
}
