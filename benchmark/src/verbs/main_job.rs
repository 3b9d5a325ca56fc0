//! `proctor` without a verb: the main job on the built-in set.

use super::settings::processors;
use super::stability::done as solve_stability;
use crate::bench::Session;
use crate::bench::config::{Asked, Config};
use crate::bench::tables::Report;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::precision::{Effort, run as study_run};
use crate::record::Record;
use crate::report;
use crate::show::{case as show, precision as show_study, stability as show_stability};
use crate::stability::{Asked as AskedOfStability, Done, jobs};
use crate::suite::{self, Ran};
use proctor_files::output::atomic;
use proctor_kernel::lanes::LaneChoice;
use proctor_kernel::plan::Demands;
use proctor_kernel::simulation::Options;
use proctor_verification::case::{self, Size};
use proctor_verification::stability::{map, nonlinear};
use proctor_verification::study;
use std::io::Write;
use std::path::Path;

/// Where record and page go, below the working folder.
const FOLDER: &str = "target/proctor";

/// Speed of the built-in set: the moving block of the speed fixtures.
const SPEED: &str = r#"{ "scenes": ["moving-3d"], "particles": 64000, "particle_steps": 4000000 }"#;

const WHERE_TO_GO: &str = "\
Where to go from here (in a checkout, `cargo run --release --` stands for `proctor`)
  proctor verify
      the full ladders with observed orders, and why each bound
  proctor precision bar
      error against run time for every combination of weighting function, scheme and transfer
  proctor run fixtures/scenes/disc_bounce_2d.json --out out
      a scene; open out/particles.pvd in ParaView
  proctor -h
      everything else";

/// The suites in short, error against run time, and speed; tables here, everything in a record and a page.
pub fn run(out: &mut dyn Write) -> Result<Outcome, Failure> {
    let options = Options::default();
    let folder = Path::new(FOLDER);
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::BadInput(format!("{}: {error}", folder.display())))?;
    let mut record = Record::new(&options);
    record.set_incomplete(true);
    record
        .write(&folder.join("record.json"))
        .map_err(Failure::bad_input)?;
    let stop = Interrupt::listen()?;

    let all = verify(&options, &mut record, &stop, out)?;
    if !stop.raised() {
        keep_cases(&record, folder)?;
    }
    let stable = stability(&mut record, &stop, out)?;
    precision(&mut record, &stop, out)?;
    let fast = speed(&mut record, &stop, out)?;

    let interrupted = stop.raised();
    record.set_incomplete(interrupted);
    write(&record, folder, out)?;
    show::total(&all, out)?;
    if interrupted {
        return Ok(Outcome::Interrupted);
    }
    writeln!(out, "\n{WHERE_TO_GO}")?;
    Ok(if fast && stable && all.iter().all(Ran::passed) {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}

/// Writes what the cases gave by itself: it is the record of `proctor verify --quick`, and no case is run twice for it.
fn keep_cases(record: &Record, folder: &Path) -> Result<(), Failure> {
    let mut cases = record.clone();
    cases.set_incomplete(false);
    let path = folder.join("cases.json");
    cases.write(&path).map_err(Failure::bad_input)
}

/// Short ladders of all cases, as many at a time as there are processors, with the plans of their scenes.
fn verify(
    options: &Options,
    record: &mut Record,
    stop: &Interrupt,
    out: &mut dyn Write,
) -> Result<Vec<Ran>, Failure> {
    let workers = processors();
    writeln!(
        out,
        "Cases with exact answers: {workers} at a time, each on one thread. What comes after them runs alone.\n"
    )?;
    let mut all: Vec<Ran> = vec![];
    let go = || !stop.raised();
    let mut each = |ran: Ran| -> Result<(), Failure> {
        record.push_case(&ran, 1);
        // Of a case that was interrupted the verdict is about a part.
        if stop.raised() {
            return Ok(());
        }
        show::runs(&ran, out)?;
        show::gates(&ran, false, out)?;
        out.flush()?;
        if let Some(rung) = ran.rungs.last() {
            let scene = ran.case.scene(&rung.rung);
            let plan = proctor_kernel::simulation::plan(&scene, Demands::default());
            record
                .details
                .push_plan(&format!("{}, {}", ran.case.name(), rung.rung.label), &plan);
        }
        all.push(ran);
        Ok(())
    };
    suite::run_side_by_side(case::all(), Size::Quick, options, workers, &go, &mut each)?;
    Ok(all)
}

/// The map of stability in short; whether all of it holds.
fn stability(record: &mut Record, stop: &Interrupt, out: &mut dyn Write) -> Result<bool, Failure> {
    let scenes: Vec<_> = nonlinear::ALL.iter().collect();
    let jobs = jobs(AskedOfStability::Short, true, &scenes, &map::SCHEMES);
    let passed = solve_stability(&jobs, stop, record)
        .iter()
        .all(Done::passed);
    if let Some(detail) = &record.details.stability {
        writeln!(
            out,
            "Stability, in short: `proctor stability` has all of it.\n"
        )?;
        show_stability::map(detail, out)?;
        writeln!(out)?;
    }
    Ok(passed)
}

/// Short studies of all cases that can be studied, on one thread.
fn precision(record: &mut Record, stop: &Interrupt, out: &mut dyn Write) -> Result<(), Failure> {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let effort = Effort {
        size: Size::Quick,
        repetitions: 1,
    };
    for study in study::all() {
        if stop.raised() {
            break;
        }
        let studied = study_run::run(study, effort, &options, stop.flag());
        show_study::study(&studied, false, out)?;
        out.flush()?;
        record.push_study(&studied, 1);
    }
    Ok(())
}

/// Speed on one thread and on all; whether every sample was taken.
fn speed(record: &mut Record, stop: &Interrupt, out: &mut dyn Write) -> Result<bool, Failure> {
    let mut threads = vec![1, processors()];
    threads.dedup();
    let asked = Asked {
        threads,
        repetitions: None,
        quick: true,
    };
    let config = Config::from_json(SPEED, "built-in set", Path::new(""), &asked)
        .map_err(Failure::bad_input)?;
    let mut session = Session::new(&config, LaneChoice::Auto).map_err(Failure::bad_input)?;
    let first = record.rows.len();
    // Nothing is written there: there are no executables.
    session.run(record, Path::new(""), stop.flag());
    let measured = Record {
        rows: record.rows[first..].to_vec(),
        ..record.clone()
    };
    write!(out, "{}", Report::new(&session, &measured))?;
    Ok(measured.rows.iter().all(|row| row.error.is_none()))
}

/// The record and the page made from it.
fn write(record: &Record, folder: &Path, out: &mut dyn Write) -> Result<(), Failure> {
    let (data, page) = (folder.join("record.json"), folder.join("report.html"));
    record.write(&data).map_err(Failure::bad_input)?;
    let html = report::page(record);
    atomic::write(&page, |file| file.write_all(html.as_bytes())).map_err(Failure::bad_input)?;
    writeln!(
        out,
        "record in {}\npage in {}\n",
        data.display(),
        page.display()
    )?;
    Ok(())
}
