//! Gates: what was found of each, its bound, and which are nearest to theirs.

use super::html::{Cell, Table};
use crate::record::Record;
use crate::record::details::GateDetail;
use crate::show::{number, percent, summary};

/// Gates that are shown as the nearest to their bounds.
const NEAREST: usize = 5;

/// Format of the numbers of a gate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    /// A relative error, or one thing over another.
    Percent,
    /// An observed order, a count, or a ratio that is not an error.
    Plain,
    /// Newton.
    Force,
}

impl Unit {
    /// Format of a gate of a case, which its name tells: a number that is no order, no force and no count is relative.
    fn of_case(name: &str) -> Self {
        if name.contains("observed order") || name.contains("largest number of") {
            Self::Plain
        } else if name.ends_with(" N") {
            Self::Force
        } else {
            Self::Percent
        }
    }

    fn written(self, value: f64) -> String {
        match self {
            Self::Percent => percent(value),
            Self::Plain => number(value),
            Self::Force => format!("{} N", number(value)),
        }
    }
}

/// Value that a gate found, and its bound.
fn found_and_bound(gate: &GateDetail, unit: Unit) -> [String; 2] {
    [
        gate.value
            .map_or_else(|| "nothing".to_owned(), |value| unit.written(value)),
        format!("{} {}", gate.relation, unit.written(gate.bound)),
    ]
}

/// A value of a gate of a case, in the unit of the name of the gate: a relative one, as most are, in per cent.
#[must_use]
pub fn value_of_case(name: &str, value: f64) -> String {
    Unit::of_case(name).written(value)
}

/// Value that a gate of a case found, and its bound.
pub(crate) fn of_case(gate: &GateDetail) -> [String; 2] {
    found_and_bound(gate, Unit::of_case(&gate.name))
}

/// Value that a gate found of which nothing is relative, and its bound.
pub(crate) fn plain(gate: &GateDetail) -> [String; 2] {
    found_and_bound(gate, Unit::Plain)
}

/// Gates with their reasons; `written` says what was found and the bound.
pub(crate) fn table(
    caption: &str,
    gates: &[GateDetail],
    written: fn(&GateDetail) -> [String; 2],
) -> Table {
    let head = [
        "what is bounded",
        "",
        "found",
        "bound",
        "of its bound",
        "why this bound",
    ];
    let mut table = Table::new(caption, &head);
    for gate in gates {
        let word = if gate.passed { "PASS" } else { "FAIL" };
        let [found, bound] = written(gate);
        let cells: [Cell; 6] = [
            short_name(&gate.name).into(),
            word.into(),
            found.into(),
            bound.into(),
            used(gate),
            gate.reason.clone().into(),
        ];
        table.push_as(class(gate), cells);
    }
    table
}

/// The look of a gate: passed, near to its bound, or failed.
pub(crate) fn class(gate: &GateDetail) -> &'static str {
    match (gate.passed, gate.is_near()) {
        (true, true) => "passed near",
        (true, false) => "passed",
        (false, _) => "failed",
    }
}

/// The name of a gate without what it says twice: the variant before its colon may stand behind it again.
#[must_use]
pub fn short_name(name: &str) -> String {
    let Some((variant, rest)) = name.split_once(": ") else {
        return name.to_owned();
    };
    let again = format!(", {variant}");
    let at = rest.find(&again).filter(|at| {
        let after = &rest[at + again.len()..];
        after.is_empty() || after.starts_with([',', ' '])
    });
    match at {
        Some(at) => format!("{variant}: {}{}", &rest[..at], &rest[at + again.len()..]),
        None => name.to_owned(),
    }
}

/// The share of its bound that a gate uses up, as a bar.
pub(crate) fn used(gate: &GateDetail) -> Cell {
    let used = gate.used();
    Cell::with_share(summary::share(used), used.min(1.0))
}

/// The gates of a record with the case that each belongs to, the nearest to its bound first; what does not hold comes
/// before all else.
pub(crate) fn ranked(record: &Record) -> Vec<(&str, &GateDetail)> {
    let mut gates: Vec<(&str, &GateDetail)> = vec![];
    for case in &record.details.cases {
        gates.extend(case.gates.iter().map(|gate| (case.name.as_str(), gate)));
    }
    gates.sort_by(|(_, a), (_, b)| b.used().total_cmp(&a.used()));
    gates
}

/// The gates of cases that are nearest to their bounds.
pub(crate) fn nearest(record: &Record) -> Option<Table> {
    let ranked = ranked(record);
    let head = ["case and gate", "of its bound", "found, bound"];
    let caption = "Share of its bound that each uses up, the largest first; failed gates come before all others";
    let mut table = Table::new(caption, &head);
    let failing = ranked.iter().filter(|(_, gate)| !gate.passed).count();
    for (case, gate) in ranked.iter().take(NEAREST.max(failing)) {
        let [found, bound] = of_case(gate);
        let text = format!("{case}: {}", short_name(&gate.name));
        let name = Cell::linked(text, format!("case-{case}"));
        let cells: [Cell; 3] = [name, used(gate), format!("{found}, {bound}").into()];
        table.push_as(class(gate), cells);
    }
    (!table.is_empty()).then_some(table)
}
