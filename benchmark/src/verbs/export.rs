//! `proctor export`: a record in the shape of another tool.

use super::names;
use crate::arena;
use crate::book;
use crate::exit::{Failure, Outcome};
use crate::history::{self, History};
use crate::interrupt::Interrupt;
use crate::precision::problems;
use crate::record::Record;
use crate::record::export::{self, Format};
use crate::record::otava;
use clap::{Args, ValueEnum};
use proctor_files::output::atomic;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Write a record in the shape that another tool reads.
///
/// Google Benchmark's compare.py reads records as they are. Runs that failed are left out, but for csv and junit. For otava
/// several records are taken, a line each; with --out FILE.csv its configuration goes to FILE.yaml.
#[derive(Args)]
#[command(
    after_help = "Example: proctor export --format critcmp record.json --out base.json\n\
    Without --out it goes to standard output: proctor export --format csv record.json > record.csv\n\
    For the tests of a pull request: proctor export --format junit record.json --out junit.xml"
)]
pub struct Export {
    /// Record, or a folder of records; for otava any number of them; for problems a folder, and cases
    #[arg(required = true)]
    record: Vec<PathBuf>,
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
    /// Value and bound of each gate, as Markdown
    Gates,
    /// JUnit XML: a test per gate, failures with what was found and the bound
    Junit,
    /// Verdict, gates that fail and other solvers, as Markdown for the summary of a CI job
    Summary,
    /// A badge for the endpoint of shields.io
    Badge,
    /// Cases for solvers that read no scene of ours: RECORD is the folder that is written; cases may follow [default: all]
    Problems,
    /// Generated pages and drawings of the book, into the folder of --out; the first record that holds a case counts
    Book,
    /// A table and a configuration for Apache Otava, which finds change points
    Otava,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let format = match self.format {
            Shape::Bmf => Format::Bmf,
            Shape::Github => Format::Github,
            Shape::Critcmp => Format::Critcmp,
            Shape::Csv => Format::Csv,
            Shape::Gates => Format::Gates,
            Shape::Junit => Format::Junit,
            Shape::Summary => Format::Summary,
            Shape::Badge => Format::Badge,
            Shape::Problems => return self.problems(out),
            Shape::Book => return self.book(out),
            Shape::Otava => {
                let history = history::of_files(&self.record).map_err(Failure::bad_input)?;
                return otava_files(&history, self.out.as_deref(), out);
            }
        };
        let [path] = self.record.as_slice() else {
            return Err(Failure::BadInput(format!(
                "found {} records; accepted: one, or a folder of passes; --format otava and --format book take several",
                self.record.len()
            )));
        };
        let record = Record::read_joined(path).map_err(Failure::bad_input)?;
        let named = self.out.as_ref().unwrap_or(path).file_stem();
        let baseline = named.map_or_else(|| "record".into(), |name| name.to_string_lossy());
        let text = export::text(&record, format, &baseline)
            .map_err(|error| Failure::BadInput(format!("{}: {error}", path.display())))?;
        write(&text, self.out.as_deref(), out)?;
        Ok(Outcome::Fine)
    }
}

impl Export {
    /// A folder per run of each open case, or of those that are named behind the folder.
    fn problems(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let [folder, cases @ ..] = self.record.as_slice() else {
            return Err(Failure::BadInput(
                "found no folder; accepted: one".to_owned(),
            ));
        };
        let cases: Vec<String> = cases
            .iter()
            .map(|case| case.display().to_string())
            .collect();
        let (problems, closed) = arena::open(names::open(&cases)?);
        if let Some((name, reason)) = closed.first().filter(|_| !cases.is_empty()) {
            let message = format!("{name}: not for other solvers: {reason}");
            return Err(Failure::BadInput(message));
        }
        let interrupt = Interrupt::listen()?;
        let written = problems::write(folder, &problems, interrupt.flag());
        let folders = written.map_err(Failure::BadInput)?;
        writeln!(out, "{} problems in {}", folders.len(), folder.display())?;
        Ok(Outcome::Fine)
    }
}

impl Export {
    /// The generated pages and drawings of the book.
    fn book(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let Some(folder) = &self.out else {
            return Err(Failure::BadInput(
                "--format book: found no --out; accepted: --out FOLDER, into which the pages are written".to_owned(),
            ));
        };
        let records: Result<Vec<Record>, _> = { self.record.iter() }
            .map(|path| Record::read_joined(path))
            .collect();
        let files = book::files(&records.map_err(Failure::bad_input)?);
        for file in &files {
            let path = folder.join(&file.path);
            if let Some(parent) = path.parent() {
                std::fs::create_dir_all(parent)
                    .map_err(|error| Failure::BadInput(format!("{}: {error}", parent.display())))?;
            }
            write(&file.text, Some(&path), out)?;
        }
        let is_page = |path: &str| Path::new(path).extension().is_some_and(|end| end == "md");
        let pages = files.iter().filter(|file| is_page(&file.path));
        writeln!(out, "{} pages in {}", pages.count(), folder.display())?;
        Ok(Outcome::Fine)
    }
}

/// Writes the table for Otava; to a file with its configuration beside it.
pub fn otava_files(
    history: &History,
    path: Option<&Path>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let table = otava::table(history).map_err(Failure::bad_input)?;
    write(&table, path, out)?;
    if let Some(path) = path {
        let configuration = otava::configuration(history, &path.display().to_string());
        let beside = path.with_extension("yaml");
        write(&configuration, Some(&beside), out)?;
        writeln!(
            out,
            "table in {}, configuration in {}",
            path.display(),
            beside.display()
        )?;
    }
    Ok(Outcome::Fine)
}

fn write(text: &str, path: Option<&Path>, out: &mut dyn Write) -> Result<(), Failure> {
    match path {
        None => out.write_all(text.as_bytes())?,
        Some(path) => atomic::write(path, |file| file.write_all(text.as_bytes()))
            .map_err(Failure::bad_input)?,
    }
    Ok(())
}
