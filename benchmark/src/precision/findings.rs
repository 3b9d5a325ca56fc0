//! The findings of a study: the cost of each accuracy, the best combination, the orders of the errors.

use super::choices::Line;
use super::cost::{At, Cost, cost, pareto};
use super::run::CaseStudy;
use proctor_verification::convergence::{ConvergenceTable, Row};
use proctor_verification::settings::Method;

/// Levels of relative error whose cost is told.
pub const LEVELS: [f64; 2] = [0.01, 0.001];

/// Findings of a study on one measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// Lines, in the order of the plan.
    pub lines: Vec<LineFindings>,
    /// Runs that no other beats in error and time, by increasing time.
    pub front: Vec<usize>,
}

/// Findings on one line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFindings {
    /// Method.
    pub method: Method,
    /// Cost of each of [`LEVELS`].
    pub costs: [Cost; 2],
    /// Smallest error of the path and its run time, where a run gave one.
    pub best: Option<At>,
    /// Errors along the path; NaN where a run failed.
    pub table: ConvergenceTable,
}

impl LineFindings {
    /// Error of the finest run of the path, infinite where it failed.
    #[must_use]
    pub fn finest(&self) -> f64 {
        let error = self.table.rows().last().map(|row| row.errors[0]);
        error
            .filter(|error| error.is_finite())
            .unwrap_or(f64::INFINITY)
    }

    /// Order of the error between the two finest runs of the path.
    #[must_use]
    pub fn order(&self) -> Option<f64> {
        self.table.order(0, self.table.rows().len().checked_sub(1)?)
    }
}

impl Findings {
    /// Findings of the runs on a measure, by its number.
    #[must_use]
    pub fn new(studied: &CaseStudy, measure: usize) -> Self {
        let at: Vec<Option<At>> = studied
            .runs
            .iter()
            .enumerate()
            .map(|(i, run)| {
                Some(At {
                    error: run.error(measure).ok()?,
                    time: studied.seconds(i)?,
                })
            })
            .collect();
        let lines = studied
            .plan
            .lines
            .iter()
            .filter(|line| line.path.iter().any(|&i| i < studied.runs.len()))
            .map(|line| line_findings(studied, measure, line, &at))
            .collect();
        Self {
            lines,
            front: pareto(&at),
        }
    }

    /// The line that reaches a level, by its number in [`LEVELS`], at the least cost.
    #[must_use]
    pub fn cheapest(&self, level: usize) -> Option<&LineFindings> {
        self.lines
            .iter()
            .filter(|line| line.costs[level].seconds().is_some())
            .min_by(|a, b| {
                let seconds = |line: &LineFindings| line.costs[level].seconds().unwrap_or(f64::NAN);
                seconds(a).total_cmp(&seconds(b))
            })
    }

    /// The line of the default method.
    #[must_use]
    pub fn default_line(&self) -> Option<&LineFindings> {
        self.lines
            .iter()
            .find(|line| line.method == Method::DEFAULT)
    }

    /// Speed-up of the cheapest line that reaches a level, over the default method.
    #[must_use]
    pub fn speed_up(&self, level: usize) -> Option<f64> {
        let default = self.default_line()?.costs[level].seconds()?;
        Some(default / self.cheapest(level)?.costs[level].seconds()?)
    }

    /// Lines by what they cost, the best first: by the finest level, then the coarser one, then by the error of the finest
    /// run; what failed there comes last.
    #[must_use]
    pub fn ranked(&self) -> Vec<&LineFindings> {
        let mut lines: Vec<&LineFindings> = self.lines.iter().collect();
        let key = |line: &LineFindings| {
            let seconds = |level: usize| line.costs[level].seconds().unwrap_or(f64::INFINITY);
            [seconds(1), seconds(0), line.finest()]
        };
        lines.sort_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a[0].total_cmp(&b[0])
                .then(a[1].total_cmp(&b[1]))
                .then(a[2].total_cmp(&b[2]))
        });
        lines
    }
}

fn line_findings(
    studied: &CaseStudy,
    measure: usize,
    line: &Line,
    at: &[Option<At>],
) -> LineFindings {
    let path: Vec<Option<At>> = line
        .path
        .iter()
        .filter_map(|&i| at.get(i).copied())
        .collect();
    let mut table = ConvergenceTable::new([studied.study.measures()[measure].word]);
    for (&i, at) in line.path.iter().zip(&path) {
        let found = studied.runs[i].found.as_ref().ok();
        // One error in a table of one quantity, by construction.
        let _ = table.push(Row {
            h: studied.plan.choices[i].rung.cell,
            errors: vec![at.map_or(f64::NAN, |at| at.error)],
            particles: found.map_or(0, |f| f.particles),
            steps: found.map_or(0, |f| f.steps as usize),
        });
    }
    LineFindings {
        method: line.method,
        costs: LEVELS.map(|level| cost(&path, level)),
        best: path
            .iter()
            .flatten()
            .copied()
            .min_by(|a, b| a.error.total_cmp(&b.error)),
        table,
    }
}
