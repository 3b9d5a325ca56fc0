//! `proctor export`: a record in the shape of another tool.

use crate::exit::{Failure, Outcome};
use crate::record::Record;
use crate::record::export::{self, Format};
use clap::{Args, ValueEnum};
use proctor_files::output::atomic;
use std::io::Write;
use std::path::PathBuf;

/// Write a record in the shape that another tool reads.
///
/// Google Benchmark's compare.py reads records as they are. Runs that failed are left out, but for csv.
#[derive(Args)]
#[command(
    after_help = "Example: proctor export --format critcmp record.json --out base.json\n\
    Without --out it goes to standard output: proctor export --format csv record.json > record.csv"
)]
pub struct Export {
    /// Record, or a folder of records
    record: PathBuf,
    /// Shape of the export
    #[arg(long, value_enum)]
    format: Shape,
    /// File to write [default: standard output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Formats by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Shape {
    /// Bencher Metric Format, for Bencher's json adapter
    Bmf,
    /// customSmallerIsBetter of github-action-benchmark
    Github,
    /// A baseline of critcmp; its name is that of --out, else of the record
    Critcmp,
    /// Every row with every counter
    Csv,
    /// What each gate found and its bound, as Markdown
    Gates,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let record = Record::read_joined(&self.record).map_err(Failure::bad_input)?;
        let format = match self.format {
            Shape::Bmf => Format::Bmf,
            Shape::Github => Format::Github,
            Shape::Critcmp => Format::Critcmp,
            Shape::Csv => Format::Csv,
            Shape::Gates => Format::Gates,
        };
        let named = self.out.as_ref().unwrap_or(&self.record).file_stem();
        let baseline = named.map_or_else(|| "record".into(), |name| name.to_string_lossy());
        let text = export::text(&record, format, &baseline)
            .map_err(|error| Failure::BadInput(format!("{}: {error}", self.record.display())))?;
        match &self.out {
            None => out.write_all(text.as_bytes())?,
            Some(path) => atomic::write(path, |file| file.write_all(text.as_bytes()))
                .map_err(Failure::bad_input)?,
        }
        Ok(Outcome::Fine)
    }
}
