//! The footing as other solvers run it: a report of its load beside the exact one, read off the stresses of the ground.
//!
//! No scene of the manuals moves nodes at a surface. So the footing is a body without contact on the ground, to which it sticks:
//! stiff, and so heavy that it goes down with nearly the velocity that it is given at the start; the exact load would take a
//! tenth of it. Its load P, from the top of the ground at the height H, is carried down to the base. The integral of
//! div(sigma) y over the ground says that the integral of sigma_yy is -P H, whatever the field is within; what inertia adds is
//! the stress of a wave of that velocity, some per cent of the load at the start and nothing later. Nothing else has to be known
//! of a solver than `Stress_YY` of its particles, which have equal volumes. The mean is taken over the last tenth of the way.
//!
//! The strength is 1e-4 of Young's modulus, so that numbers of seven digits hold the strains. Solvers that do not take means
//! over cells lock, as *footing* does without them.

use super::{CLAY, SHARE, STRENGTH, WIDTH};
use crate::cases::prelude::*;

const YOUNG: f64 = 1e4; // Young's modulus [Pa]
const POISSON: f64 = 0.3; // The load depends on it no more than on Young's modulus
const DENSITY: f64 = 1.0; // Density of the ground [kg/m³]; it sets a time
/// Young's modulus of the footing over that of the ground; its waves are slower than those of the ground all the same.
const STIFF: f64 = 1e3;
const HEIGHT: f64 = 0.5; // Height of the footing [m]
/// Share of its velocity that the exact load takes from it.
const LOST: f64 = 0.1;
/// Way of the footing over that at which elastic ground carries the exact load, as in the case.
const TIMES: f64 = 4.0;
/// Time of the way, in which a wave of shear runs so many times over the width.
const CROSSED: f64 = 60.0;
/// Frames, and those at the end of which the mean is taken.
const FRAMES: usize = 40;
const LAST: usize = 4;

/// The path, B/h.
pub(super) static PATH: Plan = Plan::new(
    Ladder::variants(&["Tresca"], ", ", "B/h", WIDTH, [&[4, 8], &[4, 8, 16]]),
    &[Measure::new("load", SHARE)],
    2,
);

/// Ground, and a footing that is thrown down on it.
pub(super) fn pressed(rung: &Rung) -> Guest {
    let h = rung.cell;
    let exact = CLAY.ground().bearing();
    let [wide, deep] = CLAY.footing().extent();
    let mut mesh = strip(h, [cells(wide, h), cells(deep + HEIGHT, h)]);
    mesh.planes[1] = [PlaneCondition::Fixed, PlaneCondition::Free];
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let time = CROSSED * WIDTH / (shear / DENSITY).sqrt();
    let down = TIMES * exact * WIDTH * (1.0 - POISSON * POISSON) / YOUNG / time;
    let heavy = exact * time / (LOST * down) / HEIGHT;
    let mut scene = plane_scene("footing", mesh, time);
    let law = MohrCoulomb::new(YOUNG, POISSON, [0.0, STRENGTH, 0.0]);
    scene.materials = material("clay", DENSITY, law);
    let stiff = elastic(heavy, STIFF * YOUNG, POISSON).into_iter();
    scene
        .materials
        .extend(stiff.map(|stiff| Material { id: 2, ..stiff }));
    let mut footing = body(
        "footing",
        2,
        rectangle([0.0, deep], [0.5 * WIDTH, deep + HEIGHT]),
    );
    footing.material = 1;
    footing.velocity = [0.0, -down, 0.0];
    scene.bodies = vec![
        body("ground", 1, rectangle([0.0; 2], [wide, deep])),
        footing,
    ];
    scene.volumetric_strain = VolumetricStrain::CellAverage;
    guest::settings().apply(&mut scene);
    let speed = (2.0 * shear * (1.0 - POISSON) / (1.0 - 2.0 * POISSON) / DENSITY).sqrt();
    let step = guest::COURANT * h / speed;
    let mut scene = guest::prepared(guest::slab(scene), FRAMES, step);
    scene.results.fields.push(Field::Stress);
    // The volume of the ground over its height, and half of the footing, of a slab one metre thick.
    let lever = wide / (0.5 * WIDTH);
    let load = move |frames: &[Snapshot]| {
        let last = &frames[frames.len().saturating_sub(LAST)..];
        let of_ground = || {
            let particles = last.iter().flat_map(|f| f.starts.iter().zip(&f.values));
            particles.filter(|(start, _)| start[1] < deep)
        };
        let sum: f64 = of_ground().map(|(_, stress)| stress[1]).sum();
        -sum / of_ground().count() as f64 * lever / exact
    };
    let source = "Prandtl 1920, 2 + pi times the strength";
    Guest {
        compared: ComparedField::Stress,
        reading: Some(Reading::new(SHARE, 1.0, source, load)),
        ..Guest::new(scene, |_, _| [0.0; 3])
    }
}
