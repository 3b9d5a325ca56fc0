//! `proctor compare`: two records, judged.

use crate::exit::{Failure, Outcome};
use crate::judge::{self, Rules, Verdict};
use crate::record::Record;
use crate::show::comparison as show;
use clap::Args;
use proctor_kernel::output::atomic;
use std::io::Write;
use std::path::PathBuf;

/// Compare two records: errors exactly, counts nearly exactly, times by interleaved passes.
///
/// An error that rose by more than 1 %, 0.1 of an observed order lost, or 1 % more instructions or steps fail, however
/// fast it has become. Time fails only if each of three or more interleaved passes is slower by more than 3 % or twice the
/// noise that was measured for the case; a gain in time that was paid for in accuracy is judged at equal error. What
/// cannot be compared (cases that are missing, another machine or build, too few passes, an interrupted record) is never
/// fine: exit code 2.
///
/// BASE and HEAD are records, or folders of records: one pass per sub-folder, or per file where there are none.
#[derive(Args)]
#[command(
    after_help = "Example: proctor verify --quick --json base.json, then after a change\n  \
    proctor verify --quick --json head.json && proctor compare base.json head.json --ignore-time\n\
    Two commits, with times, in one go: scripts/compare-commits HEAD~1"
)]
pub struct Compare {
    /// Record before the change, or a folder of records
    base: PathBuf,
    /// Record after it
    head: PathBuf,
    /// Write the table for a pull request, as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Bands of noise by case, as `proctor noise` writes them
    #[arg(long, value_name = "FILE")]
    noise: Option<PathBuf>,
    /// Leave times out: errors, orders and counts alone, which may come from different machines
    #[arg(long)]
    ignore_time: bool,
}

impl Compare {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let base = Record::read_joined(&self.base).map_err(Failure::bad_input)?;
        let head = Record::read_joined(&self.head).map_err(Failure::bad_input)?;
        let noise = self.noise.as_deref().map(Record::read).transpose();
        let noise = noise.map_err(Failure::bad_input)?;
        let rules = Rules {
            ignore_time: self.ignore_time,
            noise: noise.as_ref(),
        };
        let comparison = judge::compare(&base, &head, &rules);
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
}
