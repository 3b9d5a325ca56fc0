//! `proctor noise`: A against A.

use super::names;
use super::settings::Settings;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::judge::noise;
use crate::progress::Progress;
use crate::record::{BY_SCENE, Record, Row};
use crate::show::Table;
use crate::suite;
use clap::Args;
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::simulation::Options;
use proctor_verification::case::{self, Case, Size};
use std::io::Write;
use std::path::PathBuf;

/// Repetitions of runs in a pass, as `scripts/compare-commits` has them.
const REPETITIONS: usize = 1;
/// The two sides that are the same program.
const SIDES: usize = 2;

/// Measure the noise of each case: the same program against itself.
///
/// Without RECORDS the short ladders are run on two sides that do not differ, case by case, in the order A B B A: some two
/// minutes a pass. With RECORDS (two or more of the same program, or folders of records) nothing is run. The band of a
/// case is the largest change of time between passes: of CPU time where a run has one thread, else by the clock. `sees` is
/// the least change of time that a comparison of so many pairs finds in nine of ten cases; it finds that out from its own
/// samples too, and needs no bands. Given them, `proctor compare --noise FILE` says nothing of changes below twice the band.
#[derive(Args)]
#[command(after_help = "Example: proctor noise --json noise.json, then\n  \
    proctor compare base.json head.json --noise noise.json\n\
    Of two cases alone, in a minute: proctor noise --cases \"bar rotation\"\n\
    From the records with which scripts/compare-commits HEAD~1 began, of the base against itself:\n  \
    proctor noise target/compare/records/first target/compare/records/second")]
pub struct Noise {
    /// Records of the same program, or folders of records
    #[arg(value_name = "RECORDS")]
    records: Vec<PathBuf>,
    /// Write the bands as a record
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Cases to run, joined by spaces [default: all]
    #[arg(
        long,
        value_name = "CASE ...",
        value_delimiter = ' ',
        conflicts_with = "records"
    )]
    cases: Vec<String>,
    /// Interleaved passes to run
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u64).range(3..))]
    passes: u64,
    /// Number of pairs for which to print the smallest change that a comparison would find
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = clap::value_parser!(u64).range(3..))]
    pairs: u64,
    #[command(flatten)]
    settings: Settings,
}

impl Noise {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let options = self.settings.options()?;
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        let (records, stopped) = if self.records.is_empty() {
            let cases = names::chosen(&self.cases, case::all(), "case", Case::name)?;
            let interrupt = Interrupt::listen()?;
            let mut empty = Record::new(&options);
            empty.set_incomplete(true);
            self.write(&empty)?;
            let records = measured(&cases, &options, self.passes, &interrupt);
            (records, interrupt.raised().then(|| interrupt.outcome()))
        } else {
            let records = self.records.iter().map(|path| Record::read_joined(path));
            let records = records.collect::<Result<Vec<_>, _>>();
            (records.map_err(Failure::bad_input)?, None)
        };
        let bands = match noise::bands(&records, self.pairs as usize) {
            Ok(bands) => bands,
            Err(_) if stopped.is_some() => vec![],
            Err(reason) => return Err(Failure::BadInput(reason)),
        };
        show(&bands, self.pairs, out)?;
        // Bands belong to the program and the machine that were measured.
        let mut record = records.into_iter().next().ok_or_else(|| {
            Failure::BadInput(
                "found no record; accepted: two or more of the same program".to_owned(),
            )
        })?;
        record.rows = bands;
        record.set_incomplete(stopped.is_some());
        self.write(&record)?;
        if let Some(path) = &self.json {
            writeln!(out, "bands in {}", path.display())?;
        }
        Ok(stopped.unwrap_or(Outcome::Fine))
    }

    fn write(&self, record: &Record) -> Result<(), Failure> {
        match &self.json {
            Some(path) => record.write(path).map_err(Failure::bad_input),
            None => Ok(()),
        }
    }
}

/// The short ladders on both sides, case by case in turn: the shorter the time between two runs that are compared, the less
/// the machine has changed. Whole passes only.
fn measured(
    cases: &[&'static Case],
    options: &Options,
    passes: u64,
    interrupt: &Interrupt,
) -> Vec<Record> {
    let threads = options.threads.unwrap_or(BY_SCENE);
    let mut sides = vec![Record::new(options); SIDES];
    let go = || !interrupt.raised();
    let mut progress = Progress::new("noise");
    let runs = passes as usize * cases.len() * SIDES;
    let mut done = 0;
    for pass in 0..passes {
        let mut measured = vec![Record::new(options); SIDES];
        for &case in cases {
            // A B, then B A: what grows while the machine works is on both sides.
            for turn in 0..SIDES {
                let one = &mut measured[(turn + pass as usize) % SIDES];
                let mut each = |share| progress.at((f64::from(done) + share) / runs as f64);
                let ran =
                    suite::run_while(case, Size::Quick, options, REPETITIONS, 1, &go, &mut each);
                one.push_case(&ran, threads);
                if interrupt.raised() {
                    return sides;
                }
                done += 1;
            }
        }
        for (side, one) in sides.iter_mut().zip(measured) {
            for mut row in one.rows {
                row.set_pass(pass);
                side.push(row);
            }
        }
    }
    sides
}

fn show(bands: &[Row], pairs: u64, out: &mut dyn Write) -> Result<(), Failure> {
    let mut table = Table::new(["case", "pairs", "median", "band", "sees"]);
    for row in bands {
        let percent = |key: &str| {
            let value = row.counters.get(key);
            value.map_or_else(String::new, |x| format!("{:.1} %", 100.0 * x))
        };
        let pairs = row.counters.get("noise_pairs").copied().unwrap_or_default();
        table.push([
            row.name.clone(),
            pairs.to_string(),
            percent("noise_median"),
            percent("noise_band"),
            row.counters.get(noise::SEES).map_or_else(
                || "nothing".to_owned(),
                |sees| format!("{:.0} %", 100.0 * sees),
            ),
        ]);
    }
    writeln!(
        out,
        "change of time between two sides that do not differ, and the least that {pairs} pairs would see\n\n{table}"
    )?;
    let mut seen: Vec<f64> = bands
        .iter()
        .map(|row| {
            row.counters
                .get(noise::SEES)
                .copied()
                .unwrap_or(f64::INFINITY)
        })
        .collect();
    seen.sort_by(f64::total_cmp);
    let ten = seen.iter().filter(|sees| **sees <= 0.1).count();
    writeln!(
        out,
        "{pairs} pairs would see a change of 10 % or less in {ten} of {} cases, in nine of ten comparisons",
        seen.len()
    )?;
    Ok(())
}
