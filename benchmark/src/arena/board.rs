//! The board of an arena, read from the rows of a record: solvers by case.

use super::run::{ARENA, SKIPPED, SMALLEST, SOLVER, Start};
use crate::bench::children::OWN;
use crate::precision::cost::Cost;
use crate::precision::findings::LEVELS;
use crate::record::{Kind, Record, Row};
use proctor_verification::guest::ReadValue;
use std::collections::BTreeMap;

/// Findings of the arena of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Board {
    /// Solvers in the order of their calibration, this program's methods first.
    pub solvers: Vec<Solver>,
    /// Names of the cases, in the order in which they were run.
    pub cases: Vec<String>,
    /// Those of them that report a number and have no error.
    pub reports: Vec<String>,
    /// Cases that no solver could be given, each with its reason.
    pub broken: Vec<String>,
    cells: BTreeMap<(String, String), Cell>,
}

/// A solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Solver {
    /// Its name.
    pub name: String,
    /// Its method, where its configuration says it.
    pub method: String,
    /// Cost of its start.
    pub start: Start,
    /// Reason for which it takes no part: its calibration failed.
    pub failed: Option<String>,
    /// Reason for which it takes no part: it skipped its calibration.
    pub skipped: Option<String>,
}

/// A run on one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Cell size \[m\].
    pub cell: f64,
    /// Processor time of the process without its start-up, of the fastest repetition \[s\]; that of the whole where it failed.
    pub seconds: Option<f64>,
    /// Relative error, or why there is none.
    pub error: Result<f64, String>,
    /// Number of particles.
    pub particles: Option<u64>,
}

/// A solver on a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Cost of each of [`LEVELS`].
    pub costs: [Cost; 2],
    /// Smallest error that it reached.
    pub best: Option<f64>,
    /// Order of the error between its two finest runs.
    pub order: Option<f64>,
    /// Its report on the finest mesh, where the case is a report.
    pub reported: Option<ReadValue>,
    /// Reason for which it skipped the case.
    pub skipped: Option<String>,
    /// Its runs, coarse to fine.
    pub meshes: Vec<Mesh>,
}

impl Cell {
    /// Reason for which a run failed, if one did.
    #[must_use]
    pub fn failure(&self) -> Option<&str> {
        self.meshes
            .iter()
            .find_map(|mesh| mesh.error.as_ref().err())
            .map(String::as_str)
    }
}

impl Board {
    /// The board of a record; none where no arena was run.
    #[must_use]
    pub fn of(record: &Record) -> Option<Self> {
        let mut board = Self {
            solvers: solvers(record),
            cases: vec![],
            reports: vec![],
            broken: vec![],
            cells: BTreeMap::new(),
        };
        for row in &record.rows {
            if let (Some(case), Some(reason)) = (row.name.strip_prefix(ARENA), &row.error) {
                board.broken.push(format!("{case}: {reason}"));
            }
            let (Some(case), Some(solver)) = (row.labels.get("case"), row.labels.get(SOLVER))
            else {
                continue;
            };
            if !row.name.starts_with(ARENA) {
                continue;
            }
            if !board.cases.contains(case) {
                board.cases.push(case.clone());
            }
            let cell = cell(record, row, case, solver);
            if cell.reported.is_some() && !board.reports.contains(case) {
                board.reports.push(case.clone());
            }
            board.cells.insert((case.clone(), solver.clone()), cell);
        }
        let is_empty = board.cases.is_empty() && board.broken.is_empty();
        (!is_empty).then_some(board)
    }

    /// Findings of a solver on a case.
    #[must_use]
    pub fn cell(&self, case: &str, solver: &str) -> Option<&Cell> {
        self.cells.get(&(case.to_owned(), solver.to_owned()))
    }

    /// The cases with errors, in the order in which they were run.
    pub fn judged(&self) -> impl Iterator<Item = &String> {
        let cases = self.cases.iter();
        cases.filter(|case| !self.reports.contains(case))
    }

    /// True for a row of this program.
    #[must_use]
    pub fn is_own(solver: &str) -> bool {
        solver == OWN || solver.starts_with(&format!("{OWN} "))
    }

    /// Least cost of an error of a level by this program's methods on a case \[s\].
    #[must_use]
    pub fn own_cost(&self, case: &str, level: usize) -> Option<f64> {
        let own = self.solvers.iter().filter(|s| Self::is_own(&s.name));
        own.filter_map(|s| self.cell(case, &s.name)?.costs[level].seconds())
            .reduce(f64::min)
    }

    /// Cost of a solver over the least of this program's, on the cases where both reach a level; the smallest first.
    #[must_use]
    pub fn ratios(&self, solver: &str, level: usize) -> Vec<f64> {
        let mut ratios: Vec<f64> = self
            .cases
            .iter()
            .filter_map(|case| {
                let cost = self.cell(case, solver)?.costs[level].seconds()?;
                Some(cost / self.own_cost(case, level)?)
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        ratios
    }

    /// Cases that a solver ran without a failure, skipped, and failed on.
    #[must_use]
    pub fn counts(&self, solver: &str) -> [usize; 3] {
        let mut counts = [0; 3];
        for case in &self.cases {
            match self.cell(case, solver) {
                Some(cell) if cell.failure().is_some() => counts[2] += 1,
                Some(cell) if cell.skipped.is_some() => counts[1] += 1,
                Some(_) => counts[0] += 1,
                None => {}
            }
        }
        counts
    }
}

fn solvers(record: &Record) -> Vec<Solver> {
    let mut all: Vec<Solver> = vec![];
    for row in &record.rows {
        let label = |key: &str| row.labels.get(key).cloned();
        let (Some(name), Some("calibration")) = (
            label("executable"),
            row.labels.get("stage").map(String::as_str),
        ) else {
            continue;
        };
        if all.iter().any(|known| known.name == name) {
            continue;
        }
        all.push(Solver {
            start: Start::of(record, &name),
            method: label("method").unwrap_or_default(),
            failed: row.error.clone(),
            skipped: label(SKIPPED),
            name,
        });
    }
    all
}

fn cell(record: &Record, row: &Row, case: &str, solver: &str) -> Cell {
    let costs = LEVELS.map(|level| {
        let seconds = row.counters.get(&format!("seconds_for_error_{level}"));
        let bound = row.labels.contains_key(&format!("bound_for_error_{level}"));
        match (seconds, bound) {
            (Some(&seconds), true) => Cost::AtMost(seconds),
            (Some(&seconds), false) => Cost::Time(seconds),
            (None, _) => Cost::NotReached,
        }
    });
    Cell {
        costs,
        best: row.counters.get(SMALLEST).copied(),
        order: row.counters.get("observed_order").copied(),
        reported: row.reported(),
        skipped: row.labels.get(SKIPPED).cloned(),
        meshes: meshes(record, case, solver, Start::of_row(row)),
    }
}

/// The runs of a solver on a case, each with the time of its fastest repetition.
fn meshes(record: &Record, case: &str, solver: &str, start: Start) -> Vec<Mesh> {
    let mut all: Vec<Mesh> = vec![];
    for row in &record.rows {
        let label = |key: &str| row.labels.get(key).map(String::as_str);
        let is_run = matches!(row.kind, Kind::Sample { .. })
            && label("case") == Some(case)
            && label("executable") == Some(solver);
        let Some(&cell) = row.counters.get("cell_size").filter(|_| is_run) else {
            continue;
        };
        let seconds = row.cpu().map(|cpu| start.left_of(cpu));
        if let Some(known) = all.iter_mut().find(|mesh| mesh.cell == cell) {
            known.seconds = known.seconds.into_iter().chain(seconds).reduce(f64::min);
            continue;
        }
        let mut counters = row.counters.iter();
        let error = counters.find_map(|(key, error)| key.starts_with("error_").then_some(*error));
        let error = error.or_else(|| Some(row.reported()?.off()));
        all.push(Mesh {
            cell,
            seconds,
            error: match (&row.error, error) {
                (Some(reason), _) => Err(reason.clone()),
                (None, Some(error)) => Ok(error),
                (None, None) => Err("no error in the record".to_owned()),
            },
            particles: row.counters.get("particles").map(|n| *n as u64),
        });
    }
    all.sort_by(|a, b| b.cell.total_cmp(&a.cell));
    all
}
