//! Do fluids rest, sound and flow as their closed forms say?
//!
//! Source: soil notes, 2.5 and rank 5 of 3; exact solutions in `exact/channel.rs`, `exact/sound.rs` and
//! `exact/self_weight.rs`. Four problems:
//!
//! - *rest*: a column of water that its weight compresses by a hundredth, at rest: the pressure is the weight above.
//! - *sound*: a standing wave in a viscous fluid dies with nu k²/2. Steps grow with h², since the viscous force is that of
//!   the velocity half a step before and the rate is off by a share of the step: what remains is the order in space, 2.
//! - *force* and *drag*: flow between walls that a body force or a wall sets in motion, Newton's from the first moment on
//!   and Bingham's at last. The layer lies between antisymmetric planes, one cell apart, and is endless for it.
//!
//! Velocities are so small that no particle crosses a cell. `proctor verify fluid`.

mod flow;
mod rest;
mod sound;

use super::prelude::*;

/// A gate on the finest run: quantity, bound and reason.
type Bound = (&'static str, f64, &'static str);

/// One problem of the case.
struct Problem {
    variant: &'static str,
    /// Cells, coarse to fine; the full ladder has one more.
    cells: &'static [u32],
    scene: fn(&Rung) -> Scene,
    run: fn(Reference, &Rung, &mut Simulation, &mut dyn Observer) -> Result<Found, Failure>,
    bounds: &'static [Bound],
    /// Quantities with the order that they have at least.
    orders: &'static [(&'static str, f64)],
}

/// The problems; each in a file of its own.
const PROBLEMS: [&Problem; 6] = [
    &rest::REST,
    &sound::SOUND,
    &flow::FORCE,
    &flow::DRAG,
    &flow::FORCE_OF_BINGHAM,
    &flow::DRAG_OF_BINGHAM,
];

const WRONG_VISCOSITY: Wrong = Wrong::factor("viscosity", 1.1);
const WRONG_FORCE: Wrong = Wrong::factor("force", 1.05)
    .breaks(|gate| gate.contains("error") && !gate.starts_with("sound"));

/// Fluids at rest, in sound and in flow.
pub static FLUID: Case = Case::new(
    "fluid",
    "Do fluids rest, sound and flow as their closed forms say?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.displacements()
.residual()
.options(|rung, _, options| Options {
    initial: sound::initial(rung),
    ..options
})
.run(compare)
.judge_by(judge)
.wrong_references(&[WRONG_VISCOSITY, WRONG_FORCE])
.no_study("its problems have methods and steps of their own");

fn problem(rung: &Rung) -> &'static Problem {
    let own = |problem: &&&Problem| problem.variant == rung.variant;
    PROBLEMS.iter().find(own).unwrap_or(&PROBLEMS[0])
}

fn rungs(size: Size) -> Vec<Rung> {
    let of = |problem: &&Problem| {
        let mut cells = problem.cells.to_vec();
        if size == Size::Full {
            cells.extend(problem.cells.last().map(|last| 2 * last));
        }
        Rung::counted(
            problem.variant,
            &format!("{} cells", problem.variant),
            1.0,
            &cells,
        )
    };
    PROBLEMS.iter().flat_map(of).collect()
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for problem in PROBLEMS {
        let own = |rung: &Rung| rung.variant == problem.variant;
        let own: Vec<Rung> = runs
            .rungs
            .iter()
            .filter(|rung| own(rung))
            .cloned()
            .collect();
        let names: Vec<_> = problem.bounds.iter().map(|bound| bound.0).collect();
        let table = table(runs.solved, problem.variant, &names);
        let bounds = problem
            .bounds
            .iter()
            .map(|&(name, bound, reason)| error_gate(&own, runs.solved, name, bound, reason));
        let mut gates: Vec<Gate> = bounds.collect();
        let reason = "the order of the method";
        gates.extend(
            (problem.orders.iter()).map(|&(name, order)| order_gate(&table, name, order, reason)),
        );
        let named = gates
            .into_iter()
            .map(|gate| of_variant(problem.variant, gate));
        verdict.gates.extend(named);
        verdict
            .tables
            .push((format!("fluid, {}", problem.variant), table));
    }
    verdict
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    (problem(rung).scene)(rung)
}

fn compare(run: Run<'_>) -> Result<Found, Failure> {
    let Run {
        rung,
        reference,
        simulation,
        observer,
        ..
    } = run;
    (problem(rung).run)(reference, rung, simulation, observer)
}
