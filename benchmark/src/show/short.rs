//! Studies of error against run time in a few lines, all of them together.

use super::Table;
use crate::precision::findings::LEVELS;
use crate::precision::{Findings, Studied};
use proctor_verification::settings::Method;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Combinations that are named.
const SHOWN: usize = 2;

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
        "Error against run time: {errors} errors of {} cases in {runs} runs. How many a method brings below 1 % and 0.1 % in the \
         least run time",
        all.len()
    )?;
    let mut ranked: Vec<(String, [usize; LEVELS.len()])> = first.into_iter().collect();
    // Names in their order where the counts are the same.
    ranked.sort_by_key(|(_, counts)| std::cmp::Reverse(counts.iter().sum::<usize>()));
    let mut table = Table::new(["", "1 %", "0.1 %"]);
    let cells = |name: String, counts: [usize; LEVELS.len()]| {
        std::iter::once(name).chain(counts.map(|count| count.to_string()))
    };
    let default = Method::DEFAULT.to_string();
    for (name, counts) in ranked.iter().take(SHOWN) {
        let mark = if *name == default {
            ", the default"
        } else {
            ""
        };
        table.push(cells(format!("by {name}{mark}"), *counts));
    }
    if let Some(others) = ranked.get(SHOWN..).filter(|others| !others.is_empty()) {
        let sum = |level: usize| others.iter().map(|(_, counts)| counts[level]).sum();
        let name = format!("by {} other combinations", others.len());
        table.push(cells(name, std::array::from_fn(sum)));
    }
    table.push(cells("not reached by any".to_owned(), never));
    write!(out, "{table}")
}
