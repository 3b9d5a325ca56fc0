//! `proctor precision`: error against run time.

use super::folder::Folder;
use super::names;
use super::settings::Settings;
use crate::bench::config::{CommandLineChoices, Config, Executable};
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::precision::bounds::{self, Bound};
use crate::precision::peers::Visit;
use crate::precision::{CaseStudy, Effort, peers, rows, run};
use crate::progress::Progress;
use crate::record::Record;
use crate::show::{figures, precision as show};
use clap::Args;
use proctor_files::output::atomic;
use proctor_kernel::lanes::SelectedLanes;
use proctor_verification::case::{self, Size};
use proctor_verification::study;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Error against run time, for every case with an exact solution.
///
/// Each case is solved with every combination of weighting function, stress scheme and transfer: on finer and finer
/// meshes at a fixed Courant number (0.8 of the kernel's bound) and two particles per cell and axis, then on one mesh
/// with smaller steps and with other numbers of particles. Time is that of the stepping loop alone, the fastest of the
/// repetitions: processor time on one thread (the default), wall time on several. A run longer than two seconds is
/// done once. What an accuracy costs is interpolated along a line, never extrapolated. Combinations without a step
/// that is safe for every body are tried, and marked with `!`.
#[derive(Args)]
#[command(
    after_help = "Example: proctor precision bar axis-aligned --svg charts --csv precision.csv\n\
    The usual combinations on coarse meshes, in seconds: proctor precision --quick\n\
    With other solvers: proctor precision boussinesq --executables peer.json --svg charts\n\
    Which cases those can run: proctor precision --guests",
    mut_arg("threads", |arg| arg.help("Number of threads [default: 1]"))
)]
pub struct Precision {
    /// Cases to study [default: all]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Only the usual methods on coarse meshes, without sweeps
    #[arg(long)]
    quick: bool,
    /// Only the method of each case itself, without sweeps. Several cases that study the same error are set beside each
    /// other: what 1 % costs with each, and a chart of both
    #[arg(long)]
    own: bool,
    /// Write a record of all runs (Google Benchmark JSON)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all runs as comma-separated values
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a chart for each case and error into this folder; created if it does not exist
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    /// Runs of each point
    #[arg(long, value_name = "N", default_value = "3")]
    repetitions: NonZeroUsize,
    /// Show all methods in the tables, not only the best twelve and the default
    #[arg(long)]
    all: bool,
    /// Other solvers, beside the methods: a configuration with `executables`, as for `bench`. Each is calibrated by a
    /// free fall first; a case that other solvers cannot run says why
    #[arg(long, value_name = "FILE")]
    executables: Option<PathBuf>,
    /// Bound on the error of a case that other solvers must keep, such as self-weight=2%; without one it is twice the error
    /// of this program's own process, or 1 % where that is more
    #[arg(long, value_name = "CASE=SHARE", requires = "executables")]
    bound: Vec<String>,
    /// List which cases other solvers can run and what each needs, and why the others cannot be
    #[arg(long, conflicts_with_all = ["executables", "json", "csv", "svg"])]
    guests: bool,
    /// Keep scenes and results of executables in this folder, beside them the exact field and the error of each particle as a
    /// frame [default: they are removed]
    #[arg(long, value_name = "DIR", requires = "executables")]
    keep: Option<PathBuf>,
    #[command(flatten)]
    settings: Settings,
}

impl Precision {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if self.guests {
            let all = case::all().iter().copied();
            let without: Vec<_> = all
                .filter(|case| self.cases.is_empty() && case.open().is_empty())
                .collect();
            show::guests::list(&names::open(&self.cases)?, &without, out)?;
            return Ok(Outcome::Fine);
        }
        let studies = names::studies(&self.cases)?;
        let bounds = self.bounds()?;
        let mut options = self.settings.options()?;
        // Small runs gain nothing from threads, and their times would say more about waiting than about work.
        let threads = *options.threads.get_or_insert(1);
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        let effort = Effort {
            size: if self.quick { Size::Quick } else { Size::Full },
            repetitions: self.repetitions.get(),
            own: self.own,
        };
        let executables = self.executables()?;
        let folder = Folder::new(self.keep.as_deref())?;
        let mut record = Record::new(&options);
        self.can_write(&record)?;
        let interrupt = Interrupt::listen()?;
        let mut sound = true;
        let visit = Visit {
            effort,
            longest: None,
            threads,
            folder: folder.path(),
            stop: interrupt.flag(),
        };
        let peers = match executables {
            None => None,
            Some(executables) => {
                let mut rows = vec![];
                let words = peers::words(&studies, effort.size);
                let peers = peers::calibrated(executables, &words, &visit, &mut rows);
                show::calibrations(&peers, out)?;
                out.flush()?;
                sound = peers.iter().all(|peer| peer.calibration.is_ok());
                for row in rows {
                    record.push(row);
                }
                Some(peers)
            }
        };
        let mut studied: Vec<CaseStudy> = vec![];
        for study in studies {
            let mut progress = Progress::new(study.name());
            let mut at = |share| progress.at(share);
            let mut ran = run::run(study, effort, &options, interrupt.flag(), &mut at);
            drop(progress);
            if let Some(peers) = &peers
                && !interrupt.raised()
            {
                match peers::run(study, peers, &visit) {
                    Ok(lines) => ran.peers = lines,
                    Err(reason) => ran.no_peers = Some(reason),
                }
                let mut runs = ran.peers.iter().flat_map(|line| &line.runs);
                sound &= runs.all(|run| run.error.is_ok());
            }
            let gates = bounds::gates(&ran, &bounds);
            show::study(&ran, self.all, out)?;
            sound &= show::guests::gates(&gates, out)?;
            out.flush()?;
            record.push_study(&ran, threads);
            record.push_bounds(&gates);
            studied.push(ran);
            if interrupt.raised() {
                record.set_incomplete(true);
                break;
            }
        }
        if self.own {
            show::beside::cases(&studied, out)?;
        }
        self.write(&record, &studied, out)?;
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if sound {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }

    /// The bounds, each of a case that there is.
    fn bounds(&self) -> Result<Vec<Bound>, Failure> {
        let one = |text: &String| {
            let bound: Bound = text
                .parse()
                .map_err(|fault| Failure::BadInput(format!("--bound: {fault}")))?;
            names::chosen(
                std::slice::from_ref(&bound.case),
                &study::all(),
                "case",
                |study| study.name(),
            )?;
            Ok(bound)
        };
        self.bound.iter().map(one).collect()
    }

    /// The executables of the configuration, where one is given.
    fn executables(&self) -> Result<Option<Vec<Executable>>, Failure> {
        let Some(path) = &self.executables else {
            return Ok(None);
        };
        let name = path.display();
        if !path.is_file() {
            let message =
                format!("{name}: no such file; accepted: a configuration with `executables`");
            return Err(Failure::BadInput(message));
        }
        let config =
            Config::read(path, &CommandLineChoices::default()).map_err(Failure::bad_input)?;
        if config.executables.is_empty() {
            let message = format!(
                "{name}: executables: found none; accepted: an object of named executables"
            );
            return Err(Failure::BadInput(message));
        }
        Ok(Some(config.executables))
    }

    /// Finds out now, not after minutes, whether everything can be written.
    fn can_write(&self, record: &Record) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
        }
        if let Some(path) = &self.csv {
            atomic::write(path, |_| Ok(())).map_err(Failure::bad_input)?;
        }
        if let Some(folder) = &self.svg {
            std::fs::create_dir_all(folder)
                .map_err(|e| Failure::BadInput(format!("{}: {e}", folder.display())))?;
        }
        Ok(())
    }

    fn write(
        &self,
        record: &Record,
        studied: &[CaseStudy],
        out: &mut dyn Write,
    ) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
            writeln!(out, "record in {}", path.display())?;
        }
        if let Some(path) = &self.csv {
            atomic::write(path, |file| {
                for (i, studied) in studied.iter().enumerate() {
                    rows::csv(studied, i == 0, file).map_err(std::io::Error::other)?;
                }
                Ok(())
            })
            .map_err(Failure::bad_input)?;
            writeln!(out, "all runs in {}", path.display())?;
        }
        if let Some(folder) = &self.svg {
            for studied in studied {
                charts(studied, folder, out)?;
            }
            if self.own {
                for word in show::beside::words(studied) {
                    let of = show::beside::of(studied, word);
                    let names = of.iter().map(|(studied, _)| studied.study.name());
                    let names: Vec<&str> = names.collect();
                    let path = folder.join(format!("{}-{word}.svg", names.join("-")));
                    let svg = figures::cases_beside(&of, word).to_svg();
                    atomic::write(&path, |file| file.write_all(svg.as_bytes()))
                        .map_err(Failure::bad_input)?;
                    writeln!(out, "chart in {}", path.display())?;
                }
            }
        }
        Ok(())
    }
}

/// One chart per measure of a study.
fn charts(studied: &CaseStudy, folder: &Path, out: &mut dyn Write) -> Result<(), Failure> {
    for (number, measure) in studied.study.measures().iter().enumerate() {
        let path = folder.join(format!("{}-{}.svg", studied.study.name(), measure.word));
        let svg = figures::error_against_time(studied, number).to_svg();
        atomic::write(&path, |file| file.write_all(svg.as_bytes())).map_err(Failure::bad_input)?;
        writeln!(out, "chart in {}", path.display())?;
    }
    Ok(())
}
