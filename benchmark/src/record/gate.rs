//! Gates of a record, judged from their rows: a verdict that is stored beside them counts for nothing.

use super::row::{GATE, GATE_BOUND, GATE_SIDE, GATE_VALUE};
use super::{Kind, Record, Row};
use proctor_verification::case::Relation;

/// A gate as its row has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateRow<'a> {
    /// The case, or the scene, that it belongs to.
    pub case: &'a str,
    /// The bounded quantity.
    pub name: &'a str,
    /// The value; none where it could not be computed.
    pub value: Option<f64>,
    /// The bound; none in a row that lacks it.
    pub bound: Option<f64>,
    /// `at most` or `at least`.
    pub side: &'a str,
    /// The row.
    pub row: &'a Row,
}

impl<'a> GateRow<'a> {
    /// The gate of a row; none of other rows.
    #[must_use]
    pub fn of(row: &'a Row) -> Option<Self> {
        if !matches!(&row.kind, Kind::Aggregate { name } if name == GATE) {
            return None;
        }
        let (case, name) = row.name.split_once(": ")?;
        Some(Self {
            case,
            name,
            value: row.counters.get(GATE_VALUE).copied(),
            bound: row.counters.get(GATE_BOUND).copied(),
            side: row.labels.get(GATE_SIDE).map_or("", String::as_str),
            row,
        })
    }

    /// True if the value keeps the bound; a gate without either does not hold.
    #[must_use]
    pub fn holds(&self) -> bool {
        match (self.value, self.bound) {
            (Some(value), Some(bound)) if self.side == Relation::AtLeast.words() => value >= bound,
            (Some(value), Some(bound)) => value <= bound,
            _ => false,
        }
    }
}

impl Record {
    /// The gates in the order of their rows.
    pub fn gate_rows(&self) -> impl Iterator<Item = GateRow<'_>> {
        self.rows.iter().filter_map(GateRow::of)
    }
}
