//! `proctor report`: a record as a page, or runs of one scene.

use crate::exit::{Failure, Outcome};
use crate::history;
use crate::record::Record;
use crate::report::{self, MillResult, Since};
use crate::runs::{RunFolder, is_run};
use crate::show::comparison;
use clap::Args;
use proctor_files::output::atomic;
use std::io::Write;
use std::path::PathBuf;

/// Make the page of a record, or of runs of one scene.
///
/// Of a record: verdict, what is nearest to its bound, cheapest method, stability, speed, every case.
///
/// The page is one file that needs no network. It shows what the record holds: `proctor` without a verb writes one
/// with everything, `verify`, `precision`, `stability` and `bench` write their own parts with --json. With --base it shows
/// what got worse and what got better since another record, by the judge of `compare`; whether that is fine is for `compare`
/// to say with its exit code.
///
/// RECORD may also be a folder that `proctor run` wrote, with others of the same scene behind it: how they ended, how far they
/// are from the first, and their histories as curves.
#[derive(Args)]
#[command(
    after_help = "Example: proctor verify --quick --json record.json; proctor report record.json\n\
    What changed: proctor report head.json --base base.json\n\
    How it went: proctor report head.json --history records\n\
    Manufactured solutions: proctor report record.json --mill mill.json\n\
    Two runs: proctor report column other --out both.html"
)]
pub struct Report {
    /// Record (JSON), or the folder of a run
    record: PathBuf,
    /// Folders of other runs of the same scene
    #[arg(value_name = "RUN")]
    others: Vec<PathBuf>,
    /// Take runs of scenes that differ in name, such as two meshes of one problem
    #[arg(long)]
    any_scene: bool,
    /// Earlier record: what changed since, as tables and pictures
    #[arg(long, value_name = "RECORD")]
    base: Option<PathBuf>,
    /// Earlier records, or folders of them: how each number went, and where it changed
    #[arg(long, value_name = "FILE", num_args = 1..)]
    history: Vec<PathBuf>,
    /// The same from a record that git keeps: every commit that changed it
    #[arg(long, value_name = "PATH", conflicts_with = "history")]
    history_of: Option<PathBuf>,
    /// Result of the mill, from `verify mill --json FILE`: orders of manufactured solutions as a histogram
    #[arg(long, value_name = "FILE")]
    mill: Option<PathBuf>,
    /// The page [default: the name of the record with .html, or report.html in the folder of the run]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Report {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if is_run(&self.record) || !self.others.is_empty() {
            return self.runs(out);
        }
        let record = Record::read(&self.record).map_err(Failure::bad_input)?;
        let base = self.base.as_deref().map(Record::read).transpose();
        let base = base.map_err(Failure::bad_input)?;
        let page = self.out.clone();
        let page = page.unwrap_or_else(|| self.record.with_extension("html"));
        if page == self.record || Some(&page) == self.base.as_ref() {
            return Err(Failure::BadInput(format!(
                "{}: the page would replace a record; accepted: another name with --out",
                page.display()
            )));
        }
        let since = base.as_ref().map(|base| Since::new(base, &record));
        let history = match &self.history_of {
            Some(path) => Some(history::of_git(path)),
            None if self.history.is_empty() => None,
            None => Some(history::of_files(&self.history)),
        };
        let history = history.transpose().map_err(Failure::bad_input)?;
        let mill = self.mill.as_deref().map(MillResult::read).transpose();
        let mill = mill.map_err(Failure::BadInput)?;
        let html = report::page_with(&record, since.as_ref(), history.as_ref(), mill.as_ref());
        atomic::write(&page, |file| file.write_all(html.as_bytes())).map_err(Failure::bad_input)?;
        if let Some(since) = &since {
            writeln!(out, "{}", comparison::verdict_line(since.comparison()))?;
        }
        writeln!(out, "page in {}", page.display())?;
        Ok(Outcome::Fine)
    }

    /// The page of runs.
    fn runs(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if self.base.is_some()
            || !self.history.is_empty()
            || self.history_of.is_some()
            || self.mill.is_some()
        {
            let what = "--base, --history, --history-of and --mill are for records; accepted with runs: --out, --any-scene";
            return Err(Failure::BadInput(what.to_owned()));
        }
        let mut paths = vec![self.record.clone()];
        paths.extend_from_slice(&self.others);
        let runs = RunFolder::read_all(&paths, self.any_scene).map_err(Failure::BadInput)?;
        let page = self.out.clone();
        let page = page.unwrap_or_else(|| self.record.join("report.html"));
        let html = report::page_of_runs(&runs);
        atomic::write(&page, |file| file.write_all(html.as_bytes())).map_err(Failure::bad_input)?;
        writeln!(out, "page in {}", page.display())?;
        Ok(Outcome::Fine)
    }
}
