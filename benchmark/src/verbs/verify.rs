//! `proctor verify`: cases, errors, observed orders, gates.

mod earlier;
mod generated;
mod mill;
mod refine;

use super::settings::Settings;
use super::{Amount, names};
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::progress::{self, Whole, ladders};
use crate::record::{BY_SCENE, CaseState, Record};
use crate::say::say;
use crate::show::case as full;
use crate::show::paint::Paint;
use crate::show::summary::{EarlierCases, Lines, Verdict};
use crate::suite::{self, CaseRun};
use clap::Args;
use earlier::Earlier;
use generated::GeneratedChoices;
use mill::Mill;
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::simulation::Options;
use proctor_verification::case::{self, Case, Size};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Run verification cases: errors, observed orders, gates.
///
/// Each case compares runs on finer and finer meshes with an exact solution and prints a line: how many gates hold, how
/// much of its bound the nearest gate uses, the error on the finest mesh, and the time. A case that fails prints
/// everything. The exit code is 1 if a gate fails.
#[derive(Args)]
#[command(after_help = "Example: proctor verify boussinesq base-acceleration\n\
    A short ladder, as record: proctor verify --quick --json record.json\n\
    On two ranks: proctor verify --quick --ranks 2\n\
    After Ctrl-C, or a case that failed: proctor verify --resume record.json\n\
    A thousand random scenes: proctor verify --generated 1000 --seed 7\n\
    A hundred manufactured solutions: proctor verify mill --count 100 --seed 7\n\
    The error bars of `proctor refine` against known errors: proctor verify refine")]
pub struct Verify {
    /// Cases to run [default: all]; `mill` alone runs manufactured solutions: random motions whose body force follows from
    /// them, on finer and finer meshes, judged by orders and errors; `refine` alone judges the error bars of `proctor refine`
    /// on kept ladders whose errors are known
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Run the short ladder of each case
    #[arg(long)]
    quick: bool,
    /// Write a record of all runs (Google Benchmark JSON); Ctrl-C finishes the run and marks the record incomplete
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Repeat runs shorter than a second N times, and very short ones for half a second, so that `compare` can judge times
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    repetitions: u16,
    /// Print the names of the cases and run none
    #[arg(long)]
    list: bool,
    /// Run the cases that this record lacks or that failed in it, on its ladders, and complete it (with --json a copy of it)
    #[arg(long, value_name = "RECORD", conflicts_with_all = ["failed", "quick", "list"])]
    resume: Option<PathBuf>,
    /// Run only the cases that failed in this record, on its ladders [default: that of the main job]
    #[arg(long, value_name = "RECORD", num_args = 0..=1, default_missing_value = MAIN_JOB, conflicts_with_all = ["quick", "list"])]
    failed: Option<PathBuf>,
    /// Run N small random scenes instead of cases, judged by what holds of every scene: conservation, invariance,
    /// equilibrium. A scene that violates its property is written as a scene file; --json FILE writes the result
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with_all = ["cases", "quick", "list", "resume", "failed", "repetitions"])]
    generated: Option<u64>,
    /// Seed of generated scenes or of the mill: the same seed gives the same scenes or problems [default: 1]
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Number of problems of the mill [default: 30]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "problem")]
    count: Option<u64>,
    /// Number of the first problem of the mill, so that a run goes on where another ended [default: 0]
    #[arg(long, value_name = "N", conflicts_with = "problem")]
    first: Option<u64>,
    /// Write each problem of the mill as a file, not only those that miss a gate
    #[arg(long, conflicts_with = "problem")]
    keep: bool,
    /// Run this problem of the mill instead of random ones: a file that the mill wrote for a problem that missed a gate
    #[arg(long, value_name = "FILE")]
    problem: Option<PathBuf>,
    /// Record of full ladders for `refine` [default: fixtures/expected/full.json]
    #[arg(long, value_name = "RECORD")]
    ladders: Option<PathBuf>,
    /// Folder for generated scenes that violate their property, or problems that miss a gate
    /// [default: target/proctor/generated or target/proctor/mill]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Share each step of each case among N ranks, threads of this process: the numbers must be those of one. Cases that ranks
    /// do not share are left out, with the reason
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..), conflicts_with_all = ["generated", "resume"])]
    ranks: u16,
    #[command(flatten)]
    amount: Amount,
    #[command(flatten)]
    settings: Settings,
}

/// The record of the main job.
const MAIN_JOB: &str = "target/proctor/record.json";

/// Seed where none is given.
const SEED: u64 = 1;
/// Folder for generated scenes that violate their property.
const GENERATED: &str = "target/proctor/generated";
/// Folder for problems of the mill that miss a gate.
const MILLED: &str = "target/proctor/mill";

/// Work of the verb.
struct Task {
    cases: Vec<&'static Case>,
    size: Size,
    /// Record before the first case.
    record: Record,
    /// File of the record.
    file: Option<PathBuf>,
    /// Cases that were asked for then or now, those that are not run again too.
    asked: Vec<&'static Case>,
}

impl Verify {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        self.go_together()?;
        if self.mills() {
            return self.mill(out);
        }
        if self.calibrates() {
            let table = self.amount.more_than_the_verdict();
            let options = self.settings.options()?;
            return refine::run(self.ladders.as_deref(), &options, table, out);
        }
        let chosen = names::chosen(&self.cases, case::all(), "case", Case::name)?;
        if self.list {
            for case in chosen {
                writeln!(out, "{}", case.name())?;
            }
            return Ok(Outcome::Fine);
        }
        let options = self.settings.options()?;
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        if let Some(count) = self.generated {
            if !self.amount.more_than_the_verdict() {
                progress::hide();
            }
            return GeneratedChoices {
                count,
                seed: self.seed.unwrap_or(SEED),
                threads: options.threads,
                folder: self.out.as_deref().unwrap_or(Path::new(GENERATED)),
                json: self.json.as_deref(),
                table: self.amount.more_than_the_verdict(),
            }
            .run(out);
        }
        let task = self.task(&options, &chosen)?;
        if let (Some(path), true) = (&self.failed, task.cases.is_empty()) {
            writeln!(out, "no case failed in {}", path.display())?;
            return Ok(Outcome::Fine);
        }
        if let (Some(path), true) = (&self.resume, task.record.rows.is_empty()) {
            let count = task.cases.len();
            say!(
                "{}: holds no case that held; all {count} are run",
                path.display()
            );
        }
        let interrupt = Interrupt::listen()?;
        if !self.amount.more_than_the_verdict() {
            progress::hide();
        }
        self.work(task, &options, &interrupt, out)
    }

    /// True where the mill is meant, not cases.
    fn mills(&self) -> bool {
        self.cases.iter().any(|name| name == mill::NAME)
    }

    /// True where an option is given that belongs to the mill alone.
    fn of_mill(&self) -> bool {
        self.count.is_some() || self.first.is_some() || self.keep || self.problem.is_some()
    }

    /// True where the calibration of error bars is meant, not cases.
    fn calibrates(&self) -> bool {
        self.cases.iter().any(|name| name == refine::NAME)
    }

    /// Looks at arguments that belong to random scenes and problems alone.
    ///
    /// # Errors
    /// An option without the verb that it belongs to, or the mill together with options of cases.
    fn go_together(&self) -> Result<(), Failure> {
        let of_record = self.quick || self.list || self.repetitions > 1;
        let of_record = of_record || self.resume.is_some() || self.failed.is_some();
        let with_mill = self.cases.len() > 1 || of_record;
        let fault = if self.calibrates() {
            let with_refine = with_mill || self.json.is_some() || self.generated.is_some();
            let with_refine = with_refine || self.seed.is_some() || self.out.is_some();
            with_refine.then_some("found `refine` beside cases or their options; accepted: `refine` alone, with --ladders")
        } else if self.ladders.is_some() {
            Some(
                "found --ladders without `refine`; accepted: proctor verify refine --ladders RECORD",
            )
        } else if self.mills() {
            with_mill.then_some("found `mill` beside other cases or options of cases; accepted: `mill` alone, with --seed, --count, --first, --keep, --problem, --out, --json and --threads")
        } else if self.of_mill() {
            Some(
                "found --count, --first, --keep or --problem without `mill`; accepted: proctor verify mill --count N",
            )
        } else if self.generated.is_none() && (self.seed.is_some() || self.out.is_some()) {
            Some(
                "found --seed or --out without random scenes; accepted: with --generated N or `mill`",
            )
        } else {
            None
        };
        fault.map_or(Ok(()), |fault| Err(Failure::BadInput(fault.to_owned())))
    }

    /// Runs the mill.
    fn mill(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if !self.amount.more_than_the_verdict() {
            progress::hide();
        }
        Mill {
            count: self.count.unwrap_or(mill::COUNT),
            first: self.first.unwrap_or(0),
            seed: self.seed.unwrap_or(SEED),
            keep: self.keep,
            problem: self.problem.as_deref(),
            threads: self.settings.options()?.threads,
            folder: self.out.as_deref().unwrap_or(Path::new(MILLED)),
            json: self.json.as_deref(),
            table: self.amount.more_than_the_verdict(),
        }
        .run(out)
    }

    /// Work of the verb, and the record that it goes into.
    fn task(&self, options: &Options, chosen: &[&'static Case]) -> Result<Task, Failure> {
        let mut record = Record::new(options);
        record.set_ranks(self.ranks.into());
        let all = case::all().len();
        if let Some(path) = &self.resume {
            let earlier = Earlier::read(path)?;
            let states = [CaseState::Missing, CaseState::Failed];
            let cases = earlier.those(chosen, &states);
            let states = [CaseState::Missing, CaseState::Failed, CaseState::Held];
            return Ok(Task {
                record: earlier.without(&cases, &record, path, self.json.is_none())?,
                size: earlier.size(),
                asked: earlier.those(case::all(), &states),
                file: Some(self.json.clone().unwrap_or_else(|| path.clone())),
                cases,
            });
        }
        let (cases, size) = match &self.failed {
            Some(path) => {
                let earlier = Earlier::read(path)?;
                earlier.holds_cases(path)?;
                (earlier.those(chosen, &[CaseState::Failed]), earlier.size())
            }
            None if self.quick => (chosen.to_vec(), Size::Quick),
            None => (chosen.to_vec(), Size::Full),
        };
        record.set_ladder(size);
        let names: Vec<&str> = cases.iter().map(|case| case.name()).collect();
        record.set_cases(&names, all);
        Ok(Task {
            asked: cases.clone(),
            cases,
            size,
            record,
            file: self.json.clone(),
        })
    }

    fn work(
        &self,
        task: Task,
        options: &Options,
        interrupt: &Interrupt,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        let Task {
            cases,
            size,
            mut record,
            file,
            asked,
        } = task;
        let begun = Instant::now();
        let kept = EarlierCases::of(&record, &asked, size);
        // Until all is done. A process that is killed leaves it so.
        record.set_incomplete(true);
        let write = |record: &Record| match &file {
            Some(path) => record.write(path).map_err(Failure::bad_input),
            None => Ok(()),
        };
        // An empty record now rather than a file that cannot be written after minutes.
        write(&record)?;
        let paint = Paint::of_standard_output();
        let lines = Lines::new(paint, cases.iter().map(|case| case.name()));
        if !self.amount.all() && self.amount.more_than_the_verdict() && !cases.is_empty() {
            lines.heading(out)?;
            out.flush()?;
        }
        let expected = cases.iter().map(|case| ladders::seconds(case.name(), size));
        let whole = Whole::new("verify", expected.collect(), 1);
        let threads = options.threads.unwrap_or(BY_SCENE);
        let mut all: Vec<CaseRun> = vec![];
        let mut left_out: Vec<(&str, String)> = vec![];
        for (number, &case) in cases.iter().enumerate() {
            let go = || !interrupt.raised();
            let mut at = |share| whole.at(number, share);
            let (repetitions, ranks) = (self.repetitions.into(), self.ranks.into());
            let ran = suite::run_while(case, size, options, repetitions, ranks, &go, &mut at);
            if let Some(reason) = ran.unshared() {
                left_out.push((case.name(), reason.to_owned()));
                continue;
            }
            record.push_case(&ran, threads);
            // What was done so far is there, whatever happens to this process.
            write(&record)?;
            // Of a case that was interrupted the verdict is about a part.
            if interrupt.raised() {
                break;
            }
            progress::above(|| self.tell(&ran, &lines, out))?;
            all.push(ran);
        }
        drop(whole);
        for (name, reason) in &left_out {
            writeln!(out, "left out: {name}: {reason}")?;
        }
        let verdict = Verdict {
            cases: &all,
            kept,
            asked: cases.len() - left_out.len() + kept.cases,
            also_failed: &[],
            worse: false,
            interrupted: interrupt.raised(),
            of_stability: None,
            took: begun.elapsed(),
        };
        verdict.line(paint, out)?;
        let missing = |case: &&&Case| {
            let left_out = left_out.iter().any(|(name, _)| *name == case.name());
            !left_out && record.case_state(case, size) == CaseState::Missing
        };
        let incomplete = interrupt.raised() || asked.iter().any(|case| missing(&case));
        record.set_incomplete(incomplete);
        record.sort_cases(&earlier::names());
        write(&record)?;
        if self.amount.more_than_the_verdict() {
            verdict.busy(paint, out)?;
            if let Some(path) = &file {
                let word = if incomplete {
                    "incomplete record"
                } else {
                    "record"
                };
                writeln!(out, "{word} in {}", path.display())?;
            }
        }
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if verdict.held() {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }

    /// Prints a case.
    fn tell(&self, ran: &CaseRun, lines: &Lines, out: &mut dyn Write) -> std::io::Result<()> {
        if self.amount.all() {
            full::runs(ran, out)?;
            full::tables(ran, out)?;
            full::gates(ran, true, out)?;
            full::for_the_record(ran, out)?;
        } else if self.amount.more_than_the_verdict() {
            lines.case(ran, out)?;
        }
        out.flush()
    }
}
