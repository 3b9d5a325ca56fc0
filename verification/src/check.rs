//! The check of a case: its gates hold, each reacts to the number that it names and to no other, and each wrong reference breaks its
//! gates. A case of one's own is checked as those of this crate are.

mod shown;

use proctor_scene::simulation::Options;

use crate::case::wrong::{Reference, Wrong};
use crate::case::{Case, CaseError, Gate, Quantity, Rung, RungResult, Size, Verdict};
use crate::sensitivity::{Reaction, reactions};

/// Runs of a ladder, rung by rung.
pub type Runs = Vec<(Rung, RungResult)>;

pub use shown::shown;

/// The short ladder of a case with the correct reference, then with each wrong one on the rungs that show it.
///
/// # Errors
/// [`CaseError`] of the first rung that cannot be solved.
pub fn ladders(case: &Case, options: &Options) -> Result<Vec<Runs>, CaseError> {
    let mut ladders = vec![vec![]; 1 + case.wrong().len()];
    for rung in case.rungs(Size::Quick) {
        add(
            &mut ladders,
            &rung,
            solve(case, &rung, options, &mut |_| ())?,
        );
    }
    Ok(ladders)
}

/// Adds the results of [`solve`] to the ladders that they are of: the correct one, then those of the wrong references.
pub fn add(ladders: &mut [Runs], rung: &Rung, solved: Vec<Option<RungResult>>) {
    for (ladder, solved) in ladders.iter_mut().zip(solved) {
        ladder.extend(solved.map(|solved| (rung.clone(), solved)));
    }
}

/// Runs a rung with the correct reference, then with each wrong one; `None` for one that the rung does not show. Where a run does
/// not depend on the reference, it is run once for all of them. `progress` is called as by [`Case::solve`].
///
/// # Errors
/// [`CaseError`] if a run cannot be solved.
pub fn solve(
    case: &Case,
    rung: &Rung,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Vec<Option<RungResult>>, CaseError> {
    let wrong = case.wrong();
    let references: Vec<_> = [Reference::CORRECT]
        .into_iter()
        .chain(wrong.iter().map(|wrong| Reference::with(*wrong)))
        .collect();
    if let Some(all) = case.solve_against(rung, options, &references, progress) {
        return Ok(all?.into_iter().map(Some).collect());
    }
    let mut all = vec![Some(case.solve(rung, options, progress)?)];
    for wrong in wrong {
        let case = case.with(*wrong);
        let shown = wrong.is_shown_by(rung);
        let solved = shown.then(|| case.solve(rung, options, &mut |_| ()));
        all.push(solved.transpose()?);
    }
    Ok(all)
}

/// Faults of a case by the runs of [`ladders`]: errors that are not those of their values; gates that fail, hold without any run, have no reason, or react to nothing or to
/// another number than they name; numbers that no gate judges but those `shown` without judgement; wrong references that do not break
/// what they must. A sound case has none.
#[must_use]
pub fn faults(case: &Case, ladders: &[Runs], shown: &[&str]) -> Vec<String> {
    let Some((solved, wrong)) = ladders.split_first() else {
        return vec!["nothing was run".to_owned()];
    };
    let mut faults = faults_of_errors(solved);
    faults.extend(faults_of_gates(case, solved, shown));
    for (wrong, solved) in case.wrong().iter().zip(wrong) {
        faults.extend(faults_of_wrong(case, wrong, solved));
    }
    faults
}

/// Lines of the gates that fail.
#[must_use]
pub fn failing(verdict: &Verdict) -> Vec<String> {
    let failed = verdict.gates.iter().filter(|gate| !gate.passed());
    failed
        .map(|g| format!("{}: {:e} {:?} {:e}", g.name, g.value, g.relation, g.bound))
        .collect()
}

/// Errors that are not those of their values from what is exact, so that moving the one would not be moving the other.
fn faults_of_errors(solved: &[(Rung, RungResult)]) -> Vec<String> {
    let sound = |q: &Quantity| match (q.error, q.exact) {
        (None, _) => true,
        (Some(_), None) => false,
        // Of the unit of the value, or over what it would be without contact.
        (Some(error), Some(0.0)) => error <= q.value.abs() && (error == 0.0) == (q.value == 0.0),
        (Some(error), Some(exact)) => {
            let off = (q.value / exact - 1.0).abs();
            (error - off).abs() <= 1e-12 + 1e-9 * off
        }
    };
    let of = |(rung, run): &(Rung, RungResult)| -> Vec<String> {
        let unsound = run.quantities.iter().filter(|q| !sound(q));
        let fault = |q: &Quantity| {
            let (name, value, exact, error) = (q.name, q.value, q.exact, q.error);
            format!(
                "{}: {name}: the error {error:?} is not that of {value:e} from {exact:?}",
                rung.label
            )
        };
        unsound.map(fault).collect()
    };
    solved.iter().flat_map(of).collect()
}

fn faults_of_gates(case: &Case, solved: &[(Rung, RungResult)], shown: &[&str]) -> Vec<String> {
    let verdict = case.judge(Size::Quick, solved);
    let mut faults = failing(&verdict);
    if verdict.gates.is_empty() {
        faults.push("no gate".to_owned());
    }
    let nothing = case.judge(Size::Quick, &[]);
    let held = nothing.gates.iter().filter(|gate| gate.passed());
    faults.extend(held.map(|gate| format!("{}: holds without a run", gate.name)));
    let mut judged = vec![];
    for Reaction { gate, to } in reactions(case, Size::Quick, solved) {
        let mut fault = |what: &str| faults.push(format!("{}: {what}", gate.name));
        if gate.reason.len() <= 8 {
            fault("no reason");
        }
        if to.is_empty() {
            fault("nothing makes it fail");
        }
        for number in to {
            judged.push(number.quantity);
            let own = format!("{}: {}", case.name(), gate.name);
            if !own.contains(number.quantity) {
                fault(&format!("fails for {}, {}", number.quantity, number.rung));
            }
        }
    }
    for (rung, run) in solved {
        for q in &run.quantities {
            let should_be = q.error.is_some() || q.exact == Some(0.0);
            if should_be && !judged.contains(&q.name) && !shown.contains(&q.name) {
                faults.push(format!("{}: no gate judges {}", rung.label, q.name));
            }
        }
    }
    faults
}

fn faults_of_wrong(case: &Case, wrong: &Wrong, solved: &[(Rung, RungResult)]) -> Vec<String> {
    let verdict = case.with(*wrong).judge(Size::Quick, solved);
    let mut faults = vec![];
    let all = solved.len() == case.rungs(Size::Quick).len();
    // Where some rungs alone are run, the gates on others say nothing.
    let own = |name: &str| all || solved.iter().any(|(rung, _)| name.starts_with(&rung.label));
    let gates = || verdict.gates.iter().filter(|gate| own(&gate.name));
    if gates().all(Gate::passed) {
        faults.push(format!("a wrong {} breaks nothing", wrong.name));
    }
    for gate in gates() {
        let fault = match (wrong.must_fail(&gate.name), gate.passed()) {
            (Some(true), true) => "does not break",
            (Some(false), false) => "breaks",
            _ => continue,
        };
        faults.push(format!(
            "a wrong {} {fault} {}: {:e} {:?} {:e}",
            wrong.name, gate.name, gate.value, gate.relation, gate.bound
        ));
    }
    faults
}
