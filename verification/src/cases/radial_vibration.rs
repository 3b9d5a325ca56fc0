//! Does a cylinder in a rigid ring swing with its own frequencies, across and along its axis?
//!
//! Source: the modes of a circular membrane; Graff 1975, sections 4.3 and 8.1. An axisymmetric scene in plane strain, held at its
//! rim. `radial` has the velocity J1(k r) with k R = 3.831706 and waves of pressure, `shear` J0(k r) along the axis with
//! k R = 2.404826 and waves of shear. The speed is 1e-5 of that of the waves.
//!
//! Expected: order 2 in the frequency. `proctor verify radial-vibration`.

use super::prelude::*;
use super::vocabulary::vibration::Vibration;

const RADIUS: f64 = 1.0; // Radius [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const SPEED: f64 = 1e-5; // Velocity amplitude over wave speed
/// Zeros of J1 and J0.
const RADIAL_ZERO: f64 = 3.831_705_970_207_512;
const SHEAR_ZERO: f64 = 2.404_825_557_695_773;
/// Periods until the end: the second zero of the velocity is at 3/4, the third at 5/4.
const PERIODS: f64 = 1.3;
const RADIAL: &str = "radial";
const SHEAR: &str = "shear";
const FREQUENCY: &str = "frequency";
const WRONG_STIFFNESS: Wrong = Wrong::factor("wave speed", 1.003);

/// The cylinder in a rigid ring.
pub static RADIAL_VIBRATION: Case = Case::new(
    "radial-vibration",
    "Does a cylinder in a rigid ring swing with its own frequencies, across and along its axis?",
)
.ladder(Ladder::variants(
    &[RADIAL, SHEAR],
    " ",
    "R/h",
    RADIUS,
    [&[20, 40], &[20, 40, 80]],
))
.method(|_| Settings::new(Method::DEFAULT))
.scene(scene)
.options(start)
.run(compare)
.gates_of_variants(&[
    error(FREQUENCY).at_most_of(
        [1.2e-3, 3e-4],
        [
            "four times the bound at 80 cells, as order 2 allows",
            "a prototype of the same weights was off by 8.5e-5",
        ],
    ),
    order(FREQUENCY).at_least(
        1.9,
        "order 2 is expected at small strain; the prototype had 2.0",
    ),
])
.tables(&[TableRule::new(
    "cylinder in a rigid ring, {variant} mode",
    &[FREQUENCY],
)])
.wrong_references(&[WRONG_STIFFNESS])
.no_study("a frequency is no field that a study compares along a path")
.no_guest("the scenes of other solvers have no axis of revolution");

/// Wave number \[1/m\] and wave speed \[m/s\] of a mode.
fn mode(variant: &str) -> [f64; 2] {
    if variant == RADIAL {
        [RADIAL_ZERO / RADIUS, p_wave_speed(YOUNG, POISSON, DENSITY)]
    } else {
        let shear = YOUNG / (2.0 * (1.0 + POISSON));
        [SHEAR_ZERO / RADIUS, (shear / DENSITY).sqrt()]
    }
}

/// The mode at a radius \[m\], and its derivative \[1/m\].
fn shape(variant: &str, r: f64) -> [f64; 2] {
    let [k, _] = mode(variant);
    let x = k * r;
    if variant == RADIAL {
        // J1' = J0 - J1/x.
        let slope = if x > 0.0 {
            libm::j0(x) - libm::j1(x) / x
        } else {
            0.5
        };
        [libm::j1(x), k * slope]
    } else {
        [libm::j0(x), -k * libm::j1(x)]
    }
}

/// Component of the velocity that a mode has.
fn along(variant: &str) -> usize {
    usize::from(variant == SHEAR)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mut mesh = revolved_strip(h, [cells(RADIUS, h), 2]);
    mesh.planes[0][1] = PlaneCondition::Fixed;
    if rung.variant == SHEAR {
        // What moves along the axis alone is the same in all heights.
        mesh.planes[1] = [PlaneCondition::Antisymmetric; 2];
    }
    let [k, speed] = mode(rung.variant);
    let end = PERIODS * TAU / (k * speed);
    let fastest = p_wave_speed(YOUNG, POISSON, DENSITY);
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, fastest).0,
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("cylinder", 1, rectangle([0.0; 2], [RADIUS, 2.0 * h]))],
        ..plane_scene("radial_vibration", mesh, end)
    })
}

fn start(rung: &Rung, _: Reference, options: Options) -> Options {
    let variant = rung.variant;
    let [_, speed] = mode(variant);
    starting(options, move |x| {
        let [v, slope] = shape(variant, x[0]).map(|of| SPEED * speed * of);
        let (mut velocity, mut gradient) = ([0.0; 3], [[0.0; 3]; 3]);
        velocity[along(variant)] = v;
        gradient[along(variant)][0] = slope;
        moving(velocity, gradient)
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let variant = run.rung.variant;
    let [k, speed] = mode(variant);
    let vibration = Vibration {
        frequency: k * speed * run.reference.of(&WRONG_STIFFNESS) / TAU,
        speed: SPEED * speed,
        shape: &|x| {
            let mut of_mode = [0.0; 3];
            [of_mode[along(variant)], _] = shape(variant, x[0]);
            of_mode
        },
    };
    vibration.compare(run, FREQUENCY)
}
