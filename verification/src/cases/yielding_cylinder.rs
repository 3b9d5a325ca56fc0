//! Does a thick-walled cylinder that yields carry the pressure of Hill's solution, up to its limit?
//!
//! Source: Hill 1950, chapter V: Tresca, plane strain. The wall of *thick-cylinder*, perfectly plastic, under a pressure that rises
//! slowly: to 0.90 of its limit, where half of the wall has yielded (`half`), and to 0.996 of it, where nine tenths have (`limit`). There
//! the displacement is 13 times as sensitive as the load: an error of 0.1 % in what the wall carries would be 1.4 % of it.
//!
//! The pressure rises over ten periods of the elastic wall, and viscous damping lets it swing no more than once, so that no stress falls
//! on the way. Stresses are compared as means over cells. Expected: order 1 at least, since slopes have a kink where it yields.
//! `proctor verify yielding-cylinder`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use crate::exact::yielding_wall::YieldingWall;

const INNER: f64 = 1.0; // Inner radius [m]
const OUTER: f64 = 2.0; // Outer radius [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]
const STRENGTH: f64 = 1.0; // Yield stress in tension [Pa]
const PERIODS: f64 = 10.0; // Times that a wave goes round the wall, until the pressure is whole
const DAMPED: f64 = 0.5; // Damping over that at which the elastic wall no longer swings
const HALF: &str = "half";
const LIMIT: &str = "limit";
const RADIAL: &str = "L2(radial stress of cells)";
const WIDENING: &str = "displacement of the inner face";
const RESIDUAL: &str = "residual";
const RESIDUAL_TARGET: f64 = 1e-7;
const WRONG_STRENGTH: Wrong = Wrong::factor("strength", 1.06)
    .breaks(|gate| gate.contains("error of") && !gate.contains("stress"));

/// The cylinder that yields.
pub static YIELDING_CYLINDER: Case = Case::new(
    "yielding-cylinder",
    "Does a thick-walled cylinder that yields carry the pressure of Hill's solution, up to its limit?",
)
.ladder(Ladder::variants(
    &[HALF, LIMIT],
    " ",
    "t/h",
    OUTER - INNER,
    [&[8, 16], &[8, 16, 32]],
))
.method(|_| Settings::new(Method::DEFAULT))
.scene(scene)
.displacements()
.residual()
.compare_after(settle, compare)
.gates_of_variants(&[
    error(DISPLACEMENT)
        .at_most_of(
            [5e-3, 2e-3],
            ["half a percent at 16 cells", "order 1.3 from there"],
        )
        .of(HALF),
    error(DISPLACEMENT)
        .at_most_of(
            [3e-2, 1.5e-2],
            [
                "two thousandths of the load it carries, 14 times as much in the displacement",
                "a thousandth of the load",
            ],
        )
        .of(LIMIT),
    error(WIDENING)
        .at_most_of(
            [1e-2, 5e-3],
            ["one percent at 16 cells", "half a percent at 32 cells"],
        )
        .of(HALF),
    error(WIDENING)
        .at_most_of(
            [4e-2, 2e-2],
            ["as the displacement of the wall, and a third more at its face", "as the displacement of the wall at 32 cells, and a third more"],
        )
        .of(LIMIT),
    error(RADIAL).at_most_of(
        [5e-2, 2.5e-2],
        ["order 1, from 2.5 % at 32 cells", "stresses are of order 1 where they have a kink"],
    ),
    order(DISPLACEMENT).at_least(0.9, "order 1 at least: slopes have a kink where it yields"),
    order(RADIAL).at_least(0.9, "stresses are of order 1 where they have a kink"),
    at_rest(RESIDUAL, 1e-6),
])
.tables(&[TableRule::new(
    "cylinder that yields, {variant}",
    &[DISPLACEMENT, WIDENING, RADIAL],
)])
.wrong_references(&[WRONG_STRENGTH])
.no_study("its answer depends on the way, which has a rise of pressure and a damping of its own")
.no_guest("the scenes of other solvers have no axis of revolution");

fn exact(factor: f64) -> YieldingWall {
    YieldingWall {
        inner: INNER,
        outer: OUTER,
        strength: factor * STRENGTH,
        young: YOUNG,
        poisson: POISSON,
    }
}

/// Radius up to which the wall yields \[m\].
fn front(variant: &str) -> f64 {
    if variant == HALF { 1.5 } else { 1.9 }
}

/// Time until the pressure is whole \[s\].
fn rise() -> f64 {
    PERIODS * TAU * INNER / p_wave_speed(YOUNG, POISSON, DENSITY)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    const POINTS: usize = 200;
    let h = rung.cell;
    let mut mesh = revolved_strip(h, [cells(OUTER - INNER, h) + 5, 1]);
    mesh.origin[0] = INNER - 2.0 * h;
    mesh.planes[0] = [PlaneCondition::Free; 2];
    let pressure = exact(1.0).cylinder_pressure(front(rung.variant));
    let at = |k: usize| k as f64 / POINTS as f64;
    // The lowest frequency of the elastic wall is about that of a thin ring, c/r.
    let rate = 2.0 * DAMPED * p_wave_speed(YOUNG, POISSON, DENSITY) / INNER;
    settings.applied(Scene {
        time_step: settings.multiplier(),
        damping: Damping::Viscous {
            alpha: rate * h / (YOUNG / DENSITY).sqrt(),
        },
        materials: material(
            "Tresca",
            DENSITY,
            Tresca::new(YOUNG, POISSON, 0.5 * STRENGTH),
        ),
        bodies: vec![body("wall", 1, rectangle([INNER, 0.0], [OUTER, h]))],
        tractions: vec![Traction {
            p1: [INNER, 0.0, 0.0],
            p2: [INNER, h, 0.0],
            traction: History {
                times: (0..=POINTS).map(|k| at(k) * rise()).collect(),
                values: (0..=POINTS)
                    .map(|k| [pressure * smooth(at(k))[0], 0.0, 0.0])
                    .collect(),
            },
        }],
        ..plane_scene("yielding_cylinder", mesh, rise())
    })
}

fn settle(run: &mut Run<'_>) -> Result<(), Failure> {
    run_until(run.simulation, rise(), run.observer, |_| ())?;
    let pressure = exact(1.0).cylinder_pressure(front(run.rung.variant));
    let load = TAU * INNER * run.rung.cell * pressure;
    run.relax(load, RESIDUAL_TARGET, OUTER - INNER)
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let exact = exact(run.reference.of(&WRONG_STRENGTH));
    let pressure = self::exact(1.0).cylinder_pressure(front(run.rung.variant));
    let front = yielded(&exact, pressure);
    let simulation = &*run.simulation;
    let displacement = l2(simulation, |p, x| {
        let u = exact.cylinder_displacement(front, x[0]);
        Some((simulation.displacement(0, p)?, [u, 0.0, 0.0]))
    });
    let radial = l2_of_cells(simulation, |p, x| {
        let stress = simulation.sets()[0].stress(p);
        Some(([stress[0]], [exact.cylinder_stress(front, x[0])[0]]))
    });
    // The first two layers of particles, taken to the face by u r.
    let inner = run.along(0, |p, x| {
        let u = run.simulation.displacement(0, p);
        [u.map_or(f64::NAN, |u| u[0] * x), f64::NAN]
    });
    let face = match inner.as_deref() {
        Some([first, second, ..]) => {
            let slope = (second.computed - first.computed) / (second.at - first.at);
            (first.computed + (INNER - first.at) * slope) / INNER
        }
        _ => return Err("the wall has no two layers of particles".into()),
    };
    let points = run.along(0, |p, x| {
        [run.stress(p)[2], exact.cylinder_stress(front, x)[2]]
    });
    let title = format!("hoop stress through the wall, {}", run.rung.label);
    let curve = points.map(|points| Curve::new(title, ["r (m)", "stress (Pa)"], points));
    Ok(Measurements::of([
        ratio(DISPLACEMENT, displacement),
        Quantity::compared(
            WIDENING,
            face,
            exact.cylinder_displacement(front, INNER),
            "m",
        ),
        ratio(RADIAL, radial),
        Quantity::balance(RESIDUAL, run.residual, "1"),
    ])
    .drawn(curve))
}

/// Radius up to which a wall has yielded under a pressure \[m; Pa\].
fn yielded(wall: &YieldingWall, pressure: f64) -> f64 {
    let (mut low, mut high) = (INNER, OUTER);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if wall.cylinder_pressure(middle) < pressure {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
