//! One row of a record: one timed run, or what was found from several.

use crate::measure::Spent;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::time::Duration;

/// Name of the aggregates that are gates.
pub(crate) const GATE: &str = "gate";
/// Counter of a gate: what was found.
pub(crate) const GATE_VALUE: &str = "gate_value";
/// Counter of a gate: its bound.
pub(crate) const GATE_BOUND: &str = "gate_bound";
/// Label of a gate: `at most` or `at least`.
pub(crate) const GATE_SIDE: &str = "gate_side";
/// Label of the bar of a refined quantity: how its values settle.
pub(crate) const VERDICT: &str = "verdict";
/// Counter that holds the pass of a row.
pub(crate) const PASS: &str = "pass";

/// Number of threads of a row whose scene decides it, as far as the machine has them.
pub const BY_SCENE: usize = 0;

/// Kind of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One timed run; `repetition` counts the runs of the same name from 0.
    Sample {
        /// Number of the repetition.
        repetition: u64,
    },
    /// Result from the samples of the same name, such as a verdict or a noise band.
    Aggregate {
        /// Name of the aggregate.
        name: String,
    },
}

/// One row of a record. Counters and labels are flat keys of the JSON row, beside the keys of Google Benchmark.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the run, `case/variant/...`; rows with the same name are repetitions of each other.
    pub name: String,
    /// Sample or aggregate.
    pub kind: Kind,
    /// Threads that the run was given, of which a small scene uses fewer; [`BY_SCENE`] where none were asked for.
    pub threads: u64,
    /// Runs that were timed together; 1 but for records of other programs.
    pub iterations: u64,
    /// Time of all iterations, where they were timed.
    pub spent: Option<Spent>,
    /// Finite numbers by key: errors, counts, rates, in SI units.
    pub counters: BTreeMap<String, f64>,
    /// Words by key: scheme, weighting function, state hash.
    pub labels: BTreeMap<String, String>,
    /// Failure of the run.
    pub error: Option<String>,
}

impl Row {
    /// A sample, not yet timed.
    #[must_use]
    pub fn sample(name: impl Into<String>, repetition: u64, threads: usize) -> Self {
        Self::new(name.into(), Kind::Sample { repetition }, threads)
    }

    /// An aggregate over the samples of that name.
    #[must_use]
    pub fn aggregate(name: impl Into<String>, aggregate: &str, threads: usize) -> Self {
        let kind = Kind::Aggregate {
            name: aggregate.to_owned(),
        };
        Self::new(name.into(), kind, threads)
    }

    fn new(name: String, kind: Kind, threads: usize) -> Self {
        Self {
            name,
            kind,
            threads: threads as u64,
            iterations: 1,
            spent: None,
            counters: BTreeMap::new(),
            labels: BTreeMap::new(),
            error: None,
        }
    }

    /// Sets the time of the run.
    #[must_use]
    pub fn timed(mut self, spent: Spent) -> Self {
        self.spent = Some(spent);
        self
    }

    /// Adds a counter; one that is not finite is left out.
    pub fn count(&mut self, key: impl Into<String>, value: f64) {
        if value.is_finite() {
            self.counters.insert(key.into(), value);
        }
    }

    /// Adds a label.
    pub fn label(&mut self, key: impl Into<String>, value: impl Into<String>) {
        self.labels.insert(key.into(), value.into());
    }

    /// Clock time of one iteration \[s\], where the run was timed and did not fail.
    #[must_use]
    pub fn wall(&self) -> Option<f64> {
        let spent = self.spent.filter(|_| self.error.is_none())?;
        Some(spent.wall.as_secs_f64() / self.iterations as f64)
    }

    /// CPU time of one iteration \[s\], where the run was timed and did not fail.
    #[must_use]
    pub fn cpu(&self) -> Option<f64> {
        let spent = self.spent.filter(|_| self.error.is_none())?;
        Some(spent.cpu.as_secs_f64() / self.iterations as f64)
    }

    /// Sets the pass in which the run was made, from 0: passes are interleaved rounds over all that is compared. A row without
    /// the counter `pass` belongs to pass 0.
    #[must_use]
    pub fn pass(&self) -> u64 {
        self.counters.get(PASS).map_or(0, |pass| *pass as u64)
    }

    /// Puts the run into a pass.
    pub fn set_pass(&mut self, pass: u64) {
        self.count(PASS, pass as f64);
    }

    /// Marks the run as failed.
    pub fn fail(&mut self, message: impl Into<String>) {
        self.error = Some(message.into());
    }

    /// The row as Google Benchmark writes it; times in milliseconds.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let mut row = Map::new();
        row.insert("run_name".into(), self.name.clone().into());
        match &self.kind {
            Kind::Sample { repetition } => {
                row.insert("name".into(), self.name.clone().into());
                row.insert("run_type".into(), "iteration".into());
                row.insert("repetition_index".into(), (*repetition).into());
            }
            Kind::Aggregate { name } => {
                row.insert("name".into(), format!("{}_{name}", self.name).into());
                row.insert("run_type".into(), "aggregate".into());
                row.insert("aggregate_name".into(), name.clone().into());
            }
        }
        if self.threads != BY_SCENE as u64 {
            row.insert("threads".into(), self.threads.into());
        }
        let per_iteration = |time: Duration| time.as_secs_f64() * 1e3 / self.iterations as f64;
        let (iterations, times) = match (self.spent, &self.kind) {
            (Some(spent), _) => (
                self.iterations,
                Some([spent.wall, spent.cpu].map(per_iteration)),
            ),
            // Google Benchmark, and what reads its files, wants a time in every sample: none of no iteration.
            (None, Kind::Sample { .. }) => (0, Some([0.0; 2])),
            (None, Kind::Aggregate { .. }) => (self.iterations, None),
        };
        row.insert("iterations".into(), iterations.into());
        if let Some([wall, cpu]) = times {
            row.insert("real_time".into(), wall.into());
            row.insert("cpu_time".into(), cpu.into());
            row.insert("time_unit".into(), "ms".into());
        }
        for (key, value) in &self.counters {
            row.insert(key.clone(), (*value).into());
        }
        for (key, value) in &self.labels {
            row.insert(key.clone(), value.clone().into());
        }
        if let Some(message) = &self.error {
            row.insert("error_occurred".into(), true.into());
            row.insert("error_message".into(), message.clone().into());
        }
        row.into()
    }
}

/// A name as part of a key: lower case, everything but letters and digits one underscore.
#[must_use]
pub fn key(name: &str) -> String {
    let words: Vec<String> = name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect();
    words.join("_")
}
