//! `proctor compare`: two records, judged, or two runs of one scene beside each other.

use crate::exit::{Failure, Outcome};
use crate::judge::ledger::Ledger;
use crate::judge::{self, Rules, Verdict};
use crate::record::Record;
use crate::runs::{RunComparison, RunFolder, is_run};
use crate::show::comparison as show;
use crate::show::runs::RunPair;
use clap::Args;
use proctor_files::output::atomic;
use std::io::Write;
use std::path::PathBuf;

/// Compare two records, judged; or two runs of one scene, their ends and histories beside each other.
///
/// Of records: results bit by bit, counts nearly exactly, times by pairs of runs.
///
/// Results are the same on every machine. Errors, orders, balances, figures, gates and hashes that differ are listed; what
/// is worse by more than 1e-6 of itself fails, however fast it has become, and so do a gate that became looser, a new case
/// that fails, other failures, and 1 % more instructions or steps. What the ledger of accepted changes names is fine as
/// long as it is not worse than the best value that was ever accepted.
///
/// Time is slower if nearly all pairs of runs say so, or from twelve pairs on the fastest quarter, by more than 3 % and
/// more than their noise; fewer than ten pairs cannot show it at the rule's chance of 0.001 and are not judged. The time on the processors decides where a run has one
/// thread, the clock elsewhere. It is the same only where a loss of a tenth would have been seen. A gain in time that was
/// paid for in accuracy is judged at equal error.
///
/// A pair that cannot be compared (cases or numbers that only one record has, another machine or build, too few pairs, noise in
/// which a loss of a tenth could hide, an interrupted record) is never fine: exit code 2. Of two records that were each
/// measured in one pass the times are left out, and the output says so.
///
/// BASE and HEAD are records, or folders of records: one pass per sub-folder, or per file where there are none.
///
/// Or they are folders that `proctor run` wrote. Then it shows counts and energies at the end, and for each column of the
/// histories the largest difference, head less base, and when that was. Nothing is judged: the exit code is 0.
#[derive(Args)]
#[command(
    after_help = "Example: proctor verify --quick --json base.json, then after a change\n  \
    proctor verify --quick --json head.json && proctor compare base.json head.json --ignore-time\n\
    Two commits, with times, in one go: scripts/compare-commits HEAD~1\n\
    Two runs: proctor run column.json --out a; proctor run column.json --out b --threads 2; proctor compare a b"
)]
pub struct Compare {
    /// Record before the change, or a folder of records; or the folder of a run
    base: PathBuf,
    /// Record after it; or the folder of another run
    head: PathBuf,
    /// Compare runs of scenes that differ in name, such as two meshes of one problem
    #[arg(long)]
    any_scene: bool,
    /// Write the table for a pull request, as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Bands of noise by case, as `proctor noise` writes them
    #[arg(long, value_name = "FILE")]
    noise: Option<PathBuf>,
    /// Compare results and counts alone, without times; the records may come from different machines
    #[arg(long)]
    ignore_time: bool,
    /// Ledger of accepted changes, as `proctor accept` writes it
    #[arg(long, value_name = "FILE")]
    ledger: Option<PathBuf>,
    /// Earlier ledger, which --ledger must continue: only lines at its end may be new
    #[arg(long, value_name = "FILE", requires = "ledger")]
    continues: Option<PathBuf>,
    /// Require a line in the ledger for every difference, improvements included
    #[arg(long, requires = "ledger")]
    strict: bool,
}

impl Compare {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        if is_run(&self.base) || is_run(&self.head) {
            return self.runs(out);
        }
        let base = Record::read_joined(&self.base).map_err(Failure::bad_input)?;
        let head = Record::read_joined(&self.head).map_err(Failure::bad_input)?;
        let noise = self.noise.as_deref().map(Record::read).transpose();
        let noise = noise.map_err(Failure::bad_input)?;
        let read = |path: &PathBuf| Ledger::read(path).map_err(Failure::bad_input);
        let ledger = self.ledger.as_ref().map(read).transpose()?;
        let rules = Rules {
            ignore_time: self.ignore_time,
            noise: noise.as_ref(),
            ledger: ledger.as_ref(),
            strict: self.strict,
        };
        let mut comparison = judge::compare_as_measured(&base, &head, &rules);
        if let (Some(ledger), Some(before)) = (&ledger, &self.continues)
            && !ledger.continues(&read(before)?)
        {
            let what = "lines of the ledger were changed or removed: it may only grow at its end";
            comparison.obstacles.push(what.to_owned());
        }
        show::terminal(&comparison, out)?;
        if let Some(path) = &self.markdown {
            let text = show::markdown(&comparison, &base, &head);
            atomic::write(path, |file| file.write_all(text.as_bytes()))
                .map_err(Failure::bad_input)?;
        }
        Ok(match comparison.verdict() {
            Verdict::Fine => Outcome::Fine,
            Verdict::Worse => Outcome::Failed,
            Verdict::CannotCompare => Outcome::CannotCompare,
        })
    }

    /// Two runs beside each other.
    fn runs(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let paths = [self.base.clone(), self.head.clone()];
        let runs = RunFolder::read_all(&paths, self.any_scene).map_err(Failure::BadInput)?;
        let comparison = RunComparison::new(&runs[0], &runs[1]);
        let compared = RunPair {
            runs: &runs,
            comparison: &comparison,
        };
        write!(out, "{compared}")?;
        Ok(Outcome::Fine)
    }
}
