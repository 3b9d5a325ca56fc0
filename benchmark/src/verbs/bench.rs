//! `proctor bench`: the configurable multi-thread benchmark.

use super::folder::Folder;
use super::settings::{Lanes, OPTION, bounded};
use crate::bench::Session;
use crate::bench::config::{CommandLineChoices, Config, FILE};
use crate::bench::counted::Earlier;
use crate::bench::tables::Report;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::record::Record;
use crate::say::say;
use clap::Args;
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::simulation::Options;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Measure speed: scenes x particles x threads x methods, single stages, other executables.
///
/// CONFIG is the benchmark-configuration.json of the technical manual, or that of its start-multi-benchmark, with
/// more keys: scenes, particles, threads, shape_function, stress_scheme_update, transfer (each one value or a list),
/// repetitions, warm_up, particle_steps, stages, executables. What is missing takes a default; --log says which.
/// All combinations are measured in turn, once per repetition, and nothing runs beside a sample.
#[derive(Args)]
#[command(after_help = "Example: proctor bench --quick\n\
    With a configuration, as record and table: proctor bench fixtures/bench/peers.json --json bench.json --csv bench.csv\n\
    The median counts; spread is the largest less the smallest time, over the median.")]
pub struct Bench {
    /// Configuration (JSON) [default: benchmark-configuration.json, where there is one]
    config: Option<PathBuf>,
    /// Numbers of threads, joined by commas; they override the configuration
    #[arg(long, value_name = "N", value_delimiter = ',')]
    threads: Vec<NonZeroUsize>,
    /// Samples of each combination, 3 or more; overrides the configuration
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(3..))]
    repetitions: Option<u32>,
    /// Take short samples of few particles, unless the configuration gives their number
    #[arg(long)]
    quick: bool,
    /// Vector lanes of the inner loops; auto takes the widest that the machine has
    #[arg(long, value_enum, default_value_t = Lanes::Auto)]
    lanes: Lanes,
    /// List the values that took their default
    #[arg(long)]
    log: bool,
    /// Write a record of all samples (Google Benchmark JSON)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all samples as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Keep scenes and results of executables in this folder [default: they are removed]
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Measure nothing: name the instruction counts of this record whose sources, in this folder, changed since; exit
    /// code 1 where there are any
    #[arg(long, value_name = "RECORD", exclusive = true)]
    uncounted: Option<PathBuf>,
}

impl Bench {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if let Some(record) = &self.uncounted {
            return uncounted(record, out);
        }
        let options = Options {
            lanes: self.lanes.into(),
            ..Options::default()
        };
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        // A configuration is one for several machines and may ask for more, which is warned of there.
        for threads in &self.threads {
            bounded(OPTION, threads.get())?;
        }
        let config = self.config()?;
        let mut session = Session::new(&config, options.lanes).map_err(Failure::bad_input)?;
        let mut record = Record::new(&options);
        // From here on an interrupt leaves files that say they are incomplete.
        let stop = Interrupt::listen()?;
        record.set_incomplete(true);
        // Empty files now rather than files that cannot be written after minutes.
        self.write(&record)?;
        let folder = Folder::new(self.keep.as_deref())?;
        session.run(&mut record, folder.path(), stop.flag());
        let interrupted = stop.raised();
        record.set_incomplete(interrupted);
        self.write(&record)?;
        write!(out, "{}", Report::new(&session, &record))?;
        for path in self.json.iter().chain(&self.csv) {
            writeln!(out, "written: {}", path.display())?;
        }
        if interrupted {
            writeln!(out, "interrupted: the measurements until then")?;
            return Ok(stop.outcome());
        }
        let sound = record.rows.iter().all(|row| row.error.is_none());
        Ok(if sound {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }

    /// The configuration, with what was said of it on standard error.
    fn config(&self) -> Result<Config, Failure> {
        let asked = CommandLineChoices {
            threads: self.threads.iter().map(|n| n.get()).collect(),
            repetitions: self.repetitions.map(|n| n as usize),
            quick: self.quick,
        };
        let config = match &self.config {
            Some(path) => Config::read(path, &asked),
            None if Path::new(FILE).is_file() => Config::read(Path::new(FILE), &asked),
            None => Config::from_json("{}", FILE, Path::new(""), &asked),
        }
        .map_err(Failure::bad_input)?;
        for warning in &config.warnings {
            say!("warning: {warning}");
        }
        if self.log {
            for default in &config.defaults {
                say!("default: {default}");
            }
        }
        Ok(config)
    }

    fn write(&self, record: &Record) -> Result<(), Failure> {
        if let Some(path) = &self.json {
            record.write(path).map_err(Failure::bad_input)?;
        }
        if let Some(path) = &self.csv {
            record.write_csv(path).map_err(Failure::bad_input)?;
        }
        Ok(())
    }
}

/// Counts whose sources changed since a record, in the workspace of the current folder.
fn uncounted(record: &Path, out: &mut dyn Write) -> Result<Outcome, Failure> {
    let context = Record::new(&Options::default()).context;
    let compiler = context["rustc"].as_str().unwrap_or_default();
    let names = Earlier::read(Path::new(""), compiler, Some(record))
        .and_then(|earlier| earlier.uncounted())
        .map_err(|error| Failure::BadInput(format!("{}: {error}", record.display())))?;
    for name in &names {
        writeln!(out, "{name}")?;
    }
    writeln!(
        out,
        "{} counts depend on sources that changed since {}",
        names.len(),
        record.display()
    )?;
    Ok(if names.is_empty() {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}
