//! Do fluids rest, sound and flow as their closed forms say?
//!
//! Source: exact solutions in `exact/channel.rs`, `exact/sound.rs` and
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

const METHOD_ORDER: &str = "the order of the method";

/// One problem of the case.
struct Problem {
    variant: &'static str,
    /// Cells, coarse to fine; the full ladder has one more.
    cells: &'static [u32],
    scene: fn(&Rung) -> Scene,
    run: fn(Run<'_>) -> Result<Measurements, Failure>,
    gates: &'static [GateRule],
    /// Quantities of its table.
    names: &'static [&'static str],
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

const WRONG_VISCOSITY: Wrong = Wrong::factor("viscosity", 1.1).breaks(|gate| {
    let starts = |name| gate.starts_with(name);
    starts("sound: error")
        || starts("force: error")
        || starts("Bingham force: error")
        || (starts("drag: error") && gate.contains("starting"))
});
const WRONG_FORCE: Wrong = Wrong::factor("force", 1.05)
    .breaks(|gate| gate.contains("error") && !gate.starts_with("sound"));

/// Fluids at rest, in sound and in flow.
pub static FLUID: Case = Case::new(
    "fluid",
    "Do fluids rest, sound and flow as their closed forms say?",
)
.ladder(Ladder::made(rungs))
.scene(|rung, _| (problem(rung).scene)(rung))
.displacements()
.residual()
.options(|rung, _, options| Options {
    initial: sound::initial(rung),
    ..options
})
.run(|run| (problem(run.rung).run)(run))
.judge_by(judge)
.wrong_references(&[WRONG_VISCOSITY, WRONG_FORCE])
.no_study("its problems have methods and steps of their own")
.no_guest("the scenes of other solvers have no fluids");

fn problem(rung: &Rung) -> &'static Problem {
    let own = |problem: &&&Problem| problem.variant == rung.variant;
    PROBLEMS.iter().find(own).unwrap_or(&PROBLEMS[0])
}

/// Gates and tables, problem by problem.
fn judge(runs: &Runs<'_>) -> Verdict {
    let mut verdict = Verdict::default();
    for problem in PROBLEMS {
        let (variant, table) = (
            problem.variant,
            runs.table(Some(problem.variant), problem.names),
        );
        let gates = problem.gates.iter().map(|gate| runs.gate_of(variant, gate));
        verdict.gates.extend(gates);
        verdict.tables.push((format!("fluid, {variant}"), table));
    }
    verdict
}

fn rungs(size: Size) -> Vec<Rung> {
    let of = |problem: &&Problem| {
        let (variant, mut cells) = (problem.variant, problem.cells.to_vec());
        if size == Size::Full {
            cells.extend(problem.cells.last().map(|last| 2 * last));
        }
        Rung::counted(variant, &format!("{variant} cells"), 1.0, &cells)
    };
    PROBLEMS.iter().flat_map(of).collect()
}
