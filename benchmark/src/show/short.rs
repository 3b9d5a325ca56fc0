//! Studies of error against run time in a few lines, all of them together.

use crate::precision::findings::LEVELS;
use crate::precision::{Findings, Studied};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Combinations that are named for each error.
const SHOWN: usize = 3;

/// Which combination brings how many of the errors to 1 % and to 0.1 % in the shortest time.
///
/// # Errors
/// If `out` cannot be written.
pub fn studies(all: &[Studied], out: &mut dyn Write) -> io::Result<()> {
    let mut first: BTreeMap<String, [usize; LEVELS.len()]> = BTreeMap::new();
    let mut never = [0; LEVELS.len()];
    let mut errors = 0;
    for studied in all {
        for measure in 0..studied.study.measures().len() {
            errors += 1;
            let findings = Findings::new(studied, measure);
            for level in 0..LEVELS.len() {
                match findings.cheapest(level) {
                    Some(line) => first.entry(line.method.to_string()).or_default()[level] += 1,
                    None => never[level] += 1,
                }
            }
        }
    }
    let runs: usize = all.iter().map(|studied| studied.runs.len()).sum();
    writeln!(
        out,
        "Error against run time: {errors} errors of {} cases in {runs} runs. The fewest seconds to an error had most often,",
        all.len()
    )?;
    for (level, bound) in LEVELS.into_iter().enumerate() {
        let mut ranked: Vec<(&String, usize)> = first
            .iter()
            .map(|(name, counts)| (name, counts[level]))
            .filter(|(_, count)| *count > 0)
            .collect();
        // Names in their order where the counts are the same.
        ranked.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let named = ranked.iter().take(SHOWN);
        let named: Vec<String> = named
            .map(|(name, count)| format!("{name} {count}×"))
            .collect();
        writeln!(
            out,
            "  {:<5} {}; no method came so far for {}",
            format!("{} %:", 100.0 * bound),
            named.join(", "),
            never[level]
        )?;
    }
    Ok(())
}
