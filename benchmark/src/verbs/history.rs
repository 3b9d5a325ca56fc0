//! `proctor history`: the numbers of records over commits.

use super::export::otava_files;
use crate::exit::{Failure, Outcome};
use crate::history::{self, History as Records};
use crate::show::{figures::history as figures, history as show};
use clap::Args;
use proctor_files::output::atomic;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Show how the numbers of records went over commits, and where they changed.
///
/// A number that is computed is the same bit by bit until the program changes: every other value is a change point. Times are
/// noisy: E-divisive means in windows of 50 records with Student's t-test at 0.001, as Hunter does it, say where they changed.
/// Times of one thread are those on the processors, others by the clock; they mean something where all records come from one
/// machine.
#[derive(Args)]
#[command(
    after_help = "Example: proctor history --git fixtures/expected/errors.json --svg history\n\
    Records of one's own: proctor history records/*.json --number hertz"
)]
pub struct History {
    /// Records, or folders of them; ordered by their dates
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// A record that git keeps: every commit that changed it
    #[arg(long, value_name = "PATH", conflicts_with = "files")]
    git: Option<PathBuf>,
    /// Only numbers whose case and name contain this; given several times, all of them
    #[arg(long, value_name = "TEXT")]
    number: Vec<String>,
    /// List every change point, not only the largest
    #[arg(long)]
    all: bool,
    /// Draw what changed into this folder; created if it does not exist
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    /// Write a table for Apache Otava, its configuration beside it
    #[arg(long, value_name = "FILE")]
    otava: Option<PathBuf>,
}

impl History {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let read = match &self.git {
            Some(path) => history::of_git(path),
            None if self.files.is_empty() => {
                return Err(Failure::BadInput(
                    "found no record; accepted: records, folders of them, or --git PATH".to_owned(),
                ));
            }
            None => history::of_files(&self.files),
        };
        let mut records = read.map_err(Failure::bad_input)?;
        records.keep(&self.number);
        if records.series.is_empty() {
            return Err(Failure::BadInput(format!(
                "--number {}: no number has this in its name; `proctor export --format csv RECORD` lists them",
                self.number.join(" --number ")
            )));
        }
        show::terminal(&records, self.all, out)?;
        if let Some(folder) = &self.svg {
            draw(&records, folder, out)?;
        }
        if let Some(path) = &self.otava {
            otava_files(&records, Some(path), out)?;
        }
        Ok(Outcome::Fine)
    }
}

/// A chart of all changes, and one for each number that changed most.
fn draw(records: &Records, folder: &Path, out: &mut dyn Write) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::BadInput(format!("{}: {error}", folder.display())))?;
    for (name, figure) in figures::all(records) {
        let path = folder.join(format!("{name}.svg"));
        let svg = figure.chart.to_svg();
        atomic::write(&path, |file| file.write_all(svg.as_bytes())).map_err(Failure::bad_input)?;
        writeln!(out, "chart in {}", path.display())?;
    }
    Ok(())
}
