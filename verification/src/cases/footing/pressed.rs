//! The footing as other solvers run it: a report of its load beside the exact one, read off the stresses of all particles.
//!
//! No scene of the manuals moves nodes at a surface, but it moves the lower plane. So the footing stands, a block one cell high
//! below the fixed upper plane, and the ground is lifted against it, from rest to rest. At rest the stresses carry one load P from
//! the upper plane at the height H down to the base: the integral of div(sigma) z over all bodies says that the integral of
//! sigma_zz is -P H, whatever the field is within. Nothing else has to be known of a solver than `Stress_ZZ` of its particles,
//! which have equal volumes; the mean is taken over the last frames, in which the base goes 0.4 % of its way.
//!
//! The strength is 1e-4 of Young's modulus, so that numbers of seven digits hold the strains. Solvers that do not take means
//! over cells lock: the case itself finds 1.83 times the exact load at B/8 without them.

use super::{CLAY, Ground, SHARE, STRENGTH, WIDTH, smooth};
use crate::cases::prelude::*;

const YOUNG: f64 = 1e4; // Young's modulus [Pa]
const POISSON: f64 = 0.3; // The load depends on it no more than on Young's modulus
const DENSITY: f64 = 1.0; // Density [kg/m³]; it sets a time
/// Way of the base over that at which elastic ground carries the exact load, as in the case; one part strains the block.
const TIMES: f64 = 4.0;
/// Time of the way, in which a wave of shear runs so many times over the width.
const CROSSED: f64 = 60.0;
/// Intervals of the record of the base.
const INTERVALS: u32 = 400;
/// Frames, and those at the end of which the mean is taken.
const FRAMES: usize = 40;
const LAST: usize = 4;

/// The path, B/h.
pub(super) static PATH: Plan = Plan::new(
    Ladder::variants(&["Tresca"], ", ", "B/h", WIDTH, [&[4, 8], &[4, 8, 16]]),
    &[Measure::new("load", SHARE)],
    2,
);

/// Ground below a footing that stands, lifted by its base.
pub(super) fn pressed(rung: &Rung) -> Guest {
    let (h, ground) = (rung.cell, CLAY.ground());
    let [wide, deep] = CLAY.extent();
    let mut mesh = Mesh::new(
        Dimension::Three,
        [0.0; 3],
        [h; 3],
        [cells(wide, h), 1, cells(deep, h) + 1],
    );
    mesh.planes[2] = [PlaneCondition::Fixed; 2];
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let time = CROSSED * WIDTH / (shear / DENSITY).sqrt();
    let mut scene = bare_scene("footing", Dimension::Three, mesh, time);
    let law = MohrCoulomb::new(YOUNG, POISSON, [0.0, STRENGTH, 0.0]);
    scene.materials = material("clay", DENSITY, law);
    let block = elastic(DENSITY, YOUNG, POISSON);
    scene
        .materials
        .extend(block.into_iter().map(|block| Material { id: 2, ..block }));
    let mut footing = body(
        "footing",
        2,
        cuboid([0.0, 0.0, deep], [0.5 * WIDTH, h, deep + h]),
    );
    footing.material = 1;
    scene.bodies = vec![
        body("ground", 1, cuboid([0.0; 3], [wide, h, deep])),
        footing,
    ];
    scene.base_motion = Some(BaseMotion {
        axis: 2,
        side: 0,
        motion: Motion::Acceleration(lifted(way(&ground), time)),
    });
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    guest::settings().apply(&mut scene);
    let speed = (2.0 * shear * (1.0 - POISSON) / (1.0 - 2.0 * POISSON) / DENSITY).sqrt();
    let mut scene = guest::prepared(scene, FRAMES, guest::COURANT * h / speed);
    scene.results.fields.push(Field::Stress);
    // Volumes over the height and the area below the footing, both per metre along y.
    let lever = (wide * deep + 0.5 * WIDTH * h) / ((deep + h) * 0.5 * WIDTH);
    let exact = ground.bearing();
    let load = move |frames: &[Snapshot]| {
        let last = &frames[frames.len().saturating_sub(LAST)..];
        let stresses = || last.iter().flat_map(|frame| &frame.values);
        let sum: f64 = stresses().map(|stress| stress[2]).sum();
        -sum / stresses().count() as f64 * lever / exact
    };
    let source = "Prandtl 1920, 2 + pi times the strength";
    Guest {
        compared: ComparedField::Stress,
        reading: Some(Reading::new(SHARE, 1.0, source, load)),
        ..Guest::new(scene, |_, _| [0.0; 3])
    }
}

/// Distance that the base is lifted \[m\].
fn way(ground: &Ground) -> f64 {
    TIMES * ground.bearing() * WIDTH * (1.0 - POISSON * POISSON) / YOUNG
}

/// Acceleration of the base that goes a way in a time, from rest to rest: differences of its velocity, so that it ends at rest
/// where rows are joined by lines.
fn lifted(way: f64, time: f64) -> History {
    let interval = 1.0 / f64::from(INTERVALS);
    let rate = |i: u32| {
        let [before, after] =
            [-0.5, 0.5].map(|half| smooth((f64::from(i) + half) * interval)[1] * way / time);
        (after - before) / (interval * time)
    };
    let rows = 0..=INTERVALS;
    let mut times: Vec<f64> = rows
        .clone()
        .map(|i| f64::from(i) * interval * time)
        .collect();
    let mut values: Vec<Vector> = rows.map(|i| [0.0, 0.0, rate(i)]).collect();
    // Some programs stop where the record ends.
    times.push(2.0 * time);
    values.push([0.0; 3]);
    History { times, values }
}
