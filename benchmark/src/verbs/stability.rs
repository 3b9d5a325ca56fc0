//! `proctor stability`: where each method is stable, predicted and measured.

use super::names;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::record::Record;
use crate::show::{picture, stability as show};
use crate::side_by_side::processors;
use crate::stability::{self, JobResult, MapRequest, Outcome as JobOutcome};
use clap::Args;
use proctor_files::output::atomic;
use proctor_scene::StressScheme;
use proctor_scene::simulation::Options;
use proctor_verification::stability::extreme::{self, Ending};
use proctor_verification::stability::nonlinear::{self, Nonlinear};
use proctor_verification::stability::{StabilityError, scene, table};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Name of the map among the rows.
const MAP: &str = "map";
/// Name of the bodies about an axis of revolution among the rows.
const AXIS: &str = "axis";
/// Name of the picture.
const PICTURE: &str = "stability.svg";

/// Stability of each method: the largest time step, predicted and measured.
///
/// Predicted from the linear part of the kernel's own step, measured by runs with noise that close in on the limit, for
/// every weighting function, scheme and transfer, one to four particles per cell and axis, blocks, thin bodies and single
/// particles at nineteen places on the mesh; then scenes that are not linear, and rods, rings and discs about an axis of
/// revolution. Numbers are c dt / min(h). The exit code is 1 if a measured limit lies below the predicted one or below
/// the step that the kernel takes.
///
/// With a scene: its predicted critical step, the kernel's, what rules it, and what would allow a larger one.
#[derive(Args)]
#[command(after_help = "Example: proctor stability --quick --svg pictures\n\
    A scene of your own: proctor stability fixtures/scenes/rings_2d.json\n\
    Stiff and extreme scenes: proctor stability --extreme")]
pub struct Stability {
    /// Scene file (JSON), - for standard input; without one, the map
    #[arg(value_name = "SCENE", conflicts_with_all = ["quick", "json", "svg", "table", "rows", "schemes"])]
    scene: Option<PathBuf>,
    /// Only two dimensions, and short runs of the nonlinear scenes
    #[arg(long)]
    quick: bool,
    /// Run stiff and extreme scenes instead: each passes a physical check, is refused with a reason, or fails
    #[arg(long, conflicts_with_all = ["scene", "quick", "table", "schemes", "svg"])]
    extreme: bool,
    /// Only these rows: `map`, `axis`, or the name of a nonlinear scene; with --extreme the name of an extreme scene
    #[arg(long = "row", value_name = "ROW")]
    rows: Vec<String>,
    /// Only these schemes: usl, usf, musl
    #[arg(long = "scheme", value_name = "SCHEME")]
    schemes: Vec<String>,
    /// Write a record of all rows (Google Benchmark JSON)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the map as a picture into this folder; created if it does not exist
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    /// Print the table from which the kernel chooses its steps, as Rust source, and compare it with the one that is built in
    #[arg(long, conflicts_with_all = ["quick", "rows", "schemes", "svg", "json"])]
    table: bool,
}

/// Rows that `--row` names.
#[derive(Clone, Copy)]
enum RowName {
    Map,
    Axis,
    Scene(&'static Nonlinear),
}

impl RowName {
    fn word(self) -> &'static str {
        match self {
            Self::Map => MAP,
            Self::Axis => AXIS,
            Self::Scene(scene) => scene.name,
        }
    }
}

/// Schemes by their words.
fn scheme_word(scheme: StressScheme) -> &'static str {
    match scheme {
        StressScheme::Usl => "usl",
        StressScheme::Usf => "usf",
        StressScheme::Musl => "musl",
    }
}

impl Stability {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if let Some(path) = &self.scene {
            return ask(path, out);
        }
        if self.extreme {
            return self.extreme(out);
        }
        let all: Vec<RowName> = [RowName::Map, RowName::Axis]
            .into_iter()
            .chain(nonlinear::ALL.iter().map(RowName::Scene))
            .collect();
        let rows = names::chosen(&self.rows, &all, "row", RowName::word)?;
        let schemes: Vec<String> = self.schemes.iter().map(|s| s.to_lowercase()).collect();
        let known = [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl];
        let schemes = names::chosen(&schemes, &known, "scheme", scheme_word)?;
        let map = rows.iter().any(|row| matches!(row, RowName::Map));
        let axis = rows.iter().any(|row| matches!(row, RowName::Axis));
        let scenes: Vec<&'static Nonlinear> = rows
            .into_iter()
            .filter_map(|row| match row {
                RowName::Map | RowName::Axis => None,
                RowName::Scene(scene) => Some(scene),
            })
            .collect();
        if self.table {
            return print_table(out);
        }
        let asked = if self.quick {
            MapRequest::Quick
        } else {
            MapRequest::Full
        };
        let mut jobs = stability::jobs(asked, map, &scenes, &schemes);
        if axis {
            jobs.extend(stability::round_jobs(&schemes));
        }
        if jobs.is_empty() {
            return Err(Failure::BadInput(
                "none of these rows can be run with these schemes; mortar contact takes usl and musl".to_owned(),
            ));
        }
        let mut record = Record::new(&Options::default());
        record.set_incomplete(true);
        self.can_write(&record)?;
        let interrupt = Interrupt::listen()?;
        let mut progress = Progress::new("stability");
        let passed = done(&jobs, &interrupt, &mut record, &mut |share| {
            progress.at(share);
        })
        .iter()
        .all(JobResult::passed);
        drop(progress);
        record.set_incomplete(interrupt.raised());
        if let Some(detail) = &record.details.stability {
            show::map(detail, interrupt.raised(), out)?;
        }
        self.write(&record, out)?;
        Ok(ended(&interrupt, passed))
    }

    /// Runs the stiff and extreme scenes.
    fn extreme(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let rows = names::chosen(&self.rows, &extreme::all(), "row", |row| row.name)?;
        let mut record = Record::new(&Options::default());
        record.set_incomplete(true);
        self.can_write(&record)?;
        let interrupt = Interrupt::listen()?;
        let mut progress = Progress::new("extreme scenes");
        let (mut tried, mut passed) = (0, true);
        stability::extreme::try_all(&rows, processors(), &|| !interrupt.raised(), |one| {
            record.push_extreme(&one);
            passed &= one.ending() != Ending::Failed;
            tried += 1;
            progress.at(f64::from(tried) / rows.len() as f64);
        });
        record.set_incomplete(interrupt.raised());
        if let Some(detail) = &record.details.stability {
            show::extreme(&detail.extreme, interrupt.raised(), out)?;
        }
        self.write(&record, out)?;
        Ok(ended(&interrupt, passed))
    }

    /// Finds out now, not after minutes, whether everything can be written.
    fn can_write(&self, record: &Record) -> Result<(), Failure> {
        if let Some(folder) = &self.svg {
            std::fs::create_dir_all(folder)
                .map_err(|e| Failure::BadInput(format!("{}: {e}", folder.display())))?;
        }
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
        }
        Ok(())
    }

    fn write(&self, record: &Record, out: &mut dyn Write) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
            writeln!(out, "record in {}", path.display())?;
        }
        let detail = record.details.stability.as_ref();
        if let (Some(folder), Some(detail)) = (&self.svg, detail.filter(|d| !d.cells.is_empty())) {
            let path = folder.join(PICTURE);
            let svg = picture::svg(detail);
            atomic::write(&path, |file| file.write_all(svg.as_bytes()))
                .map_err(Failure::bad_input)?;
            writeln!(out, "picture in {}", path.display())?;
        }
        Ok(())
    }
}

/// Ending of a run of rows.
fn ended(interrupt: &Interrupt, passed: bool) -> Outcome {
    if interrupt.raised() {
        interrupt.outcome()
    } else if passed {
        Outcome::Fine
    } else {
        Outcome::Failed
    }
}

/// Runs jobs and puts them into a record; `progress` hears the share that is done.
pub fn done(
    jobs: &[stability::Job],
    interrupt: &Interrupt,
    record: &mut Record,
    progress: &mut dyn FnMut(f64),
) -> Vec<JobResult> {
    let mut all: Vec<JobResult> = vec![];
    let go = || !interrupt.raised();
    stability::run(jobs, processors(), &go, |done| {
        record.push_stability(&done);
        all.push(done);
        progress(all.len() as f64 / jobs.len() as f64);
    });
    all
}

/// Asks a scene; it fails where the kernel's step is longer than the predicted one, and where no step holds its tension.
fn ask(path: &Path, out: &mut dyn Write) -> Result<Outcome, Failure> {
    let (given, places) = super::scene(path)?;
    let report = match scene::ask(&given) {
        Ok(report) => report,
        Err(error @ (StabilityError::Step(_) | StabilityError::NoConvergence { .. })) => {
            writeln!(out, "{}: {error}", places.name())?;
            return Ok(Outcome::Failed);
        }
        Err(StabilityError::Setup(error)) => {
            return Err(Failure::BadInput(places.of_setup(&error)));
        }
        Err(error) => {
            return Err(Failure::BadInput(format!("{}: {error}", places.name())));
        }
    };
    show::scene(&given.name, &report, out)?;
    let limit = report.predicted.map_or(f64::INFINITY, |limit| limit.dt);
    let torn = report.tension.filter(|tension| !tension.holds());
    Ok(if let Some(tension) = torn {
        writeln!(
            out,
            "FAIL  no step holds the tension of {} with {}",
            tension.name, report.method
        )?;
        Outcome::Failed
    } else if report.dt <= limit {
        Outcome::Fine
    } else {
        writeln!(
            out,
            "FAIL  the kernel's step is longer than the predicted critical one"
        )?;
        Outcome::Failed
    })
}

/// Prints the kernel's table as its source, then what the one that it holds is worth.
fn print_table(out: &mut dyn Write) -> Result<Outcome, Failure> {
    let all = [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl];
    let mut jobs = stability::jobs(MapRequest::Table, true, &[], &all);
    jobs.extend(stability::round_jobs(&all));
    let mut record = Record::new(&Options::default());
    let interrupt = Interrupt::listen()?;
    let (mut entries, mut right) = (vec![], true);
    let mut progress = Progress::new("stability");
    for done in done(&jobs, &interrupt, &mut record, &mut |share| {
        progress.at(share);
    }) {
        let passed = done.passed();
        match done.outcome {
            Ok(JobOutcome::Entry(entry)) => entries.push(*entry),
            // What was found stands in the record, for a table of its own.
            Ok(JobOutcome::Round(_)) => right &= passed,
            Ok(JobOutcome::Nonlinear(_)) => {}
            Err(error) => {
                writeln!(out, "{}: {error}", done.job.name())?;
                return Ok(Outcome::Failed);
            }
        }
    }
    if interrupt.raised() {
        return Ok(interrupt.outcome());
    }
    let numbers = table::numbers(&entries);
    let date = record.context["date"].as_str().unwrap_or("an unknown day");
    writeln!(
        out,
        "{}",
        table::source(&numbers, date.split('T').next().unwrap_or(date))
    )?;
    show::numbers(&numbers, out)?;
    right &= numbers.iter().all(|n| n.worth() == table::Worth::Right);
    if let Some(detail) = &record.details.stability {
        show::round(detail, out)?;
    }
    Ok(if right {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}
