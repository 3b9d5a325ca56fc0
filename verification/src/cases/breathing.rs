//! Do a cylinder and a sphere breathe with their own frequencies, where nothing holds their surfaces?
//!
//! Source: Love 1944, section 196; Graff 1975, sections 8.1 and 8.2. The lowest radial mode in axisymmetric scenes, the cylinder in plane
//! strain with its surface on nodes; the sphere is filled by parts of cells, so that its surface is a staircase. The speed is 1e-5 of
//! that of the waves.
//!
//! Expected: order 2 in the frequency of the cylinder; the staircase leaves the sphere an error like h. `proctor verify breathing`.

use super::prelude::*;
use super::vocabulary::round::{distance, gradient, radial};
use super::vocabulary::vibration::Vibration;
use crate::exact::breathing::Round;

const RADIUS: f64 = 1.0; // Radius [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const SPEED: f64 = 1e-5; // Velocity amplitude over wave speed
/// Periods until the end: the second zero of the velocity is at 3/4, the third at 5/4.
const PERIODS: f64 = 1.3;
const CYLINDER: &str = "cylinder";
const SPHERE: &str = "sphere";
const FREQUENCY: &str = "frequency";
const AIR: f64 = 2.0; // Cells between the body and the ends of the mesh
const WRONG_STIFFNESS: Wrong = Wrong::factor("wave speed", 1.02);

/// Bodies that breathe.
pub static BREATHING: Case = Case::new(
    "breathing",
    "Do a cylinder and a sphere breathe with their own frequencies, where nothing holds their surfaces?",
)
.ladder(Ladder::variants(
    &[CYLINDER, SPHERE],
    " ",
    "R/h",
    RADIUS,
    [&[10, 20], &[10, 20, 40]],
))
.method(|_| Settings::new(Method::DEFAULT))
.scene(scene)
.options(start)
.run(compare)
.gates_of_variants(&[
    error(FREQUENCY)
        .at_most_of(
            [4.8e-3, 1.2e-3],
            [
                "four times the bound at 40 cells, as order 2 allows",
                "that of the cylinder in a rigid ring at 40 cells",
            ],
        )
        .of(CYLINDER),
    error(FREQUENCY)
        .at_most_of(
            [1e-2, 5e-3],
            ["twice the bound at 40 cells, as order 1 allows", "a tenth of a cell at the surface is 0.25 % of the radius"],
        )
        .of(SPHERE),
    order(FREQUENCY)
        .at_least(1.8, "order 2 is expected at small strain, with a surface on nodes")
        .of(CYLINDER),
])
.tables(&[TableRule::new("{variant} that breathes", &[FREQUENCY])])
.wrong_references(&[WRONG_STIFFNESS.breaks(|gate| gate.contains("error of"))])
.no_study("a frequency is no field that a study compares along a path")
.no_guest("the scenes of other solvers have no axis of revolution");

fn round(variant: &str) -> Round {
    if variant == SPHERE {
        Round::Sphere
    } else {
        Round::Cylinder
    }
}

/// The middle of the body in its mesh \[m\].
fn middle(rung: &Rung) -> Vector {
    let up = if rung.variant == SPHERE {
        RADIUS + AIR * rung.cell
    } else {
        0.0
    };
    [0.0, up, 0.0]
}

/// A place seen from the middle, along the radius alone in a cylinder \[m\].
fn from_middle(rung: &Rung, x: Vector) -> Vector {
    let middle = middle(rung);
    let up = if rung.variant == SPHERE {
        x[1] - middle[1]
    } else {
        0.0
    };
    [x[0], up, 0.0]
}

fn wave_speed() -> f64 {
    p_wave_speed(YOUNG, POISSON, DENSITY)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let (h, n) = (rung.cell, cells(RADIUS, rung.cell) + AIR as usize);
    let is_sphere = rung.variant == SPHERE;
    let mut mesh = revolved_strip(h, [n, if is_sphere { 2 * n } else { 2 }]);
    mesh.planes[0][1] = PlaneCondition::Free;
    let shape = if is_sphere {
        mesh.planes[1] = [PlaneCondition::Free; 2];
        Shape::Sphere {
            center: middle(rung),
            radius: RADIUS,
        }
    } else {
        rectangle([0.0; 2], [RADIUS, 2.0 * h])
    };
    let period = TAU * RADIUS / (round(rung.variant).lowest(POISSON) * wave_speed());
    let end = PERIODS * period;
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, wave_speed()).0,
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body(rung.variant, 1, shape)],
        ..plane_scene("breathing", mesh, end)
    })
}

/// The mode of a wave number \[1/m\] at a place \[m\]: its velocity, and the derivative of it by the place \[1/m\].
fn mode(rung: &Rung, k: f64, x: Vector) -> (Vector, [[f64; 3]; 3]) {
    let round = round(rung.variant);
    let at = from_middle(rung, x);
    let far = distance(at);
    let [of, slope] = round.shape(k * far);
    let mut rates = gradient(at, k * slope, of / far);
    if round == Round::Cylinder {
        // No strain along the axis.
        rates[1][1] = 0.0;
    }
    (radial(at, of / far), rates)
}

fn start(rung: &Rung, _: Reference, options: Options) -> Options {
    let rung = rung.clone();
    let k = round(rung.variant).lowest(POISSON) / RADIUS;
    starting(options, move |x| {
        let scale = SPEED * wave_speed();
        let (velocity, rates) = mode(&rung, k, *x);
        moving(
            velocity.map(|v| scale * v),
            rates.map(|row| row.map(|v| scale * v)),
        )
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let rung = run.rung;
    let lowest = round(rung.variant).lowest(POISSON);
    let vibration = Vibration {
        frequency: lowest * wave_speed() * run.reference.of(&WRONG_STIFFNESS) / (TAU * RADIUS),
        speed: SPEED * wave_speed(),
        shape: &|x| mode(rung, lowest / RADIUS, x).0,
    };
    vibration.compare(run, FREQUENCY)
}
