//! Does a half-space carry a smooth rigid punch as Boussinesq's solution says?
//!
//! Source: Boussinesq 1885; Johnson 1985, *Contact Mechanics*, section 3.8: a flat round punch of radius a that sinks by d carries
//! 2 E a d/(1 - nu²). The scene is that of *half-space*, a cylinder whose far boundary is moved as the exact half-space moves there.
//! Nodes of the surface under the punch are moved down and slide. The edge of the punch lies in the middle of a cell, between the
//! last node that is moved and the first that is free. Viscous damping lets the ground settle, as local damping would act on what
//! carries the punch.
//!
//! Expected: pressure has no limit at the edge, so the load is of order 1; the edge lies within half a cell of where it should be,
//! which is h/(2 a) of the load. The curve of the stress on the axis is not judged. `proctor verify punch`.

use super::prelude::*;
use super::vocabulary::far_boundary::FarBoundary;
use super::vocabulary::press::Press;
use crate::exact::half_space::HalfSpace;

const PUNCH: f64 = 1.0; // Radius of the punch, a [m]
const FAR: f64 = 4.0; // Radius and depth of the cylinder [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]; it sets a time
const SUNK: f64 = 1e-6; // Way of the punch, d [m]
/// Cells of the body beyond the far boundary, as in *half-space*.
const BEYOND: usize = 2;
/// Times that a wave goes through the cylinder until boundary and punch stand, and until the end.
const TRANSITS: [f64; 2] = [3.0, 20.0];
/// Rate of viscous damping, in waves over the radius of the punch: twice the slowest frequency of the cylinder.
const DAMPING: f64 = 0.5;
/// Share of the time at the end over which the load is read.
const LOOK: f64 = 0.02;
/// Depths on the axis between which the vertical stress is drawn \[m\].
const ON_AXIS: std::ops::Range<f64> = 0.5..3.0;
const LOAD: &str = "load";
const WRONG_YOUNG: Wrong =
    Wrong::factor("Young's modulus", 0.8).breaks(|gate| gate.contains("error of load"));

/// The punch.
pub static RIGID_PUNCH: Case = Case::new(
    "punch",
    "Does a half-space carry a smooth rigid punch as Boussinesq's solution says?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.solve_by(solve)
.gates(&[error(LOAD).at_most_by(
    |finest| 0.5 * finest.cell / PUNCH,
    "the edge lies within half a cell of where it should be",
)])
.tables(&[TableRule::new("punch, uGIMP, USL, FLIP", &[LOAD])])
.wrong_references(&[WRONG_YOUNG])
.refer_by(refer)
.no_study("its load is decided by where a grid has the edge, which is no setting of a study")
.no_guest("the scenes of other solvers have no axis of revolution");

fn exact(reference: Reference) -> HalfSpace {
    HalfSpace {
        young: YOUNG * reference.of(&WRONG_YOUNG),
        poisson: POISSON,
    }
}

/// Cells over the radius of the punch, half a cell among them.
fn rungs(size: Size) -> Vec<Rung> {
    let counts: &[u32] = size.pick(&[4, 8], &[4, 8, 16]);
    let of = |&whole: &u32| {
        let count = f64::from(whole) + 0.5;
        Rung::labelled(format!("a/h={count}"), "punch", PUNCH / count)
    };
    counts.iter().map(of).collect()
}

/// Time that a wave takes through the cylinder \[s\].
fn transit() -> f64 {
    FAR / p_wave_speed(YOUNG, POISSON, DENSITY)
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let n = cells(FAR, h);
    let mut mesh = revolved_strip(h, [n + BEYOND + 1, n + BEYOND + 3]);
    mesh.origin[1] = -h * (BEYOND + 1) as f64;
    mesh.planes[0][1] = PlaneCondition::Free;
    mesh.planes[1] = [PlaneCondition::Free; 2];
    let beyond = BEYOND as f64 * h;
    settings.applied(Scene {
        time_step: settings.multiplier(),
        damping: Damping::Viscous {
            alpha: DAMPING * h / PUNCH,
        },
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body(
            "half-space",
            1,
            rectangle([0.0, -beyond], [FAR + beyond, FAR]),
        )],
        ..plane_scene("punch", mesh, TRANSITS[1] * transit())
    })
}

fn solve(
    rung: &Rung,
    reference: Reference,
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<RungResult, Failure> {
    let h = rung.cell;
    let half_space = exact(Reference::CORRECT);
    let [stands, end] = TRANSITS.map(|count| count * transit());
    let moved = |x: Vector| {
        let [along, down] = half_space.punch_displacement([SUNK, PUNCH], [x[0], FAR - x[1]]);
        [along, -down, 0.0]
    };
    let down = move |t: f64| {
        if t > 0.0 && t < stands {
            -SUNK / stands
        } else {
            0.0
        }
    };
    let press = Arc::new(Press::smooth(FAR, h, down).up_to(PUNCH - 0.5 * h));
    let mut options = options.clone();
    options.conditions.push(press.clone());
    let options = options.with_condition(FarBoundary::new(h, [FAR, stands], BEYOND, moved));
    let scene = scene(rung, &Settings::new(Method::DEFAULT));
    let mut solved = simulate(scene, &options, |simulation| {
        let mut load = f64::NAN;
        let looks = [(1.0 - LOOK) * end, end];
        press.forces(simulation, looks, observer, |force| load = force)?;
        let known = half_space.punch_load([SUNK, PUNCH]);
        let mut stress = vec![];
        for p in 0..simulation.sets()[0].len() {
            let x = simulation.position(0, p);
            let depth = FAR - x[1];
            if x[0] < 0.5 * h && ON_AXIS.contains(&depth) {
                let known = half_space.punch_axis_stress([SUNK, PUNCH], depth);
                stress.push((depth, simulation.sets()[0].stress(p)[1], known));
            }
        }
        stress.sort_by(|a, b| a.0.total_cmp(&b.0));
        let points = stress.iter();
        let points = points.map(|&(depth, found, known)| CurvePoint::new(depth, found, known));
        let curve = Curve::new(
            format!("vertical stress on the axis, {}", rung.label),
            ["depth (m)", "stress (Pa)"],
            points,
        );
        Ok(Measurements::of([Quantity::compared(LOAD, load, known, "N")]).drawn(curve))
    })?;
    refer(rung, reference, &mut solved);
    Ok(solved)
}

/// Results do not depend on the reference, but for the exact load beside them.
fn refer(_: &Rung, reference: Reference, solved: &mut RungResult) {
    let known = exact(reference).punch_load([SUNK, PUNCH]);
    for q in &mut solved.quantities {
        *q = Quantity::compared(q.name, q.value, known, q.unit);
    }
}
