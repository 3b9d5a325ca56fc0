//! `proctor accept`: changes of a record, taken into the ledger with a reason.

use crate::exit::{Failure, Outcome};
use crate::judge::change::{Change, Direction};
use crate::judge::ledger::{Ledger, Line};
use crate::judge::{self, Rules};
use crate::record::Record;
use crate::show::paragraph;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Add the changes between two records to the ledger of accepted changes, each with the reason.
///
/// One line is added for every number that is not the same bit by bit. What is worse than it was, or than the best value
/// that was ever accepted, and what is gone, is taken with --worse alone; without it nothing is written and the exit code
/// is 1. `scripts/update-expected` does all of it for the records that CI compares with.
#[derive(Args)]
#[command(
    after_help = "Example: proctor accept fixtures/expected/errors.json new.json \\\n    \
    --ledger fixtures/expected/accepted.csv --because \"the disc is filled by whole sub-cells\""
)]
pub struct Accept {
    /// Record that was kept so far
    base: PathBuf,
    /// Record to be kept from now on
    head: PathBuf,
    /// The ledger; created if it does not exist
    #[arg(long, value_name = "FILE")]
    ledger: PathBuf,
    /// Reason for which the numbers moved, for readers of the ledger
    #[arg(long, value_name = "REASON", value_parser = reason)]
    because: String,
    /// Also accept numbers that got worse
    #[arg(long)]
    worse: bool,
}

/// A reason has words.
fn reason(text: &str) -> Result<String, String> {
    let words = text.split_whitespace().count();
    if words < 3 {
        return Err(format!(
            "found {words} words; accepted: a sentence that says why the numbers moved"
        ));
    }
    Ok(text.trim().to_owned())
}

impl Accept {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let base = Record::read_joined(&self.base).map_err(Failure::bad_input)?;
        let head = Record::read_joined(&self.head).map_err(Failure::bad_input)?;
        let mut ledger = if self.ledger.exists() {
            Ledger::read(&self.ledger).map_err(Failure::bad_input)?
        } else {
            Ledger::default()
        };
        // The ledger must come to name every difference; without it the judge says which there are.
        let rules = Rules {
            ignore_time: true,
            ..Rules::default()
        };
        let comparison = judge::compare(&base, &head, &rules);
        if !comparison.obstacles.is_empty() {
            for line in &comparison.obstacles {
                writeln!(out, "{line}")?;
            }
            return Ok(Outcome::CannotCompare);
        }
        let commit = commit(&head);
        let ladder = &comparison.ladder;
        let mut lines: Vec<(Line, bool)> = vec![];
        for finding in &comparison.findings {
            let case = finding.case.to_string();
            for change in &finding.changes {
                if change.moved == Direction::Same {
                    continue;
                }
                let line = ledger.line(ladder, &case, change, &self.because, &commit);
                lines.push((line, self.asks(&ledger, ladder, &case, change)));
            }
        }
        let refused = lines.iter().filter(|(_, asks)| *asks).count();
        let all = lines.len();
        for (line, asks) in &lines {
            let mark = if *asks { "WORSE " } else { "" };
            let text = format!(
                "{mark}{}: {} {} -> {}",
                line.case, line.number, line.from, line.to
            );
            paragraph(&text, 2, out)?;
        }
        if refused > 0 {
            writeln!(
                out,
                "REFUSED: {refused} of {all} changes are for the worse; --worse takes them, too"
            )?;
            return Ok(Outcome::Failed);
        }
        ledger.append(lines.into_iter().map(|(line, _)| line).collect());
        ledger.write(&self.ledger).map_err(Failure::bad_input)?;
        writeln!(out, "{all} changes taken into {}", self.ledger.display())?;
        Ok(Outcome::Fine)
    }

    /// True if a change is for the worse and was not asked for.
    fn asks(&self, ledger: &Ledger, ladder: &str, case: &str, change: &Change) -> bool {
        let worse = change.moved == Direction::Missing || ledger.worse(ladder, case, change);
        worse && !self.worse
    }
}

/// Commit of the sources that a record was measured with.
fn commit(record: &Record) -> String {
    let commit = record.context["commit"].as_str().unwrap_or("unknown");
    let short: String = commit.chars().take(10).collect();
    let more = record.context["dirty"] == true;
    format!("{short}{}", if more { "+" } else { "" })
}
