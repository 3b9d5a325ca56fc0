//! Studies of error against run time in a few lines, all of them together.

use crate::precision::costs::{Costs, winners};
use crate::precision::findings::LEVELS;
use std::io::{self, Write};

/// Combinations that are named for each error, and those that come as often as the last of them.
const SHOWN: usize = 3;

/// Which combination brings how many of the errors to 1 % and to 0.1 % in the shortest processor time, of `runs` runs of
/// `cases` cases.
///
/// # Errors
/// If `out` cannot be written.
pub fn studies(all: &[Costs], cases: usize, runs: usize, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "Error against run time: {} errors of {cases} cases in {runs} runs.\nThe fewest CPU seconds to an error had most often,",
        all.len(),
    )?;
    for (level, bound) in LEVELS.into_iter().enumerate() {
        let (ranked, never) = winners(all, level);
        let last = ranked.get(SHOWN - 1).map_or(0, |(_, count)| *count);
        let (first, tied): (Vec<_>, Vec<_>) = ranked
            .iter()
            .take_while(|(_, count)| *count >= last.max(1))
            .enumerate()
            .partition(|(place, _)| *place < SHOWN);
        let named: Vec<String> = first
            .iter()
            .map(|(_, (name, count))| format!("{name} {count}×"))
            .collect();
        let as_often = match tied.len() {
            0 => String::new(),
            n => format!(" (and {n} more as often as the last)"),
        };
        writeln!(
            out,
            "  {:<6} {}{as_often};",
            format!("{} %:", 100.0 * bound),
            named.join(", ")
        )?;
        writeln!(out, "         no method came so far for {never}")?;
    }
    Ok(())
}
