//! Does a thick-walled cylinder under internal pressure widen as Lamé's solution says?
//!
//! Source: Lamé 1852; Timoshenko and Goodier 1970, section 28. An axisymmetric scene: a wall from 1 m to 2 m between sliding
//! planes (plane strain), under a pressure inside that strains it by 1e-6. `on` has its faces on nodes, `off` 0.3 of a cell beside
//! them, so that domains of particles lie across nodes. `stiff` has a Poisson's ratio of 0.4999 and means over cells.
//!
//! Expected: order 2 in the displacement, 1 in the stress. Those of `off`, 1.86 and 0.94 from 32 to 64 cells, are in its table, and no
//! gate is on them. `proctor verify thick-cylinder`.

use super::prelude::*;
use crate::exact::thick_wall::ThickWall;

const INNER: f64 = 1.0; // Inner radius [m]
const OUTER: f64 = 2.0; // Outer radius [m]
const YOUNG: f64 = 1e6; // Young's modulus [Pa]
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1000.0; // Density [kg/m³]
/// Pressure inside \[Pa\].
const PRESSURE: f64 = 1.0;
const ON: &str = "on";
const OFF: &str = "off";
/// Nearly incompressible, with its volumetric strain a mean over cells.
const STIFF: &str = "stiff";
/// Poisson's ratio of `stiff`.
const NEARLY: f64 = 0.4999;
/// Part of a cell by which the faces of `off` are beside nodes.
const BESIDE: f64 = 0.3;
const RADIAL: &str = "L2(radial stress)";
const RESIDUAL: &str = "residual";
/// Residual at which the relaxation stops, over the force of the pressure.
const RESIDUAL_TARGET: f64 = 1e-9;
const RESIDUAL_STUDIED: f64 = 1e-6;
const WRONG_PRESSURE: Wrong =
    Wrong::factor("pressure", 1.001).breaks(|gate| gate.contains("L2(u)"));

/// Lamé's cylinder.
pub static THICK_CYLINDER: Case = Case::new(
    "thick-cylinder",
    "Does a thick-walled cylinder under internal pressure widen as Lamé's solution says?",
)
.ladder(Ladder::made(rungs))
.method(|_| Settings::new(Method::DEFAULT))
.scene(scene)
.displacements()
.residual()
.compare_after(settle, compare)
.gates_of_variants(&[
    error(DISPLACEMENT)
        .at_most_of(
            [4.8e-4, 3e-5],
            [
                "sixteen times the bound at 64 cells, as order 2 allows at 16",
                "a prototype of the same weights was off by 1e-5",
            ],
        )
        .on(|rung| rung.variant != STIFF),
    error(DISPLACEMENT)
        .at_most_of(
            [8e-4, 2e-4],
            [
                "four times the bound at 32 cells, as order 2 allows at 16",
                "a prototype of the same means was off by 6.2e-5, and by 0.16 without them",
            ],
        )
        .of(STIFF),
    order(DISPLACEMENT)
        .at_least(1.8, "the prototype had 2.0")
        .of(STIFF),
    order(DISPLACEMENT)
        .at_least(1.9, "the prototype had 1.99")
        .of(ON),
    order(RADIAL)
        .at_least(0.9, "stresses of the particles are of order 1")
        .of(ON),
    at_rest(RESIDUAL, 1e-8),
])
.tables(&[TableRule::new(
    "Lamé's cylinder, {variant}",
    &[DISPLACEMENT, RADIAL],
)])
.wrong_references(&[WRONG_PRESSURE])
.studies(&[Plan::new(
    Ladder::cells(ON, "t/h", OUTER - INNER, &[8, 16, 32], &[8, 16, 32, 64]),
    &[
        Measure::new("displacement", DISPLACEMENT),
        Measure::new("stress", RADIAL),
    ],
    1,
)
// The gradient of least squares has no axisymmetric form.
.trying(|_, method| method.transfer != TransferKind::Mls)])
.no_guest("the scenes of other solvers have no axis of revolution");

/// Of a nearly incompressible wall few: what is slow in it takes seventy times as long as what is fast.
fn rungs(size: Size) -> Vec<Rung> {
    let (counts, stiff): (&[u32], &[u32]) =
        size.pick((&[8, 16], &[8, 16]), (&[8, 16, 32, 64], &[8, 16, 32]));
    let of = |variant: &'static str, counts: &[u32]| -> Vec<Rung> {
        let label = |count: u32| format!("{variant} t/h={count}");
        let cell = |count: u32| (OUTER - INNER) / f64::from(count);
        let rung = |&count: &u32| Rung::labelled(label(count), variant, cell(count));
        counts.iter().map(rung).collect()
    };
    [of(ON, counts), of(OFF, counts), of(STIFF, stiff)].concat()
}

fn poisson(rung: &Rung) -> f64 {
    if rung.variant == STIFF {
        NEARLY
    } else {
        POISSON
    }
}

fn exact(rung: &Rung, factor: f64) -> ThickWall {
    ThickWall {
        inner: INNER,
        outer: OUTER,
        pressure: factor * PRESSURE,
        young: YOUNG,
        poisson: poisson(rung),
    }
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    // Two cells before the wall and behind it, so that nothing but the wall is there.
    let first = INNER - 2.0 * h - if rung.variant == OFF { BESIDE * h } else { 0.0 };
    let mut mesh = revolved_strip(h, [cells(OUTER - INNER, h) + 5, 1]);
    mesh.origin[0] = first;
    mesh.planes[0] = [PlaneCondition::Free; 2];
    settings.applied(Scene {
        time_step: settings.multiplier(),
        damping: Damping::Kinetic,
        volumetric_strain: if rung.variant == STIFF {
            VolumetricStrain::CellAverage
        } else {
            VolumetricStrain::Particle
        },
        materials: elastic(DENSITY, YOUNG, poisson(rung)),
        bodies: vec![body("wall", 1, rectangle([INNER, 0.0], [OUTER, h]))],
        tractions: traction([INNER, 0.0, 0.0], [INNER, h, 0.0], [PRESSURE, 0.0, 0.0]),
        ..plane_scene("thick_cylinder", mesh, 1.0)
    })
}

fn settle(run: &mut Run<'_>) -> Result<(), Failure> {
    let target = match run.settings.courant {
        None => RESIDUAL_TARGET,
        Some(_) => RESIDUAL_STUDIED,
    };
    let load = TAU * INNER * run.rung.cell * PRESSURE;
    run.relax(load, target, OUTER - INNER)
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let exact = exact(run.rung, run.reference.of(&WRONG_PRESSURE));
    let simulation = &*run.simulation;
    let displacement = l2(simulation, |p, x| {
        Some((
            simulation.displacement(0, p)?,
            [exact.cylinder_displacement(x[0]), 0.0, 0.0],
        ))
    });
    let radial = l2(simulation, |p, x| {
        let stress = simulation.sets()[0].stress(p);
        Some(([stress[0]], [exact.cylinder_stress(x[0])[0]]))
    });
    let points = run.along(0, |p, x| [run.stress(p)[2], exact.cylinder_stress(x)[2]]);
    let title = format!("hoop stress through the wall, {}", run.rung.label);
    let curve = points.map(|points| Curve::new(title, ["r (m)", "stress / p"], points));
    Ok(Measurements::of([
        ratio(DISPLACEMENT, displacement),
        ratio(RADIAL, radial),
        Quantity::balance(RESIDUAL, run.residual, "1"),
    ])
    .drawn(curve))
}
