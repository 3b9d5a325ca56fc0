//! Does a block slide down an incline with the acceleration that Coulomb's law gives, and stick where it should?
//!
//! Source: contact manual, section 2.1. The frame is that of the incline: gravity is
//! 7.07 m/s² along x and into the base, 45 degrees.
//!
//! The *settled* scene is judged: a block of 10 m x 2 m on a held base is relaxed under the gravity normal to it, then
//! released. It is flatter than the manual's cube, whose rear edge lifts for mu > b/3H = 1/3. The block keeps its weight on the
//! base from the first step on, so the acceleration of its centre of mass is g_x - mu g_n whatever the mesh. Its displacement
//! is that of a rigid block but for the time in which the base still sticks, H/c_s: 0.4 % for mu = 0.5. The study compares with
//! the elastic block, to which the displacement converges.
//!
//! It *sticks* for mu >= tan(theta) = 1: its creep velocity falls to zero. A rigid block does so however it is let go; an
//! elastic one swings when it is released at once, and asks for twice the friction at the turn. So it is tilted slowly
//! with mu = 1.2, and released at once with mu = 2.5; a little local damping lets the swing end. Released at once with
//! mu = 1.2 it walks: it slides at the turn, and an elastic body that slides with a friction near 1 and more
//! flutters, lifts and slides on (Martins, Guimaraes and Faria 1995; Adams 1995). Finite elements of the same block
//! (`exact::elastic_block`) do the same; both stand in the record.
//!
//! The scene as *printed* is run for the record. Its gravity is switched on at once: the force on the base swings
//! between nothing and twice the weight (period 4H/c = 0.2 s), and the base is free between its rollers and swings
//! along the incline itself. `proctor verify inclined-block`.

mod judge;

use super::prelude::*;
use super::vocabulary::incline::{
    ACCELERATION, Block, COURANT, CREEP, DENSITY, GRAVITY, Incline, POISSON, WAY, YOUNG,
    acceleration, follow, shear_wave_speed, sliding_curve, stuck,
};
use crate::exact::elastic_block::{ElasticBlock, Release, Slid};
use crate::exact::sliding::Slope;

const TIME: f64 = 2.0; // Time from the release to the end [s]
/// Range of the block along the incline at the start \[m\].
const ALONG: [f64; 2] = [2.0, 12.0];
const LENGTH: f64 = 28.0; // Length of the base [m]: the way without friction is 14.14 m
const HEIGHT: f64 = 2.0; // Height of the settled block [m]
/// Coefficients of friction of the manual.
const FRICTIONS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
/// Coefficient of a block that sticks where it is tilted slowly; tan(theta) = 1.
const STICKING: f64 = 1.2;
/// Coefficient of a block that sticks where it is released at once.
const STICKING_AT_ONCE: f64 = 2.5;
/// Time over which a block that is to stick is tilted: 15 periods of its shear \[s\].
const TILTING: f64 = 1.0;
const STUDIED: f64 = 0.3; // Friction of the study
const STICKING_DAMPING: f64 = 0.1; // Local damping of a block that is to stick
/// Name of the displacement against that of an elastic block.
const ELASTIC: &str = "displacement at 2 s, elastic";
const WRONG_PULL: Wrong =
    Wrong::factor("pull", 1.01).breaks_only(|gate| !gate.starts_with("stick"));

/// The block on an incline.
pub static INCLINED_BLOCK: Case = Case::new(
    "inclined-block",
    "Does a block slide down an incline as Coulomb's law says, and stick where it should?",
)
.ladder(Ladder::made(rungs))
.method(|rung| {
    Settings::new(Method::DEFAULT.with_scheme(rung.problem::<Problem>().scheme)).courant(COURANT)
})
.scene_by(scene)
.options(|rung, reference, options| incline(reference, rung).options(options))
.run(compare)
.judge_by(judge::verdict)
.wrong_references(&[WRONG_PULL])
.studies(&[Plan::new(
    Ladder::made(path),
    &[
        Measure::new("displacement", ELASTIC),
        Measure::new("acceleration", ACCELERATION),
    ],
    2,
)])
.guest(guest);

/// Problem of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The settled block slides.
    Settled,
    /// The block sticks, tilted slowly.
    Stick,
    /// The block sticks, tilted the other way.
    StickMirrored,
    /// The block sticks, released at once.
    StickAtOnce,
    /// Released at once with a friction at which it walks, with damping and without.
    Walk(Option<f64>),
    /// The block slides as in the manual.
    Printed,
}

/// The problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Problem {
    kind: Kind,
    dimension: Dimension,
    scheme: StressScheme,
    friction: f64,
}

/// Variants of sliding and of sticking, by dimension and scheme.
const VARIANTS: [(Dimension, StressScheme, [&str; 2]); 6] = {
    use Dimension::{Three, Two};
    use StressScheme::{Musl, Usf, Usl};
    [
        (Two, Usl, ["2D USL", "stick 2D USL"]),
        (Two, Usf, ["2D USF", "stick 2D USF"]),
        (Two, Musl, ["2D MUSL", "stick 2D MUSL"]),
        (Three, Usl, ["3D USL", "stick 3D USL"]),
        (Three, Usf, ["3D USF", "stick 3D USF"]),
        (Three, Musl, ["3D MUSL", "stick 3D MUSL"]),
    ]
};
const PRINTED: &str = "printed"; // The variant of the manual's own scene

/// All rungs of a size with their problems.
fn rungs(size: Size) -> Vec<Rung> {
    let mut all = vec![];
    let whole = [
        (Dimension::Two, 1.0),
        (Dimension::Two, 0.5),
        (Dimension::Three, 1.0),
    ];
    let cells = size.pick(&whole[..1], &whole);
    for &(dimension, cell) in cells {
        for (_, scheme, [slides, sticks]) in VARIANTS.into_iter().filter(|v| v.0 == dimension) {
            let problem = |kind, friction| Problem {
                kind,
                dimension,
                scheme,
                friction,
            };
            all.extend(FRICTIONS.map(|friction| {
                rung(slides, cell, friction, "").with(problem(Kind::Settled, friction))
            }));
            for (kind, friction, how) in [
                (Kind::Stick, STICKING, " tilted"),
                (Kind::StickMirrored, STICKING, " tilted, mirrored"),
                (Kind::StickAtOnce, STICKING_AT_ONCE, " at once"),
                (Kind::Walk(Some(STICKING_DAMPING)), STICKING, " at once"),
                (Kind::Walk(None), STICKING, " at once, undamped"),
            ] {
                all.push(rung(sticks, cell, friction, how).with(problem(kind, friction)));
            }
        }
    }
    if size == Size::Full {
        all.extend(FRICTIONS.map(|friction| {
            let problem = Problem {
                kind: Kind::Printed,
                dimension: Dimension::Three,
                scheme: StressScheme::Usl,
                friction,
            };
            rung(PRINTED, 1.0, friction, "").with(problem)
        }));
    }
    all
}

fn rung(variant: &'static str, cell: f64, friction: f64, how: &str) -> Rung {
    let label = format!("{variant} h={cell} mu={friction}{how}");
    Rung::labelled(label, variant, cell)
}

/// The path of the study with its problem.
fn path(size: Size) -> Vec<Rung> {
    let cells: &[f64] = size.pick(&[1.0, 0.5], &[1.0, 0.5, 0.25, 0.125]);
    let problem = Problem {
        kind: Kind::Settled,
        dimension: Dimension::Two,
        scheme: StressScheme::Usl,
        friction: STUDIED,
    };
    let rung = |&cell: &f64| rung(VARIANTS[0].2[0], cell, STUDIED, "").with(problem);
    cells.iter().map(rung).collect()
}

fn incline(reference: Reference, rung: &Rung) -> Incline {
    let problem = *rung.problem::<Problem>();
    let h = rung.cell;
    let mirrored = problem.kind == Kind::StickMirrored;
    let sign = if mirrored { -1.0 } else { 1.0 };
    let settled = Incline {
        dimension: problem.dimension,
        cell: h,
        length: LENGTH,
        base: 2.0 * h,
        height: HEIGHT,
        air: 2.0 * h,
        blocks: vec![Block {
            along: ALONG,
            friction: problem.friction,
        }],
        gravity: [sign * reference.of(&WRONG_PULL) * GRAVITY, GRAVITY],
        held: true,
        damping: match problem.kind {
            Kind::Stick | Kind::StickMirrored | Kind::StickAtOnce => Some(STICKING_DAMPING),
            Kind::Walk(damping) => damping,
            Kind::Settled | Kind::Printed => None,
        },
        tilting: matches!(problem.kind, Kind::Stick | Kind::StickMirrored).then_some(TILTING),
    };
    match problem.kind {
        Kind::Printed => Incline {
            length: 32.0,
            height: 10.0,
            held: false,
            ..settled
        },
        _ => settled,
    }
}

/// The exact motion.
fn exact(problem: &Problem) -> Slope {
    Slope {
        along: GRAVITY,
        into: GRAVITY,
        friction: problem.friction,
    }
}

/// Creep of a flat block in finite elements of the same size.
fn by_elements(rung: &Rung, problem: &Problem) -> Option<Slid> {
    let (Kind::Walk(damping), Dimension::Two) = (problem.kind, problem.dimension) else {
        return None;
    };
    let elements = [ALONG[1] - ALONG[0], HEIGHT].map(|length| (length / rung.cell) as usize);
    let block = ElasticBlock {
        elements,
        edge: rung.cell,
        young: YOUNG,
        poisson: POISSON,
        density: DENSITY,
    };
    Some(block.slide(&Release {
        gravity: [GRAVITY; 2],
        friction: problem.friction,
        damping: damping.unwrap_or(0.0),
        tilting: 0.0,
        time: TIME,
    }))
}

fn scene(rung: &Rung, settings: &Settings, reference: Reference) -> Scene {
    let mut scene = incline(reference, rung).scene("inclined_block", TIME);
    scene.time_step = settings.multiplier();
    if rung.problem::<Problem>().kind == Kind::Printed {
        scene.mesh.planes[2][1] = PlaneCondition::Sliding;
        scene.time_step = TimeStep::Multiplier {
            multiplier: 0.15,
            allow_unstable: settings.allow_unstable,
        };
        scene.contact_distance = Some(0.5);
    }
    settings.apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let incline = incline(run.reference, rung);
    incline.release(simulation, observer)?;
    let tracks = follow(&incline, simulation, observer)?;
    let (track, exact) = (&tracks[0], exact(rung.problem()));
    let curve = sliding_curve(track, &exact, &rung.label);
    if exact.sticks() {
        // Since the block was laid down.
        let moved = simulation.center(1).position[0] - 0.5 * (ALONG[0] + ALONG[1]);
        return Ok(Measurements::of(stuck(track, moved, &exact, TIME)).drawn(curve));
    }
    let (end, way) = (track.way.last().map_or(f64::NAN, |w| w[0]), track.end());
    let elastic = exact.elastic_displacement(end, incline.height, shear_wave_speed());
    let quantities = [
        Quantity::compared(WAY, way, exact.displacement(end), "m"),
        Quantity::compared(ELASTIC, way, elastic, "m"),
        acceleration(track, &exact),
    ];
    Ok(Measurements::of(quantities).drawn(curve))
}

/// A scene file has one gravity for all of a run, so the block is released at once. It is so flat that the swing of its
/// weight is over in a hundredth of the time, and leaves the impulse of friction as it is but for the settlement.
fn guest(rung: &Rung) -> Result<Guest, &'static str> {
    let problem = *rung.problem::<Problem>();
    if (problem.kind, problem.dimension) != (Kind::Settled, Dimension::Two) {
        let why =
            "blocks that stick are judged by their creep, after a time in which gravity turns";
        return Err(why);
    }
    let incline = Incline {
        held: false,
        ..incline(Reference::CORRECT, rung)
    };
    let mut scene = incline.scene("inclined_block", TIME);
    guest::settings().apply(&mut scene);
    scene.mesh.planes[1][0] = PlaneCondition::Fixed;
    let speed = scene.materials[0].law.wave_speed(DENSITY);
    let step = guest::COURANT * rung.cell / speed;
    let scene = guest::prepared(guest::slab(scene), 1, step);
    let (exact, base) = (exact(&problem), incline.base);
    let slid = move |_: &Vector, t| [exact.displacement(t), 0.0, 0.0];
    Ok(Guest {
        norm: Norm::Mean(0),
        counts: Box::new(move |x| x[1] > base),
        ..Guest::new(scene, slid).at_the_end()
    })
}
