//! A comparison of two records, as text and as Markdown.

use super::{Table, columns, paragraph, shortened};
use crate::judge::change::Direction;
use crate::judge::{CaseVerdict, Comparison, Finding, Tally, Verdict};
use crate::record::{CaseKey, Record};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Characters of a case's name in the table on a terminal; the reasons below it name the case in full.
pub const NAME: usize = 29;
/// Columns of a terminal from which on the chance and the tolerance of a time are shown.
const WIDE: usize = 100;
/// Places of these two among the cells.
const NARROW: [usize; 2] = [5, 6];

/// The table of a comparison on a terminal, the reasons, the verdict.
///
/// # Errors
/// If `out` cannot be written.
pub fn terminal(comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
    let wide = columns() >= WIDE;
    let fits = |cells: [String; 8]| -> Vec<String> {
        let cells = cells.into_iter().enumerate();
        cells
            .filter(|(place, _)| wide || !NARROW.contains(place))
            .map(|(_, cell)| cell)
            .collect()
    };
    let mut table = Table::new(fits(HEADINGS.map(str::to_owned)));
    // What is equal bit by bit and has no time says nothing that the last lines do not say.
    let telling = |f: &&Finding| f.verdict != CaseVerdict::Same || f.time.is_some();
    for finding in shown(comparison).filter(telling) {
        let mut cells = cells(finding);
        cells[0] = shortened(&short_name(&finding.case), NAME);
        table.push(fits(cells));
    }
    if table.lines().len() > 1 {
        let mut what =
            "HEAD over BASE: worst error and count, median time and its 95 % interval".to_owned();
        if wide {
            what.push_str(
                ", chance of such an order of times without a change (Mann-Whitney), tolerance",
            );
        }
        paragraph(&what, 0, out)?;
        writeln!(out, "\n{table}")?;
    }
    for (about, reason) in reasons(comparison) {
        paragraph(&about, 2, out)?;
        paragraph(&reason, 6, out)?;
    }
    let told = told(comparison);
    if !told.is_empty() {
        writeln!(out, "  different, and not judged for it")?;
    }
    for line in told {
        paragraph(&line, 6, out)?;
    }
    paragraph(&compared(comparison), 2, out)?;
    for line in comparison.notes.iter().chain(&comparison.obstacles) {
        paragraph(line, 2, out)?;
    }
    writeln!(out, "{}", verdict_line(comparison))
}

/// The same as Markdown for a pull request: the verdict, what changed, and the whole table folded.
#[must_use]
pub fn markdown(comparison: &Comparison, base: &Record, head: &Record) -> String {
    let mut text = format!("### {}\n\n", verdict_line(comparison));
    let _ = writeln!(
        text,
        "{} against {}\n",
        side("HEAD", head),
        side("BASE", base)
    );
    for line in comparison.obstacles.iter().chain(&comparison.notes) {
        let _ = writeln!(text, "- {}", escaped(line));
    }
    for (about, reason) in reasons(comparison) {
        let _ = writeln!(text, "- {}: {}", escaped(&about), escaped(&reason));
    }
    let told = told(comparison);
    if !told.is_empty() {
        let _ = writeln!(
            text,
            "\n<details><summary>{} different, and not judged for it</summary>\n",
            told.len()
        );
        for line in told {
            let _ = writeln!(text, "- {}", escaped(&line));
        }
        text.push_str("\n</details>\n");
    }
    let _ = writeln!(text, "\n{}", escaped(&compared(comparison)));
    let (changed, same): (Vec<&Finding>, Vec<&Finding>) =
        shown(comparison).partition(|finding| finding.verdict != CaseVerdict::Same);
    if !changed.is_empty() {
        text.push('\n');
        text.push_str(&markdown_table(&changed));
    }
    if !same.is_empty() {
        let _ = write!(
            text,
            "\n<details><summary>{} without a change</summary>\n\n{}\n</details>\n",
            cases(same.len()),
            markdown_table(&same)
        );
    }
    text.push_str(
        "\nHEAD over BASE. Error, count: the worst of the case. Time: ratio of medians over pairs of runs; a case is \
         slower or faster if nearly all pairs are, or their fastest quarter, by more than the tolerance. p: Mann-Whitney, \
         two-sided.\n",
    );
    text
}

/// The name of a row without what all rows of studies have in common. Of another solver both its name and the case can then be
/// read: `precision/step-bar/peer/solver/h=1e-1` is `step-bar solver h=1e-1`.
#[must_use]
pub fn short_name(case: &CaseKey) -> String {
    let name = case.to_string();
    match name.strip_prefix("precision/") {
        Some(rest) => rest.replace("/peer/", " ").replace("/h=", " h="),
        None => name,
    }
}

const HEADINGS: [&str; 8] = [
    "case", "error", "count", "time", "95 %", "p", "tol.", "verdict",
];

fn markdown_table(findings: &[&Finding]) -> String {
    let mut text = format!(
        "| {} |\n|---|{}\n",
        HEADINGS.join(" | "),
        "--:|".repeat(HEADINGS.len() - 1)
    );
    for finding in findings {
        let cells = cells(finding).map(|cell| escaped(&cell));
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

/// Findings that have anything to show.
fn shown(comparison: &Comparison) -> impl Iterator<Item = &Finding> {
    let tells = |finding: &&Finding| finding.judged() || finding.verdict != CaseVerdict::Same;
    comparison.findings.iter().filter(tells)
}

fn cells(finding: &Finding) -> [String; 8] {
    let percent = |ratio: f64| format!("{:+.1} %", 100.0 * (ratio - 1.0));
    let or_none = |cell: Option<String>| cell.unwrap_or_else(|| "-".to_owned());
    let time = finding.time.as_ref();
    [
        finding.case.to_string(),
        or_none(finding.error_ratio().map(factor)),
        or_none(finding.count_ratio().map(factor)),
        or_none(time.map(|t| percent(t.median))),
        or_none(time.map(|t| {
            let (low, high) = t.interval;
            format!("{:+.1} {:+.1}", 100.0 * (low - 1.0), 100.0 * (high - 1.0))
        })),
        or_none(time.map(|t| chance(t.chance))),
        or_none(time.map(|t| format!("{:.0} %", 100.0 * t.tolerance))),
        word(finding).to_owned(),
    ]
}

/// A ratio of errors or counts.
#[must_use]
pub fn factor(ratio: f64) -> String {
    match ratio {
        _ if ratio == 1.0 => "=".to_owned(),
        _ if (0.1..100.0).contains(&ratio) => format!("x{ratio:.3}"),
        _ => format!("x{ratio:.1e}"),
    }
}

/// A chance (0 to 1) with three decimals and no zero before them.
#[must_use]
pub fn chance(p: f64) -> String {
    if p < 0.001 {
        "<.001".to_owned()
    } else {
        format!("{p:.3}").trim_start_matches('0').to_owned()
    }
}

/// One word for a case.
fn word(finding: &Finding) -> &'static str {
    match finding.verdict {
        CaseVerdict::CannotCompare => "?",
        CaseVerdict::Worse => "WORSE",
        CaseVerdict::Better => "better",
        CaseVerdict::Same => "same",
        CaseVerdict::New => "new",
    }
}

/// Reasons, each with its cases; cases with the same reason share a line.
pub(crate) fn reasons(comparison: &Comparison) -> Vec<(String, String)> {
    let mut lines: Vec<(&str, &str, Vec<String>)> = vec![];
    for finding in &comparison.findings {
        for reason in &finding.reasons {
            let word = word(finding);
            let name = finding.case.to_string();
            match lines.iter_mut().find(|(w, r, _)| *w == word && r == reason) {
                Some((_, _, names)) => names.push(name),
                None => lines.push((word, reason, vec![name])),
            }
        }
    }
    let said = lines.into_iter().map(|(word, reason, names)| {
        let more = match names.len() {
            1 => String::new(),
            n => format!(" and {} more", n - 1),
        };
        let first = names.into_iter().next().unwrap_or_default();
        (format!("{word} {first}{more}"), reason.to_owned())
    });
    said.collect()
}

/// Differences that are not judged, case by case.
fn told(comparison: &Comparison) -> Vec<String> {
    let of = |finding: &Finding| -> Vec<String> {
        let case = finding.case.to_string();
        let lines = finding.told.iter().map(|line| format!("{case}: {line}"));
        lines.collect()
    };
    comparison.findings.iter().flat_map(of).collect()
}

/// Numbers that were compared, and those that could not be.
pub(crate) fn compared(comparison: &Comparison) -> String {
    let tallies = comparison.tallies();
    let part = |tally: &Tally| {
        let word = tally.meaning.plural();
        match tally.compared - tally.equal.min(tally.compared) {
            0 => format!("{} {word}", tally.compared),
            changed => format!("{} {word} ({changed} differ)", tally.compared),
        }
    };
    let parts: Vec<String> = tallies
        .iter()
        .filter(|t| t.compared > 0)
        .map(part)
        .collect();
    let times = comparison.findings.iter().filter(|f| f.time.is_some());
    let mut text = match (parts.is_empty(), times.count()) {
        (true, 0) => "compared nothing".to_owned(),
        (true, n) => format!("compared {n} times"),
        (false, 0) => format!("compared bit by bit: {}; no times", parts.join(", ")),
        (false, n) => format!("compared bit by bit: {}; {n} times", parts.join(", ")),
    };
    let alone: usize = tallies.iter().map(|tally| tally.alone).sum();
    let whole = |verdict| {
        comparison
            .findings
            .iter()
            .filter(move |f| f.verdict == verdict)
    };
    let left = whole(CaseVerdict::CannotCompare).count();
    if alone + left > 0 {
        let _ = write!(
            text,
            "; could not compare {left} of {} cases, {alone} numbers that only one of them has",
            comparison.findings.len()
        );
    }
    text
}

/// The verdict in a word.
pub(crate) fn verdict_word(comparison: &Comparison) -> &'static str {
    match comparison.verdict() {
        Verdict::Fine => "FINE",
        Verdict::Worse => "WORSE",
        Verdict::CannotCompare => "CANNOT COMPARE",
    }
}

/// The verdict, and how many cases it rests on.
pub(crate) fn verdict_line(comparison: &Comparison) -> String {
    let count = |verdict| {
        let of_it = comparison.findings.iter().filter(|f| f.verdict == verdict);
        of_it.count()
    };
    let compared = comparison.findings.iter().filter(|f| f.judged()).count();
    let mut parts = vec![];
    for (verdict, word) in [
        (CaseVerdict::CannotCompare, "cannot be compared"),
        (CaseVerdict::Worse, "worse"),
        (CaseVerdict::Better, "better"),
        (CaseVerdict::New, "new"),
    ] {
        if count(verdict) > 0 {
            parts.push(format!("{} {word}", count(verdict)));
        }
    }
    let changes = comparison
        .findings
        .iter()
        .flat_map(|finding| &finding.changes);
    match changes
        .filter(|change| change.moved == Direction::Accepted)
        .count()
    {
        0 => {}
        1 => parts.push("1 accepted change".to_owned()),
        n => parts.push(format!("{n} accepted changes")),
    }
    let parts = if parts.is_empty() {
        "no change".to_owned()
    } else {
        parts.join(", ")
    };
    let verdict = verdict_word(comparison);
    let times = if comparison.times_left_out {
        "; times left out"
    } else {
        ""
    };
    format!("{verdict}: {} compared, {parts}{times}", cases(compared))
}

fn cases(count: usize) -> String {
    match count {
        1 => "1 case".to_owned(),
        n => format!("{n} cases"),
    }
}

/// Commit and machine of a record.
fn side(name: &str, record: &Record) -> String {
    let word = |key: &str| record.context[key].as_str().unwrap_or("unknown");
    let commit: String = word("commit").chars().take(10).collect();
    format!(
        "{name} `{commit}` ({}, {} lanes)",
        word("cpu_model"),
        word("lanes")
    )
}

/// Text inside a Markdown table or list.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '|' | '*' | '_' | '`' | '<' | '>' | '[' | ']' | '\\' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '\n' | '\r' => escaped.push(' '),
            _ if c.is_control() => {}
            _ => escaped.push(c),
        }
    }
    escaped
}
