//! Studies of error against run time in a few lines, all of them together.

use crate::precision::costs::{Costs, winners};
use crate::precision::findings::LEVELS;
use std::io::{self, Write};

/// Combinations that are named for each error, and those that come as often as the last of them.
const SHOWN: usize = 3;

/// Combinations that bring the most errors to 1 % and to 0.1 % in the shortest processor time, of `runs` runs of `cases` cases.
/// Between combinations that come first equally often stands an equals sign.
///
/// # Errors
/// If `out` cannot be written.
pub fn studies(all: &[Costs], cases: usize, runs: usize, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "Fewest CPU s to an error (ties: within 10 %); {} errors, {cases} cases, {runs} runs:",
        all.len(),
    )?;
    for (level, bound) in LEVELS.into_iter().enumerate() {
        let (ranked, never) = winners(all, level);
        let last = ranked.get(SHOWN - 1).map_or(0, |(_, count)| *count);
        let shown = ranked.iter().filter(|(_, count)| *count >= last.max(1));
        let shown: Vec<&(&str, usize)> = shown.collect();
        let ties = shown.chunk_by(|(_, a), (_, b)| a == b).map(|tie| {
            let names: Vec<&str> = tie.iter().map(|(name, _)| *name).collect();
            format!("{} {}×", names.join(" = "), tie[0].1)
        });
        let named: Vec<String> = ties.collect();
        let bound = format!("{} %:", 100.0 * bound);
        writeln!(out, "  {bound:<6} {}; none for {never}", named.join(", "))?;
    }
    Ok(())
}
