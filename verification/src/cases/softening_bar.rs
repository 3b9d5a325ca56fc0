//! What does a band take that softens, and does the mesh decide it?
//!
//! Source: the crack band of Bazant and Oh 1983. A bar in uniaxial strain without Poisson's ratio is drawn at one end, slowly against its
//! waves; its middle is 2 % weaker and parts. The law is the tension of Mohr and Coulomb that falls along a line.
//!
//! - *crack band*: softening scales with the cell, and the band is the weak cell: it takes the fracture energy.
//! - *local*: the law as it stands. The band is as wide as a cell, so that its energy is proportional to the cell size and
//!   goes to zero with it: no mesh is fine enough. That is what is gated.
//! - *on a node*: with a crack band, the weak zone as wide as a cell but around a node. Two cells have particles of it, and
//!   a band that takes both is two cells wide. What a crack band promises is the fracture energy times 1 to 1.5, by where the
//!   mesh lies, and that is gated; here it is 1.03, since the stronger particles of both cells do not yield.
//!
//! Strains stay below 1e-3. `proctor verify softening-bar`.

use super::prelude::*;
use crate::exact::softening_bar::SofteningBar as Exact;

const LENGTH: f64 = 2.0; // Length [m]
const YOUNG: f64 = 1.0; // Young's modulus [Pa]
const DENSITY: f64 = 1.0; // Density [kg/m³]: waves run at 1 m/s
const STRENGTH: f64 = 1e-5; // Strength of the bar [Pa]
const WEAK: f64 = 0.98; // Strength of its middle over that
/// Opening at which the band has parted over the displacement at which the bar begins to soften: the larger it is, the
/// slower the stress falls.
const OPENING: f64 = 3.0;
const WIDTH: f64 = 0.1; // Width of the band in which strength falls as the law says [m]
const DRAWN: f64 = 1.2; // Displacement of the end over the opening
const TIME: f64 = 400.0; // Time over which it is drawn [s]: two hundred times that of a wave
const RATE: f64 = 0.02; // Rate of viscous damping [1/s]
const ROWS: u32 = 400; // Rows of the prescribed velocity
const POINTS: usize = 120; // Points of the picture

const CRACK_BAND: &str = "crack band"; // Softening that scales with the cell
const LOCAL: &str = "local"; // The law as it stands
const ON_A_NODE: &str = "on a node"; // The weak zone around a node

/// Names of the quantities.
const ENERGY: &str = "dissipated over fracture energy";
const PEAK: &str = "largest stress";

const WRONG_OPENING: Wrong = Wrong::factor("opening", 1.1)
    .breaks(|gate| gate.starts_with("least") && gate.contains("crack band"));

/// The bar that parts.
pub static SOFTENING_BAR: Case = Case::new(
    "softening-bar",
    "What does a band take that softens, and does the mesh decide it?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.displacements()
.run(compare)
.tables(&[TableRule::new(
    "softening-bar, {variant}, uGIMP, USL, FLIP",
    &[ENERGY, PEAK],
)])
.judge_by(judge)
.wrong_references(&[WRONG_OPENING])
.no_study("its question is to the law and the mesh, not to the method")
.no_guest("its bar softens, a law of this program alone");

fn exact(reference: Reference) -> Exact {
    let elastic = STRENGTH * LENGTH / YOUNG;
    Exact {
        length: LENGTH,
        young: YOUNG,
        strength: WEAK * STRENGTH,
        opening: reference.of(&WRONG_OPENING) * OPENING * elastic,
    }
}

/// A material of a strength \[Pa\] that has parted at the opening of the band. A plastic strain e along one axis counts
/// 2/3 e.
fn material(id: i64, variant: &str, strength: f64) -> Material {
    let softening = Softening::Linear {
        from: 0.0,
        to: 2.0 / 3.0 * exact(Reference::CORRECT).opening / WIDTH,
    };
    let parted = Residual {
        tensile: Some(0.0),
        ..Residual::default()
    };
    let band = match variant {
        LOCAL => Band::NONE,
        _ => Band::of_width(WIDTH),
    };
    // Cohesion that is never reached.
    let law = MohrCoulomb::new(YOUNG, 0.0, [30.0, 1e3 * STRENGTH, 0.0])
        .with_tensile(strength)
        .softening(softening, parted)
        .in_band(band);
    Material {
        name: format!("strength {strength}"),
        id,
        density: DENSITY,
        law: law.into(),
    }
}

/// The exact bar of a rung. A band of the law as it stands is as wide as a cell.
fn exact_in(reference: Reference, rung: &Rung) -> Exact {
    let exact = exact(reference);
    if rung.variant == LOCAL {
        Exact {
            opening: exact.opening * rung.cell / WIDTH,
            ..exact
        }
    } else {
        exact
    }
}

/// Displacement of the end when the bar has been drawn \[m\].
fn drawn_at_last(rung: &Rung) -> f64 {
    DRAWN * exact_in(Reference::CORRECT, rung).opening
}

/// Velocity of the end, one bell over the time.
fn drawing(rung: &Rung) -> History {
    let most = 2.0 * drawn_at_last(rung) / TIME;
    let rows = 0..=ROWS;
    let share = |row: u32| f64::from(row) / f64::from(ROWS);
    let speed = |row: u32| 0.5 * most * (1.0 - libm::cos(2.0 * PI * share(row)));
    History {
        times: rows.clone().map(|row| TIME * share(row)).collect(),
        values: rows.map(|row| [speed(row), 0.0, 0.0]).collect(),
    }
}

/// Displacement of the end \[m\] at a time \[s\].
fn drawn(rung: &Rung, time: f64) -> f64 {
    let share = (time / TIME).min(1.0);
    let bell = share - libm::sin(2.0 * PI * share) / (2.0 * PI);
    drawn_at_last(rung) * bell
}

/// Draws the bar apart.
fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let (whole, exact) = (exact(run.reference), exact_in(run.reference, rung));
    let (mut peak, mut points) = (0.0_f64, vec![]);
    observer.phase(Phase::Stepping);
    while simulation.time() < TIME * (1.0 - 1e-9) {
        step(simulation, TIME, observer)?;
        // The first body is the left part of the bar.
        let stress = mean_stress(simulation, 0);
        peak = peak.max(stress);
        if simulation.time() >= TIME * points.len() as f64 / POINTS as f64 {
            let u = drawn(rung, simulation.time());
            points.push(CurvePoint::new(
                u / exact.opening,
                stress / STRENGTH,
                exact.stress(u) / STRENGTH,
            ));
            observer.progress(simulation.time() / TIME);
        }
    }
    observer.phase(Phase::Comparing);
    // Lost in the whole bar, one cell wide.
    let dissipated = simulation.plastic_work() / rung.cell;
    let whole = whole.fracture_energy();
    let (share, of_exact) = (dissipated / whole, exact.fracture_energy() / whole);
    let quantities = [
        Quantity::compared(ENERGY, share, of_exact, "1"),
        Quantity::compared(PEAK, peak, exact.strength, "Pa"),
    ];
    let axes = [
        "displacement of the end over the last opening",
        "stress over strength",
    ];
    let curve = Curve::new(format!("stress of the bar, {}", rung.label), axes, points);
    Ok(Measurements::of(quantities).drawn(curve))
}

/// Mean of the stress along the bar in a body \[Pa\].
fn mean_stress(simulation: &Simulation, index: usize) -> f64 {
    let set = &simulation.sets()[index];
    let sum: f64 = (0..set.len()).map(|p| set.stress(p)[0]).sum();
    sum / set.len() as f64
}

/// The energy of each band within its bounds, then how local ones are off, then the peaks.
fn judge(runs: &Runs<'_>) -> Verdict {
    let energy = |rung: &Rung, low: f64, high: f64, reason| {
        let (label, found) = (&rung.label, runs.value(&rung.label, ENERGY));
        [
            Gate::at_least(format!("least {ENERGY}, {label}"), found, low, reason),
            Gate::at_most(format!("most {ENERGY}, {label}"), found, high, reason),
        ]
    };
    let error = |rung: &Rung, name: String, quantity, bound, reason| {
        Gate::at_most(name, runs.error(&rung.label, quantity), bound, reason)
    };
    let aligned = "the band is the weak cell, and takes the fracture energy";
    let offset = "the band is one to two cells wide, by where the mesh lies";
    let energies = (runs
        .of(CRACK_BAND)
        .flat_map(|rung| energy(rung, 0.98, 1.05, aligned)))
    .chain(
        runs.of(ON_A_NODE)
            .flat_map(|rung| energy(rung, 0.98, 1.6, offset)),
    );
    let local = runs.of(LOCAL).map(|rung| {
        let of = "which is cell over width";
        let name = format!("{LOCAL}: {}: error of {ENERGY}, {of}", rung.label);
        let reason = "proportional to the cell: not converged, and never will";
        error(rung, name, ENERGY, 0.05, reason)
    });
    let peaks = runs.of(CRACK_BAND).chain(runs.of(ON_A_NODE)).map(|rung| {
        let name = format!("{}: {}: {PEAK}", rung.variant, rung.label);
        error(rung, name, PEAK, 0.02, "its weak middle decides")
    });
    Verdict {
        gates: energies.chain(local).chain(peaks).collect(),
        ..Verdict::default()
    }
}

fn rungs(size: Size) -> Vec<Rung> {
    let finest = |counts: &'static [u32]| size.pick(&counts[..2], counts);
    let of =
        |variant, counts| Rung::counted(variant, &format!("{variant} L/h"), LENGTH, finest(counts));
    let mut rungs = of(CRACK_BAND, &[11, 21, 41]);
    rungs.extend(of(LOCAL, &[11, 21, 41]));
    rungs.extend(of(ON_A_NODE, &[12, 22, 42]));
    rungs
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = strip(h, [cells(LENGTH, h) + 2, 1]);
    mesh.planes[0][1] = PlaneCondition::Free;
    let mut scene = plane_scene("softening_bar", mesh, TIME);
    // The rate of viscous damping is alpha sqrt(E/rho)/h.
    scene.damping = Damping::Viscous { alpha: RATE * h };
    scene.materials = vec![
        material(1, rung.variant, STRENGTH),
        material(2, rung.variant, WEAK * STRENGTH),
    ];
    let half = 0.5 * h;
    let part =
        |name: &str, id, [from, to]: [f64; 2]| body(name, id, rectangle([from, 0.0], [to, h]));
    let middle = [0.5 * LENGTH - half, 0.5 * LENGTH + half];
    scene.bodies = vec![
        part("left", 1, [0.0, middle[0]]),
        Body {
            material: 1,
            ..part("middle", 2, middle)
        },
        part("right", 3, [middle[1], LENGTH]),
        Body {
            motion: Some(drawing(rung)),
            ..part("grip", 4, [LENGTH, LENGTH + h])
        },
    ];
    Settings::new(Method::DEFAULT).apply(&mut scene);
    scene
}
