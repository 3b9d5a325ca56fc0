//! Does a block with sharp corners keep to Coulomb's law wherever it rubs, as slave and as master?
//!
//! A block of 2 m x 0.5 m (1 GPa, nu = 0.3, 2500 kg/m³) on a rigid line at 30 degrees, gravity 10 m/s² turned instead of
//! the line, mortar contact through a barrier. Held by friction it settles with local damping; then damping ends and
//! friction becomes mu = 0.35. From then on the block slides by (g sin - mu g cos) t²/2, and each of its vertices is rubbed
//! by no more than mu times what presses it, in the directions of the line.
//!
//! A block as slave presses along the normals of its own base, which its weight and friction turn by up to theta, so that
//! friction may be tan(atan mu + theta) of the force into the line; theta is taken from the segments of the base, and what
//! is more than that is judged. With a mean normal at its corners (eq. 41) it is rubbed by 1.02 to 1.03 mu N.
//! Source: Liang et al. 2024, eq. 41 and 50. `proctor verify corner-block`.

use super::prelude::*;
use crate::exact::sliding::Slope;

const LENGTH: f64 = 2.0;
const HEIGHT: f64 = 0.5;
const YOUNG: f64 = 1e9;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 2500.0;
const GRAVITY: f64 = 10.0;
const TILT: f64 = 30.0;
const FRICTION: f64 = 0.35;
const ROUGH: f64 = 10.0; // Friction that holds the block before the release
/// Distance below which the barrier pushes \[m\], and its stiffness \[Pa/m\].
const GAP: f64 = 0.02;
const KAPPA: f64 = 1e7;
/// Stiffness of the tangential spring \[Pa/m\]: 0.04 mm of slip under the weight.
const KAPPA_T: f64 = 1e8;
const SEGMENT: f64 = 0.05; // Length of a segment [m]
/// Local damping while the block settles, and for how long \[s\].
const SETTLING: f64 = 0.6;
const STAGE: f64 = 0.5;
/// Time from the release to the end \[s\], and its parts after each of which is looked.
const TIME: f64 = 1.0;
const LOOKS: u32 = 40;
/// Vertices that are pressed by less than this share of the weight are about to lose contact.
const PRESSED: f64 = 1e-6;

const WAY: &str = "displacement";
const TOTAL: &str = "friction of the block beyond its limit";
const VERTEX: &str = "friction of a vertex beyond its limit";

/// Variants, by who is the slave.
const SLAVE: &str = "block as slave";
const MASTER: &str = "line as slave";
const WRONG_FRICTION: Wrong = Wrong::factor("friction", 1.1);

/// The block, by who is the slave.
pub static CORNER_BLOCK: Case = Case::new("corner-block", "Does a block with sharp corners keep to Coulomb's law wherever it rubs, as slave and as master?")
    .ladder(Ladder::sizes(
    &[(SLAVE, &[0.25]), (MASTER, &[0.25])],
    &[(SLAVE, &[0.25, 0.125, 0.0625]), (MASTER, &[0.25, 0.125, 0.0625])],
))
    .method(|_| settings(APIC, 2))
    .scene_by(scene)
    .run(compare)
    .gates_of_rungs(&[
    error(WAY).at_most(1e-2, "the project promises one percent of friction"),
    error(TOTAL).at_most(1e-6, "Coulomb's law, but for the turn of the block's base"),
    error(VERTEX).at_most(1e-6, "Coulomb's law at each vertex"),
])
    .wrong_references(&[WRONG_FRICTION])
    .studies(&[Plan::new(Ladder::sizes(&[(SLAVE, &[0.5, 0.25])], &[(SLAVE, &[0.25, 0.125, 0.0625])]), &[Measure::new("displacement", WAY)], 2)])
    .no_guest(NO_GUEST);

fn exact() -> Slope {
    let (sin, cos) = libm::sincos(TILT.to_radians());
    Slope {
        along: GRAVITY * sin,
        into: GRAVITY * cos,
        friction: FRICTION,
    }
}

/// Largest turn of the base of the block \[rad\].
fn turn(simulation: &Simulation) -> f64 {
    let vertices = simulation.boundaries().vertices;
    let own: Vec<_> = vertices.iter().filter(|v| v.id == 1).collect();
    let sides = own.windows(2).map(|w| [w[0].position, w[1].position]);
    sides
        .filter(|[a, b]| a[1].max(b[1]) < 2.0 * GAP)
        .map(|[a, b]| libm::atan((b[1] - a[1]) / (b[0] - a[0])).abs())
        .fold(0.0, f64::max)
}

/// Friction over the most that Coulomb's law allows with normals that turn so far, less 1: of all vertices of the block
/// together, and the largest of one alone.
fn excess(simulation: &Simulation, turn: f64) -> [f64; 2] {
    let most = libm::tan(libm::atan(FRICTION) + turn);
    let over = |[along, into, _]: Vector| along.abs() / (most * into) - 1.0;
    let weight = DENSITY * LENGTH * HEIGHT * GRAVITY;
    let vertices = simulation.boundaries().vertices;
    let pressed = vertices
        .iter()
        .filter(|v| v.id == 1 && v.force[1] > PRESSED * weight);
    let vertex = pressed
        .map(|v| over(v.force))
        .fold(f64::NEG_INFINITY, f64::max);
    let total = simulation.mortar_force(1).map_or(f64::NAN, over);
    [total, vertex]
}

fn scene(rung: &Rung, settings: &Settings, reference: Reference) -> Scene {
    let h = rung.cell;
    let way = exact().displacement(TIME);
    let (from, to) = (-1.0, LENGTH + way + 1.0);
    let mesh = open_plane(h, [from, -0.5], [to, 1.5]);
    let at = |k: i32| Point::new(to - 0.2 - (to - from - 0.4) * f64::from(k) / 20.0, 0.0);
    let line = open_line("line", 2, (0..=20).map(at), None);
    let block = rectangle([0.0, 0.5 * GAP], [LENGTH, 0.5 * GAP + HEIGHT]);
    let is_slave = rung.variant == SLAVE;
    let ends = if is_slave { [2, 1] } else { [1, 2] };
    let friction = reference.of(&WRONG_FRICTION) * FRICTION;
    let mut scene = Scene {
        time_step: settings.multiplier(),
        gravity: [exact().along, -exact().into, 0.0],
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("block", 1, block)],
        damping: Damping::Local { alpha: SETTLING },
        mortar: Mortar {
            boundaries: vec![boundary(1, Vertices::Spacing(SEGMENT))],
            lines: vec![line],
            contacts: vec![rubbing(
                [friction, KAPPA_T],
                barrier("block on line", ends, GAP, KAPPA),
            )],
            ..Mortar::default()
        },
        ..plane_scene(&rung.label, mesh, STAGE + TIME)
    };
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let exact = exact();
    simulation.set_friction(1, ROUGH)?;
    run_until(simulation, STAGE, &mut *observer, |_| ())?;
    simulation.set_local_damping(None)?;
    simulation.set_friction(1, run.reference.of(&WRONG_FRICTION) * FRICTION)?;
    let start = simulation.center(0).position[0];
    let mut most = [f64::NEG_INFINITY; 2];
    let mut turned = turn(simulation);
    let mut points = vec![];
    for k in 1..=LOOKS {
        let time = f64::from(k) / f64::from(LOOKS) * TIME;
        run_until(simulation, STAGE + time, &mut *observer, |simulation| {
            // Forces are of the step before the vertices moved. The normals of the line do not turn.
            let now = turn(simulation);
            let is_slave = rung.variant == SLAVE;
            let turn = if is_slave { turned.max(now) } else { 0.0 };
            turned = now;
            let found = excess(simulation, turn);
            most = [0, 1].map(|of| most[of].max(found[of]));
        })?;
        let way = simulation.center(0).position[0] - start;
        points.push(CurvePoint::new(time, way, exact.displacement(time)));
    }
    let way = points.last().map_or(f64::NAN, |p| p.computed);
    let quantities = vec![
        Quantity::compared(WAY, way, exact.displacement(TIME), "m"),
        Quantity::of_zero(TOTAL, most[0].max(0.0)),
        Quantity::of_zero(VERTEX, most[1].max(0.0)),
    ];
    let title = format!("{}: way along the line", rung.label);
    let curve = Curve::new(title, ["t in s", "u_x in m"], points);
    Ok(Measurements::of(quantities).drawn(curve))
}
