//! How far does a column come that is let go: of sand, and of water?
//!
//! Source: Lube et al. 2005 (Phys. Rev. E 72, 041301). A column of dry sand in plane strain, d wide and H high,
//! stands at a smooth wall on rough ground and loses its other wall at once. What experiments found depends on H/d alone:
//! the heap reaches 1.2 H/d widths farther up to 1.8, 1.9 (H/d)^(2/3) beyond 2.8, and is as high as the column up to 1.15,
//! (H/d)^0.4 widths beyond. That is an experiment, not an exact answer, and shown beside what comes out; judged are the books of
//! `run_out.rs`. *water*, twice as wide as high, is let go on smooth ground, and its front is shown beside that of Ritter,
//! 2 sqrt(gH) of the shallow water that it is not at first.
//!
//! Sand: Mohr and Coulomb, 30°, no cohesion, no dilation, at rest between its walls before. E is 200 times the stress at the
//! base, so that the column is strained by half a percent. `proctor verify collapse`.
//!
//! Other solvers run the column of H/d = 0.75 as a report: their run-out stands beside that of the experiments and has no bound.
//! No scene of the manuals has a stress at the start, so that theirs is let go before it is strained.

use super::prelude::*;
use super::vocabulary::run_out;

const WIDTH: f64 = 1.0; // Width of the columns of sand, d [m]
const GRAVITY: f64 = 9.81; // Gravity [m/s²]
/// Density of sand and of water \[kg/m³\].
const SAND: f64 = 1600.0;
const WATER_DENSITY: f64 = 1000.0;
/// Young's modulus over the stress at the base.
const STIFFNESS: f64 = 200.0;
const POISSON: f64 = 0.3;
const FRICTION: f64 = 30.0; // Angle of friction [°]
const SOUND: f64 = 10.0; // Speed of sound in water over that of falling, sqrt(2gH)
/// Time of a run over that of a fall, sqrt(H/g): sand comes to rest after 3.3.
const FALLS: f64 = 6.0;
const FALLS_OF_WATER: f64 = 2.0; // That of water, before the front reaches the end of the mesh

/// APIC, which does not ring where particles cross cells.
const METHOD: Method = Method::DEFAULT.with_transfer(TransferKind::Apic);

/// Run-out of the front beyond the column, over the width.
const BEYOND: &str = "run-out over width";
const PUBLISHED: &str = "published run-out over width"; // The same by experiment, or by Ritter
/// Height of the heap over the width, and that of experiments.
const HEIGHT: &str = "height over width";
const PUBLISHED_HEIGHT: &str = "published height over width";

/// Material that a rung lets go.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Column {
    variant: &'static str,
    /// Height over width.
    aspect: f64,
    /// Width \[m\].
    width: f64,
    is_water: bool,
    /// Cells over the width of a metre, on the short ladder and on the whole one.
    cells: [&'static [u32]; 2],
}

const fn sand(variant: &'static str, aspect: f64, cells: [&'static [u32]; 2]) -> Column {
    Column {
        variant,
        aspect,
        width: WIDTH,
        is_water: false,
        cells,
    }
}

const COLUMNS: [Column; 5] = [
    sand("H/d=0.75", 0.75, [&[8], &[16, 32]]),
    sand("H/d=1.5", 1.5, [&[8], &[16, 32]]),
    sand("H/d=3", 3.0, [&[6], &[12, 24]]),
    sand("H/d=6", 6.0, [&[4], &[8, 16]]),
    Column {
        width: 2.0,
        is_water: true,
        ..sand("water", 0.5, [&[8], &[16, 32]])
    },
];

impl Column {
    fn of(rung: &Rung) -> Self {
        let found = COLUMNS.into_iter().find(|c| c.variant == rung.variant);
        found.unwrap_or(COLUMNS[0])
    }

    /// Height \[m\].
    fn height(&self) -> f64 {
        self.aspect * self.width
    }

    fn time(&self) -> f64 {
        let falls = if self.is_water { FALLS_OF_WATER } else { FALLS };
        falls * (self.height() / GRAVITY).sqrt()
    }

    fn density(&self) -> f64 {
        if self.is_water { WATER_DENSITY } else { SAND }
    }

    fn law(&self) -> AnyLaw {
        if self.is_water {
            let state = EquationOfState {
                bulk: WATER_DENSITY * SOUND * SOUND * 2.0 * GRAVITY * self.height(),
                exponent: 7.0,
                carries_tension: false,
            };
            Newtonian::new(state.bulk, 0.0).with_state(state).into()
        } else {
            let young = STIFFNESS * SAND * GRAVITY * self.height();
            MohrCoulomb::new(young, POISSON, [FRICTION, 0.0, 0.0]).into()
        }
    }

    /// Published run-out and height over the width; between two of their regimes the mean of both, and no height of water.
    fn published(&self) -> [f64; 2] {
        let a = self.aspect;
        if self.is_water {
            return [2.0 * FALLS_OF_WATER * a, f64::NAN];
        }
        let [low, high] = [1.2 * a, 1.9 * libm::pow(a, 2.0 / 3.0)];
        let far = match a {
            _ if a < 1.8 => low,
            _ if a > 2.8 => high,
            _ => 0.5 * (low + high),
        };
        [far, if a < 1.15 { a } else { libm::pow(a, 0.4) }]
    }
}

const WRONG_WORK: Wrong =
    Wrong::factor("work of gravity", 0.5).breaks_only(|gate| gate.contains("energy gained"));

/// Columns that are let go.
pub static COLLAPSE: Case = Case::new(
    "collapse",
    "How far does a column come that is let go: of sand, and of water?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.run(compare)
.gates_of_rungs(&[
    run_out::LOSES_NOTHING,
    run_out::GAINS_NOTHING,
    run_out::GIVES_NOTHING_BACK,
    run_out::STAYS_ON_ITS_PATH,
    run_out::RESTS.on(|rung| !Column::of(rung).is_water),
])
.line_of_each(line)
.wrong_references(&[WRONG_WORK])
.no_study("nothing exact is known of a heap but balances, which hold whatever the settings")
.guests_along(&Plan::new(
    Ladder::variants(&["H/d=0.75"], ", ", "1/h", WIDTH, [&[8, 16], &[8, 16, 32]]),
    &[Measure::new("run-out", BEYOND)],
    2,
))
.guest(|rung| Ok(let_go(rung)));

/// The column without a stress at the start, and its run-out by the last frame.
fn let_go(rung: &Rung) -> Guest {
    let column = Column::of(rung);
    let mut scene = scene(rung, &guest::settings());
    let method = guest::settings().method.with_transfer(METHOD.transfer);
    (Settings::new(method).courant(guest::COURANT)).apply(&mut scene);
    scene.name = "collapse".into();
    for body in &mut scene.bodies {
        body.initial_stress = InitialStress::None;
    }
    let scene = guest::slab(scene);
    let stiffness = STIFFNESS * GRAVITY * column.height() * (1.0 - POISSON)
        / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let step = guest::COURANT * rung.cell / stiffness.sqrt();
    let (mesh, width) = (scene.mesh.clone(), column.width);
    let half = 0.5 * mesh.cell[0] / scene.bodies[0].particles_per_cell[0] as f64;
    let run_out = move |frames: &[Snapshot]| {
        let Some(last) = frames.last() else {
            return f64::NAN;
        };
        let moved = last.starts.iter().zip(&last.values);
        let places = moved.map(|(x, u)| std::array::from_fn(|axis| x[axis] + u[axis]));
        let columns = run_out::columns_of(&mesh, half, places);
        let front = columns.last().map_or(f64::NAN, |column| column[0]);
        front / width - 1.0
    };
    let source = "experiments of Lube et al. 2005";
    let reading = Reading::new(BEYOND, column.published()[0], source, run_out);
    Guest {
        reading: Some(reading),
        ..Guest::new(guest::prepared(scene, guest::FRAMES, step), |_, _| [0.0; 3]).at_the_end()
    }
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (column, label) = (Column::of(run.rung), &run.rung.label);
    let work = run.reference.of(&WRONG_WORK);
    let mut ran = run_out::run(run.simulation, work, run.observer)?;
    let [far, high] = column.published();
    let (width, [front, top]) = (column.width, ran.at_last());
    ran.quantities.extend([
        Quantity::figure(BEYOND, front / width - 1.0, "1"),
        Quantity::figure(PUBLISHED, far, "1"),
    ]);
    if !column.is_water {
        ran.quantities.extend([
            Quantity::figure(HEIGHT, top / width, "1"),
            Quantity::figure(PUBLISHED_HEIGHT, high, "1"),
        ]);
    }
    let fall = (column.height() / GRAVITY).sqrt();
    let points = ran.places.iter().map(|place| {
        let (at, ritter) = (place.time / fall, 2.0 * column.aspect * place.time / fall);
        // Ritter's front is one of all times, the experiment's of the end.
        let exact = if column.is_water { ritter } else { f64::NAN };
        CurvePoint::new(at, place.front / width - 1.0, exact)
    });
    let names = ["time over sqrt(H/g)", "distance of the front over width"];
    let curve = Curve::new(format!("front of the column, {label}"), names, points);
    Ok(Measurements {
        drawings: vec![ran.drawing],
        ..Measurements::of(ran.quantities).drawn(curve)
    })
}

fn rungs(size: Size) -> Vec<Rung> {
    let cells = |column: &Column| column.cells[usize::from(size == Size::Full)];
    Rung::of_problems(&COLUMNS, |c| c.variant, "1/h", WIDTH, cells)
}

/// The run-out of a run, for the record.
fn line(rung: &Rung, run: &RungResult) -> Option<String> {
    let [far, far_published] = [BEYOND, PUBLISHED].map(|name| run.value(name));
    let [high, high_published] = [HEIGHT, PUBLISHED_HEIGHT].map(|name| run.value(name));
    let what = if Column::of(rung).is_water {
        let share = far / far_published;
        format!("front {share:.2} of Ritter's after {FALLS_OF_WATER} sqrt(H/g)")
    } else {
        format!(
            "run-out {far:.2} widths, experiments {far_published:.2}; height {high:.2}, experiments {high_published:.2}"
        )
    };
    Some(run_out::said(rung, run, &what))
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, column) = (rung.cell, Column::of(rung));
    let height = column.height();
    // Twice as far as experiments went.
    let long = column.width * (1.0 + 2.0 * column.published()[0]).ceil();
    let cells = |length: f64| (length / h).ceil() as usize;
    let mut mesh = strip(h, [cells(long), cells(height) + 2]);
    mesh.planes[1][1] = PlaneCondition::Free;
    if !column.is_water {
        mesh.planes[1][0] = PlaneCondition::Fixed;
    }
    let mut scene = plane_scene(&rung.label, mesh, column.time());
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.materials = material(column.variant, column.density(), column.law());
    let in_sand = POISSON / (1.0 - POISSON);
    scene.bodies = vec![Body {
        initial_stress: InitialStress::AtRest {
            ratio: if column.is_water { 1.0 } else { in_sand },
            level: height,
            surcharge: 0.0,
        },
        ..body("column", 1, rectangle([0.0; 2], [column.width, height]))
    }];
    if column.is_water {
        scene.volumetric_strain = VolumetricStrain::CellAverage;
    }
    Settings::new(METHOD).apply(&mut scene);
    scene
}
