//! Cases, run and timed.

use crate::measure::{Spent, Stopwatch};
use crate::side_by_side::side_by_side;
use proctor_kernel::ranks::{ThreadRank, of_threads};
use proctor_scene::simulation::Options;
use proctor_verification::case::{Case, CaseError, Rung, RungResult, Size, Verdict};
use proctor_verification::check::{self, Runs};
use std::sync::Arc;
use std::time::Duration;

/// Clock time above which a run is timed once, because its time scatters little.
const LONG: Duration = Duration::from_secs(1);
/// Time that is measured of runs that are measured again, of [`MOST`] runs at most.
const ENOUGH: Duration = Duration::from_millis(500);
const MOST: usize = 30;

/// A case that was run.
pub struct CaseRun {
    /// The case.
    pub case: &'static Case,
    /// Its runs, in order.
    pub rungs: Vec<RanRung>,
    /// Verdict of the case on them.
    pub verdict: Verdict,
    /// Faults of the case itself, where it was run with wrong references too: a gate that notices nothing, or another number.
    pub faults: Vec<String>,
}

/// The references that a case is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The correct one.
    Correct,
    /// The wrong ones too, each of which must break its gates.
    Wrong,
}

/// A run of a case.
pub struct RanRung {
    /// Rung of the run.
    pub rung: Rung,
    /// Result of the run.
    pub solved: Result<RungResult, CaseError>,
    /// Time for all of it, once per repetition: set-up, steps, comparison. Never empty.
    pub samples: Vec<Spent>,
}

impl RanRung {
    /// Time of the fastest repetition: whatever else goes on in a machine only adds time.
    #[must_use]
    pub fn spent(&self) -> Spent {
        let fastest = self.samples.iter().min_by_key(|spent| spent.wall);
        fastest.copied().unwrap_or_default()
    }
}

impl CaseRun {
    /// The reason for which ranks cannot share a scene of the case, where they were to.
    #[must_use]
    pub fn unshared(&self) -> Option<&str> {
        let errors = self
            .rungs
            .iter()
            .filter_map(|rung| rung.solved.as_ref().err());
        let mut unshared = errors.filter(|error| error.unshared);
        unshared.next().map(|error| error.reason.as_str())
    }

    /// True if every run was solved, every gate passed, and no fault of the case itself was found.
    #[must_use]
    pub fn passed(&self) -> bool {
        let solved = self.rungs.iter().all(|rung| rung.solved.is_ok());
        self.verdict.passed() && solved && self.faults.is_empty()
    }
}

/// Runs the short ladders of cases side by side, `workers` at a time and each on one thread, as long as `go` says so before each run, and
/// hands them to `each` in their order as soon as all before them are there, until one fails. `progress` hears of each case,
/// by its number, the share that is done.
///
/// Small scenes gain little from a second thread; two cases on two threads gain all of it.
///
/// # Errors
/// The first error of `each`.
pub fn run_side_by_side<E>(
    cases: &[&'static Case],
    against: Against,
    options: &Options,
    workers: usize,
    go: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(usize, f64) + Sync),
    each: impl FnMut(CaseRun) -> Result<(), E>,
) -> Result<(), E> {
    let options = Options {
        threads: Some(1),
        ..options.clone()
    };
    let order: Vec<usize> = (0..cases.len()).collect();
    let work = |k, case: &&'static Case| {
        let mut progress = |share| progress(k, share);
        match against {
            Against::Correct => run_while(case, Size::Quick, &options, 1, 1, go, &mut progress),
            Against::Wrong => run_against_wrong(case, &options, go, &mut progress),
        }
    };
    side_by_side(cases, &order, workers, go, work, each)
}

/// Runs a case as long as `go` says so before each run; the verdict is about those that were made. A run that fails does
/// not end it. `progress` hears the share of the case that is done.
///
/// Runs of less than a second are repeated `repetitions` times, for their time: the answers are the same. If that is more than
/// once, what is very short is run until half a second is measured, because a busy machine is slow for tenths of a second at a
/// time. Where there are several ranks, they share each step of each simulation as threads of this process.
pub fn run_while(
    case: &'static Case,
    size: Size,
    options: &Options,
    repetitions: usize,
    ranks: usize,
    go: &dyn Fn() -> bool,
    progress: &mut dyn FnMut(f64),
) -> CaseRun {
    // Whether a run is measured once more.
    let wanted = |samples: usize, measured: Duration| {
        samples < repetitions || (1 < repetitions && samples < MOST && measured < ENOUGH)
    };
    let ladder = case.rungs(size);
    let weights = weights(&ladder);
    let rungs: Vec<RanRung> = ladder
        .into_iter()
        .zip(&weights)
        .take_while(|_| go())
        .map(|(rung, [before, own])| {
            let mut solve = || {
                let mut stopwatch = Stopwatch::default();
                let mut at = |share| progress(before + share * own);
                let work = || {
                    if ranks > 1 {
                        solve_on_ranks(case, &rung, options, ranks, &mut at)
                    } else {
                        case.solve(&rung, options, &mut at)
                    }
                };
                // With one thread a simulation stays in that of its caller.
                let solved = if options.threads == Some(1) && ranks == 1 {
                    stopwatch.time_thread(work)
                } else {
                    stopwatch.time(work)
                };
                (solved, stopwatch.spent)
            };
            case.prepare_for(&rung);
            let (solved, first) = solve();
            let mut samples = vec![first];
            let mut measured = first.wall;
            while wanted(samples.len(), measured) && first.wall < LONG && solved.is_ok() && go() {
                let again = solve().1;
                measured += again.wall;
                samples.push(again);
            }
            progress(before + own);
            RanRung {
                rung,
                solved,
                samples,
            }
        })
        .collect();
    let solved: Vec<(Rung, RungResult)> = rungs
        .iter()
        .filter_map(|ran| Some((ran.rung.clone(), ran.solved.clone().ok()?)))
        .collect();
    let verdict = case.judge(size, &solved);
    CaseRun {
        case,
        rungs,
        verdict,
        faults: vec![],
    }
}

/// Runs the short ladder of a case on one thread, with the correct reference and with each wrong one, as long as `go` says so
/// before each run. Where all was run, the case itself is judged: each gate reacts to its number, and each wrong reference breaks
/// its gates. The time of a run is that with all references.
fn run_against_wrong(
    case: &'static Case,
    options: &Options,
    go: &dyn Fn() -> bool,
    progress: &mut dyn FnMut(f64),
) -> CaseRun {
    let ladder = case.rungs(Size::Quick);
    let weights = weights(&ladder);
    let all = ladder.len();
    let mut ladders = vec![Runs::new(); 1 + case.wrong().len()];
    let mut rungs = vec![];
    for (rung, [before, own]) in ladder.into_iter().zip(weights) {
        if !go() {
            break;
        }
        case.prepare_for(&rung);
        let mut stopwatch = Stopwatch::default();
        let mut at = |share| progress(before + share * own);
        let solved = stopwatch.time_thread(|| check::solve(case, &rung, options, &mut at));
        progress(before + own);
        let solved = solved.map(|solved| {
            let correct = solved[0].clone();
            check::add(&mut ladders, &rung, solved);
            correct.expect("a run with the correct reference")
        });
        rungs.push(RanRung {
            rung,
            solved,
            samples: vec![stopwatch.spent],
        });
    }
    let faults = if ladders[0].len() == all {
        check::faults(case, &ladders, &check::shown(case))
    } else {
        vec![]
    };
    CaseRun {
        verdict: case.judge(Size::Quick, &ladders[0]),
        case,
        rungs,
        faults,
    }
}

/// Solves a rung on ranks that are threads of this process: all of them do the same, and the first one reports progress.
fn solve_on_ranks(
    case: &Case,
    rung: &Rung,
    options: &Options,
    ranks: usize,
    progress: &mut dyn FnMut(f64),
) -> Result<RungResult, CaseError> {
    let on = |rank: ThreadRank| Options {
        step_ranks: Some(Arc::new(rank)),
        ..options.clone()
    };
    let mut ranks = of_threads(ranks).into_iter();
    std::thread::scope(|scope| {
        let first = ranks.next().map(on).unwrap_or_default();
        let other = |rank| {
            let options = on(rank);
            scope.spawn(move || drop(case.solve(rung, &options, &mut |_| ())))
        };
        let others: Vec<_> = ranks.map(other).collect();
        let solved = case.solve(rung, &first, progress);
        drop(first);
        // They have the same result, or wait for messages of a rank that was stopped.
        for other in others {
            drop(other.join());
        }
        solved
    })
}

/// Share of a ladder that lies before each of its runs, and the share that the run is, as far as the cell size tells: in the
/// plane half as large a cell means four times as many particles and twice as many steps.
fn weights(ladder: &[Rung]) -> Vec<[f64; 2]> {
    let work = |rung: &Rung| rung.cell.powi(-3);
    let all: f64 = ladder.iter().map(work).sum();
    let mut before = 0.0;
    let share = |rung: &Rung| {
        let own = work(rung) / all;
        before += own;
        [before - own, own]
    };
    ladder.iter().map(share).collect()
}
