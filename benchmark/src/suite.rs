//! Cases, run and timed.

use crate::measure::{Spent, Stopwatch};
use crate::progress::Progress;
use proctor_kernel::simulation::Options;
use proctor_verification::case::{Case, CaseError, Rung, Size, Solved, Verdict};

/// A case that was run.
pub struct Ran {
    /// The case.
    pub case: &'static dyn Case,
    /// Its runs, in order.
    pub rungs: Vec<RanRung>,
    /// What the case says of them.
    pub verdict: Verdict,
}

/// A run of a case.
pub struct RanRung {
    /// Which run.
    pub rung: Rung,
    /// What it gave.
    pub solved: Result<Solved, CaseError>,
    /// Time for all of it: set-up, steps, comparison.
    pub spent: Spent,
}

impl Ran {
    /// Whether every run was solved and every gate passed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.verdict.passed() && self.rungs.iter().all(|rung| rung.solved.is_ok())
    }
}

/// Runs a case. A run that fails does not end it: the verdict is about all of them.
pub fn run(case: &'static dyn Case, size: Size, options: &Options) -> Ran {
    run_while(case, size, options, &|| true)
}

/// Runs a case as long as `go` says so before each run; the verdict is about those that were made.
pub fn run_while(
    case: &'static dyn Case,
    size: Size,
    options: &Options,
    go: &dyn Fn() -> bool,
) -> Ran {
    let rungs: Vec<RanRung> = case
        .rungs(size)
        .into_iter()
        .take_while(|_| go())
        .map(|rung| {
            let mut progress = Progress::new(&format!("{} {}", case.name(), rung.label));
            let mut stopwatch = Stopwatch::default();
            let solved =
                stopwatch.time(|| case.solve(&rung, options, &mut |share| progress.at(share)));
            RanRung {
                rung,
                solved,
                spent: stopwatch.spent,
            }
        })
        .collect();
    let solved: Vec<(Rung, Solved)> = rungs
        .iter()
        .filter_map(|ran| Some((ran.rung.clone(), ran.solved.clone().ok()?)))
        .collect();
    let verdict = case.judge(size, &solved);
    Ran {
        case,
        rungs,
        verdict,
    }
}
