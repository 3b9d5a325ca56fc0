//! Do errors fall at their order in a body of revolution, and beside its axis?
//!
//! Source: a manufactured solution of a neo-Hookean body (Salari and Knupp 2000; `exact/revolved_mms.rs`) on a cylinder of radius and
//! height 1 m between fixed planes. All components of strain are there, the hoop strain has one more power of the radius than the
//! radial displacement, and the axis moves along itself. With the amplitude 0.04 m strains are 0.16, with 0.1 m 0.4, and particles cross
//! cells. `axis` is the error of the particles within two cells of the axis.
//!
//! Expected: order 2 in the displacement, there too; 1 in the stress. `proctor verify revolved`.

use super::prelude::*;
use crate::exact::revolved_mms::RevolvedMms;

const SIDE: f64 = 1.0; // Radius and height [m]
/// Neo-Hookean with E = 10 MPa, nu = 0.3: the order of rubber.
const LAW: NeoHookean = NeoHookean::new(1e7, 0.3);
const DENSITY: f64 = 1000.0; // Density [kg/m³]
/// End of the comparison, in sides over `sqrt(E/rho)`: the sine is at 0.81 and no field is zero.
const END: f64 = 0.7;
/// `c dt/h`, inside the bound where waves run faster in compression.
const COURANT: f64 = 0.25;
const SMALL: &str = "A=0.04";
const LARGE: &str = "A=0.1";
/// Cells from the axis within which errors are also taken by themselves.
const BESIDE: f64 = 2.0;
const AXIS: &str = "L2(u) beside the axis";
const PROTOTYPE: &str = "a prototype of the same weights had 2.0 to 2.2 and 1.1 to 1.35";
const WRONG_AMPLITUDE: Wrong =
    Wrong::factor("amplitude", 1.06).breaks(|gate| gate.starts_with("A=0.1: error of L2(u), "));

/// The motion of revolution.
pub static REVOLVED: Case = Case::new(
    "revolved",
    "Do errors fall at their order in a body of revolution, and beside its axis?",
)
.ladder(Ladder::variants(
    &[SMALL, LARGE],
    " ",
    "L/h",
    SIDE,
    [&[12, 24], &[8, 16, 32]],
))
.method(|_| {
    Settings::new(Method::DEFAULT.with_weighting(Weighting::ContiguousGimp(DomainUpdate::Stretch)))
        .courant(COURANT)
})
.scene(scene)
.options(start)
.displacements()
.compare(compare)
.gates_of_variants(&[
    error(DISPLACEMENT)
        .at_most_by(
            |finest| 4e-3 * (32.0 * finest.cell / SIDE).powi(2),
            "twice the error of a prototype of the same weights at 32 cells",
        )
        .full_alone()
        .of(SMALL),
    error(DISPLACEMENT)
        .at_most_by(
            |finest| 1e-2 * (32.0 * finest.cell / SIDE).powi(2),
            "two and a half times that of the smaller amplitude, as strains are",
        )
        .of(LARGE),
    order(DISPLACEMENT).at_least(1.8, PROTOTYPE),
    order(STRESS).at_least(0.9, PROTOTYPE),
    order(AXIS).at_least(1.8, "order 2 beside the axis as elsewhere, less 0.2"),
    error(AXIS).at_most_by(
        |finest| 2e-2 * (32.0 * finest.cell / SIDE).powi(2),
        "five times the bound of the whole: the radial displacement falls to zero there",
    ),
])
.tables(&[TableRule::new(
    "body of revolution, {variant} m, cpGIMP, USL, FLIP",
    &[DISPLACEMENT, AXIS, STRESS],
)])
.wrong_references(&[WRONG_AMPLITUDE])
.no_study("*axis-aligned* compares methods with the same law, and the axis is the same for all")
.no_guest("the scenes of other solvers have no axis of revolution");

fn exact(rung: &Rung, factor: f64) -> RevolvedMms {
    let young = LAW.elasticity().young;
    RevolvedMms {
        lambda: LAW.elasticity().lambda,
        mu: LAW.elasticity().shear,
        density: DENSITY,
        amplitude: factor * if rung.variant == SMALL { 0.04 } else { 0.1 },
        angular_frequency: PI / SIDE * (young / DENSITY).sqrt(),
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = revolved_strip(h, [cells(SIDE, h); 2]);
    mesh.planes[0][1] = PlaneCondition::Fixed;
    mesh.planes[1] = [PlaneCondition::Fixed; 2];
    let LinearWaves { end, speed } = waves();
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, speed).0,
        materials: material("neo-Hookean", DENSITY, LAW),
        bodies: vec![body("body", 1, rectangle([0.0; 2], [SIDE; 2]))],
        ..plane_scene("revolved", mesh, end)
    })
}

/// End of the run \[s\] and speed of waves \[m/s\].
struct LinearWaves {
    end: f64,
    speed: f64,
}

fn waves() -> LinearWaves {
    let elasticity = LAW.elasticity();
    LinearWaves {
        end: END * SIDE / (elasticity.young / DENSITY).sqrt(),
        speed: ((elasticity.lambda + 2.0 * elasticity.shear) / DENSITY).sqrt(),
    }
}

fn start(rung: &Rung, _: Reference, options: Options) -> Options {
    let exact = exact(rung, 1.0);
    let options = starting(options, move |x| {
        let at = [x[0], x[1]];
        let [along, up] = exact.velocity(at, 0.0);
        let [rr, rz, zr, zz, tt] = exact.velocity_gradient(at);
        let gradient = [[rr, rz, 0.0], [zr, zz, 0.0], [0.0, 0.0, tt]];
        moving([along, up, 0.0], gradient)
    });
    driven(options, move |x, t| {
        let [along, up] = exact.body_force([x[0], x[1]], t);
        [along, up, 0.0]
    })
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let exact = exact(run.rung, run.reference.of(&WRONG_AMPLITUDE));
    let (t, h) = (run.time(), run.rung.cell);
    let displacement = |x: Vector| {
        let [along, up] = exact.displacement([x[0], x[1]], t);
        [along, up, 0.0]
    };
    let mut quantities = run.errors(displacement, |x| {
        let [rr, zz, tt, rz] = exact.stress([x[0], x[1]], t);
        [rr, zz, tt, 0.0, 0.0, rz]
    });
    let simulation = &*run.simulation;
    let beside = l2(simulation, |p, x| {
        let u = simulation.displacement(0, p)?;
        let near = x[0] < BESIDE * h;
        Some(if near {
            (u, displacement(x))
        } else {
            ([0.0; 3], [0.0; 3])
        })
    });
    quantities.push(ratio(AXIS, beside));
    Ok(Measurements::of(quantities))
}
