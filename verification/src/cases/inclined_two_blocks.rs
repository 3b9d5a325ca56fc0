//! Do two blocks on one incline slide each with its own friction, and lift off when gravity is reversed?
//!
//! Source: contact manual, section 2.2: blocks of 5 m x 5 m with mu = 0.2 and, in front of it, mu = 0 on one base, in
//! the frame of the incline. As in `inclined-block` the base is held and the blocks have settled when they are released;
//! the mesh is longer than the manual's, whose wall the block in front reaches. Two pairs share a master.
//!
//! *Lift-off*: after settling, gravity normal to the base is reversed. The blocks spring off with the strain of their
//! weight; contact must not hold them, and once they are off they fall freely.
//!
//! `precision` studies the block that rubs, in two dimensions. `proctor verify inclined-two-blocks`.

use super::prelude::*;
use super::vocabulary::incline::{
    Block, COURANT, GRAVITY, Incline, Track, fitted_slope, follow, shear_wave_speed,
};
use crate::exact::sliding::Slope;

const TIME: f64 = 2.0; // Time from the release to the end [s]
const TIME_LIFTED: f64 = 1.0; // The same after gravity is reversed: they rise by 3.5 m
/// Time after the release from which on lifted blocks must be free: two periods of their vertical motion \[s\].
const FREE_FROM: f64 = 0.2;
const HEIGHT: f64 = 5.0; // Height of the blocks [m]
/// The blocks of the manual, the one behind first.
const BLOCKS: [Block; 2] = [
    Block {
        along: [2.0, 7.0],
        friction: 0.2,
    },
    Block {
        along: [12.0, 17.0],
        friction: 0.0,
    },
];

/// Names of the displacements among the quantities.
const WAYS: [&str; 2] = ["displacement, mu = 0.2", "displacement, mu = 0"];
/// Name of the displacement of the block that rubs against that of an elastic block, to which it converges.
const ELASTIC: &str = "displacement, mu = 0.2, elastic";
/// Names of the fitted accelerations.
const ACCELERATIONS: [&str; 2] = ["acceleration, mu = 0.2", "acceleration, mu = 0"];
/// Names of the accelerations out of the incline after lift-off.
const LIFTS: [&str; 2] = ["lift, mu = 0.2", "lift, mu = 0"];
/// Name of the largest force once the blocks are free.
const HELD: &str = "largest force when free, over weight";
const PULL: &str = "largest pull, over weight"; // Name of the largest pull

/// Gravity is added step by step.
const FREE: &str = "a free body has the acceleration of gravity";
const PROMISED: &str = "the project promises half a percent";
const WRONG_PULL: Wrong =
    Wrong::factor("pull", 1.01).breaks_only(|gate| !gate.contains("over weight"));

/// Two blocks on an incline.
pub static INCLINED_TWO_BLOCKS: Case = Case::new("inclined-two-blocks", "Do two blocks on one incline slide each with its own friction, and lift off when gravity is reversed?")
    .ladder(Ladder::made(rungs))
    .method(|rung| Settings::new(Method::DEFAULT.with_scheme(variant(rung).1)).courant(COURANT))
    .scene_by(scene)
    .options(|rung, reference, options| incline(reference, rung).options(options))
    .run(compare)
    .gates_of_rungs(&[
    error(PULL).at_most(1e-9, "contact never pulls; round-off is left"),
    error(HELD).at_most(0.0, "bodies that have parted feel no force").on(parts),
    error(LIFTS[0]).at_most(1e-9, FREE).on(parts),
    error(LIFTS[1]).at_most(1e-9, FREE).on(parts),
    error(WAYS[0]).at_most(5e-3, PROMISED).on(slides),
    error(WAYS[1]).at_most(5e-3, PROMISED).on(slides),
    error(ACCELERATIONS[0]).at_most(5e-3, PROMISED).on(slides),
    error(ACCELERATIONS[1]).at_most(5e-3, PROMISED).on(slides),
])
    .wrong_references(&[WRONG_PULL])
    .studies(&[Plan::new(Ladder::sizes(&[("2D USL", &[1.0, 0.5])], &[("2D USL", &[1.0, 0.5, 0.25])]), &[
        Measure::new("displacement", ELASTIC),
        Measure::new("acceleration", ACCELERATIONS[0]),
    ], 2).trying(few)])
    .guest(released);

/// A scene file has one gravity and one friction for all of a run, so the blocks are released at once. Judged by the block that
/// rubs, as an elastic one.
fn released(rung: &Rung) -> Result<Guest, &'static str> {
    let incline = Incline {
        held: false,
        ..incline(Reference::CORRECT, rung)
    };
    let mut scene = incline.scene("inclined_two_blocks", TIME);
    guest::settings().apply(&mut scene);
    scene.mesh.planes[1][0] = PlaneCondition::Fixed;
    let material = &scene.materials[0];
    let step = guest::COURANT * rung.cell / material.law.wave_speed(material.density);
    let scene = guest::prepared(guest::slab(scene), 1, step);
    let (slope, speed) = (exact(&BLOCKS[0]), shear_wave_speed());
    let slid = move |_: &Vector, t| [slope.elastic_displacement(t, HEIGHT, speed), 0.0, 0.0];
    let (base, [from, to]) = (incline.base, BLOCKS[0].along);
    Ok(Guest {
        norm: Norm::Mean(0),
        counts: Box::new(move |x| x[1] > base && x[0] > from && x[0] < to),
        ..Guest::new(scene, slid).at_the_end()
    })
}

/// Variants by dimension, scheme and whether gravity is reversed.
const VARIANTS: [(&str, Dimension, StressScheme, bool); 12] = {
    use Dimension::{Three, Two};
    use StressScheme::{Musl, Usf, Usl};
    [
        ("2D USL", Two, Usl, false),
        ("2D USF", Two, Usf, false),
        ("2D MUSL", Two, Musl, false),
        ("3D USL", Three, Usl, false),
        ("3D USF", Three, Usf, false),
        ("3D MUSL", Three, Musl, false),
        ("lift-off 2D USL", Two, Usl, true),
        ("lift-off 2D USF", Two, Usf, true),
        ("lift-off 2D MUSL", Two, Musl, true),
        ("lift-off 3D USL", Three, Usl, true),
        ("lift-off 3D USF", Three, Usf, true),
        ("lift-off 3D MUSL", Three, Musl, true),
    ]
};

/// Dimension, scheme and whether gravity is reversed, of a rung.
fn variant(rung: &Rung) -> (Dimension, StressScheme, bool) {
    let found = VARIANTS.iter().find(|v| v.0 == rung.variant);
    let &(_, dimension, scheme, lifts) = found.unwrap_or(&VARIANTS[0]);
    (dimension, scheme, lifts)
}

fn incline(reference: Reference, rung: &Rung) -> Incline {
    let (dimension, _, lifts) = variant(rung);
    let (h, pull) = (rung.cell, reference.of(&WRONG_PULL) * GRAVITY);
    Incline {
        dimension,
        cell: h,
        length: 34.0,
        base: 2.0 * h,
        height: HEIGHT,
        air: if lifts { 6.0 } else { 2.0 * h },
        blocks: BLOCKS.to_vec(),
        gravity: [pull, if lifts { -pull } else { GRAVITY }],
        held: true,
        damping: None,
        tilting: None,
    }
}

/// The exact motion of a block.
fn exact(block: &Block) -> Slope {
    Slope {
        along: GRAVITY,
        into: GRAVITY,
        friction: block.friction,
    }
}

/// Way and acceleration of the blocks that slide.
fn slid(tracks: &[Track]) -> Vec<Quantity> {
    let mut all = vec![];
    for (i, (block, track)) in BLOCKS.iter().zip(tracks).enumerate() {
        let exact = exact(block);
        let (end, way) = (track.way.last().map_or(f64::NAN, |w| w[0]), track.end());
        all.push(Quantity::compared(
            WAYS[i],
            way,
            exact.displacement(end),
            "m",
        ));
        if i == 0 {
            let elastic = exact.elastic_displacement(end, HEIGHT, shear_wave_speed());
            all.push(Quantity::compared(ELASTIC, way, elastic, "m"));
        }
        let (found, exact) = (fitted_slope(&track.velocity), exact.acceleration());
        all.push(Quantity::compared(ACCELERATIONS[i], found, exact, "m/s²"));
    }
    all
}

/// Accelerations of the blocks that have lifted off.
fn lifted(tracks: &[Track]) -> Vec<Quantity> {
    let lift = |(name, track): (&'static str, &Track)| {
        let free = track.out.iter().copied().filter(|v| v[0] > FREE_FROM);
        let found = fitted_slope(&free.collect::<Vec<_>>());
        Quantity::compared(name, found, GRAVITY, "m/s²")
    };
    LIFTS.into_iter().zip(tracks).map(lift).collect()
}

fn quantities(tracks: &[Track], lifts: bool) -> Vec<Quantity> {
    let mut all = if lifts { lifted(tracks) } else { slid(tracks) };
    let largest = |forces: &mut dyn Iterator<Item = f64>| forces.fold(0.0, f64::max);
    let over_weight = |name, force: &dyn Fn(&Track) -> f64| {
        let mut shares = tracks.iter().map(|track| force(track) / track.weight);
        Quantity::of_zero(name, largest(&mut shares))
    };
    all.push(over_weight(PULL, &|t| {
        largest(&mut t.force.iter().map(|f| -f))
    }));
    if lifts {
        all.push(over_weight(HELD, &|t| {
            let late = t.force.iter().zip(&t.out).filter(|(_, v)| v[0] > FREE_FROM);
            largest(&mut late.map(|(f, _)| f.abs()))
        }));
    }
    all
}

fn rungs(size: Size) -> Vec<Rung> {
    let whole = [
        (Dimension::Two, 1.0),
        (Dimension::Two, 0.5),
        (Dimension::Three, 1.0),
    ];
    let cells = size.pick(&whole[..1], &whole);
    let of = |&(dimension, cell): &(Dimension, f64)| {
        let own = VARIANTS.into_iter().filter(move |v| v.1 == dimension);
        own.map(move |v| Rung::new(v.0, cell))
    };
    cells.iter().flat_map(of).collect()
}

fn parts(rung: &Rung) -> bool {
    variant(rung).2
}

fn slides(rung: &Rung) -> bool {
    !parts(rung)
}

fn scene(rung: &Rung, settings: &Settings, reference: Reference) -> Scene {
    let (_, _, lifts) = variant(rung);
    let time = if lifts { TIME_LIFTED } else { TIME };
    let mut scene = incline(reference, rung).scene("inclined_two_blocks", time);
    scene.time_step = settings.multiplier();
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let incline = incline(run.reference, run.rung);
    incline.release(run.simulation, run.observer)?;
    let tracks = follow(&incline, run.simulation, run.observer)?;
    Ok(Measurements::of(quantities(&tracks, variant(run.rung).2)))
}
