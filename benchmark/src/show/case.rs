//! A case that was run, as text.

use super::{Table, grouped, number, percent, seconds};
use crate::suite::{CaseRun, RanRung};
use proctor_verification::case::{Gate, Quantity, Relation};
use std::io::{self, Write};

/// Errors shown beside the run times; the convergence tables hold all.
const SHOWN_ERRORS: usize = 3;

/// Name and question of a case, its runs with error and run time side by side.
///
/// # Errors
/// If `out` cannot be written.
pub fn runs(ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}: {}", ran.case.name(), ran.case.question())?;
    let mut rest = &ran.rungs[..];
    while let Some(first) = rest.first() {
        let count = rest
            .iter()
            .take_while(|ran| ran.rung.variant == first.rung.variant)
            .count();
        let (variant, after) = rest.split_at(count);
        rest = after;
        writeln!(out)?;
        write!(out, "{}", table(variant))?;
        for ran in variant {
            if let Err(error) = &ran.solved {
                writeln!(out, "  {} failed: {}", ran.rung.label, error.reason)?;
            }
        }
    }
    writeln!(out)
}

/// Convergence tables with observed orders.
///
/// # Errors
/// If `out` cannot be written.
pub fn tables(ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
    for (title, table) in &ran.verdict.tables {
        writeln!(out, "  {title}: errors and observed orders")?;
        for line in table.to_string().lines() {
            writeln!(out, "    {line}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Gates, each with its bound, and its reason if asked for.
///
/// # Errors
/// If `out` cannot be written.
pub fn gates(ran: &CaseRun, reasons: bool, out: &mut dyn Write) -> io::Result<()> {
    for gate in &ran.verdict.gates {
        writeln!(out, "  {}", gate_line(gate))?;
        if reasons || !gate.passed() {
            writeln!(out, "        {}", gate.reason)?;
        }
    }
    if ran.verdict.gates.is_empty() {
        writeln!(out, "  FAIL  nothing was compared")?;
    }
    writeln!(out)
}

/// Gates that do not hold, each with its reason.
///
/// # Errors
/// If `out` cannot be written.
pub fn failed_gates(ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
    for gate in ran.verdict.gates.iter().filter(|gate| !gate.passed()) {
        writeln!(out, "  {}\n        {}", gate_line(gate), gate.reason)?;
    }
    if ran.verdict.gates.is_empty() {
        writeln!(out, "  FAIL  nothing was compared")?;
    }
    writeln!(out)
}

/// Faults of the case itself, where it was run with wrong references too.
///
/// # Errors
/// If `out` cannot be written.
pub fn faults(ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
    for fault in &ran.faults {
        writeln!(out, "  FAULT OF THE CASE  {fault}")?;
    }
    Ok(())
}

/// Lines that judge nothing.
///
/// # Errors
/// If `out` cannot be written.
pub fn for_the_record(ran: &CaseRun, out: &mut dyn Write) -> io::Result<()> {
    if ran.verdict.for_the_record.is_empty() {
        return Ok(());
    }
    writeln!(out, "  for the record")?;
    for line in &ran.verdict.for_the_record {
        writeln!(out, "    {line}")?;
    }
    writeln!(out)
}

/// One line per run.
fn table(variant: &[RanRung]) -> Table {
    let errors: Vec<&'static str> = variant
        .iter()
        .find_map(|ran| ran.solved.as_ref().ok())
        .map(|solved| {
            let with_error = |q: &&Quantity| q.error.is_some();
            let names = solved.quantities.iter().filter(with_error).map(|q| q.name);
            names.take(SHOWN_ERRORS).collect()
        })
        .unwrap_or_default();
    let halves: Vec<(&str, &str)> = errors.iter().map(|name| in_two(name)).collect();
    let upper = halves.iter().map(|(upper, _)| *upper);
    let lower = halves.iter().map(|(_, lower)| *lower);
    let mut table = Table::new(["", "", ""].into_iter().chain(upper).chain(["wall", "CPU"]));
    let heading = ["relative error of", "particles", "steps"];
    table.push(heading.into_iter().chain(lower).chain(["time", "time"]));
    for ran in variant {
        let mut line = vec![ran.rung.label.clone()];
        if let Ok(solved) = &ran.solved {
            line.extend([grouped(solved.particles as u64), grouped(solved.steps)]);
            line.extend(errors.iter().map(|name| percent(solved.error(name))));
        } else {
            line.push("failed".to_owned());
            line.extend((0..=errors.len()).map(|_| String::new()));
        }
        line.push(seconds(ran.spent().wall.as_secs_f64()));
        line.push(seconds(ran.spent().cpu.as_secs_f64()));
        table.push(line);
    }
    table
}

/// A name in two lines of about the same length, broken at a blank; a short one has no first line.
#[must_use]
pub fn in_two(name: &str) -> (&str, &str) {
    let middle = name.len() / 2;
    let blanks = name.match_indices(' ').map(|(at, _)| at);
    match blanks.min_by_key(|at| at.abs_diff(middle)) {
        Some(at) if name.len() > 10 => (&name[..at], &name[at + 1..]),
        _ => ("", name),
    }
}

fn gate_line(gate: &Gate) -> String {
    let word = if gate.passed() { "PASS" } else { "FAIL" };
    let relation = match gate.relation {
        Relation::AtMost => "at most",
        Relation::AtLeast => "at least",
    };
    format!(
        "{word}  {}: {}, {relation} {}",
        gate.name,
        number(gate.value),
        number(gate.bound)
    )
}
