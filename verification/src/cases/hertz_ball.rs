//! Is the pressure between an elastic ball and a rigid plate that of Hertz, as a body of revolution in contact on the grid?
//!
//! Source: Hertz 1881 (Johnson, Contact Mechanics, section 4.2b). The lower part of a ball, a round block of six contact radii with
//! a spherical bottom, stands in an axisymmetric scene on a plate that does not move. Its weight is the load of a contact of radius
//! a = 1 m. It settles under local damping, and pressures are averaged over the last steps: the vertical stress of the lowest
//! particles, as a mean over a cell. Pressure spreads with the depth z: in a half-space its second moment grows by 2 z², the mean of
//! which over a cell is taken off again.
//!
//! Beside it *hertz-sphere* runs the same contact in three dimensions, with mortar contact. What 1 % costs with each, and a chart of
//! both: `proctor precision hertz-ball hertz-sphere --own --svg charts`.
//!
//! Expected: order 1, and beside it what the block's size does, 8/3 (a/L)^3 = 1.2 % at most. A node takes the lowest particle
//! within reach, a quarter of a cell nearer to the axis, and particles under pressure are thinner than at the start: contact begins
//! about h/4 farther out. The radius is then off by h/(4 a), and the peak by twice that. `proctor verify hertz-ball`.

use super::prelude::*;
use crate::exact::hertz::contact_modulus;
use crate::exact::hertz_sphere::HertzSphere as Exact;

const RADIUS: f64 = 20.0; // Radius of the ball [m]
const CONTACT: f64 = 1.0; // Contact radius that the weight is chosen for [m]
const BLOCK: f64 = 6.0; // Radius and height of the block [m]
const PLATE: f64 = 2.0; // Radius of the plate [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]; it sets a time
/// Factor of local damping while the block settles.
const DAMPING: f64 = 0.7;
/// Periods of the block on its contact until averaging begins, and until the end: under this damping half a period leaves a fifth
/// of a swing.
const PERIODS: [f64; 2] = [3.0, 3.1];
const MIDDLE: f64 = 0.5; // The mean over this share of the contact radius gives the peak pressure

const FORCE: &str = "contact force";
const PEAK: &str = "peak pressure";
const WIDTH: &str = "contact radius";
const L2: &str = "L2(p) against Hertz";
const WRONG_LOAD: Wrong = Wrong::factor("load", 1.05).breaks(|gate| gate.contains("force"));
const QUARTER: &str = "a quarter of a cell farther out, h/(4 a), and the size of the block, 1.2 %";
const TWICE: &str = "twice that of the radius, since the load is given";

/// The ball on a rigid plate.
pub static HERTZ_BALL: Case = Case::new(
    "hertz-ball",
    "Is the pressure between an elastic ball and a rigid plate that of Hertz, as a body of revolution in contact on the grid?",
)
.ladder(Ladder::cells("ball", "a/h", CONTACT, &[4], &[4, 8, 16]))
.method(|_| Settings::new(Method::DEFAULT.with_scheme(StressScheme::Musl)))
.displacements()
.scene(scene)
.run(compare)
.gates(&[
    error(FORCE).at_most(0.01, "the weight must arrive"),
    error(WIDTH).at_most_by(|finest| 0.25 * finest.cell / CONTACT + 0.012, QUARTER),
    error(PEAK).at_most_by(|finest| 0.5 * finest.cell / CONTACT + 0.012, TWICE),
])
.tables(&[TableRule::new(
    "ball, uGIMP, MUSL, FLIP, contact on the grid",
    &[FORCE, PEAK, WIDTH, L2],
)])
.wrong_references(&[WRONG_LOAD])
.studies(&[Plan::new(
    Ladder::cells("ball", "a/h", CONTACT, &[2, 4], &[2, 4, 8]),
    &[
        Measure::new("pressure", L2),
        Measure::new("peak", PEAK),
        Measure::new("radius", WIDTH),
    ],
    2,
)
.trying(few)])
.no_guest("what is known exactly is the pressure of a contact, and frames of particles hold none");

fn of_load(load: f64) -> Exact {
    Exact {
        radius: RADIUS,
        load,
        modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
    }
}

/// Force with which Hertz gives the contact radius \[N\].
fn load() -> f64 {
    4.0 * of_load(1.0).modulus * CONTACT.powi(3) / (3.0 * RADIUS)
}

fn exact(reference: Reference) -> Exact {
    of_load(load() * reference.of(&WRONG_LOAD))
}

/// Volume of the block \[m³\]: its top has the shape of its bottom.
const VOLUME: f64 = PI * BLOCK * BLOCK * BLOCK;

/// Period of the block as a rigid body on the stiffness 2 E* a of its contact \[s\].
fn period() -> f64 {
    let stiffness = 2.0 * of_load(1.0).modulus * CONTACT;
    TAU * (VOLUME * DENSITY / stiffness).sqrt()
}

/// Height of the ball's bottom at a distance from its axis \[m\].
fn bottom(r: f64) -> f64 {
    RADIUS - (RADIUS * RADIUS - r * r).sqrt()
}

/// Columns of rings from the ball's surface up, so that no step of a lattice lies in the contact.
fn rings(h: f64, per_cell: usize) -> Shape {
    let step = h / per_cell as f64;
    let count = cells(BLOCK, step);
    let at = |k: usize| (k as f64 + 0.5) * step;
    let seeds = (0..count).flat_map(|i| {
        (0..count).map(move |k| ParticleSeed {
            position: [at(i), bottom(at(i)) + at(k), 0.0],
            volume: TAU * at(i) * step * step,
        })
    });
    Shape::Particles(Arc::new(seeds.collect()))
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let height = bottom(BLOCK) + BLOCK;
    let mut mesh = open_quarter(h, [cells(BLOCK, h) + 2, (height / h).ceil() as usize + 4]);
    mesh.origin[1] = -3.0 * h;
    mesh.planes[1][0] = PlaneCondition::Free;
    let plate = Body {
        motion: Some([0.0; 3].into()),
        ..body("plate", 1, rectangle([0.0, -2.0 * h], [PLATE, 0.0]))
    };
    let ball = rings(h, settings.particles_per_cell);
    settings.applied(Scene {
        time_step: settings.multiplier(),
        damping: Damping::Local { alpha: DAMPING },
        gravity: [0.0, -load() / (DENSITY * VOLUME), 0.0],
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![plate, body("ball", 2, ball)],
        contacts: contact("ball on plate", [1, 2], 0.0, ContactNormal::Master),
        ..plane_scene("hertz_ball", mesh, PERIODS[1] * period())
    })
}

/// Sums over the last steps.
#[derive(Default)]
struct Window {
    /// Upward force on the ball \[N\], summed.
    force: f64,
    /// Pressure over volume of the lowest cells, summed, and the volume, by the column of cells.
    columns: Vec<[f64; 2]>,
    /// Steps.
    steps: f64,
}

impl Window {
    /// Adds a step.
    fn add(&mut self, simulation: &Simulation, h: f64) {
        self.force += simulation.contact_force(1)[1];
        self.steps += 1.0;
        let set = &simulation.sets()[1];
        for p in 0..set.len() {
            let Some(x) = simulation.initial_position(1, p) else {
                continue;
            };
            let column = (x[0] / h) as usize;
            if column >= self.columns.len() || x[1] - bottom(x[0]) > h {
                continue;
            }
            let volume = simulation.particle_mass(1, p) / DENSITY;
            let [pressure, whole] = &mut self.columns[column];
            *pressure -= volume * set.stress(p)[1];
            *whole += volume;
        }
    }
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let h = rung.cell;
    let exact = exact(run.reference);
    let [settled, end] = PERIODS.map(|periods| periods * period());
    run_until(simulation, settled, observer, |_| ())?;
    let mut window = Window {
        columns: vec![[0.0; 2]; cells(PLATE, h)],
        ..Window::default()
    };
    run_until(simulation, end, observer, |simulation| {
        window.add(simulation, h);
    })?;
    // Of each column of cells: its middle, its mean pressure, and its area.
    let columns = window.columns.iter().enumerate();
    let columns = columns.map(|(k, [pressure, volume])| {
        let middle = (k as f64 + 0.5) * h;
        (middle, pressure / volume, TAU * middle * h)
    });
    let columns: Vec<(f64, f64, f64)> = columns.collect();
    let moment = |power: i32| -> f64 {
        let terms = columns.iter().map(|(r, p, area)| p * r.powi(power) * area);
        terms.sum()
    };
    // Of the Hertz pressure with the same second moment; a ring of the width h has r² + h²/4, and the mean of 2 z² down to h is
    // 2 h²/3.
    let square = moment(2) / moment(0) + (0.25 - 2.0 / 3.0) * h * h;
    let radius = (2.5 * square).sqrt();
    let inner = columns.iter().filter(|(r, ..)| *r < MIDDLE * CONTACT);
    let (force, area) = inner.fold((0.0, 0.0), |(f, a), (_, p, area)| (f + p * area, a + area));
    let within = (area / PI).sqrt();
    let peak = force / area * exact.peak() / exact.mean_within(within);
    let beside = |r: f64| mean(&exact, r, h);
    let samples = columns.iter();
    let distance = relative_l2(samples.map(|&(r, p, area)| (area, [p], [beside(r)])));
    let points = columns.iter();
    let points = points.map(|&(r, p, _)| CurvePoint::new(r, p, beside(r)));
    let title = format!("{}: contact pressure", rung.label);
    let curve = Curve::new(title, ["r in m", "p in Pa"], points);
    Ok(Measurements::of([
        Quantity::compared(FORCE, window.force / window.steps, exact.load, "N"),
        Quantity::compared(PEAK, peak, exact.peak(), "Pa"),
        Quantity::compared(WIDTH, radius, exact.contact_radius(), "m"),
        ratio(L2, distance),
    ])
    .drawn(curve))
}

/// Mean of the Hertz pressure over a column of cells about a radius \[Pa\].
fn mean(exact: &Exact, r: f64, h: f64) -> f64 {
    let force = |r: f64| {
        if r == 0.0 {
            0.0
        } else {
            exact.mean_within(r) * r.min(exact.contact_radius()).powi(2)
        }
    };
    (force(r + 0.5 * h) - force(r - 0.5 * h)) / (2.0 * r * h)
}
