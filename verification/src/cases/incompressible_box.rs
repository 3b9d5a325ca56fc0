//! Does a nearly incompressible box under a surface load settle as the exact solution of the box says, and by how much does it
//! lock without means over cells?
//!
//! Source: the box of `boussinesq` with a patch load and nu = 0.4999, where waves of pressure are 41 times as fast as
//! sqrt(E/rho) and every particle asks for a volume that stays. With the volumetric strain of each particle (`locked`) a cell
//! has eight such conditions, more than nodes can meet; with their mean over cells
//! (`VolumetricStrain::CellAverage`) it has one.
//!
//! Expected: order 2 as at nu = 0.25, for every scheme; a locked box settles too little.
//! `proctor verify incompressible-box`.

use super::boussinesq::compare::{Comparison, LEFT_OUT};
use super::boussinesq::model::{self, Loading, QUARTER_LOAD, SIDE, YOUNG};
use super::prelude::*;

const POISSON: f64 = 0.4999; // Poisson's ratio
const DENSITY: f64 = 1500.0; // Density [kg/m³]; it sets a time, not a rest
/// Variants with means over cells, and their schemes.
const AVERAGED: [(&str, StressScheme); 3] = [
    ("usl", StressScheme::Usl),
    ("usf", StressScheme::Usf),
    ("musl", StressScheme::Musl),
];
const LOCKED: &str = "locked"; // With the strain of each particle, by USL
/// Name of the mean settlement of the uppermost cells under the load among the quantities.
const SETTLEMENT: &str = "u_z under the load";
const CENTRE: &str = "u_z at (.5,.5,.5)"; // Name of the settlement at the centre of the box
const SHARE: &str = "settlement over the exact one"; // Name of the settlement over the exact one
const L2: &str = "L2(u), r >= 0.2 m"; // Name of the L2 error outside the ball
const RESIDUAL: &str = "residual"; // Name of the static residual
const REST: f64 = 1e-5; // Unbalanced force over load at which a box is at rest
const MOST_STEPS: u64 = 100_000; // Most steps: several times what h = 1/16 takes
/// Angular frequency \[1/s\] of the slowest wave of shear, over sqrt(E/rho)/L: half a wave across the quarter box and one
/// down, (pi²/0.25 + pi²)^(1/2) sqrt(G/E).
const SLOWEST: f64 = 4.0;

const WRONG_POISSON: Wrong =
    Wrong::value("Poisson's ratio", POISSON, 0.28).breaks(|gate| gate.contains("error of u_z"));

/// The nearly incompressible box.
pub static INCOMPRESSIBLE_BOX: Case = Case::new("incompressible-box", "Does a nearly incompressible box settle as its exact solution says, and how much does it lock without means over cells?")
    .ladder(Ladder::made(rungs))
    .method(method)
    .scene(scene)
    .displacements()
.residual()
    .compare_after(settle, compare)
    .gates_of_variants(&[
    error(SETTLEMENT)
        .at_most_of(
            [0.2, 0.05],
            [
                "four times the bound at h = 1/16, as order 2 allows at 1/8",
                "within 5 % of the exact box at h = 1/16",
            ],
        )
        .named("error of {quantity} on the finest mesh")
        .on(|rung| rung.variant != LOCKED),
    order(L2)
        .at_least(1.7, "order 2 as at nu = 0.25; 0.3 is left for meshes that are not yet fine")
        .full_alone()
        .on(|rung| rung.variant != LOCKED),
    value(SHARE)
        .at_most(0.9, "a box that did not lock without means over cells would prove nothing of them")
        .named("{quantity} with the strain of each particle")
        .of(LOCKED),
])
.tables(&[
    TableRule::new("incompressible-box, {variant}, means over cells", &[SETTLEMENT, CENTRE, L2])
        .of(|variant| variant != LOCKED),
    TableRule::new("incompressible-box, {variant}", &[SETTLEMENT, CENTRE, L2])
        .of(|variant| variant == LOCKED),
])
    .wrong_references(&[WRONG_POISSON])
    .no_study("*boussinesq* is the same box; here a relaxation takes minutes, and means over cells are no setting of a study")
        .no_guest("without means of volumetric strain over cells, which the manuals do not know, it locks");

fn rungs(size: Size) -> Vec<Rung> {
    let counts: &[u32] = size.pick(&[8], &[8, 16]);
    let variants = AVERAGED.iter().map(|(variant, _)| *variant).chain([LOCKED]);
    variants
        .flat_map(|variant| Rung::counted(variant, &format!("{variant} L/h"), SIDE, counts))
        .collect()
}

fn method(rung: &Rung) -> Settings {
    let scheme = AVERAGED
        .iter()
        .find(|(variant, _)| *variant == rung.variant);
    Settings::new(
        Method::DEFAULT.with_scheme(scheme.map_or(Method::DEFAULT.scheme, |(_, scheme)| *scheme)),
    )
}

fn scene(rung: &Rung, settings: &Settings) -> Scene {
    let mut scene = model::scene(rung.cell, Loading::Patch);
    scene.name = String::from("incompressible-box");
    scene.materials = elastic(DENSITY, YOUNG, POISSON);
    if rung.variant != LOCKED {
        scene.volumetric_strain = VolumetricStrain::CellAverage;
    }
    // Waves of pressure are 70 times as fast as those of shear. Each peak of theirs would stop the slow motion, which a
    // steady damping lets go on: critical for the slowest wave, 2 omega m v.
    scene.damping = Damping::Viscous {
        alpha: 2.0 * SLOWEST * rung.cell / SIDE,
    };
    settings.apply(&mut scene);
    scene.time_step = settings.multiplier();
    scene
}

fn settle(run: &mut Run<'_>) -> Result<(), Failure> {
    run.residual = relax(run.simulation, QUARTER_LOAD, REST, MOST_STEPS, run.observer)?;
    Ok(())
}

fn compare(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let exact = model::exact(Loading::Patch, run.reference.of(&WRONG_POISSON))?;
    let comparison =
        Comparison::new(run.simulation, &exact).ok_or("the simulation kept no displacements")?;
    let (computed, reference) = comparison.settlement_under_patch();
    let (in_centre, exact_in_centre) = comparison.settlement_around([0.5; 3]);
    let quantities = vec![
        Quantity::compared(SETTLEMENT, computed, reference, "m"),
        Quantity::compared(CENTRE, in_centre, exact_in_centre, "m"),
        Quantity::figure(SHARE, computed / reference, "1"),
        ratio(L2, comparison.l2_outside(LEFT_OUT)),
        Quantity::balance(RESIDUAL, run.residual, "1"),
    ];
    Ok(Measurements::of(quantities))
}
