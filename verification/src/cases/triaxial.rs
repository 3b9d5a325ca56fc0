//! Does a cylinder of soil in a triaxial cell carry what Mohr and Coulomb say, run as a body between platens?
//!
//! Source: Mohr and Coulomb: sigma_1 = sigma_3 N + 2 c sqrt(N), N = tan²(45° + phi/2). A cylinder in an axisymmetric scene begins
//! with the pressure of the cell, which acts on its mantle. Smooth platens shorten it to three times the strain at which it yields;
//! stress and strain stay the same everywhere. The flow is associated: beyond yield the radius widens by N/2 times the shortening.
//! Without dilation uniform strain is not the only answer (Rudnicki and Rice 1975): bands form, the sooner the finer the mesh, and
//! the mantle is 0.04, 0.4 and 2.4 % off with 2, 4 and 8 cells.
//!
//! Strains are 1e-5, so that no change of shape is in it. Linear functions, as in *footing*. Expected: no error of a mesh.
//! `proctor verify triaxial`.

use super::prelude::*;
use super::vocabulary::press::Press;

const RADIUS: f64 = 1.0; // Radius [m]
const HEIGHT: f64 = 2.0; // Height [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1.0; // Density [kg/m³]; it sets a time
const CELL: f64 = 2.0; // Pressure of the cell [Pa]
const COHESION: f64 = 1.0; // Cohesion [Pa]
const FRICTION: f64 = 30.0; // Angle of friction [°]
const TIMES: f64 = 3.0; // Shortening over that at which it yields
const TRANSITS: f64 = 60.0; // Time of the run, over that of a wave of shear along the cylinder
const LOOKS: f64 = 0.02; // Share of the time at the end over which the load is read
const LOAD: &str = "load of the platen";
const RIM: &str = "widening of the mantle";
/// The mantle is hardly wider with it.
const WRONG_FRICTION: Wrong =
    Wrong::factor("angle of friction", 1.02).breaks(|gate| !gate.contains("mantle"));

/// The triaxial test.
pub static TRIAXIAL: Case = Case::new(
    "triaxial",
    "Does a cylinder of soil in a triaxial cell carry what Mohr and Coulomb say, run as a body between platens?",
)
.ladder(Ladder::cells("triaxial", "R/h", RADIUS, &[2, 4], &[2, 4, 8]))
.scene(scene)
.solve_by(solve)
.gates(&[
    error(LOAD).at_most(1e-3, "stresses are uniform: the rest is inertia, some thousandths in *footing*"),
    error(STRESS).at_most(2e-3, "as the load, in all particles"),
    error(RIM).at_most(1e-2, "the mantle swings after the platen has stopped"),
])
.tables(&[TableRule::new("triaxial test of a body", &[LOAD, STRESS, RIM])])
.wrong_references(&[WRONG_FRICTION])
.refer_by(refer)
.no_study("its stress is uniform, so that no resolution is better than another")
.no_guest("the scenes of other solvers have no axis of revolution");

/// The exact answer.
#[derive(Clone, Copy)]
struct Exact {
    /// Stress along the axis at which it flows, in compression \[Pa\].
    carried: f64,
    /// Strain along the axis at which it yields, as a shortening.
    yields: f64,
    /// N, by which the radius widens with twice the shortening.
    flow: f64,
}

fn exact(reference: Reference) -> Exact {
    let angle = (reference.of(&WRONG_FRICTION) * FRICTION).to_radians();
    let n = (1.0 + libm::sin(angle)) / (1.0 - libm::sin(angle));
    let carried = CELL * n + 2.0 * COHESION * n.sqrt();
    Exact {
        carried,
        yields: (carried - CELL) / YOUNG,
        flow: n,
    }
}

impl Exact {
    /// Strain of the radius at the end.
    fn widening(&self, shortening: f64) -> f64 {
        POISSON * self.yields + 0.5 * self.flow * (shortening - self.yields)
    }
}

/// Shortening of the cylinder at the end, over its height.
fn shortening() -> f64 {
    TIMES * exact(Reference::CORRECT).yields
}

fn time() -> f64 {
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    TRANSITS * HEIGHT / (shear / DENSITY).sqrt()
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let h = rung.cell;
    let mesh = open_quarter(h, [cells(RADIUS, h) + 1, cells(HEIGHT, h) + 1]);
    let mut soil = body("soil", 1, rectangle([0.0; 2], [RADIUS, HEIGHT]));
    soil.initial_stress = InitialStress::Isotropic(-CELL);
    let law = MohrCoulomb::new(YOUNG, POISSON, [FRICTION, COHESION, FRICTION]);
    let mut scene = Scene {
        materials: material("soil", DENSITY, law),
        bodies: vec![soil],
        tractions: traction([RADIUS, 0.0, 0.0], [RADIUS, HEIGHT, 0.0], [-CELL, 0.0, 0.0]),
        ..plane_scene("triaxial", mesh, time())
    };
    let method = Method::DEFAULT.with_weighting(Weighting::Linear);
    Settings::new(method).apply(&mut scene);
    scene
}

fn solve(
    rung: &Rung,
    reference: Reference,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let (way, time) = (shortening() * HEIGHT, time());
    let press = Arc::new(Press::from_rest(HEIGHT, rung.cell, [way, time]));
    let mut options = options.clone();
    options.displacement = true;
    options.conditions.push(press.clone());
    let scene = scene(rung, &Settings::new(Method::DEFAULT));
    let mut solved = simulate(scene, &options, |simulation| {
        let mut force = f64::NAN;
        let looks = [(1.0 - LOOKS) * time, time];
        press.forces(simulation, looks, observer, |last| force = last)?;
        found(simulation, force / (PI * RADIUS * RADIUS))
    })?;
    refer(rung, reference, &mut solved);
    Ok(solved)
}

/// Results, against the correct reference.
fn found(simulation: &Simulation, carried: f64) -> Result<Measurements, Failure> {
    let exact = exact(Reference::CORRECT);
    let stress = l2(simulation, |p, _| {
        let across = -CELL;
        let known = [across, -exact.carried, across, 0.0, 0.0, 0.0];
        Some((simulation.sets()[0].stress(p), known))
    });
    let outer = along(simulation, 0, |p, x| {
        let u = simulation.displacement(0, p);
        [u.map_or(f64::NAN, |u| u[0] / x), f64::NAN]
    });
    let last = outer.as_deref().and_then(<[CurvePoint]>::last);
    let widening = last.ok_or("no displacements are kept")?.computed;
    Ok(Measurements::of([
        Quantity::compared(LOAD, carried, exact.carried, "Pa"),
        ratio(STRESS, stress),
        Quantity::compared(RIM, widening, exact.widening(shortening()), "1"),
    ]))
}

/// Results do not depend on the reference, but for the exact values beside them.
fn refer(_: &Rung, reference: Reference, solved: &mut RungResult) {
    if reference.is_correct() {
        return;
    }
    let wrong = exact(reference);
    for q in &mut solved.quantities {
        let known = match q.name {
            LOAD => wrong.carried,
            RIM => wrong.widening(shortening()),
            _ => {
                // All stresses are as far off as the axial one.
                let off = wrong.carried / exact(Reference::CORRECT).carried - 1.0;
                *q = Quantity::of_zero(STRESS, off.abs());
                continue;
            }
        };
        *q = Quantity::compared(q.name, q.value, known, q.unit);
    }
}
