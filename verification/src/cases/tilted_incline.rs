//! Does a block slide on a plane of triangles, tilted against the mesh, as Coulomb's law says, and stick where it
//! should?
//!
//! The plane falls at 30 degrees, given as an STL text; gravity is vertical. In the ladder of plane strain the mesh is
//! one cell wide between sliding planes and the plane falls along x; *turned*, it falls at 33 degrees to x and nothing
//! is aligned with the mesh.
//!
//! A block of 2 m x 0.5 m is held by a rough plane, settles under its weight with local damping, and is *released*:
//! damping ends and friction becomes mu. From then on every part of the base slips at once and the acceleration of the
//! centre of mass is g sin - mu g cos whatever the mesh. A block that settles without friction and is then pulled
//! downhill is off by what the elastic block gains while its base still sticks, 1.1 % at mu = 0.5 with 100 MPa; it is
//! run for the record.
//!
//! An elastic block without any damping does not slide so: its modes couple through friction, which follows the normal
//! force, and grow until it bounces and parts of it slip backwards (Martins et al. 1999). That is the block's own motion.
//! Without friction it stays quiet. Finite elements of a block do the same ([`crate::exact::elastic_block`]). So the block is
//! stiff (1 GPa), which shortens the time in which it swings faster than it slides, and FLIP has a share of PIC, which
//! takes the motion out of it and leaves that of the centre of mass alone. Without that share it is off by 1.3 to 1.9 %
//! at mu = 0.5 and h = 0.125 m. `proctor verify tilted-incline`.

mod frame;

use super::prelude::*;
use super::vocabulary::incline::{
    ACCELERATION, COURANT, CREEP, Track, WAY, acceleration, dot, follow_along, sliding_curve, stuck,
};
use crate::exact::sliding::Slope;
use frame::Frame;

const TILT: f64 = 30.0; // Angle of the plane with the horizontal [degrees]
const GRAVITY: f64 = 10.0; // Acceleration of gravity [m/s²]
/// Length of the block down the plane and its height \[m\].
const LENGTH: f64 = 2.0;
const HEIGHT: f64 = 0.5;
const TIME: f64 = 2.0; // Time from the release to the end [s]
/// Density \[kg/m³\] and Poisson's ratio.
const DENSITY: f64 = 2500.0;
const POISSON: f64 = 0.3;
const STIFF: f64 = 1e9; // Young's modulus of the full ladder [Pa]
const SOFT: f64 = 20e6; // Young's modulus of the quick one [Pa], in a seventh of the steps
/// Local damping before the release, and for how many periods of the block's shear.
const DAMPING: f64 = 0.6;
const PERIODS: f64 = 8.0;
const PIC: f64 = 0.05; // Share of PIC in FLIP
const ROUGH: f64 = 10.0; // Friction that holds the block before the release
const STICKING: f64 = 0.7; // Friction of a block that sticks, 1.2 tan(30 degrees)
/// The same close to the limit, 1.04 tan(30 degrees), and the local damping that keeps it from fluttering.
const CLOSE: f64 = 0.6;
const CLOSE_DAMPING: f64 = 0.1;
/// Friction of the study, and of the block that is pulled from rest for the record.
const STUDIED: f64 = 0.5;

const DEPTH: &str = "deepest penetration over cell"; // Name of the deepest penetration

/// Name of the way across the fall of the plane over the way down it.
const SIDEWAYS: &str = "way sideways over way";

const PROMISED: &str = "the project promises one percent for every friction";
const WRONG_PULL: Wrong = Wrong::factor("pull", 1.02)
    .breaks_only(|gate| {
        gate.starts_with("USL")
            && (gate.contains("mu=0 soft:") || gate.contains("mu=0.5 soft:"))
            && !gate.contains("penetration")
    })
    .on(|rung| rung.variant == "USL");

/// The block on a tilted plane.
pub static TILTED_INCLINE: Case = Case::new("tilted-incline", "Does a block slide on an STL plane tilted against the mesh as Coulomb's law says, and stick where it should?")
    .ladder(Ladder::made(rungs))
    .method(|rung| Settings::new(Method::DEFAULT.with_scheme(rung.problem::<Problem>().scheme)).courant(COURANT))
    .scene_by(scene)
    .options(options)
    .run(compare)
    .gates_of_rungs(&[
    error(ACCELERATION).at_most(1e-2, PROMISED).on(slides),
    error(WAY).at_most(1e-2, PROMISED).on(slides),
    error(SIDEWAYS)
        .at_most(
            2e-4,
            "nothing pushes the block sideways; a mesh that is not aligned with it must not either",
        )
        .on(|rung| slides(rung) && rung.problem::<Problem>().turned),
    error(CREEP).at_most(1e-4, "a block that sticks does not creep").on(sticks),
    error(WAY).at_most(5e-3, "it shears, the free block slides 10 m").on(sticks),
    error(DEPTH)
        .at_most(
            0.05,
            "a bound on the step keeps particles out to a residue of the sweeps",
        )
        .on(|rung| slides(rung) || sticks(rung)),
])
.line_of_each(line)
    .wrong_references(&[WRONG_PULL])
    .studies(&[Plan::new(Ladder::made(path), &[
        Measure::new("displacement", WAY),
        Measure::new("acceleration", ACCELERATION),
    ], 2)])
    .guest(|rung| Ok(released_at_once(rung)));

/// A scene file has one friction for all of a run, so the block is released at once, and compared as an elastic one. Its rows are
/// parallel to the plane: each particle is a body of half a cell.
fn released_at_once(rung: &Rung) -> Guest {
    let problem = *rung.problem::<Problem>();
    let (h, frame) = (rung.cell, Frame::new(rung.cell, problem.turned));
    let settings = guest::settings();
    let mut scene = scene(rung, &settings, Reference::CORRECT);
    scene.time = TIME;
    let per_cell = settings.particles_per_cell;
    let half = 0.5 * h / per_cell as f64;
    let pieces = frame.seeds(h, per_cell).into_iter().enumerate();
    let pieces = pieces.map(|(i, seed)| {
        let [low, high] = [-half, half].map(|away| seed.position.map(|x| x + away));
        Body {
            particles_per_cell: [per_cell; 3],
            ..body(format!("piece {}", i + 1), i as i64 + 1, cuboid(low, high))
        }
    });
    scene.bodies = pieces.collect();
    let material = &scene.materials[0];
    let step = guest::COURANT * h / material.law.wave_speed(material.density);
    let (slope, speed) = (exact(&problem), shear_speed(problem.young));
    let down = frame.down;
    let slid = move |_: &Vector, t| {
        let way = slope.elastic_displacement(t, HEIGHT, speed);
        down.map(|along| along * way)
    };
    Guest {
        norm: Norm::Mean(0),
        ..Guest::new(guest::prepared(scene, 1, step), slid).at_the_end()
    }
}

/// Problem of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// The block slides, released from a rough plane.
    Slide,
    /// The block slides, pulled from rest.
    Pulled,
    /// The block slides without a share of PIC.
    Undamped,
    /// The block sticks, pulled from rest.
    Stick,
}

/// The problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Problem {
    kind: Kind,
    scheme: StressScheme,
    turned: bool,
    friction: f64,
    young: f64,
}

impl Problem {
    /// True if the block settles without friction and is pulled from rest.
    fn pulled_later(&self) -> bool {
        matches!(self.kind, Kind::Pulled | Kind::Stick)
    }

    /// Gravity down the plane while the block settles \[m/s²\].
    fn pull_before(&self) -> f64 {
        if self.pulled_later() {
            0.0
        } else {
            exact(self).along
        }
    }
}

/// Runs of a size: cell size (m), whether the plane is turned, and the frictions.
type Group = (f64, bool, &'static [f64]);

/// Variants by scheme and whether the plane is turned.
const VARIANTS: [(&str, StressScheme, bool); 6] = [
    ("USL", StressScheme::Usl, false),
    ("USF", StressScheme::Usf, false),
    ("MUSL", StressScheme::Musl, false),
    ("turned USL", StressScheme::Usl, true),
    ("turned USF", StressScheme::Usf, true),
    ("turned MUSL", StressScheme::Musl, true),
];

/// Speed of shear waves \[m/s\].
fn shear_speed(young: f64) -> f64 {
    s_wave_speed(young, POISSON, DENSITY)
}

/// All rungs of a size with their problems.
fn rungs(size: Size) -> Vec<Rung> {
    const ALL: &[f64] = &[0.0, 0.1, 0.2, 0.3, 0.4, STUDIED];
    // The friction closest to sticking is the hardest: it alone where a run takes long.
    const WHOLE: [Group; 3] = [
        (0.25, false, ALL),
        (0.125, false, &[STUDIED]),
        (0.25, true, &[STUDIED]),
    ];
    let (young, soft, groups): (f64, &str, &[Group]) = size.pick(
        (SOFT, " soft", &[(0.25, false, &[0.0, STUDIED])]),
        (STIFF, "", &WHOLE),
    );
    let mut all = vec![];
    for &(h, turned, frictions) in groups {
        for (variant, scheme, _) in VARIANTS.into_iter().filter(|v| v.2 == turned) {
            let mut add = |kind: Kind, friction: f64, word: &str| {
                let label = format!("{variant} h={h} mu={friction}{word}{soft}");
                let problem = Problem {
                    kind,
                    scheme,
                    turned,
                    friction,
                    young,
                };
                all.push(Rung::labelled(label, variant, h).with(problem));
            };
            for &friction in frictions {
                add(Kind::Slide, friction, "");
            }
            add(Kind::Stick, STICKING, "");
            if frictions == ALL {
                add(Kind::Stick, CLOSE, " damped");
                add(Kind::Pulled, STUDIED, " pulled from rest");
            } else if size == Size::Full && !turned {
                add(Kind::Undamped, STUDIED, " without PIC");
            }
        }
    }
    all
}

/// The path of the study with its problem.
fn path(size: Size) -> Vec<Rung> {
    let (young, cells): (f64, &[f64]) =
        size.pick((SOFT, &[0.5, 0.25]), (STIFF, &[0.5, 0.25, 0.125]));
    let (variant, scheme, turned) = VARIANTS[0];
    let problem = Problem {
        kind: Kind::Slide,
        scheme,
        turned,
        friction: STUDIED,
        young,
    };
    let label = |h: f64| format!("{variant} h={h} mu={STUDIED} E={young:e}");
    let rung = |&h: &f64| Rung::labelled(label(h), variant, h).with(problem);
    cells.iter().map(rung).collect()
}

/// The exact motion.
fn exact(problem: &Problem) -> Slope {
    let tilt = TILT.to_radians();
    Slope {
        along: GRAVITY * libm::sin(tilt),
        into: GRAVITY * libm::cos(tilt),
        friction: problem.friction,
    }
}

/// Settles the block on the plane and releases it.
fn release(
    frame: &Frame,
    problem: &Problem,
    simulation: &mut Simulation,
    observer: &mut dyn Observer,
) -> Result<(), Failure> {
    // As it is to be from the release on.
    let scene = simulation.scene().clone();
    let (slope, along) = (exact(problem), problem.pull_before());
    let held = std::array::from_fn(|axis| along * frame.down[axis] - slope.into * frame.out[axis]);
    simulation.set_gravity(held)?;
    simulation.set_surface_friction(0, if problem.pulled_later() { 0.0 } else { ROUGH })?;
    simulation.set_local_damping(Some(DAMPING))?;
    run_until(simulation, scene.time - TIME, observer, |_| ())?;
    let after = (problem.friction == CLOSE).then_some(CLOSE_DAMPING);
    simulation.set_local_damping(after)?;
    simulation.set_gravity(scene.gravity)?;
    simulation.set_surface_friction(0, problem.friction)?;
    Ok(())
}

fn quantities(track: &Track, deepest: f64, sideways: f64, problem: &Problem) -> Vec<Quantity> {
    let exact = exact(problem);
    let end = track.way.last().map_or(f64::NAN, |w| w[0]);
    let mut all = vec![Quantity::of_zero(DEPTH, deepest)];
    if problem.kind == Kind::Stick {
        all.extend(stuck(track, track.end(), &exact, TIME));
    } else {
        // A block that is pulled from rest is compared with the elastic one.
        let way = if problem.kind == Kind::Pulled {
            exact.elastic_displacement(end, HEIGHT, shear_speed(problem.young))
        } else {
            exact.displacement(end)
        };
        all.push(Quantity::compared(WAY, track.end(), way, "m"));
        all.push(acceleration(track, &exact));
        if problem.turned {
            all.push(Quantity::of_zero(SIDEWAYS, sideways / track.end()));
        }
    }
    all
}

fn slides(rung: &Rung) -> bool {
    rung.problem::<Problem>().kind == Kind::Slide
}

fn sticks(rung: &Rung) -> bool {
    rung.problem::<Problem>().kind == Kind::Stick
}

/// Blocks that are pulled from rest, and those without a share of PIC.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    let rigid = exact(rung.problem()).displacement(TIME);
    let off = 100.0 * (run.value(WAY) / rigid - 1.0);
    let acceleration = 100.0 * run.error(ACCELERATION);
    (!slides(rung) && !sticks(rung)).then(|| {
        let of = "displacement off by";
        format!(
            "{}: {of} {off:+.2} % from a rigid block, acceleration by {acceleration:.2} %",
            rung.label
        )
    })
}

fn scene(rung: &Rung, settings: &Settings, reference: Reference) -> Scene {
    let problem = *rung.problem::<Problem>();
    let h = rung.cell;
    let frame = Frame::new(h, problem.turned);
    let mesh = Mesh::new(Dimension::Three, [0.0; 3], [h; 3], frame.cells);
    let settling = PERIODS * 4.0 * HEIGHT / shear_speed(problem.young);
    let mut scene = bare_scene("tilted_incline", Dimension::Three, mesh, settling + TIME);
    scene.gravity = [0.0, 0.0, -reference.of(&WRONG_PULL) * GRAVITY];
    scene.materials = elastic(DENSITY, problem.young, POISSON);
    let seeds = Arc::new(frame.seeds(h, settings.particles_per_cell));
    scene.bodies = vec![body("block", 1, Shape::Particles(seeds))];
    let plane = stl_surface("incline", frame.stl().as_bytes(), problem.friction, h);
    scene.surfaces.extend(plane);
    scene.time_step = settings.multiplier();
    settings.apply(&mut scene);
    if settings.method.transfer == TransferKind::Flip && problem.kind != Kind::Undamped {
        scene.transfer.pic_fraction = PIC;
    }
    scene
}

fn options(rung: &Rung, _: Reference, options: Options) -> Options {
    let problem = *rung.problem::<Problem>();
    let frame = Frame::new(rung.cell, problem.turned);
    let (slope, along) = (exact(&problem), problem.pull_before());
    let (down, out, foot) = (frame.down, frame.out, frame.corner);
    // The weight of what lies above, carried by the plane.
    starting(options, move |x| {
        let height = dot(&std::array::from_fn(|axis| x[axis] - foot[axis]), &out);
        let above = DENSITY * (HEIGHT - height);
        let component = |a: usize, b: usize| {
            above * (along * (down[a] * out[b] + out[a] * down[b]) - slope.into * out[a] * out[b])
        };
        let pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
        InitialState {
            stress: pairs.map(|(a, b)| component(a, b)),
            ..AT_REST
        }
    })
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let problem = *rung.problem::<Problem>();
    let (exact, frame) = (exact(&problem), Frame::new(rung.cell, problem.turned));
    release(&frame, &problem, simulation, observer)?;
    let mut deepest = 0.0_f64;
    let directions = [frame.down, frame.out];
    let aside = |simulation: &Simulation| dot(&simulation.center(0).position, &frame.across);
    let begin = aside(simulation);
    let tracks = follow_along(directions, &[0], exact.into, simulation, observer, |s| {
        if s.steps().is_multiple_of(50) {
            let gaps = (0..s.particles()).filter_map(|p| s.surface_gap(0, 0, p, 0.0));
            deepest = gaps.fold(deepest, |d, (gap, _)| d.max(-gap / rung.cell));
        }
    })?;
    let quantities = quantities(&tracks[0], deepest, aside(simulation) - begin, &problem);
    let curve = sliding_curve(&tracks[0], &exact, &rung.label);
    Ok(Measurements::of(quantities).drawn(curve))
}
