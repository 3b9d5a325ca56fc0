//! `proctor` without a verb: the main job on the built-in set.

use super::Amount;
use super::stability::done as solve_stability;
use crate::bench::Session;
use crate::bench::config::{CommandLineChoices, Config};
use crate::bench::tables::Report;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::judge::Verdict as Judgement;
use crate::precision::costs::Costs;
use crate::precision::{CaseStudy, Effort, run as study_run};
use crate::progress::{self, Whole, ladders};
use crate::record::{BY_SCENE, Record};
use crate::refine::judge::SceneBars;
use crate::refine::kept::OF_MAIN_JOB;
use crate::report::before::Before;
use crate::report::{self, Since};
use crate::say::say;
use crate::show::paint::Paint;
use crate::show::refine as show_refined;
use crate::show::summary::{EarlierCases, Lines, Verdict, is_far};
use crate::show::{case as full, precision as show_study, short, stability as show_stability};
use crate::side_by_side::{processors, side_by_side};
use crate::stability::{JobResult, MapRequest, jobs};
use crate::suite::{self, Against, CaseRun};
use proctor_files::output::atomic;
use proctor_kernel::lanes::LaneChoice;
use proctor_scene::plan::PlanOptions;
use proctor_scene::simulation::Options;
use proctor_verification::case::{self, Gate, Size};
use proctor_verification::stability::{map, nonlinear};
use proctor_verification::study::{self, Study};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Folder of record and page, below the working folder.
const FOLDER: &str = "target/proctor";

/// Speed of the built-in set on one thread and on all: the moving block of the speed fixtures.
const SPEED: &str = r#"{ "scenes": ["moving-3d"], "particles": 64000, "particle_steps": 4000000 }"#;
/// Speed where it is lost, on one thread: disorder, the plane, few particles, contact.
const SLOW: &str = r#"{
    "scenes": ["rest-3d", "disordered-3d", "sparse-3d", "contact-3d", "mixed-3d", "stl-3d", "mortar-3d", "moving-2d",
        "disordered-2d", "mortar-2d"],
    "particles": 8000, "threads": 1
}"#;
/// Heading above both.
const SPEED_HEADING: &str =
    "Whole steps with uGIMP, USL, FLIP: CPU ns per particle and step, median; less is better";

/// CPU time of the map of stability and time of the studies \[s\] on the machine on which they were last looked at: what is
/// expected at first.
const STABILITY_SECONDS: f64 = 5.0;
const STUDIES_SECONDS: f64 = 100.0;

const WHERE_TO_GO: &str = "next: `proctor new`, `proctor -h`";

/// Data that the parts of the main job share.
struct Job<'a> {
    amount: Amount,
    paint: Paint,
    stop: Interrupt,
    whole: Whole,
    out: &'a mut dyn Write,
}

impl Job<'_> {
    /// Writes below what is there, the line of progress taken away.
    fn tell(
        &mut self,
        write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<(), Failure> {
        let out = &mut *self.out;
        Ok(progress::above(|| write(out).and_then(|()| out.flush()))?)
    }
}

/// The suites in short, error against run time, and speed; a line each here, everything in a record and a page.
pub fn run(amount: Amount, against: Against, out: &mut dyn Write) -> Result<Outcome, Failure> {
    let begun = Instant::now();
    let options = Options::default();
    let folder = Path::new(FOLDER);
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::BadInput(format!("{}: {error}", folder.display())))?;
    let before = Before::take(folder);
    let mut record = Record::new(&options);
    record.set_ladder(Size::Quick);
    record.set_incomplete(true);
    record
        .write(&folder.join("record.json"))
        .map_err(Failure::bad_input)?;
    if !amount.more_than_the_verdict() {
        progress::hide();
    }
    let mut job = Job {
        amount,
        paint: Paint::of_standard_output(),
        stop: Interrupt::listen()?,
        whole: whole(),
        out,
    };
    let all = job.verify(against, &options, &mut record)?;
    if !job.stop.raised() {
        keep_cases(&record, folder)?;
    }
    let (stable, of_stability) = job.stability(&mut record)?;
    job.precision(&mut record)?;
    let settled = job.refine(&options, &mut record)?;
    let Job {
        stop,
        paint,
        whole,
        out,
        ..
    } = job;
    drop(whole);
    let fast = speed(&mut record, amount, &stop, out)?;

    let interrupted = stop.raised();
    record.set_incomplete(interrupted);
    let since = before
        .as_ref()
        .filter(|_| !interrupted)
        .map(|before| before.judge(&record));
    write(&record, since.as_ref(), folder)?;
    let also = [
        (stable, "stability"),
        (settled, "error bars"),
        (fast, "speed"),
    ];
    let also: Vec<&'static str> = also
        .iter()
        .filter(|(held, _)| !held)
        .map(|(_, name)| *name)
        .collect();
    let verdict = Verdict {
        cases: &all,
        kept: EarlierCases::default(),
        asked: case::all().len(),
        also_failed: &also,
        worse: since
            .as_ref()
            .is_some_and(|since| since.comparison().verdict() == Judgement::Worse),
        interrupted,
        of_stability: Some(of_stability),
        took: begun.elapsed(),
    };
    if let (Some(before), Some(since)) = (&before, &since)
        && amount.more_than_the_verdict()
    {
        before.tell(since, paint, out)?;
    }
    verdict.line(paint, out)?;
    if amount.more_than_the_verdict() {
        verdict.busy(paint, out)?;
        let [data, page] = files(folder);
        let name = |path: &Path| -> String {
            path.file_name()
                .map_or_else(String::new, |name| name.to_string_lossy().into())
        };
        writeln!(
            out,
            "{} and {} in {}; {WHERE_TO_GO}",
            name(&data),
            name(&page),
            folder.display()
        )?;
    }
    if interrupted {
        return Ok(stop.outcome());
    }
    Ok(if verdict.held() {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}

/// The line of progress over the cases, the map of stability and the studies, in that order.
fn whole() -> Whole {
    let at_a_time = processors() as f64;
    let cases = case::all()
        .iter()
        .map(|case| ladders::seconds(case.name(), Size::Quick) / at_a_time);
    let studies = study::all().len();
    let each = STUDIES_SECONDS / studies.max(1) as f64;
    let weights = cases
        .chain([STABILITY_SECONDS / at_a_time])
        .chain(std::iter::repeat_n(each / at_a_time, studies));
    Whole::new("main job", weights.collect(), 1)
}

/// Writes what the cases gave by itself: it is the record of `proctor verify --quick`, and no case is run twice for it.
fn keep_cases(record: &Record, folder: &Path) -> Result<(), Failure> {
    let mut cases = record.clone();
    cases.set_incomplete(false);
    let path = folder.join("cases.json");
    cases.write(&path).map_err(Failure::bad_input)
}

impl Job<'_> {
    /// Short ladders of all cases, as many at a time as there are processors, with the plans of their scenes.
    fn verify(
        &mut self,
        against: Against,
        options: &Options,
        record: &mut Record,
    ) -> Result<Vec<CaseRun>, Failure> {
        let workers = processors();
        let (amount, paint) = (self.amount, self.paint);
        let lines = Lines::new(paint, case::all().iter().map(|case| case.name()));
        if amount.more_than_the_verdict() {
            self.tell(|out| {
                if !amount.all() {
                    return lines.heading(out);
                }
                writeln!(
                    out,
                    "Cases with exact answers: {workers} at a time, each on one thread, as the map and the studies below.\nSpeed is measured alone.\n"
                )
            })?;
        }
        let mut all: Vec<CaseRun> = vec![];
        let stop = self.stop.clone();
        let Self { whole, out, .. } = self;
        let each = |ran: CaseRun| -> Result<(), Failure> {
            record.push_case(&ran, 1);
            // Of a case that was interrupted the verdict is about a part.
            if stop.raised() {
                return Ok(());
            }
            progress::above(|| -> std::io::Result<()> {
                if amount.all() {
                    full::runs(&ran, out)?;
                    full::gates(&ran, false, out)?;
                    full::faults(&ran, out)?;
                } else if amount.more_than_the_verdict() && !is_far(&ran) {
                    lines.case(&ran, out)?;
                }
                out.flush()
            })?;
            let last = ran.rungs.last().map(|ran| &ran.rung);
            let planned = last.and_then(|rung| Some((rung, ran.case.scene_of(rung).ok()?)));
            if let Some((rung, scene)) = planned {
                let plan = proctor_scene::simulation::plan(&scene, PlanOptions::default());
                record
                    .details
                    .push_plan(&format!("{}, {}", ran.case.name(), rung.label), &plan);
            }
            all.push(ran);
            Ok(())
        };
        let go = || !stop.raised();
        let progress = |case: usize, share: f64| whole.at(case, share);
        suite::run_side_by_side(case::all(), against, options, workers, &go, &progress, each)?;
        let stopped = self.stop.raised();
        if amount.more_than_the_verdict() && !amount.all() {
            self.tell(|out| lines.far(all.iter(), out))?;
        }
        let sound = all.iter().all(|ran| ran.faults.is_empty());
        if against == Against::Wrong && sound && amount.all() && !stopped {
            let wrong: usize = all.iter().map(|ran| ran.case.wrong().len()).sum();
            self.tell(|out| {
                writeln!(out, "Each gate reacts to its number, and {wrong} wrong references break what they must")
            })?;
        }
        Ok(all)
    }

    /// The map of stability in short; whether all of it holds, and how many gates do and are there.
    fn stability(&mut self, record: &mut Record) -> Result<(bool, [usize; 2]), Failure> {
        let scenes: Vec<_> = nonlinear::ALL.iter().collect();
        let jobs = jobs(MapRequest::Short, true, &scenes, &map::SCHEMES);
        let whole = &self.whole;
        let mut at = |share| whole.at(case::all().len(), share);
        let done = solve_stability(&jobs, &self.stop, record, &mut at);
        let passed = done.iter().all(JobResult::passed);
        let gates: Vec<Gate> = done.iter().flat_map(JobResult::gates).collect();
        let held = gates.iter().filter(|gate| gate.passed()).count();
        let (amount, interrupted) = (self.amount, self.stop.raised());
        if let Some(detail) = record
            .details
            .stability
            .as_ref()
            // The verdict at the end has the number of gates that hold.
            .filter(|_| amount.all() || (amount.more_than_the_verdict() && !passed))
        {
            self.tell(|out| {
                if amount.all() {
                    writeln!(
                        out,
                        "\nStability, in short: `proctor stability` has all of it.\n"
                    )?;
                    show_stability::map(detail, interrupted, out)
                } else {
                    show_stability::verdict(detail, interrupted, out)
                }
            })?;
        }
        Ok((passed, [held, gates.len()]))
    }

    /// Short studies of all cases that can be studied, as many at a time as there are processors, each on one thread: what a run
    /// costs is its own time on a processor. `proctor precision` runs them one by one.
    fn precision(&mut self, record: &mut Record) -> Result<(), Failure> {
        let options = Options {
            threads: Some(1),
            ..Options::default()
        };
        let effort = Effort {
            size: Size::Quick,
            repetitions: 1,
            own: false,
        };
        let amount = self.amount;
        let studies = study::all();
        // The longest begin first.
        let mut order: Vec<usize> = (0..studies.len()).collect();
        let seconds = |k: &usize| ladders::seconds(studies[*k].name(), Size::Quick);
        order.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)));
        let mut all: Vec<CaseStudy> = vec![];
        let stop = self.stop.clone();
        let Self { whole, out, .. } = self;
        let first = case::all().len() + 1;
        let work = |number: usize, study: &Study| {
            let mut at = |share| whole.at(first + number, share);
            let studied = study_run::run(*study, effort, &options, stop.flag(), &mut at);
            at(1.0);
            studied
        };
        let each = |studied: CaseStudy| -> Result<(), Failure> {
            record.push_study(&studied, 1);
            if amount.all() {
                progress::above(|| {
                    show_study::study(&studied, false, out).and_then(|()| out.flush())
                })?;
            }
            all.push(studied);
            Ok(())
        };
        side_by_side(
            &studies,
            &order,
            processors(),
            &|| !stop.raised(),
            work,
            each,
        )?;
        if amount.more_than_the_verdict() && !amount.all() && !all.is_empty() {
            let costs = Costs::all(record);
            let runs = all.iter().map(|studied| studied.runs.len()).sum();
            self.tell(|out| short::studies(&costs, all.len(), runs, out))?;
        }
        Ok(())
    }
}

impl Job<'_> {
    /// Two scenes with error bars, a line for both; whether their energies settle.
    fn refine(&mut self, options: &Options, record: &mut Record) -> Result<bool, Failure> {
        let mut all_settle = true;
        let mut done = vec![];
        for scene in OF_MAIN_JOB {
            match scene.refined(options, &self.stop) {
                Ok(None) => break,
                Ok(Some((refined, runs))) => {
                    all_settle &= refined.until().is_none();
                    record.push_refined(&refined, &runs, BY_SCENE);
                    done.push((refined, runs));
                }
                Err(reason) => {
                    all_settle = false;
                    say!("{}: {reason}", scene.name);
                }
            }
        }
        let (amount, paint) = (self.amount, self.paint);
        if amount.more_than_the_verdict() && !done.is_empty() {
            self.tell(|out| {
                if amount.all() {
                    for (refined, runs) in &done {
                        show_refined::table(refined, runs, paint, out)?;
                    }
                    Ok(())
                } else {
                    let refined: Vec<&SceneBars> =
                        done.iter().map(|(refined, _)| refined).collect();
                    writeln!(out, "{}", show_refined::short(&refined, paint))
                }
            })?;
        }
        Ok(all_settle)
    }
}

/// Speed on one thread and on all; whether every sample was taken.
fn speed(
    record: &mut Record,
    amount: Amount,
    stop: &Interrupt,
    out: &mut dyn Write,
) -> Result<bool, Failure> {
    if stop.raised() {
        return Ok(true);
    }
    let mut threads = vec![1, processors()];
    threads.dedup();
    let in_short = amount.more_than_the_verdict() && !amount.all();
    if in_short {
        writeln!(out, "{SPEED_HEADING}")?;
    }
    let mut all_taken = true;
    for (configuration, threads) in [(SPEED, threads), (SLOW, vec![])] {
        let asked = CommandLineChoices {
            threads,
            repetitions: None,
            quick: true,
        };
        let config = Config::from_json(configuration, "built-in set", Path::new(""), &asked)
            .map_err(Failure::bad_input)?;
        let mut session = Session::new(&config, LaneChoice::Auto).map_err(Failure::bad_input)?;
        let first = record.rows.len();
        // Nothing is written there: there are no executables.
        session.run(record, Path::new(""), stop.flag());
        let measured = Record {
            rows: record.rows[first..].to_vec(),
            ..record.clone()
        };
        let report = Report::new(&session, &measured);
        if amount.all() {
            write!(out, "{report}")?;
        } else if in_short {
            write!(out, "{}", report.short())?;
        }
        all_taken &= measured.rows.iter().all(|row| row.error.is_none());
    }
    Ok(all_taken)
}

/// Files of the record and of the page made from it.
fn files(folder: &Path) -> [PathBuf; 2] {
    ["record.json", "report.html"].map(|name| folder.join(name))
}

fn write(record: &Record, since: Option<&Since<'_>>, folder: &Path) -> Result<(), Failure> {
    let [data, page] = files(folder);
    record.write(&data).map_err(Failure::bad_input)?;
    let html = report::page(record, since);
    atomic::write(&page, |file| file.write_all(html.as_bytes())).map_err(Failure::bad_input)
}
