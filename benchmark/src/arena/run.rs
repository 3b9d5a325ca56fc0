//! The runs of an arena: calibrations, then every case with every solver on its path of refinement.

use crate::bench::children::{OWN, Word, calibrate, is_skip, own};
use crate::bench::config::{Executable, Method};
use crate::precision::cost::{At, Cost, cost};
use crate::precision::findings::LEVELS;
use crate::precision::peers::{self, Visit};
use crate::precision::rows::peer_rows;
use crate::precision::{Peer, PeerLine};
use crate::record::{Kind, Record, Row, key};
use crate::say::say;
use crate::statistics::median;
use proctor_verification::case::Size;
use proctor_verification::study::Study;
use serde_json::Value;
use std::sync::atomic::Ordering;

/// Label of the rows of a solver that skipped all or one case: the reason.
pub(super) const SKIPPED: &str = "skip_reason";
/// First part of the names of the rows that say what an accuracy costs.
pub(super) const ARENA: &str = "arena/";
/// Label and counter of those rows.
pub(super) const SOLVER: &str = "solver";
pub(super) const SMALLEST: &str = "smallest_error";
const START_UP: &str = "seconds_start_up";
const SPREAD: &str = "seconds_start_up_spread";
/// Free falls of each solver after the first, in which kernels may be compiled.
const FALLS: u64 = 3;
/// Method of the scenes that all solvers get, and the methods of this program beside it where the configuration names none.
pub const METHODS: [&str; 3] = [
    "uGIMP USL FLIP",
    "cpGIMP MUSL FLIP",
    "quadratic_bspline MUSL APIC",
];

/// A case that other solvers can run.
pub type Problem = Study;

/// Solvers and cases that take part.
pub struct Solvers {
    /// Calibrated solvers, this program's methods first.
    pub peers: Vec<Peer>,
    /// Number of solvers that are not this program and were found.
    pub guests: usize,
    /// False if a calibration failed.
    pub sound: bool,
}

/// Cases of a list that are open, and the others with the reason.
#[must_use]
pub fn open(studies: Vec<Study>) -> (Vec<Problem>, Vec<(&'static str, &'static str)>) {
    let (mut all, mut closed) = (vec![], vec![]);
    for study in studies {
        let first = study.path(Size::Quick);
        match first.first().map(|rung| study.guest(rung)) {
            Some(Err(reason)) => closed.push((study.name(), reason)),
            _ => all.push(study),
        }
    }
    (all, closed)
}

/// This program once with the method of the scenes, and once with each of the methods.
fn own_rows(methods: &[Method]) -> Vec<Executable> {
    let Some(own) = own() else { return vec![] };
    let mut all = vec![Executable {
        method: Some(METHODS[0].to_owned()),
        ..own.clone()
    }];
    for method in methods {
        let words = [&method.weighting, &method.scheme, &method.transfer];
        let keys = ["shape_function", "stress_scheme_update", "transfer"];
        let named: Vec<&str> = words.into_iter().flatten().map(String::as_str).collect();
        if named.is_empty() || named.join(" ") == METHODS[0] {
            continue;
        }
        let given = keys.into_iter().zip(words);
        let given = given.filter_map(|(key, word)| Some((key.to_owned(), word.clone()?)));
        // Means over cells are no part of MLS: it takes a scene that has them without.
        let without = (method.transfer.as_deref() == Some("MLS"))
            .then(|| ("volumetric_strain".to_owned(), "particle".to_owned()));
        let given = given.chain(without);
        all.push(Executable {
            name: format!("{OWN} {}", named.join(" ")),
            method: Some(named.join(" ")),
            scene: given.map(|(key, word)| (key, Value::from(word))).collect(),
            ..own.clone()
        });
    }
    all
}

impl Solvers {
    /// Runs a free fall with each solver: the meaning of its frames, and then the cost of its start once its kernels are
    /// compiled. One that skips it takes no part.
    #[must_use]
    pub fn calibrated(
        methods: &[Method],
        executables: Vec<Executable>,
        words: &[Word],
        visit: &Visit<'_>,
        record: &mut Record,
    ) -> Self {
        let Visit {
            threads,
            folder,
            stop,
            ..
        } = *visit;
        let mut solvers = Self {
            peers: vec![],
            guests: 0,
            sound: true,
        };
        let mut all = own_rows(methods);
        let own = all.len();
        all.extend(executables);
        for (i, executable) in all.into_iter().enumerate() {
            let axes = executable.space.axes();
            let (mut row, calibration) = calibrate(&executable, axes, threads, folder, stop);
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let reason = calibration.as_ref().err().map(ToString::to_string);
            if let Some(reason) = reason.as_ref().filter(|reason| is_skip(reason)) {
                row.error = None;
                row.label(SKIPPED, reason.clone());
                record.push(row);
                say!("{}: {reason}", executable.name);
                continue;
            }
            record.push(row);
            let falls = if calibration.is_ok() { FALLS } else { 0 };
            for repetition in 1..=falls {
                let (mut again, _) = calibrate(&executable, axes, threads, folder, stop);
                again.kind = Kind::Sample { repetition };
                record.push(again);
            }
            solvers.sound &= calibration.is_ok();
            solvers.guests += usize::from(i >= own);
            let calibration = calibration.map_err(|fault| fault.to_string());
            let peer = Peer::new(executable, calibration, words, visit);
            solvers.peers.push(peer);
        }
        solvers
    }
}

/// Runs a case with all solvers whose calibration passed, and adds their rows: one per run, and one per solver for what an accuracy
/// costs. True if no run failed.
pub fn run(problem: Problem, solvers: &[Peer], visit: &Visit<'_>, record: &mut Record) -> bool {
    let sound: Vec<Peer> = solvers
        .iter()
        .filter(|peer| peer.calibration.is_ok())
        .cloned()
        .collect();
    let threads = visit.threads;
    let lines = match peers::run(problem, &sound, visit) {
        Ok(lines) => lines,
        Err(reason) => {
            let mut row = Row::sample(format!("{ARENA}{}", problem.name()), 0, threads);
            row.fail(reason);
            record.push(row);
            return false;
        }
    };
    let mut all_ran = true;
    for line in &lines {
        let start = Start::of(record, &line.name);
        let mut summary = summary(problem, line, threads, start);
        if let Some(reason) = line.left_out {
            summary.label(SKIPPED, reason);
        }
        for run in &line.runs {
            match run.error.as_ref().err() {
                Some(reason) if is_skip(reason) => summary.label(SKIPPED, reason.clone()),
                _ => {
                    all_ran &= run.error.is_ok();
                    for row in peer_rows(problem, line, run, threads) {
                        record.push(row);
                    }
                }
            }
        }
        record.push(summary);
    }
    all_ran
}

/// Processor time that the start of a solver takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Median of its free falls \[s\].
    pub seconds: f64,
    /// Their spread \[s\].
    pub spread: f64,
}

impl Start {
    /// Start of a calibrated solver.
    pub(super) fn of(record: &Record, solver: &str) -> Self {
        let of_solver = |row: &&Row| {
            row.labels.get("executable").map(String::as_str) == Some(solver)
                && row.labels.get("stage").map(String::as_str) == Some("calibration")
                && row.kind != (Kind::Sample { repetition: 0 })
        };
        let falls = record.rows.iter().filter(of_solver);
        let times: Vec<f64> = falls.filter_map(Row::cpu).collect();
        let most = times.iter().copied().reduce(f64::max);
        let least = times.iter().copied().reduce(f64::min);
        Self {
            seconds: median(&times).unwrap_or(0.0),
            spread: most.unwrap_or(0.0) - least.unwrap_or(0.0),
        }
    }

    /// Values of the row of a solver on a case.
    pub(super) fn of_row(row: &Row) -> Self {
        let count = |key: &str| row.counters.get(key).copied().unwrap_or(0.0);
        Self {
            seconds: count(START_UP),
            spread: count(SPREAD),
        }
    }

    /// A time without the start \[s\]: no less than the spread, below which it is nothing.
    pub(super) fn left_of(self, seconds: f64) -> f64 {
        (seconds - self.seconds).max(self.spread)
    }
}

/// The row that says what an accuracy costs a solver on a case.
fn summary(problem: Problem, line: &PeerLine, threads: usize, start: Start) -> Row {
    let name = format!("{ARENA}{}/{}", problem.name(), key(&line.name));
    let mut row = Row::aggregate(name, "cost", threads);
    row.label("case", problem.name());
    row.label(SOLVER, line.name.clone());
    row.count(START_UP, start.seconds);
    row.count(SPREAD, start.spread);
    let reported = line.runs.iter().rev().find_map(|run| run.reported.as_ref());
    if let (Some(reported), Some(measure)) = (reported, problem.measures().first()) {
        row.report(measure.word, reported);
        return row;
    }
    let points: Vec<Option<At>> = line
        .runs
        .iter()
        .map(|run| {
            let cpu = run.samples.iter().map(|spent| spent.cpu).min()?;
            Some(At {
                error: *run.error.as_ref().ok()?,
                time: start.left_of(cpu.as_secs_f64()),
            })
        })
        .collect();
    for level in LEVELS {
        let cost = cost(&points, level);
        if let Some(seconds) = cost.seconds() {
            row.count(format!("seconds_for_error_{level}"), seconds);
        }
        if let Cost::AtMost(_) = cost {
            row.label(format!("bound_for_error_{level}"), "at most");
        }
    }
    if let Some(best) = points.iter().flatten().map(|at| at.error).reduce(f64::min) {
        row.count(SMALLEST, best);
    }
    if let Some(order) = line.order() {
        row.count("observed_order", order);
    }
    row
}
