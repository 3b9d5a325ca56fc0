//! The rows of a record, gathered by case.

use super::row::PASS;
use super::{Kind, LADDER, Record, Row};
use std::collections::BTreeMap;
use std::fmt;

/// What two records must share to be compared: name, number of threads, and which aggregate if it is one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CaseKey {
    /// Name of the rows.
    pub name: String,
    /// Which aggregate; `None` for samples.
    pub aggregate: Option<String>,
    /// Threads of the runs.
    pub threads: u64,
}

impl CaseKey {
    fn of(row: &Row) -> Self {
        Self {
            name: row.name.clone(),
            aggregate: match &row.kind {
                Kind::Sample { .. } => None,
                Kind::Aggregate { name } => Some(name.clone()),
            },
            threads: row.threads,
        }
    }
}

impl fmt::Display for CaseKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)?;
        if let Some(aggregate) = &self.aggregate {
            write!(f, " {aggregate}")?;
        }
        // A verdict is the same for every number of threads.
        if self.threads > 1 && self.aggregate.is_none() {
            write!(f, " ({} threads)", self.threads)?;
        }
        Ok(())
    }
}

/// All rows of a case.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Clock times by pass \[s\].
    pub wall: BTreeMap<u64, Vec<f64>>,
    /// CPU times of all passes \[s\].
    pub cpu: Vec<f64>,
    /// Every value of every counter.
    pub counters: BTreeMap<String, Vec<f64>>,
    /// Hash of the final state, where it was kept.
    pub state_hash: Option<String>,
    /// Rows with the same ladder differ in resolution alone.
    pub ladder: Option<String>,
    /// Why a run failed, if one did.
    pub error: Option<String>,
}

impl Series {
    fn add(&mut self, row: &Row) {
        if let Some(wall) = row.wall() {
            self.wall.entry(row.pass()).or_default().push(wall);
        }
        self.cpu.extend(row.cpu());
        for (key, value) in row.counters.iter().filter(|(key, _)| *key != PASS) {
            self.counters.entry(key.clone()).or_default().push(*value);
        }
        self.state_hash = row.labels.get("state_hash").cloned();
        self.ladder = row.labels.get(LADDER).cloned();
        if self.error.is_none() {
            self.error.clone_from(&row.error);
        }
    }

    /// Clock times of all passes \[s\].
    #[must_use]
    pub fn all_wall(&self) -> Vec<f64> {
        self.wall.values().flatten().copied().collect()
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
