//! The stiff and extreme scenes: their rows, run side by side, and what a record keeps of them.

use crate::measure::{Spent, Stopwatch};
use crate::record::details::{Details, GateDetail, gate};
use crate::record::{Record, Row};
use crate::side_by_side::side_by_side;
use proctor_verification::stability::extreme::{Ending, Extreme, Finding, RowFault};
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::convert::Infallible;
use std::panic::catch_unwind;

/// Beginning of the names of its rows in a record.
pub(crate) const ROWS: &str = "stability/extreme/";

/// A row that was run.
pub struct RowResult {
    /// Row that was run.
    pub row: &'static Extreme,
    /// Result of the row.
    pub outcome: Result<Finding, RowFault>,
    /// Its time.
    pub spent: Spent,
}

impl RowResult {
    /// Ending of the row.
    #[must_use]
    pub fn ending(&self) -> Ending {
        self.outcome
            .as_ref()
            .map_or(Ending::Failed, Finding::ending)
    }
}

/// Runs rows, `workers` at a time and each on one thread, as long as `go` says so before each, and hands them to `each` in
/// their order. A row that panics has failed, and the others go on.
pub fn try_all(
    rows: &[&'static Extreme],
    workers: usize,
    go: &(dyn Fn() -> bool + Sync),
    mut each: impl FnMut(RowResult),
) {
    let order: Vec<usize> = (0..rows.len()).collect();
    let work = |_, row: &&'static Extreme| {
        let mut stopwatch = Stopwatch::default();
        let outcome = stopwatch.time_thread(|| {
            catch_unwind(row.judge).unwrap_or_else(|panic| Err(RowFault(said(&*panic))))
        });
        RowResult {
            row,
            outcome,
            spent: stopwatch.spent,
        }
    };
    let Ok(()) = side_by_side(rows, &order, workers, go, work, |done| {
        each(done);
        Ok::<(), Infallible>(())
    });
}

/// The message of a panic.
fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!("panicked: {}", text.as_deref().unwrap_or("without a word"))
}

/// Details of a row that a record keeps beside its flat rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExtremeDetail {
    /// Its name.
    pub name: String,
    /// Extreme of the row.
    pub what: String,
    /// Requirement on a good code.
    pub required: String,
    /// Ending of the row: `held`, `refused`, `FAILED`.
    pub ending: String,
    /// True if it ended as it should.
    pub passed: bool,
    /// Its bounds.
    pub gates: Vec<GateDetail>,
    /// Messages of what was refused as it should be.
    pub refusals: Vec<String>,
    /// Fault of the row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unexpected: Option<String>,
    /// Cause of the failure, if known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Its time \[s\].
    pub seconds: f64,
}

impl ExtremeDetail {
    /// The gate that is nearest to its bound, or farthest beyond it.
    #[must_use]
    pub fn worst(&self) -> Option<&GateDetail> {
        let by_use = |a: &&GateDetail, b: &&GateDetail| a.used().total_cmp(&b.used());
        self.gates.iter().max_by(by_use)
    }
}

impl From<&RowResult> for ExtremeDetail {
    fn from(tried: &RowResult) -> Self {
        let row = tried.row;
        let ending = tried.ending();
        let finding = tried.outcome.as_ref().ok().cloned().unwrap_or_default();
        Self {
            name: row.name.to_owned(),
            what: row.what.to_owned(),
            required: row.required.to_owned(),
            ending: ending.word().to_owned(),
            passed: ending != Ending::Failed,
            gates: finding.gates.iter().map(gate).collect(),
            refusals: finding.refusals,
            unexpected: tried.outcome.as_ref().err().map(ToString::to_string),
            cause: row
                .cause
                .filter(|_| ending == Ending::Failed)
                .map(str::to_owned),
            seconds: tried.spent.wall.as_secs_f64(),
        }
    }
}

impl Details {
    /// Adds a row of the stiff and extreme scenes.
    fn push_extreme(&mut self, tried: &RowResult) {
        let detail = self.stability.get_or_insert_default();
        detail.extreme.push(tried.into());
    }
}

impl Record {
    /// Adds a row for one of the stiff and extreme scenes, and one per gate.
    pub fn push_extreme(&mut self, tried: &RowResult) {
        let name = format!("{ROWS}{}", tried.row.name);
        let mut row = Row::sample(&name, 0, 1).timed(tried.spent);
        row.label("ending", tried.ending().word());
        match &tried.outcome {
            Ok(finding) => {
                row.count("value_refusals", finding.refusals.len() as f64);
                self.push(row);
                for gate in &finding.gates {
                    self.push_gate(&name, gate, 1);
                }
            }
            Err(unexpected) => {
                row.fail(unexpected.to_string());
                self.push(row);
            }
        }
        self.details.push_extreme(tried);
    }
}
