//! `proctor verify`: cases, errors, observed orders, gates.

use super::names;
use super::settings::Settings;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::record::{BY_SCENE, Record};
use crate::say::say;
use crate::show::case as show;
use crate::suite::{self, Ran};
use clap::Args;
use proctor_kernel::lanes::Selected;
use proctor_verification::case::{self, Case, Size};
use std::io::Write;
use std::path::PathBuf;

/// Run verification cases: errors, observed orders, gates.
///
/// Each case compares runs over a ladder of resolutions with an exact solution. The exit code is 1 if a gate fails.
#[derive(Args)]
#[command(after_help = "Example: proctor verify boussinesq base-acceleration\n\
    A short ladder, as record: proctor verify --quick --json record.json")]
pub struct Verify {
    /// Cases to run [default: all]
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Run the short ladder of each case
    #[arg(long)]
    quick: bool,
    /// Write a record of all runs (Google Benchmark JSON); Ctrl-C finishes the run and marks the record incomplete
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Take the time of runs shorter than a second N times, of very short ones for half a second, for `compare`
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    repetitions: u16,
    /// Print the names of the cases and run none
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    settings: Settings,
}

impl Verify {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let cases = names::chosen(&self.cases, case::all(), "case", Case::name)?;
        if self.list {
            for case in cases {
                writeln!(out, "{}", case.name())?;
            }
            return Ok(Outcome::Fine);
        }
        let options = self.settings.options();
        Selected::new(options.lanes).map_err(Failure::bad_input)?;
        let size = if self.quick { Size::Quick } else { Size::Full };
        let threads = options.threads.unwrap_or(BY_SCENE);
        let interrupt = Interrupt::listen()?;
        let mut record = Record::new(&options);
        record.set_ladder(size);
        // Until all is done. A process that is killed leaves it so.
        record.set_incomplete(true);
        if let Some(path) = &self.json {
            // An empty record now rather than a file that cannot be written after minutes.
            record.write(path).map_err(Failure::bad_input)?;
        }
        let mut all: Vec<Ran> = vec![];
        for case in cases {
            let go = || !interrupt.raised();
            let ran = suite::run_while(case, size, &options, self.repetitions.into(), &go);
            record.push_case(&ran, threads);
            if interrupt.raised() {
                return self.interrupted(&record);
            }
            show::runs(&ran, out)?;
            show::tables(&ran, out)?;
            show::gates(&ran, true, out)?;
            show::for_the_record(&ran, out)?;
            out.flush()?;
            all.push(ran);
        }
        show::total(&all, out)?;
        record.set_incomplete(false);
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
            writeln!(out, "record in {}", path.display())?;
        }
        Ok(if all.iter().all(Ran::passed) {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }

    /// Writes what was measured until Ctrl-C.
    fn interrupted(&self, record: &Record) -> Result<Outcome, Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
            say!("interrupted; incomplete record in {}", path.display());
        }
        Ok(Outcome::Interrupted)
    }
}
