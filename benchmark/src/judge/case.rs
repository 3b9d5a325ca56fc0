//! One case, judged.

use super::change::{self, Change, Direction, RecordedValue};
use super::equal_error;
use super::time::{self, Pace, Time};
use super::{Rules, noise};
use crate::record::{CaseKey, Cases, Meaning, Series};

/// The verdict on a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseVerdict {
    /// It cannot be compared, or not in full.
    CannotCompare,
    /// It got worse.
    Worse,
    /// It got better, and in nothing worse.
    Better,
    /// Nothing changed that is judged.
    Same,
    /// HEAD alone has it, and it holds.
    New,
}

/// A case of one or both records.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Key of the case.
    pub case: CaseKey,
    /// All that was compared bit by bit, what is equal too.
    pub changes: Vec<Change>,
    /// Its time, where it was judged.
    pub time: Option<Time>,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// Reasons of the verdict, line by line.
    pub reasons: Vec<String>,
    /// Lines on numbers that moved and are not judged for it.
    pub told: Vec<String>,
}

impl Finding {
    /// True if anything of the case was compared.
    #[must_use]
    pub fn judged(&self) -> bool {
        self.time.is_some()
            || self.verdict == CaseVerdict::Worse
            || self
                .changes
                .iter()
                .any(|c| !matches!(c.meaning, Meaning::Setting | Meaning::Information))
    }

    /// Largest ratio of errors, HEAD over BASE.
    #[must_use]
    pub fn error_ratio(&self) -> Option<f64> {
        self.largest(Meaning::Error)
    }

    /// Largest ratio of counts, HEAD over BASE.
    #[must_use]
    pub fn count_ratio(&self) -> Option<f64> {
        self.largest(Meaning::Count)
    }

    fn largest(&self, meaning: Meaning) -> Option<f64> {
        let of_it = self.changes.iter().filter(|c| c.meaning == meaning);
        of_it.filter_map(Change::ratio).reduce(f64::max)
    }
}

/// A case with what is found of it so far.
struct Docket<'a> {
    rules: &'a Rules<'a>,
    ladder: &'a str,
    finding: Finding,
    marks: Marks,
}

impl<'a> Docket<'a> {
    fn new(case: &CaseKey, rules: &'a Rules<'a>, ladder: &'a str) -> Self {
        Self {
            rules,
            ladder,
            finding: Finding {
                case: case.clone(),
                changes: vec![],
                time: None,
                verdict: CaseVerdict::Same,
                reasons: vec![],
                told: vec![],
            },
            marks: Marks::default(),
        }
    }

    /// Takes a change into the verdict: as the ledger says where it knows it, as it stands otherwise.
    fn add(&mut self, change: Change) {
        self.add_in_bars(change, None);
    }

    /// The same of a value that moved by so many half-widths of its bar in BASE. A bar excuses no moved number; it says
    /// whether the move is one.
    fn add_in_bars(&mut self, mut change: Change, bars: Option<f64>) {
        let name = self.finding.case.to_string();
        if let Some(ledger) = self.rules.ledger {
            if change.moved != Direction::Same && ledger.accepts(self.ladder, &name, &change) {
                change.moved = Direction::Accepted;
            }
            if let Some(best) = ledger.below_best(self.ladder, &name, &change) {
                self.marks.worse = true;
                self.finding.reasons.push(format!(
                    "{} {} is worse than the best value ever accepted, {best:?}",
                    change.number, change.head
                ));
            }
            if self.rules.strict && !matches!(change.moved, Direction::Same | Direction::Accepted) {
                self.marks.worse = true;
                self.finding.reasons.push(format!(
                    "{} {} -> {} without a line in the ledger",
                    change.number, change.base, change.head
                ));
            }
        }
        self.marks.add(change.moved);
        if let Some(mut line) = line(&change) {
            match bars {
                Some(bars) if bars > 1.0 => line += ", out of the bar",
                Some(bars) => {
                    line = format!("{line}, by {} of the bar", crate::show::number(bars));
                }
                None => {}
            }
            match change.moved {
                Direction::Close | Direction::Accepted => self.finding.told.push(line),
                _ => self.finding.reasons.push(line),
            }
        }
        self.finding.changes.push(change);
    }

    fn close(mut self, verdict: CaseVerdict) -> Finding {
        self.finding.verdict = verdict;
        self.finding
    }
}

/// A case that HEAD lacks.
pub(super) fn missing(case: &CaseKey, rules: &Rules<'_>, ladder: &str) -> Finding {
    let mut docket = Docket::new(case, rules, ladder);
    docket.add(Change::of_case(true, false));
    let verdict = docket.marks.verdict();
    docket.close(verdict)
}

/// Judges a case of HEAD.
pub(super) fn judge(
    case: &CaseKey,
    head: &Series,
    base: &Cases,
    rules: &Rules<'_>,
    ladder: &str,
) -> Finding {
    let mut docket = Docket::new(case, rules, ladder);
    let Some(own) = base.get(case) else {
        // New is told, and fine, unless a ledger is to know of everything.
        let mut new = Change::of_case(false, true);
        if rules.strict {
            docket.add(new);
        } else {
            new.moved = Direction::Close;
            docket.finding.changes.push(new);
        }
        if let Some(failures) = Change::of_failures(None, head) {
            docket.add(failures);
        }
        if change::gate_holds(head) == Some(false) {
            docket.marks.worse = true;
            let reason = "a new gate that does not hold".to_owned();
            docket.finding.reasons.push(reason);
        }
        let verdict = match docket.marks.verdict() {
            CaseVerdict::Same => CaseVerdict::New,
            other => other,
        };
        return docket.close(verdict);
    };
    if let Some(failures) = Change::of_failures(Some(own), head) {
        docket.add(failures);
    }
    for change in change::compare(own, head) {
        let bars = change::in_bars(&change, own);
        docket.add_in_bars(change, bars);
    }
    if change::gate_holds(head) == Some(false) {
        let held = change::gate_holds(own) == Some(true);
        let accepted = docket
            .finding
            .changes
            .iter()
            .any(|change| change.moved == Direction::Accepted);
        if held && !accepted {
            docket.marks.worse = true;
            let reason = "the gate held in BASE and does not hold in HEAD".to_owned();
            docket.finding.reasons.push(reason);
        }
    }
    let untimed = own.wall.is_empty() && head.wall.is_empty();
    let failed = !own.errors.is_empty() || !head.errors.is_empty();
    if !rules.ignore_time && !untimed && !failed {
        let band = rules.noise.and_then(|noise| noise::band(noise, case));
        match time::compare(own, head, band) {
            Ok(found) => {
                let paid = paid(base, case, &docket.finding.changes);
                let (moved, reason) = judge_time(&found, &paid);
                docket.marks.add(moved);
                docket.finding.reasons.extend(reason);
                docket.finding.time = Some(found);
            }
            Err(reason) => {
                docket.marks.cannot = true;
                docket.finding.reasons.push(reason);
            }
        }
    }
    let verdict = docket.marks.verdict();
    docket.close(verdict)
}

/// Findings in a case so far.
#[derive(Default)]
struct Marks {
    cannot: bool,
    worse: bool,
    better: bool,
}

impl Marks {
    fn add(&mut self, moved: Direction) {
        match moved {
            Direction::Same | Direction::Close | Direction::Accepted => {}
            Direction::Better => self.better = true,
            Direction::Worse => self.worse = true,
            Direction::Missing | Direction::Appeared | Direction::Other => self.cannot = true,
        }
    }

    fn verdict(&self) -> CaseVerdict {
        if self.cannot {
            CaseVerdict::CannotCompare
        } else if self.worse {
            CaseVerdict::Worse
        } else if self.better {
            CaseVerdict::Better
        } else {
            CaseVerdict::Same
        }
    }
}

/// Line on a change; nothing where there is none.
fn line(changed: &Change) -> Option<String> {
    let Change {
        number, base, head, ..
    } = changed;
    let moved = format!("{number} {}", arrow(changed));
    Some(match changed.moved {
        Direction::Same => return None,
        Direction::Missing if number == change::CASE => "missing in HEAD".to_owned(),
        Direction::Missing => format!("{number} is missing in HEAD, {base} in BASE"),
        Direction::Appeared if number == change::CASE => "not in BASE".to_owned(),
        Direction::Appeared => format!("{number} is {head} in HEAD, and not in BASE"),
        Direction::Other => format!("another problem: {moved}"),
        Direction::Accepted => format!("accepted: {moved}"),
        Direction::Better if number == change::FAILURE => format!("failed in BASE only: {base}"),
        Direction::Worse if number == change::FAILURE => match base {
            RecordedValue::Nothing => format!("fails in HEAD only: {head}"),
            _ => format!("fails for another reason: {base} -> {head}"),
        },
        Direction::Worse if changed.meaning == Meaning::GateBound => format!("looser: {moved}"),
        Direction::Close | Direction::Better | Direction::Worse => moved,
    })
}

/// Values before and after, with as many digits as tell the two apart.
fn arrow(changed: &Change) -> String {
    let (base, head) = (&changed.base, &changed.head);
    let (Some(from), Some(to)) = (base.number(), head.number()) else {
        return format!("{base} -> {head}");
    };
    let short = crate::show::number;
    if from == to {
        return format!("{} in both, not the same in every run", short(to));
    }
    let (before, after) = (short(from), short(to));
    let values = if before == after {
        format!("{base} -> {head}")
    } else {
        format!("{before} -> {after}")
    };
    match changed.meaning {
        Meaning::Order => format!("{values} ({:+.2})", to - from),
        _ if from == 0.0 => values,
        _ => format!("{values} ({})", change(to / from)),
    }
}

/// A ratio as a change in per cent, or as a factor where that reads better.
fn change(ratio: f64) -> String {
    if (ratio - 1.0).abs() < 1e-3 {
        format!("{:+.1e} of itself", ratio - 1.0)
    } else if (0.5..2.0).contains(&ratio) {
        format!("{:+.1} %", 100.0 * (ratio - 1.0))
    } else {
        format!("x{}", crate::show::number(ratio))
    }
}

/// Accuracy that a gain in time cost.
enum Paid {
    /// Nothing: no error rose.
    Nothing,
    /// The error that cost most, and how many times longer BASE takes for its own error than for that of HEAD.
    Factor(String, f64),
    /// An error rose, and no ladder says what that is worth.
    Unknown(String),
}

fn paid(base: &Cases, case: &CaseKey, changes: &[Change]) -> Paid {
    let mut paid = Paid::Nothing;
    for changed in changes.iter().filter(|c| c.meaning == Meaning::Error) {
        let (Some(from), Some(to)) = (changed.base.number(), changed.head.number()) else {
            continue;
        };
        if to <= from {
            continue;
        }
        match equal_error::cost(base, case, &changed.number, to) {
            None => return Paid::Unknown(changed.number.clone()),
            Some(factor) => match &paid {
                Paid::Factor(_, known) if *known >= factor => {}
                _ => paid = Paid::Factor(changed.number.clone(), factor),
            },
        }
    }
    paid
}

/// Direction of the time, at equal error where a gain was paid for in accuracy.
fn judge_time(time: &Time, paid: &Paid) -> (Direction, Option<String>) {
    match (time.pace, paid) {
        (Pace::Same, _) => (Direction::Same, None),
        (Pace::Slower, _) => (Direction::Worse, Some(time.said("slower"))),
        (Pace::Unclear, _) => (Direction::Other, Some(time.unclear())),
        (Pace::Faster, Paid::Nothing) => (Direction::Better, Some(time.said("faster"))),
        (Pace::Faster, Paid::Unknown(key)) => (
            Direction::Same,
            Some(format!(
                "faster, but {key} rose, and no ladder tells its worth: no gain"
            )),
        ),
        (Pace::Faster, Paid::Factor(key, factor)) => {
            let (moved, word) = match time.pace_at(*factor) {
                Pace::Same => (Direction::Same, "no change"),
                Pace::Faster => (Direction::Better, "still faster"),
                Pace::Slower => (Direction::Worse, "slower"),
                Pace::Unclear => (Direction::Other, "too noisy to tell"),
            };
            let text = format!(
                "time {} was paid for in accuracy ({key}); at equal error {}: {word}",
                change(time.median),
                change(time.median * factor)
            );
            (moved, Some(text))
        }
    }
}
