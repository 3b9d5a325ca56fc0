//! The numbers of a record, read without anything else of it: a history reads hundreds of records of thousands of numbers.

use super::{CLOCK, CPU, Point};
use crate::judge::change::Better;
use crate::record::context::SCHEMA_VERSION;
use crate::record::row::{GATE_SIDE, PASS};
use crate::record::{CaseKey, Meaning};
use crate::statistics::median;
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::collections::HashMap;
use std::fmt;

/// A number of a case in one record.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Its key.
    pub key: String,
    /// Its meaning.
    pub meaning: Meaning,
    /// Better side of the number.
    pub better: Better,
    /// Its value, of several samples the worst; of times the median.
    pub value: f64,
}

/// The cases of a record with their numbers, in the order of its rows.
pub type Numbers = Vec<(CaseKey, Vec<Number>)>;

/// Place of a record in the history, and its numbers; none of a text that is no record of this version, for which
/// [`crate::record::Record::parse`] gives the reason.
#[must_use]
pub fn read(text: &[u8]) -> Option<(Point, Numbers)> {
    let file: File = serde_json::from_slice(text).ok()?;
    let version = file.context.get("schema_version").map(Value::as_u64);
    if version.is_some_and(|version| version != Some(u64::from(SCHEMA_VERSION)))
        || file.benchmarks.is_empty()
    {
        return None;
    }
    let word = |key: &str| {
        file.context
            .get(key)
            .and_then(Value::as_str)
            .unwrap_or_default()
            .to_owned()
    };
    let point = Point {
        commit: word("commit"),
        date: word("date"),
        subject: String::new(),
        machine: word("cpu_model"),
    };
    Some((point, gathered(file.benchmarks)))
}

#[derive(Deserialize)]
struct File {
    context: Map<String, Value>,
    benchmarks: Vec<Row>,
    #[serde(default, rename = "details")]
    _details: IgnoredAny,
}

/// The part of a row that is read.
#[derive(Default)]
struct Row {
    name: String,
    aggregate: Option<String>,
    side: Option<String>,
    one_thread: bool,
    failed: bool,
    timed: bool,
    /// Times by the clock and on the processors, in its unit.
    times: [Option<f64>; 2],
    unit: f64,
    numbers: Vec<(String, f64)>,
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RowVisitor)
    }
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Row;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a row")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Row, A::Error> {
        let mut row = Row {
            timed: true,
            unit: 1e-9,
            ..Row::default()
        };
        while let Some((key, value)) = map.next_entry::<String, Cell>()? {
            match (key.as_str(), value) {
                ("run_name", Cell::Word(name)) => row.name = name,
                ("name", Cell::Word(name)) if row.name.is_empty() => row.name = name,
                ("aggregate_name", Cell::Word(name)) => row.aggregate = Some(name),
                (GATE_SIDE, Cell::Word(side)) => row.side = Some(side),
                ("time_unit", Cell::Word(unit)) => {
                    row.unit = match unit.as_str() {
                        "s" => 1.0,
                        "ms" => 1e-3,
                        "us" => 1e-6,
                        _ => 1e-9,
                    }
                }
                ("error_occurred", Cell::Flag(failed)) => row.failed = failed,
                ("threads", Cell::Number(threads)) => row.one_thread = threads == 1.0,
                ("iterations", Cell::Number(iterations)) => row.timed = iterations > 0.0,
                ("real_time", Cell::Number(time)) => row.times[0] = Some(time),
                ("cpu_time", Cell::Number(time)) => row.times[1] = Some(time),
                (PASS, _) => {}
                (_, Cell::Number(value)) if value.is_finite() => row.numbers.push((key, value)),
                _ => {}
            }
        }
        Ok(row)
    }
}

/// A value of a row.
enum Cell {
    Number(f64),
    Word(String),
    Flag(bool),
    Other,
}

impl<'de> Deserialize<'de> for Cell {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CellVisitor)
    }
}

struct CellVisitor;

impl<'de> Visitor<'de> for CellVisitor {
    type Value = Cell;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a value")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Cell, E> {
        Ok(Cell::Number(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Cell, E> {
        Ok(Cell::Number(value as f64))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Cell, E> {
        Ok(Cell::Number(value as f64))
    }

    fn visit_bool<E>(self, value: bool) -> Result<Cell, E> {
        Ok(Cell::Flag(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Cell, E> {
        Ok(Cell::Word(value.to_owned()))
    }

    fn visit_unit<E>(self) -> Result<Cell, E> {
        Ok(Cell::Other)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Cell, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Cell::Other)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Cell, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Cell::Other)
    }
}

/// The rows by case.
fn gathered(rows: Vec<Row>) -> Numbers {
    let mut order: Vec<(CaseKey, Vec<Row>)> = vec![];
    let mut places: HashMap<CaseKey, usize> = HashMap::with_capacity(rows.len());
    for mut row in rows {
        let key = CaseKey {
            name: std::mem::take(&mut row.name),
            aggregate: row.aggregate.take(),
        };
        if let Some(place) = places.get(&key) {
            order[*place].1.push(row);
        } else {
            places.insert(key.clone(), order.len());
            order.push((key, vec![row]));
        }
    }
    order
        .into_iter()
        .map(|(case, rows)| (case, of_case(rows)))
        .collect()
}

fn of_case(mut rows: Vec<Row>) -> Vec<Number> {
    let side = rows.iter().find_map(|row| row.side.clone());
    let mut all: Vec<Number> = vec![];
    let one_thread = rows.iter().all(|row| row.one_thread);
    let failed = rows.iter().any(|row| row.failed);
    let mut times = vec![];
    for (number, row) in rows.iter_mut().enumerate() {
        for (key, value) in std::mem::take(&mut row.numbers) {
            // Of several samples the worst counts.
            if number > 0
                && let Some(known) = all.iter_mut().find(|known| known.key == key)
            {
                known.value = known.better.worst(&[known.value, value]);
                continue;
            }
            let meaning = Meaning::of(&key);
            if !matches!(meaning, Meaning::Information | Meaning::Setting) {
                let better = Better::of(meaning, side.as_deref());
                all.push(Number {
                    key,
                    meaning,
                    better,
                    value,
                });
            }
        }
        let time = row.times[usize::from(one_thread)].filter(|_| row.timed);
        times.extend(time.map(|time| time * row.unit));
    }
    if let Some(value) = median(&times).filter(|_| !failed) {
        all.push(Number {
            key: if one_thread { CPU } else { CLOCK }.to_owned(),
            meaning: Meaning::Information,
            better: Better::Lower,
            value,
        });
    }
    all
}
