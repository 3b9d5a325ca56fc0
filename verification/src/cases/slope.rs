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
    let cells: &[f64] = match size {
        Size::Quick => &[1.0, 0.5],
        Size::Full => &[1.0, 0.5, 0.25, 0.125],
    };
    Rung::ladders(&[(LOCAL, cells), (CRACK_BAND, cells)])
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for variant in [LOCAL, CRACK_BAND] {
        let mut points = vec![];
        for rung in runs.rungs {
            if rung.variant != variant {
                continue;
            }
            let label = &rung.label;
            verdict.gates.extend(run_out::gates(runs, label, true));
            if runs.run(label).is_none() {
                continue;
            }
            let value = |name: &str| runs.value(label, name);
            let what = format!(
                "run-out {:.2} heights beyond the foot, highest point {:.2} m",
                value(BEYOND),
                value(TOP)
            );
            let line = run_out::said(runs, label, &what);
            verdict.for_the_record.push(line);
            points.push(CurvePoint::new(
                rung.cell,
                value(FRONT) - CREST - HEIGHT,
                f64::NAN,
            ));
        }
        points.reverse();
        verdict.for_the_record.push(match variant {
            LOCAL => "local: energy per band is proportional to h: not converged".to_owned(),
            _ => format!("{variant}: a band takes the same energy in cells of any size"),
        });
        verdict.curves.push(Curve::new(
            format!("run-out against the cell size, {variant}"),
            ["cell size (m)", "run-out beyond the foot (m)"],
            points,
        ));
    }
    verdict
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let cells = |length: f64| (length / h).round() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [0.0; 3],
        [h; 3],
        [cells(GROUND), cells(HEIGHT) + 2, 1],
    );
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let mut scene = Scene::new(Dimension::Two, mesh, TIME);
    scene.name.clone_from(&rung.label);
    scene.results = NO_RESULTS;
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.materials = material("clay", DENSITY, law(rung.variant));
    let corners = [
        [0.0, 0.0],
        [CREST + HEIGHT, 0.0],
        [CREST, HEIGHT],
        [0.0, HEIGHT],
    ];
    let shape = Shape::Polygon {
        points: corners.iter().map(|p| [p[0], p[1], 0.0]).collect(),
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
    let (rung, reference) = (run.rung, run.reference);
    let (simulation, observer) = (run.simulation, run.observer);
    let run = run_out::run(simulation, reference.of(&WRONG_WORK), observer)?;
    let foot = CREST + HEIGHT;
    let points = run
        .places
        .iter()
        .map(|place| CurvePoint::new(place.time, place.front - foot, f64::NAN));
    let curve = Curve::new(
        format!("front of the slope, {}", rung.label),
        ["time (s)", "distance of the front (m)"],
        points,
    );
    let mut quantities = run.quantities;
    let front = run.places.last().map_or(f64::NAN, |place| place.front);
    let beyond = (front - foot) / HEIGHT;
    quantities.push(Quantity::figure(BEYOND, beyond, "1"));
    Ok(Measurements {
        drawings: vec![run.drawing],
        ..Measurements::of(quantities).drawn(curve)
    })
}
