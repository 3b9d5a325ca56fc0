//! A study as a table: the best combination first.

pub mod beside;
pub mod guests;

use super::{Table, columns, grouped, number, paragraph, seconds, shortened};
use crate::precision::cost::Cost;
use crate::precision::findings::{LEVELS, LineFindings};
use crate::precision::peers::stays;
use crate::precision::{CaseStudy, Findings, Peer, PeerLine};
use std::io::{self, Write};

/// Lines of the table unless all are asked for.
const SHOWN: usize = 12;
/// Columns of a terminal from which on the table has all of its own; and those that it else leaves out.
const WIDE: usize = 104;
const ONLY_WIDE: [&str; 3] = ["particles", "steps", "wall"];
/// Characters of the name of another solver.
const NAME: usize = 22;
/// Names of the levels of error.
const NAMES: [&str; 2] = ["1 %", "0.1 %"];

/// Question, and for each measure the lines by cost and what is best.
///
/// # Errors
/// If `out` cannot be written.
pub fn study(studied: &CaseStudy, all: bool, out: &mut dyn Write) -> io::Result<()> {
    let (name, question) = (studied.study.name(), studied.study.case.question());
    paragraph(&format!("{name}: {question}"), 0, out)?;
    for (number, measure) in studied.study.measures().iter().enumerate() {
        writeln!(out, "\n  {}", measure.word)?;
        let summary = summary(studied, number, all);
        if columns() < WIDE {
            write!(out, "{}", summary.table.without(&ONLY_WIDE))?;
        } else {
            write!(out, "{}", summary.table)?;
        }
        if summary.left_out > 0 {
            writeln!(out, "  and {} more; --all shows them", summary.left_out)?;
        }
        for line in &summary.best {
            paragraph(line, 2, out)?;
        }
    }
    failures(studied, out)?;
    peers(studied, out)?;
    writeln!(out)
}

/// Findings of the free fall on each executable, before any case.
///
/// # Errors
/// If `out` cannot be written.
pub fn calibrations(peers: &[Peer], out: &mut dyn Write) -> io::Result<()> {
    for peer in peers {
        let name = &peer.executable.name;
        match &peer.calibration {
            Ok(calibration) => {
                writeln!(out, "{name}: calibrated by a free fall")?;
                if let Some(hint) = calibration.hint() {
                    writeln!(out, "  note  {name}: {hint}")?;
                }
            }
            Err(fault) => writeln!(out, "FAIL  {name}: {fault}")?,
        }
        for fault in peer.faults.values() {
            paragraph(&format!("FAIL  {name}: {fault}"), 2, out)?;
        }
    }
    writeln!(out)
}

/// Summary of a study on one error.
pub struct Summary {
    /// Lines by their cost, the best first.
    pub table: Table,
    /// Number of lines that the table leaves out.
    pub left_out: usize,
    /// Best method for each level of error.
    pub best: Vec<String>,
}

/// The summary of a study for one of its errors, with `all` lines or the best and the default.
#[must_use]
pub fn summary(studied: &CaseStudy, measure: usize, all: bool) -> Summary {
    let findings = Findings::new(studied, measure);
    let ranked = findings.ranked();
    let shown = if all { ranked.len() } else { SHOWN };
    let levels = NAMES.iter().enumerate().take(LEVELS.len());
    Summary {
        table: table(studied, measure, &findings, &ranked, shown),
        left_out: ranked.len().saturating_sub(shown),
        best: levels
            .map(|(level, name)| best(&findings, level, name))
            .collect(),
    }
}

fn table(
    studied: &CaseStudy,
    measure: usize,
    findings: &Findings,
    ranked: &[&LineFindings],
    shown: usize,
) -> Table {
    let mut table = Table::new([
        "combination",
        "C",
        "finest",
        "order",
        "particles",
        "steps",
        "wall",
        "CPU",
        "for 1 %",
        "for 0.1 %",
    ]);
    let default = findings.default_line().map(|line| line.method);
    let kept = ranked
        .iter()
        .enumerate()
        .filter(|(i, line)| *i < shown || Some(line.method) == default);
    for (_, line) in kept {
        let plan = studied.plan.lines.iter().find(|l| l.method == line.method);
        // The finest run of the path that was run.
        let finest = plan.and_then(|l| l.path.iter().rev().find(|i| **i < studied.runs.len()));
        let Some(&finest) = finest else { continue };
        let (choice, run) = (&studied.plan.choices[finest], &studied.runs[finest]);
        let mark = if line.method.has_safe_step() {
            ""
        } else {
            " !"
        };
        let error = line
            .table
            .rows()
            .last()
            .map_or(f64::NAN, |row| row.errors[0]);
        let time = |i: usize, cpu: bool| {
            run.minimum_and_median(|s| if cpu { s.stepping.cpu } else { s.stepping.wall })
                .map_or_else(String::new, |t| seconds(t[i]))
        };
        table.push([
            format!("{}{mark}", line.method),
            format!("{:.2}", choice.settings.courant_or_automatic()),
            if error.is_finite() {
                super::percent(error)
            } else {
                "failed".to_owned()
            },
            line.order()
                .map_or_else(|| "-".to_owned(), |p| format!("{p:.2}")),
            run.found
                .as_ref()
                .map_or_else(|_| "-".to_owned(), |f| grouped(f.particles as u64)),
            run.found
                .as_ref()
                .map_or_else(|_| "-".to_owned(), |f| grouped(f.steps)),
            time(0, false),
            time(0, true),
            words(line.costs[0]),
            words(line.costs[1]),
        ]);
    }
    for peer in studied.peers_of(measure) {
        table.push(peer_line(&peer, studied.threads));
    }
    table
}

/// The line of another solver: the time is that of its process.
fn peer_line(peer: &PeerLine, threads: usize) -> [String; 10] {
    let none = || "-".to_owned();
    let finest = peer.runs.last();
    let error = finest.and_then(|run| run.error.as_ref().ok().copied());
    let time = |cpu: bool| {
        let samples = finest.into_iter().flat_map(|run| &run.samples);
        let least = samples.map(|s| if cpu { s.cpu } else { s.wall }).min();
        least.map_or_else(none, |time| seconds(time.as_secs_f64()))
    };
    let costs = peer.costs(threads);
    [
        shortened(&format!("{} (process)", peer.name), NAME),
        none(),
        error.map_or_else(|| "failed".to_owned(), super::percent),
        peer.order().map_or_else(none, |p| format!("{p:.2}")),
        finest
            .and_then(|run| run.particles)
            .map_or_else(none, |n| grouped(n as u64)),
        none(),
        time(false),
        time(true),
        words(costs[0]),
        words(costs[1]),
    ]
}

fn words(cost: Cost) -> String {
    match cost {
        Cost::Time(time) => seconds(time),
        Cost::AtMost(time) => format!("<= {}", seconds(time)),
        Cost::NotReached => "-".to_owned(),
    }
}

/// Best combination for a level, and its gain over the default.
fn best(findings: &Findings, level: usize, name: &str) -> String {
    let Some(line) = findings.cheapest(level) else {
        return format!("{name}: not reached by any combination");
    };
    let gain = match findings.speed_up(level) {
        Some(gain) if (gain - 1.0).abs() < 5e-3 => "as fast as the default".to_owned(),
        Some(gain) => format!(
            "{} times as fast as the default",
            number((gain * 100.0).round() / 100.0)
        ),
        None if findings.default_line().is_none() => "the default was not tried".to_owned(),
        None => "the default does not reach it".to_owned(),
    };
    let time = match line.costs[level] {
        Cost::AtMost(time) => format!("at most {}", seconds(time)),
        cost => words(cost),
    };
    format!("{name}: best with {}, {time}; {gain}", line.method)
}

/// Notes on other solvers: the meaning of their lines, the failed runs, or the reason for which there are none.
fn peers(studied: &CaseStudy, out: &mut dyn Write) -> io::Result<()> {
    if let Some(reason) = &studied.no_peers {
        writeln!(out)?;
        return paragraph(&format!("not for other solvers: {reason}"), 2, out);
    }
    if studied.peers.is_empty() {
        return Ok(());
    }
    writeln!(out)?;
    paragraph(
        "(process): the case's scene for other solvers, in three dimensions, with uGIMP, USL, FLIP and C = 0.3 at most; whole \
         processes, frames judged by the first error; that of the stress beside it where frames hold stresses",
        2,
        out,
    )?;
    for peer in &studied.peers {
        if let Some(reason) = peer.left_out {
            paragraph(&format!("skip  {}: {reason}", peer.name), 2, out)?;
        }
        for run in &peer.runs {
            if let Err(reason) = &run.error {
                let text = format!("FAIL  {}, {}: {reason}", peer.name, run.rung.label);
                paragraph(&text, 2, out)?;
            }
        }
        let finest = peer.runs.last().and_then(|run| run.error.clone().ok());
        if let Some(note) = finest.and_then(|error| stays(peer.order(), error)) {
            paragraph(&format!("note  {}: {note}", peer.name), 2, out)?;
        }
    }
    Ok(())
}

/// Every reason for failure once, with how many runs it ended and the first of them.
fn failures(studied: &CaseStudy, out: &mut dyn Write) -> io::Result<()> {
    let failed: Vec<(String, String)> = studied
        .plan
        .choices
        .iter()
        .zip(&studied.runs)
        .filter_map(|(choice, run)| {
            let reason = run.error(0).err()?;
            let what = format!(
                "{}, {}, C = {:.2}, {} per cell",
                choice.settings.method,
                choice.rung.label,
                choice.settings.courant_or_automatic(),
                choice.settings.particles_per_cell
            );
            Some((what, reason))
        })
        .collect();
    if failed.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\n  {} of {} runs failed; the record says why each did. The first:",
        failed.len(),
        studied.runs.len()
    )?;
    for (what, reason) in failed.iter().take(3) {
        paragraph(&format!("{what}:"), 4, out)?;
        paragraph(reason, 6, out)?;
    }
    Ok(())
}
