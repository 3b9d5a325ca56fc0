//! Records from files: ours, and those that Google Benchmark writes.

use super::context::SCHEMA_VERSION;
use super::error::{Reason, RecordError};
use super::{Details, Kind, Record, Row, renamed};
use crate::measure::Spent;
use serde::Deserialize;
use serde::de::{self, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::time::Duration;

impl Record {
    /// Reads a record, or a file of Google Benchmark, whose times are converted from their unit. Rows that such a file
    /// marks as skipped are failed runs here; keys that only count rows (`family_index`, ...) are left out.
    ///
    /// # Errors
    /// [`RecordError`] with file, line and reason.
    pub fn read(path: &Path) -> Result<Self, RecordError> {
        let record = Self::read_any(path)?;
        if record.rows.is_empty() {
            return Err(RecordError {
                path: path.to_owned(),
                line: None,
                reason: Reason::NoBenchmarks,
            });
        }
        Ok(record)
    }

    /// The same, also of a record that holds nothing yet: a run that ends in its first case leaves such a one.
    ///
    /// # Errors
    /// As [`Record::read`].
    pub fn read_any(path: &Path) -> Result<Self, RecordError> {
        let text = proctor_files::reading::read(path)
            .map_err(|error| RecordError::new(path, Reason::Unreadable(error)))?;
        Self::parse(path, &text)
    }

    /// The same from the text of a record that stands under that name.
    ///
    /// # Errors
    /// As [`Record::read`].
    pub fn parse(path: &Path, text: &[u8]) -> Result<Self, RecordError> {
        let fault = |line, reason| RecordError {
            path: path.to_owned(),
            line,
            reason,
        };
        if text.trim_ascii().is_empty() {
            return Err(fault(None, Reason::Empty));
        }
        let file: File = serde_json::from_slice(text).map_err(|error| {
            let line = (error.line() > 0).then(|| error.line());
            let reason = match error.classify() {
                serde_json::error::Category::Eof => Reason::Truncated,
                serde_json::error::Category::Data => Reason::Shape(without_place(&error)),
                _ => Reason::NotJson(without_place(&error)),
            };
            fault(line, reason)
        })?;
        if let Some(version) = file.context.get("schema_version")
            && version.as_u64() != Some(u64::from(SCHEMA_VERSION))
        {
            return Err(fault(None, Reason::Version(version.to_string())));
        }
        let mut record = Self {
            context: file.context.into(),
            rows: file.benchmarks,
            details: file.details,
        };
        record.details.rename();
        Ok(record)
    }
}

/// The message of an error without the place, which is said in front of it.
fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.rfind(" at line ") {
        Some(at) => text[..at].to_owned(),
        None => text,
    }
}

/// A file as it is read.
struct File {
    context: Map<String, Value>,
    benchmarks: Vec<Row>,
    details: Details,
}

impl<'de> Deserialize<'de> for File {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FileVisitor)
    }
}

struct FileVisitor;

impl<'de> Visitor<'de> for FileVisitor {
    type Value = File;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a record: an object with `context` and `benchmarks`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<File, A::Error> {
        let (mut context, mut benchmarks, mut details) = (None, None, Details::default());
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "context" => {
                    let value: Value = map.next_value()?;
                    context = Some(match value {
                        Value::Object(context) => context,
                        other => return Err(found("context", &other, "an object")),
                    });
                }
                "benchmarks" => benchmarks = Some(map.next_value::<Rows>()?.0),
                "details" => details = map.next_value()?,
                other => {
                    return Err(A::Error::custom(format!(
                        "found the key `{other}`; a record has `context`, `benchmarks` and `details`"
                    )));
                }
            }
        }
        let missing = |key| A::Error::custom(format!("`{key}` is missing: not a record"));
        Ok(File {
            context: context.ok_or_else(|| missing("context"))?,
            benchmarks: benchmarks.ok_or_else(|| missing("benchmarks"))?,
            details,
        })
    }
}

/// The list of rows; a type of its own so that a fault names the row.
struct Rows(Vec<Row>);

impl<'de> Deserialize<'de> for Rows {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RowsVisitor)
    }
}

struct RowsVisitor;

impl<'de> Visitor<'de> for RowsVisitor {
    type Value = Rows;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`benchmarks` as a list of rows")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Rows, A::Error> {
        let mut rows = vec![];
        while let Some(row) = list.next_element()? {
            rows.push(row);
        }
        Ok(Rows(rows))
    }
}

impl<'de> Deserialize<'de> for Row {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RowVisitor)
    }
}

struct RowVisitor;

impl<'de> Visitor<'de> for RowVisitor {
    type Value = Row;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a row of `benchmarks` as an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Row, A::Error> {
        let mut fields = Fields::default();
        while let Some(key) = map.next_key::<String>()? {
            // Where a fault is found decides the line that is reported.
            let value = map.next_value()?;
            fields.take(renamed::key_of_row(&key).into_owned(), value)?;
        }
        fields.row()
    }
}

/// Values of a row, key by key.
#[derive(Default)]
struct Fields {
    words: BTreeMap<String, String>,
    numbers: BTreeMap<String, f64>,
    error_occurred: bool,
}

/// Keys of Google Benchmark that hold a word.
const WORDS: [&str; 8] = [
    "name",
    "run_name",
    "run_type",
    "aggregate_name",
    "aggregate_unit",
    "time_unit",
    "error_message",
    "skip_message",
];
/// Keys of Google Benchmark that hold a whole number.
const WHOLE: [&str; 6] = [
    "repetition_index",
    "repetitions",
    "iterations",
    "threads",
    "family_index",
    "per_family_instance_index",
];

impl Fields {
    fn take<E: de::Error>(&mut self, key: String, value: Value) -> Result<(), E> {
        if self.words.contains_key(&key) || self.numbers.contains_key(&key) {
            return Err(E::custom(format!("the key `{key}` is given twice")));
        }
        match value {
            Value::Bool(value) if is_flag(&key) => {
                self.error_occurred |= value;
            }
            Value::String(word)
                if !WHOLE.contains(&key.as_str()) && !is_time(&key) && !is_flag(&key) =>
            {
                self.words.insert(key, word);
            }
            Value::Number(number) if !is_flag(&key) && !WORDS.contains(&key.as_str()) => {
                let value = number.as_f64().filter(|x| x.is_finite());
                let value = value.ok_or_else(|| E::custom(format!("`{key}` is too large")))?;
                let whole = value >= 0.0 && value.fract() == 0.0;
                if WHOLE.contains(&key.as_str()) && !whole {
                    return Err(found(&key, &number.into(), "a whole number from 0"));
                }
                if is_time(&key) && value < 0.0 {
                    return Err(found(&key, &number.into(), "a time from 0"));
                }
                self.numbers.insert(key, value);
            }
            other => return Err(found(&key, &other, accepted(&key))),
        }
        Ok(())
    }

    fn row<E: de::Error>(mut self) -> Result<Row, E> {
        let name = self.words.remove("name");
        let name = self.words.remove("run_name").or(name);
        let name = name.ok_or_else(|| E::custom("a row without `name`"))?;
        let name = renamed::name(&name).into_owned();
        let whole = |numbers: &mut BTreeMap<String, f64>, key: &str, default: u64| {
            numbers.remove(key).map_or(default, |n| n as u64)
        };
        let kind = match self.words.remove("run_type").as_deref() {
            // Old files of Google Benchmark do not say.
            Some("iteration") | None => Kind::Sample {
                repetition: whole(&mut self.numbers, "repetition_index", 0),
            },
            Some("aggregate") => Kind::Aggregate {
                name: self.words.remove("aggregate_name").ok_or_else(|| {
                    E::custom(format!("{name}: an aggregate without `aggregate_name`"))
                })?,
            },
            Some(other) => {
                return Err(E::custom(format!(
                    "{name}: found `run_type` {other:?}; accepted: \"iteration\", \"aggregate\""
                )));
            }
        };
        // A sample of no iteration was not timed.
        let iterations = whole(&mut self.numbers, "iterations", 1);
        let threads = whole(&mut self.numbers, "threads", super::BY_SCENE as u64);
        let spent = self.spent(&name, iterations)?.filter(|_| iterations > 0);
        let message = ["error_message", "skip_message"].map(|key| self.words.remove(key));
        let message = message.into_iter().flatten().next();
        let error = match message {
            Some(message) if self.error_occurred => Some(message),
            None if self.error_occurred => Some("no reason given".to_owned()),
            _ => None,
        };
        for key in WHOLE {
            self.numbers.remove(key);
        }
        Ok(Row {
            name,
            kind,
            threads,
            iterations: iterations.max(1),
            spent,
            counters: self.numbers,
            labels: self.words,
            error,
        })
    }

    /// Time of all iterations, from that of one and its unit.
    fn spent<E: de::Error>(&mut self, name: &str, iterations: u64) -> Result<Option<Spent>, E> {
        let unit = self.words.remove("time_unit");
        let seconds = match unit.as_deref() {
            Some("ns") | None => 1e-9,
            Some("us") => 1e-6,
            Some("ms") => 1e-3,
            Some("s") => 1.0,
            Some(other) => {
                return Err(E::custom(format!(
                    "{name}: found `time_unit` {other:?}; accepted: ns, us, ms, s"
                )));
            }
        };
        let times = ["real_time", "cpu_time"].map(|key| self.numbers.remove(key));
        // A coefficient of variation stands under the keys of times, but is none.
        if self.words.remove("aggregate_unit").as_deref() == Some("percentage") {
            return Ok(None);
        }
        let [Some(wall), Some(cpu)] = times else {
            return match times {
                [None, None] => Ok(None),
                _ => Err(E::custom(format!(
                    "{name}: `real_time` and `cpu_time` must be given together"
                ))),
            };
        };
        let duration = |time: f64| {
            Duration::try_from_secs_f64(time * seconds * iterations as f64)
                .map_err(|_| E::custom(format!("{name}: a time that is too large")))
        };
        Ok(Some(Spent {
            wall: duration(wall)?,
            cpu: duration(cpu)?,
        }))
    }
}

fn is_time(key: &str) -> bool {
    key == "real_time" || key == "cpu_time"
}

/// Keys that say whether a run failed.
fn is_flag(key: &str) -> bool {
    key == "error_occurred" || key == "skipped"
}

/// Values that are accepted under a key.
fn accepted(key: &str) -> &'static str {
    if WHOLE.contains(&key) {
        "a whole number from 0"
    } else if WORDS.contains(&key) {
        "a word"
    } else if is_time(key) {
        "a number"
    } else if is_flag(key) {
        "true or false"
    } else {
        "a number or a word"
    }
}

/// Something else than what may stand there.
fn found<E: de::Error>(key: &str, value: &Value, accepted: &str) -> E {
    let what = match value {
        Value::Null => "null".to_owned(),
        Value::Array(_) => "a list".to_owned(),
        Value::Object(_) => "an object".to_owned(),
        other => other.to_string(),
    };
    E::custom(format!("`{key}`: found {what}; accepted: {accepted}"))
}
