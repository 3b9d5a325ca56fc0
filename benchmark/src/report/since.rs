//! The changes since a base record: regressions and gains as tables and pictures, by the judge of `proctor compare`.

use super::gates;
use super::html::{Pictures, Section, Table, folded, paragraph};
use crate::judge::change::{CASE, Change, Direction, FAILURE, RecordedValue};
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
const NAME: usize = 40;

/// A base record and what the judge says of the record beside it.
pub struct Since<'a> {
    base: &'a Record,
    comparison: Comparison,
    /// Names of quantities by their keys.
    names: BTreeMap<String, String>,
}

/// A number or a word that moved.
struct Line<'a> {
    finding: &'a Finding,
    change: &'a Change,
    /// Loss over the value before, for an order the loss itself; negative where it is better. None of what has no size, such as
    /// a failure.
    loss: Option<f64>,
}

impl<'a> Line<'a> {
    fn new(finding: &'a Finding, change: &'a Change) -> Self {
        let numbers = change.base.number().zip(change.head.number());
        Self {
            finding,
            change,
            loss: numbers.map(|(base, head)| match change.meaning {
                Meaning::Order => base - head,
                _ => change.better.loss(base, head),
            }),
        }
    }

    /// Value that was found, relative errors in per cent.
    fn written(&self, found: &RecordedValue) -> String {
        let name = self.finding.case.name.as_str();
        match (self.change.meaning, found) {
            (_, RecordedValue::Nothing) => "none".to_owned(),
            (_, RecordedValue::Word(word)) => word.clone(),
            (Meaning::Error, RecordedValue::Number(value)) => percent(*value),
            (Meaning::GateValue | Meaning::GateBound, RecordedValue::Number(value))
                if !name.starts_with("stability") =>
            {
                gates::value_of_case(name, *value)
            }
            (_, RecordedValue::Number(value)) => number(*value),
        }
    }

    fn size(&self) -> f64 {
        self.loss.map_or(f64::INFINITY, f64::abs)
    }

    /// The name of the case, without what all studies have in common.
    fn case(&self) -> &str {
        let name = self.finding.case.name.as_str();
        name.strip_prefix("precision/").unwrap_or(name)
    }
}

impl<'a> Since<'a> {
    /// Judges a record against a base as both were measured.
    #[must_use]
    pub fn new(base: &'a Record, head: &Record) -> Self {
        Self::of(
            base,
            head,
            judge::compare_as_measured(base, head, &Rules::default()),
        )
    }

    /// Judges a record against a base by these rules.
    #[must_use]
    pub fn by(base: &'a Record, head: &Record, rules: &Rules<'_>) -> Self {
        Self::of(base, head, judge::compare(base, head, rules))
    }

    fn of(base: &'a Record, head: &Record, comparison: Comparison) -> Self {
        let cases = head.details.cases.iter();
        let names = cases.flat_map(|case| case.quantities.iter().cloned());
        Self {
            base,
            comparison,
            names: names.map(|[key, name]| (key, name)).collect(),
        }
    }

    /// Verdict of the judge.
    #[must_use]
    pub fn comparison(&self) -> &Comparison {
        &self.comparison
    }

    fn count(&self, verdict: CaseVerdict) -> usize {
        let findings = self.comparison.findings.iter();
        findings.filter(|f| f.verdict == verdict).count()
    }

    /// Lines that moved that way, the largest change first; lines without a size come before all else.
    fn moved(&self, way: Direction) -> Vec<Line<'_>> {
        let findings = self.comparison.findings.iter();
        let mut lines: Vec<Line<'_>> = findings
            .flat_map(|finding| {
                let changes = finding.changes.iter().filter(|c| c.moved == way);
                changes.map(|change| Line::new(finding, change))
            })
            .collect();
        lines.sort_by(|a, b| b.size().total_cmp(&a.size()));
        lines
    }

    /// Name of a number, in words.
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
    fn texts(&self, line: &Line<'_>) -> [String; 5] {
        let change = line.change;
        let moved = match (change.base.number(), change.head.number()) {
            (Some(base), Some(head)) if change.meaning == Meaning::Order => {
                format!("{:+.2}", head - base)
            }
            (Some(base), Some(head)) if base != 0.0 => ratio(head / base),
            _ => String::new(),
        };
        [
            line.case().to_owned(),
            self.name(change),
            line.written(&change.base),
            line.written(&change.head),
            moved,
        ]
    }

    /// Numbers with their change.
    fn table<'b>(&self, caption: &str, lines: impl Iterator<Item = &'b Line<'b>>) -> Table {
        let head = ["case", "what", "before", "now", "change"];
        let mut table = Table::new(caption, &head);
        for line in lines {
            table.push(self.texts(line));
        }
        table
    }

    /// Lines without a size: failures, words.
    fn words<'b>(&self, caption: &str, lines: impl Iterator<Item = &'b Line<'b>>) -> Table {
        let mut table = Table::new(caption, &["case", "what", "before", "now"]);
        for line in lines {
            let [case, what, before, now, _] = self.texts(line);
            table.push([case, what, before, now]);
        }
        table
    }

    /// The largest changes as bars, each over what it was; orders, and what was zero, are in the table alone.
    fn picture(&self, title: &str, quantity: &str, lines: &[Line<'_>]) -> Option<Figure> {
        let bars: Vec<(String, f64)> = lines
            .iter()
            .filter(|line| line.size().is_finite() && line.change.meaning != Meaning::Order)
            .take(BARS)
            .map(|line| {
                let name = format!("{}: {}", line.case(), self.name(line.change));
                (shortened(&name, NAME), line.size())
            })
            .collect();
        (!bars.is_empty()).then(|| Figure {
            caption: format!(
                "{title}: change of each number over its value before, the largest first."
            ),
            chart: figures::bars_of(title, quantity, Format::Percent, &bars),
        })
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

/// The changes, in a word and a sentence, and their look: none, `near` or `bad`.
#[must_use]
pub fn headline(since: Option<&Since<'_>>) -> ([String; 2], &'static str) {
    let Some(since) = since else {
        let text = "no earlier record was given to compare with";
        return (["–".to_owned(), text.to_owned()], "");
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
    let look = match verdict {
        Verdict::Fine => "",
        Verdict::Worse => "bad",
        Verdict::CannotCompare => "near",
    };
    ([word, text], look)
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
            "No earlier record was given. `proctor report HEAD --base BASE` makes this page from two records: \
             the losses and gains from BASE to HEAD, in tables and pictures.",
        );
    };
    let mut html = paragraph(&show::verdict_line(&since.comparison));
    for (caption, way) in [
        ("Largest losses", Direction::Worse),
        ("Largest gains", Direction::Better),
    ] {
        let lines = since.moved(way);
        let mut table = Table::new(caption, &["case and number", "before, now", "change"]);
        for line in lines.iter().filter(|line| line.loss.is_some()).take(FIRST) {
            let [case, what, before, now, change] = since.texts(line);
            table.push([
                format!("{case}: {what}"),
                format!("{before}, {now}"),
                change,
            ]);
        }
        if !table.is_empty() {
            html.push_str(&table.html());
        }
        let others = lines.iter().filter(|line| line.loss.is_none()).count();
        if others > 0 {
            html.push_str(&paragraph(&format!(
                "{caption}: {others} without a size, such as failures."
            )));
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
            "worse by, over the value before",
            Direction::Worse,
        ),
        (
            "Gains, the largest first",
            "What got better",
            "better by, over the value before",
            Direction::Better,
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
        let (sized, others): (Vec<_>, Vec<_>) = lines.iter().partition(|line| line.loss.is_some());
        if !sized.is_empty() {
            let listed = sized.iter().copied().take(LISTED);
            body.push_str(&since.table(caption, listed).html());
        }
        if !others.is_empty() {
            let listed = others.iter().copied().take(LISTED);
            let caption = format!("{title}, and has no size");
            body.push_str(&since.words(&caption, listed).html());
        }
        let more = sized.len().saturating_sub(LISTED) + others.len().saturating_sub(LISTED);
        if more > 0 {
            body.push_str(&paragraph(&format!(
                "And {more} more: `proctor compare BASE HEAD` lists all of them."
            )));
        }
    }
    let reasons: String = show::reasons(comparison)
        .into_iter()
        .map(|(about, reason)| paragraph(&format!("{about}: {reason}")))
        .collect();
    if !reasons.is_empty() {
        body.push_str(&folded("the judge's lines, case by case", &reasons));
    }
    Section {
        id: "changes",
        title: "What changed since the base record".to_owned(),
        body,
    }
}
