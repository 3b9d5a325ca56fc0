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
use super::vocabulary::run_out::{self, FRONT, RunOut, TOP};

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
.judge_by(judge)
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
    Settings::new(method)
        .courant(guest::COURANT)
        .apply(&mut scene);
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

fn found(rung: &Rung, mut run: RunOut) -> Measurements {
    let column = Column::of(rung);
    let [far, high] = column.published();
    let of = |name: &str| {
        let found = run.quantities.iter().find(|q| q.name == name);
        found.map_or(f64::NAN, |q| q.value)
    };
    let beyond = of(FRONT) / column.width - 1.0;
    let height = of(TOP) / column.width;
    run.quantities.extend([
        Quantity::figure(BEYOND, beyond, "1"),
        Quantity::figure(PUBLISHED, far, "1"),
    ]);
    if !column.is_water {
        run.quantities.extend([
            Quantity::figure(HEIGHT, height, "1"),
            Quantity::figure(PUBLISHED_HEIGHT, high, "1"),
        ]);
    }
    let fall = (column.height() / GRAVITY).sqrt();
    let points = run.places.iter().map(|place| CurvePoint {
        at: place.time / fall,
        computed: place.front / column.width - 1.0,
        // Ritter's front is one of all times, the experiment's of the end.
        exact: if column.is_water {
            2.0 * column.aspect * place.time / fall
        } else {
            f64::NAN
        },
    });
    let curve = Curve::new(
        format!("front of the column, {}", rung.label),
        ["time over sqrt(H/g)", "distance of the front over width"],
        points,
    );
    Measurements {
        drawings: vec![run.drawing],
        ..Measurements::of(run.quantities).drawn(curve)
    }
}

fn rungs(size: Size) -> Vec<Rung> {
    let of = |column: &Column| {
        let cells = column.cells[usize::from(size == Size::Full)];
        Rung::counted(
            column.variant,
            &format!("{}, 1/h", column.variant),
            WIDTH,
            cells,
        )
    };
    COLUMNS.iter().flat_map(of).collect()
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for rung in runs.rungs {
        let label = &rung.label;
        let column = Column::of(rung);
        let gates = run_out::gates(runs, label, !column.is_water);
        verdict.gates.extend(gates);
        if runs.run(label).is_none() {
            continue;
        }
        let value = |name: &str| runs.value(label, name);
        let what = if column.is_water {
            format!(
                "front {:.2} of Ritter's after {FALLS_OF_WATER} sqrt(H/g)",
                value(BEYOND) / value(PUBLISHED)
            )
        } else {
            format!(
                "run-out {:.2} widths, experiments {:.2}; height {:.2}, experiments {:.2}",
                value(BEYOND),
                value(PUBLISHED),
                value(HEIGHT),
                value(PUBLISHED_HEIGHT)
            )
        };
        let line = run_out::said(runs, label, &what);
        verdict.for_the_record.push(line);
    }
    verdict
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, column) = (rung.cell, Column::of(rung));
    let height = column.height();
    // Twice as far as experiments went.
    let long = column.width * (1.0 + 2.0 * column.published()[0]).ceil();
    let cells = |length: f64| (length / h).ceil() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [0.0; 3],
        [h; 3],
        [cells(long), cells(height) + 2, 1],
    );
    mesh.planes[1][1] = PlaneCondition::Free;
    if !column.is_water {
        mesh.planes[1][0] = PlaneCondition::Fixed;
    }
    let mut scene = Scene::new(Dimension::Two, mesh, column.time());
    scene.name.clone_from(&rung.label);
    scene.results = NO_RESULTS;
    scene.gravity = [0.0, -GRAVITY, 0.0];
    scene.materials = material(column.variant, column.density(), column.law());
    let mut what = body("column", 1, rectangle([0.0; 2], [column.width, height]));
    let ratio = if column.is_water {
        1.0
    } else {
        POISSON / (1.0 - POISSON)
    };
    what.initial_stress = InitialStress::AtRest {
        ratio,
        level: height,
        surcharge: 0.0,
    };
    scene.bodies = vec![what];
    if column.is_water {
        scene.volumetric_strain = VolumetricStrain::CellAverage;
    }
    Settings::new(METHOD).apply(&mut scene);
    scene
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let work = run.reference.of(&WRONG_WORK);
    let ran = run_out::run(run.simulation, work, run.observer)?;
    Ok(found(run.rung, ran))
}
