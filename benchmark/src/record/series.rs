//! The rows of a record, gathered by case.

use super::row::PASS;
use super::{Kind, LADDER, Meaning, Record, Row};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The key by which rows of two records are matched: the name, and the aggregate if it is one. Results do not depend
/// on the number of threads, so that it does not tell cases apart; whose times are compared must agree in it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CaseKey {
    /// Name of the rows.
    pub name: String,
    /// Name of the aggregate; `None` for samples.
    pub aggregate: Option<String>,
}

impl CaseKey {
    fn of(row: &Row) -> Self {
        Self {
            name: row.name.clone(),
            aggregate: match &row.kind {
                Kind::Sample { .. } => None,
                Kind::Aggregate { name } => Some(name.clone()),
            },
        }
    }
}

impl fmt::Display for CaseKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        match &self.aggregate {
            Some(aggregate) => write!(f, " {aggregate}"),
            None => Ok(()),
        }
    }
}

/// All rows of a case.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Clock times by pass \[s\].
    pub wall: BTreeMap<u64, Vec<f64>>,
    /// CPU times by pass \[s\].
    pub cpu: BTreeMap<u64, Vec<f64>>,
    /// Numbers of threads that the rows were given; 0 where the scene decides.
    pub threads: BTreeSet<u64>,
    /// Every value of every counter.
    pub counters: BTreeMap<String, Vec<f64>>,
    /// Every word of every label that is judged.
    pub labels: BTreeMap<String, BTreeSet<String>>,
    /// Rows with the same ladder differ in resolution alone.
    pub ladder: Option<String>,
    /// Failures of the runs.
    pub errors: BTreeSet<String>,
}

impl Series {
    fn add(&mut self, row: &Row) {
        if let Some(wall) = row.wall() {
            self.wall.entry(row.pass()).or_default().push(wall);
        }
        if let Some(cpu) = row.cpu() {
            self.cpu.entry(row.pass()).or_default().push(cpu);
        }
        self.threads.insert(row.threads);
        for (key, value) in row.counters.iter().filter(|(key, _)| *key != PASS) {
            self.counters.entry(key.clone()).or_default().push(*value);
        }
        for (key, word) in &row.labels {
            if Meaning::of_label(key) != Meaning::Information {
                let words = self.labels.entry(key.clone()).or_default();
                words.insert(word.clone());
            }
        }
        self.ladder = row.labels.get(LADDER).cloned();
        self.errors.extend(row.error.clone());
    }

    /// Clock times of all passes \[s\].
    #[must_use]
    pub fn all_wall(&self) -> Vec<f64> {
        self.wall.values().flatten().copied().collect()
    }

    /// Failures of the runs, in one line; `None` where none did.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        let errors: Vec<&str> = self.errors.iter().map(String::as_str).collect();
        (!errors.is_empty()).then(|| errors.join("; "))
    }
}

/// The cases of a record, in the order in which they were first measured.
#[derive(Clone, Debug, Default)]
pub struct Cases {
    /// Key and rows.
    pub list: Vec<(CaseKey, Series)>,
}

impl Cases {
    /// Gathers a record.
    #[must_use]
    pub fn of(record: &Record) -> Self {
        let mut index: BTreeMap<CaseKey, usize> = BTreeMap::new();
        let mut list: Vec<(CaseKey, Series)> = vec![];
        for row in &record.rows {
            let key = CaseKey::of(row);
            let at = *index.entry(key.clone()).or_insert_with(|| {
                list.push((key, Series::default()));
                list.len() - 1
            });
            list[at].1.add(row);
        }
        Self { list }
    }

    /// The rows of a case.
    #[must_use]
    pub fn get(&self, key: &CaseKey) -> Option<&Series> {
        let found = self.list.iter().find(|(known, _)| known == key);
        found.map(|(_, series)| series)
    }
}
