//! What changed since a base record: regressions and gains as tables and pictures, by the judge of `proctor compare`.

use super::html::{Cell, Pictures, Section, Table, folded, paragraph};
use crate::judge::change::{CASE, Change, FAILURE, Found, Moved};
use crate::judge::{self, CaseVerdict, Comparison, Finding, Rules, Verdict};
use crate::record::details::Figure;
use crate::record::row::{GATE_BOUND, GATE_VALUE};
use crate::record::{Meaning, Record};
use crate::show::chart::Format;
use crate::show::{comparison as show, figures, number, percent, shortened};
use std::collections::BTreeMap;

/// Lines of a table; `proctor compare` lists all.
const LISTED: usize = 40;
/// Lines on the first screen.
const FIRST: usize = 4;
/// Bars of a picture.
const BARS: usize = 12;
/// Characters of the name of a bar.
const NAME: usize = 32;

/// A base record and what the judge says of the record beside it.
pub struct Since<'a> {
    base: &'a Record,
    comparison: Comparison,
    /// Names of quantities by their keys.
    names: BTreeMap<String, String>,
}

/// A number that moved.
struct Line<'a> {
    finding: &'a Finding,
    change: &'a Change,
    /// How much worse, over what it was; negative where it is better.
    loss: f64,
}

impl<'a> Since<'a> {
    /// Judges a record against a base.
    #[must_use]
    pub fn new(base: &'a Record, head: &Record) -> Self {
        let cases = head.details.cases.iter();
        let names = cases.flat_map(|case| case.quantities.iter().cloned());
        Self {
            base,
            comparison: judge::compare_as_measured(base, head, &Rules::default()),
            names: names.map(|[key, name]| (key, name)).collect(),
        }
    }

    /// What the judge says.
    #[must_use]
    pub fn comparison(&self) -> &Comparison {
        &self.comparison
    }

    fn count(&self, verdict: CaseVerdict) -> usize {
        let findings = self.comparison.findings.iter();
        findings.filter(|f| f.verdict == verdict).count()
    }

    /// Numbers that moved that way, the largest change first.
    fn moved(&self, way: Moved) -> Vec<Line<'_>> {
        let mut lines: Vec<Line<'_>> = vec![];
        for finding in &self.comparison.findings {
            for change in finding.changes.iter().filter(|c| c.moved == way) {
                let numbers = change.base.number().zip(change.head.number());
                let loss =
                    numbers.map_or(f64::INFINITY, |(base, head)| change.better.loss(base, head));
                lines.push(Line {
                    finding,
                    change,
                    loss,
                });
            }
        }
        lines.sort_by(|a, b| b.loss.abs().total_cmp(&a.loss.abs()));
        lines
    }

    /// What a number is, in words.
    fn name(&self, change: &Change) -> String {
        let key = change.number.as_str();
        let told = |prefix: &str, word: &str| {
            let rest = key.strip_prefix(prefix)?;
            let name = self.names.get(rest).cloned();
            Some(format!(
                "{word} {}",
                name.unwrap_or_else(|| rest.replace('_', " "))
            ))
        };
        match key {
            CASE => "the case".to_owned(),
            FAILURE => "failure".to_owned(),
            GATE_VALUE => "found by the gate".to_owned(),
            GATE_BOUND => "bound of the gate".to_owned(),
            _ => told("error_", "error of")
                .or_else(|| told("observed_order_", "order of"))
                .or_else(|| told("balance_", "balance of"))
                .or_else(|| told("value_", "value of"))
                .unwrap_or_else(|| key.replace('_', " ")),
        }
    }

    /// Case, number, before, after and change.
    fn cells(&self, line: &Line<'_>) -> [Cell; 5] {
        let Line {
            finding,
            change,
            loss,
        } = line;
        let moved = match (change.base.number(), change.head.number()) {
            _ if change.meaning == Meaning::Order => {
                let by = change.head.number().zip(change.base.number());
                by.map_or_else(String::new, |(head, base)| format!("{:+.2}", head - base))
            }
            (Some(base), Some(head)) if base != 0.0 => ratio(head / base),
            _ if loss.is_infinite() => "new".to_owned(),
            _ => String::new(),
        };
        [
            finding.case.name.clone().into(),
            self.name(change).into(),
            written(change.meaning, &change.base).into(),
            written(change.meaning, &change.head).into(),
            moved.into(),
        ]
    }

    fn table(&self, caption: &str, lines: &[Line<'_>], most: usize) -> Table {
        let head = ["case", "what", "before", "now", "change"];
        let mut table = Table::new(caption, &head);
        for line in lines.iter().take(most) {
            table.push(self.cells(line));
        }
        table
    }

    /// The largest changes as bars, each over what it was; what has no such ratio is in the table alone.
    fn picture(&self, title: &str, quantity: &str, lines: &[Line<'_>]) -> Option<Figure> {
        let bars: Vec<(String, f64)> = lines
            .iter()
            .filter(|line| line.loss.is_finite())
            .take(BARS)
            .map(|line| {
                let name = format!("{}: {}", line.finding.case.name, self.name(line.change));
                (shortened(&name, NAME), line.loss.abs())
            })
            .collect();
        (!bars.is_empty()).then(|| Figure {
            caption: format!("{title}: change of each number over what it was, the largest first."),
            chart: figures::bars_of(title, quantity, Format::Percent, &bars),
        })
    }
}

/// A number of that meaning.
fn written(meaning: Meaning, found: &Found) -> String {
    match (meaning, found) {
        (_, Found::Nothing) => "none".to_owned(),
        (Meaning::Error, Found::Number(value)) => percent(*value),
        (_, Found::Number(value)) => number(*value),
        (_, Found::Word(word)) => word.clone(),
    }
}

/// A ratio as a change in per cent, or as a factor where that reads better.
fn ratio(ratio: f64) -> String {
    if (0.5..2.0).contains(&ratio) {
        let change = percent(ratio - 1.0);
        if ratio > 1.0 {
            format!("+{change}")
        } else {
            change
        }
    } else {
        format!("×{}", number(ratio))
    }
}

/// What changed, in a word and a sentence, and whether it is one to worry about.
#[must_use]
pub fn headline(since: Option<&Since<'_>>) -> ([String; 2], bool) {
    let Some(since) = since else {
        let text = "no earlier record was given to compare with";
        return (["–".to_owned(), text.to_owned()], false);
    };
    let verdict = since.comparison.verdict();
    let mut parts = vec![];
    for (verdict, word) in [
        (CaseVerdict::Worse, "worse"),
        (CaseVerdict::Better, "better"),
        (CaseVerdict::New, "new"),
        (CaseVerdict::CannotCompare, "cannot be compared"),
    ] {
        if since.count(verdict) > 0 {
            parts.push(format!("{} {word}", since.count(verdict)));
        }
    }
    let compared = since.comparison.findings.iter().filter(|f| f.judged());
    let text = format!(
        "since {}: {} of {} runs and gates",
        commit(since.base),
        if parts.is_empty() {
            "no change in any".to_owned()
        } else {
            parts.join(", ")
        },
        compared.count()
    );
    let word = show::verdict_word(&since.comparison).to_owned();
    ([word, text], verdict != Verdict::Fine)
}

fn commit(record: &Record) -> String {
    let commit = record.context["commit"].as_str();
    let date = record.context["date"].as_str();
    let short = |text: &str, n: usize| text.chars().take(n).collect::<String>();
    match (commit, date) {
        (Some(commit), _) => format!("commit {}", short(commit, 10)),
        (None, Some(date)) => format!("the record of {}", short(date, 10)),
        (None, None) => "the base record".to_owned(),
    }
}

/// The panel of the first screen.
#[must_use]
pub fn panel(since: Option<&Since<'_>>) -> String {
    let Some(since) = since else {
        return paragraph(
            "No earlier record was given. `proctor report HEAD --base BASE` makes this page from two records: what got \
             worse and what got better from BASE to HEAD, in tables and pictures.",
        );
    };
    let mut html = paragraph(&show::verdict_line(&since.comparison));
    for (caption, way) in [
        ("Largest losses", Moved::Worse),
        ("Largest gains", Moved::Better),
    ] {
        let lines = since.moved(way);
        if !lines.is_empty() {
            html.push_str(&since.table(caption, &lines, FIRST).html());
        }
    }
    html.push_str("<p><a href=\"#changes\">All changes</a></p>\n");
    html
}

/// The section, where there is a base.
#[must_use]
pub fn section(since: &Since<'_>, pictures: &mut Pictures) -> Section {
    let mut body = paragraph(&format!(
        "Against {}, by the judge of `proctor compare`: {}.",
        commit(since.base),
        show::compared(&since.comparison)
    ));
    let comparison = &since.comparison;
    for line in comparison.obstacles.iter().chain(&comparison.notes) {
        body.push_str(&paragraph(line));
    }
    for (caption, title, quantity, way) in [
        (
            "Regressions, the largest first",
            "What got worse",
            "worse by, over what it was",
            Moved::Worse,
        ),
        (
            "Gains, the largest first",
            "What got better",
            "better by, over what it was",
            Moved::Better,
        ),
    ] {
        let lines = since.moved(way);
        if lines.is_empty() {
            body.push_str(&paragraph(&format!("{title}: nothing.")));
            continue;
        }
        if let Some(picture) = since.picture(title, quantity, &lines) {
            body.push_str(&pictures.one("", &picture));
        }
        body.push_str(&since.table(caption, &lines, LISTED).html());
        if lines.len() > LISTED {
            body.push_str(&paragraph(&format!(
                "And {} more: `proctor compare BASE HEAD` lists all of them.",
                lines.len() - LISTED
            )));
        }
    }
    let reasons: String = show::reasons(comparison)
        .into_iter()
        .map(|(about, reason)| paragraph(&format!("{about}: {reason}")))
        .collect();
    if !reasons.is_empty() {
        body.push_str(&folded("what the judge said, case by case", &reasons));
    }
    Section {
        id: "changes",
        title: "What changed since the base record".to_owned(),
        body,
    }
}
