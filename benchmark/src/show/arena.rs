//! The tables of an arena: who took part, and what an error costs each solver on each case.

use super::{Table, columns, grouped, number, paragraph, percent, seconds, shortened};
use crate::arena::speed::{self, Speed};
use crate::arena::{Board, Cell};
use crate::precision::cost::Cost;
use crate::precision::peers::stays;
use crate::record::Record;
use proctor_verification::guest::ReadValue;
use std::io::{self, Write};

/// Columns of a terminal from which on the table has more of them.
const WIDE: usize = 120;
/// Characters of the name and method of a solver.
const NAME: usize = 40;

/// Both tables, and what failed.
///
/// # Errors
/// If `out` cannot be written.
pub fn board(board: &Board, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{}", solvers(board))?;
    paragraph(
        "start: CPU of a free fall of 216 particles in 40 steps, which all times below are without, but for the spread of three \
         such; done, skipped, failed: cases; over ours: CPU to 1 % over the least of Proctor's methods",
        2,
        out,
    )?;
    if board.judged().next().is_some() {
        writeln!(out, "\nCPU to an error, and the smallest error reached\n")?;
        write!(out, "{}", cases(board, columns() >= WIDE))?;
    }
    if !board.reports.is_empty() {
        writeln!(out, "\n{REPORTS}\n")?;
        write!(out, "{}", reports(board))?;
    }
    failures(board, out)
}

/// Title of the table of reports.
pub const REPORTS: &str =
    "Reports, without a bound: a number of the finest mesh beside its reference";

/// A number that is reported, in words: `run-out over width 1.93, 7.2 % above 1.8 (experiments)`.
#[must_use]
pub fn reported(reported: &ReadValue) -> String {
    let side = if reported.value < reported.reference {
        "below"
    } else {
        "above"
    };
    format!(
        "{} {}, {} {side} {} ({})",
        reported.name,
        number(reported.value),
        percent(reported.off()),
        number(reported.reference),
        reported.source
    )
}

/// Characters of a case and its number on one line, so that the table fits a terminal of 80 columns.
const HEAD: usize = 46;

/// The numbers that are reported: below the name of each case a line for each solver.
#[must_use]
pub fn reports(board: &Board) -> Table {
    let mut table = Table::new(["case, solver", "found", "reference", "off"]);
    for case in &board.reports {
        let lines = board
            .solvers
            .iter()
            .filter_map(|solver| Some((solver, board.cell(case, &solver.name)?)));
        let name = lines.clone().find_map(|(_, cell)| cell.reported.as_ref());
        let name = name.map_or("", |reported| reported.name.as_str());
        let head = format!("{case}: {name}");
        if head.chars().count() > HEAD {
            table.push([format!("{case}:")]);
            table.push([format!("  {name}")]);
        } else {
            table.push([head]);
        }
        for (solver, cell) in lines {
            let name = with_method(&solver.name, &solver.method);
            let mut line = vec![format!("  {}", shortened(&name, NAME))];
            match &cell.reported {
                Some(reported) => line.extend([
                    number(reported.value),
                    number(reported.reference),
                    percent(reported.off()),
                ]),
                None => line.extend(found(cell, false).into_iter().take(1)),
            }
            table.push(line);
        }
    }
    table
}

/// The solvers that took part.
#[must_use]
pub fn solvers(board: &Board) -> Table {
    let mut table = Table::new(["solver", "start", "done", "skip", "fail", "over ours"]);
    for solver in &board.solvers {
        let name = shortened(&with_method(&solver.name, &solver.method), NAME);
        if solver.skipped.is_some() || solver.failed.is_some() {
            let word = if solver.skipped.is_some() {
                "skipped"
            } else {
                "failed"
            };
            table.push([name, word.to_owned()]);
            continue;
        }
        let [done, skipped, failed] = board.counts(&solver.name).map(|n| n.to_string());
        let ratios = board.ratios(&solver.name, 0);
        let over = match ratios[..] {
            [] => "-".to_owned(),
            [one] => ratio(one),
            [first, .., last] => format!("{} to {}", ratio(first), ratio(last)),
        };
        table.push([
            name,
            seconds(solver.start.seconds),
            done,
            skipped,
            failed,
            over,
        ]);
    }
    table
}

/// A ratio with two digits.
fn ratio(x: f64) -> String {
    if x < 9.95 {
        format!("{x:.1}")
    } else {
        format!("{x:.0}")
    }
}

/// Name and method of a solver, the method once.
#[must_use]
pub fn with_method(name: &str, method: &str) -> String {
    if method.is_empty() || name.ends_with(method) {
        name.to_owned()
    } else {
        format!("{name}: {method}")
    }
}

/// Solver by case: below the name of each case a line for each solver; with `wide` more columns.
#[must_use]
pub fn cases(board: &Board, wide: bool) -> Table {
    let mut heads = vec!["case, solver", "to 1 %", "to 0.1 %", "best"];
    if wide {
        heads.extend(["order", "finest", "particles", "CPU"]);
    }
    let mut table = Table::new(heads);
    for case in board.judged() {
        table.push([case.clone()]);
        for solver in &board.solvers {
            if let Some(cell) = board.cell(case, &solver.name) {
                let name = with_method(&solver.name, &solver.method);
                let mut line = vec![format!("  {}", shortened(&name, NAME))];
                line.extend(found(cell, wide));
                table.push(line);
            }
        }
    }
    table
}

/// The cells of a solver on a case.
fn found(cell: &Cell, wide: bool) -> Vec<String> {
    let nothing = || "-".to_owned();
    if cell.best.is_none() {
        let word = match (cell.failure(), &cell.skipped) {
            (Some(_), _) => "failed",
            (None, Some(_)) => "skipped",
            (None, None) => "-",
        };
        return vec![word.to_owned()];
    }
    let mut all: Vec<String> = cell.costs.into_iter().map(words).collect();
    let best = cell.best.map_or_else(nothing, percent);
    all.push(if cell.failure().is_some() {
        format!("{best} !")
    } else {
        best
    });
    if wide {
        let finest = cell.meshes.iter().rfind(|mesh| mesh.error.is_ok());
        all.push(cell.order.map_or_else(nothing, |p| format!("{p:.2}")));
        all.push(finest.map_or_else(nothing, |mesh| number(mesh.cell)));
        let particles = finest.and_then(|mesh| mesh.particles);
        all.push(particles.map_or_else(nothing, grouped));
        let time = finest.and_then(|mesh| mesh.seconds);
        all.push(time.map_or_else(nothing, seconds));
    }
    all
}

/// A cost in words.
#[must_use]
pub fn words(cost: Cost) -> String {
    match cost {
        Cost::Time(time) => seconds(time),
        Cost::AtMost(time) => format!("<= {}", seconds(time)),
        Cost::NotReached => "-".to_owned(),
    }
}

/// Reasons of failures and skips, each once with the solver and the cases.
#[must_use]
pub fn reasons(board: &Board) -> Vec<String> {
    let mut all: Vec<(String, Vec<&str>)> = vec![];
    let mut add = |text: String, case: Option<&'_ str>| {
        let case = case.and_then(|case| board.cases.iter().find(|known| *known == case));
        let known = all.iter_mut().find(|(known, _)| *known == text);
        match known {
            Some((_, cases)) => cases.extend(case.map(String::as_str)),
            None => all.push((text, case.map(String::as_str).into_iter().collect())),
        }
    };
    for broken in &board.broken {
        add(format!("FAIL  {broken}"), None);
    }
    for solver in &board.solvers {
        let name = &solver.name;
        if let Some(reason) = &solver.failed {
            add(format!("FAIL  {name}: {reason}"), None);
        }
        if let Some(reason) = &solver.skipped {
            add(format!("skip  {name}: {reason}"), None);
        }
        for case in &board.cases {
            let Some(cell) = board.cell(case, name) else {
                continue;
            };
            if let Some(reason) = cell.failure() {
                add(format!("FAIL  {name}: {reason}"), Some(case));
            }
            if cell.reported.is_some() {
                continue;
            }
            let finest = cell.meshes.last().and_then(|mesh| mesh.error.clone().ok());
            if let Some(note) = finest.and_then(|error| stays(cell.order, error)) {
                add(format!("note  {name}: {note}"), Some(case));
            }
            if let Some(reason) = &cell.skipped {
                add(format!("skip  {name}: {reason}"), Some(case));
            }
        }
    }
    let joined = all.into_iter().map(|(text, cases)| {
        if cases.is_empty() {
            text
        } else {
            format!("{text} ({})", cases.join(", "))
        }
    });
    joined.collect()
}

/// CPU per particle and step of each solver, and its ratio to the least of this program's methods.
///
/// # Errors
/// If `out` cannot be written.
pub fn speed(record: &Record, out: &mut dyn Write) -> io::Result<()> {
    let speeds = speed::speeds(record);
    writeln!(
        out,
        "a flying neo-Hookean block, {} thread: ns of CPU per particle and step\n",
        record.rows.first().map_or(1, |row| row.threads)
    )?;
    write!(out, "{}", speed_table(&speeds))?;
    paragraph(
        "over ours: over the least of Proctor's methods with as many particles; error: of the displacement against free flight",
        2,
        out,
    )?;
    for speed in &speeds {
        if let Err(reason) = &speed.found {
            paragraph(&format!("FAIL  {}: {reason}", speed.solver), 2, out)?;
        }
    }
    Ok(())
}

/// The table of the speed problem.
#[must_use]
pub fn speed_table(speeds: &[Speed]) -> Table {
    let mut table = Table::new(["solver", "particles", "ns", "over ours", "error"]);
    for one in speeds {
        let mut line = vec![
            shortened(&with_method(&one.solver, &one.method), NAME),
            grouped(one.particles),
        ];
        match &one.found {
            Ok((ns, error)) => {
                let own = speeds
                    .iter()
                    .filter(|other| {
                        other.particles == one.particles && Board::is_own(&other.solver)
                    })
                    .filter_map(|other| Some(other.found.as_ref().ok()?.0))
                    .reduce(f64::min);
                line.push(format!("{ns:.1}"));
                line.push(own.map_or_else(|| "-".to_owned(), |own| ratio(ns / own)));
                line.push(format!("{error:.1e}"));
            }
            Err(_) => line.push("failed".to_owned()),
        }
        table.push(line);
    }
    table
}

fn failures(board: &Board, out: &mut dyn Write) -> io::Result<()> {
    let all = reasons(board);
    if !all.is_empty() {
        writeln!(out)?;
    }
    for text in all {
        paragraph(&text, 2, out)?;
    }
    Ok(())
}
