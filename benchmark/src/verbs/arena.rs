//! `proctor arena`: other solvers beside this program on all open cases.

use super::folder::Folder;
use super::names;
use super::settings::Settings;
use crate::arena::{self, Board, METHODS, Solvers, speed};
use crate::bench::config::{CommandLineChoices, Config, Method};
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::precision::Effort;
use crate::precision::peers::{self, Visit};
use crate::progress::Progress;
use crate::record::Record;
use crate::say::say;
use crate::show;
use crate::show::figures;
use clap::Args;
use proctor_files::output::atomic;
use proctor_kernel::lanes::SelectedLanes;
use proctor_verification::case::Size;
use proctor_verification::study;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Run other solvers on all open cases, in one table and one picture.
///
/// CONFIG names the `executables`, as for `bench`, and with `methods` the methods of this program that stand beside them. Each
/// solver is calibrated by a free fall, then runs each case on finer and finer meshes. Times are those of the processors, without
/// the start-up, which the free fall takes. A solver that ends with exit code 77 skips the case, or in the free fall all of them;
/// every other failure has a row with its reason, and the rest goes on.
#[derive(Args)]
#[command(
    after_help = "Example: proctor arena fixtures/guests/arena.json --quick --svg arena.svg --json arena.json\n\
    The page of it: proctor report arena.json\n\
    CPU per particle and step: proctor arena fixtures/guests/arena.json --speed\n\
    Exit code 1 if a run failed, 2 for bad input or where every other solver was skipped.",
    mut_arg("threads", |arg| arg.help("Number of threads [default: 1]"))
)]
pub struct Arena {
    /// Configuration with `executables` (JSON)
    config: PathBuf,
    /// Cases to run, of those that `proctor precision --guests` lists [default: all that are open]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Only the coarse meshes of the short studies, each run once
    #[arg(long)]
    quick: bool,
    /// The speed problem in place of the cases: CPU per particle and step of a flying neo-Hookean block, for each number of
    /// `particles` of the configuration
    #[arg(long, conflicts_with = "cases")]
    speed: bool,
    /// Runs of each point, the fastest of which counts [default: 1 with --quick, else 3]
    #[arg(long, value_name = "N")]
    repetitions: Option<NonZeroUsize>,
    /// After a run that took longer by the clock (s), a solver gets no finer mesh of the case
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = positive)]
    longest: f64,
    /// Time by the clock (s) after which a run is ended, where the configuration allows more
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    timeout: Option<f64>,
    /// Write a record of all runs (Google Benchmark JSON)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the picture, error against CPU time for each case
    #[arg(long, value_name = "FILE", conflicts_with = "speed")]
    svg: Option<PathBuf>,
    /// Keep scenes and results in this folder [default: they are removed]
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    #[command(flatten)]
    settings: Settings,
}

/// A number of seconds above zero.
fn positive(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "no number".to_owned())?;
    if Duration::try_from_secs_f64(seconds).is_ok_and(|time| !time.is_zero()) {
        Ok(seconds)
    } else {
        Err("a number of seconds above zero is accepted".to_owned())
    }
}

impl Arena {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let problems = self.problems()?;
        let mut options = self.settings.options()?;
        let threads = *options.threads.get_or_insert(1);
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        let config = self.config()?;
        let folder = Folder::new(self.keep.as_deref())?;
        let mut record = Record::new(&options);
        self.can_write(&record)?;
        let interrupt = Interrupt::listen()?;
        let methods = own_methods(&config);
        let repetitions = self
            .repetitions
            .map_or(if self.quick { 1 } else { 3 }, NonZeroUsize::get);
        let visit = Visit {
            effort: Effort {
                size: if self.quick { Size::Quick } else { Size::Full },
                repetitions,
                own: false,
            },
            longest: Duration::try_from_secs_f64(self.longest).ok(),
            threads,
            folder: folder.path(),
            stop: interrupt.flag(),
        };
        let words = if self.speed {
            vec![]
        } else {
            peers::words(&problems, visit.effort.size)
        };
        let executables = config.executables;
        let solvers = Solvers::calibrated(&methods, executables, &words, &visit, &mut record);
        let mut sound = solvers.sound;
        if self.speed {
            sound &= speed::run(&solvers, &config.particles, &visit, &mut record);
        } else {
            let all = problems.len().max(1) as f64;
            for (i, problem) in problems.into_iter().enumerate() {
                let mut progress = Progress::new(problem.name());
                progress.at(i as f64 / all);
                sound &= arena::run(problem, &solvers.peers, &visit, &mut record);
                if interrupt.raised() {
                    break;
                }
            }
        }
        record.set_incomplete(interrupt.raised());
        self.show(&record, out)?;
        self.write(&record, out)?;
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if !sound {
            Outcome::Failed
        } else if solvers.guests == 0 {
            writeln!(out, "no other solver took part: nothing to compare")?;
            Outcome::CannotCompare
        } else {
            Outcome::Fine
        })
    }

    /// The open cases of the request.
    fn problems(&self) -> Result<Vec<arena::Problem>, Failure> {
        let studies = names::open(&self.cases)?;
        let (open, closed) = arena::open(studies);
        match closed.first().filter(|_| !self.cases.is_empty()) {
            Some((name, reason)) => {
                let names: Vec<&str> = arena::open(study::open())
                    .0
                    .iter()
                    .map(proctor_verification::study::Study::name)
                    .collect();
                Err(Failure::BadInput(format!(
                    "{name}: not for other solvers: {reason}; accepted: {}",
                    names.join(", ")
                )))
            }
            None => Ok(open),
        }
    }

    fn config(&self) -> Result<Config, Failure> {
        let name = self.config.display();
        if !self.config.is_file() {
            let message =
                format!("{name}: no such file; accepted: a configuration with `executables`");
            return Err(Failure::BadInput(message));
        }
        let asked = CommandLineChoices {
            quick: self.quick,
            ..CommandLineChoices::default()
        };
        let mut config = Config::read(&self.config, &asked).map_err(Failure::bad_input)?;
        for warning in &config.warnings {
            say!("warning: {warning}");
        }
        if config.executables.is_empty() {
            let message = format!(
                "{name}: executables: found none; accepted: an object of named executables"
            );
            return Err(Failure::BadInput(message));
        }
        let longest = self
            .timeout
            .and_then(|s| Duration::try_from_secs_f64(s).ok());
        for executable in &mut config.executables {
            executable.timeout = executable.timeout.min(longest.unwrap_or(Duration::MAX));
        }
        Ok(config)
    }

    /// Finds out now, not after minutes, whether everything can be written.
    fn can_write(&self, record: &Record) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
        }
        if let Some(path) = &self.svg {
            write_text(path, "")?;
        }
        Ok(())
    }

    fn show(&self, record: &Record, out: &mut dyn Write) -> Result<(), Failure> {
        if self.speed {
            show::arena::speed(record, out)?;
        }
        match Board::of(record) {
            Some(board) => show::arena::board(&board, out)?,
            None if self.speed => {}
            None => writeln!(out, "no case was run")?,
        }
        Ok(())
    }

    fn write(&self, record: &Record, out: &mut dyn Write) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
            writeln!(out, "record in {}", path.display())?;
        }
        if let (Some(path), Some(board)) = (&self.svg, Board::of(record)) {
            write_text(path, &figures::arena(&board))?;
            writeln!(out, "picture in {}", path.display())?;
        }
        Ok(())
    }
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    atomic::write(path, |file| file.write_all(text.as_bytes())).map_err(Failure::bad_input)
}

/// The methods of this program: those of the configuration, or the usual ones.
fn own_methods(config: &Config) -> Vec<Method> {
    let given = config
        .methods
        .iter()
        .any(|method| *method != Method::default());
    if given {
        return config.methods.clone();
    }
    let of_words = |text: &&str| {
        let mut words = text.split(' ').map(str::to_owned);
        Method {
            weighting: words.next(),
            scheme: words.next(),
            transfer: words.next(),
        }
    };
    METHODS.iter().map(of_words).collect()
}
