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

use proctor_scene::Scene;
use proctor_scene::simulation::{Options, Simulation};

use super::judging::{error_gate, of_variant, order_gate, table};
use super::solve_scene;
use crate::case::{Case, CaseError, Found, Gate, Rung, Size, Solved, Verdict};
use crate::study::{Failure, Observer, Study};

/// A gate on the finest run: quantity, bound and reason.
type Bound = (&'static str, f64, &'static str);

/// One problem of the case.
struct Problem {
    variant: &'static str,
    /// Cells, coarse to fine; the full ladder has one more.
    cells: &'static [u32],
    scene: fn(&Rung) -> Scene,
    run: fn(Fluid, &Rung, &mut Simulation, &mut dyn Observer) -> Result<Found, Failure>,
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

/// Fluids at rest, in sound and in flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// Viscosity of the exact fluids over that of the scenes. Anything but 1 is a wrong reference, to prove that the gates
    /// notice.
    pub reference_viscosity: f64,
    /// Gravity and yield stress of the exact fluids over those of the scenes, for the same reason.
    pub reference_force: f64,
}

impl Fluid {
    /// The case as it is meant.
    pub const GIVEN: Self = Self {
        reference_viscosity: 1.0,
        reference_force: 1.0,
    };

    fn problem(rung: &Rung) -> &'static Problem {
        let own = |problem: &&&Problem| problem.variant == rung.variant;
        PROBLEMS.iter().find(own).unwrap_or(&PROBLEMS[0])
    }
}

impl Case for Fluid {
    fn name(&self) -> &'static str {
        "fluid"
    }

    fn question(&self) -> &'static str {
        "Do fluids rest, sound and flow as their closed forms say?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
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

    fn scene(&self, rung: &Rung) -> Scene {
        (Self::problem(rung).scene)(rung)
    }

    fn studies(&self) -> Result<Vec<&dyn Study>, &'static str> {
        Err("its problems have methods and steps of their own")
    }

    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let options = Options {
            displacement: true,
            measure: true,
            initial: sound::initial(rung),
            ..options.clone()
        };
        solve_scene(self, rung, &options, |simulation| {
            (Self::problem(rung).run)(*self, rung, simulation, &mut |share| progress(share))
        })
    }

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let mut verdict = Verdict::default();
        for problem in PROBLEMS {
            let own = |rung: &Rung| rung.variant == problem.variant;
            let rungs: Vec<Rung> = self.rungs(size).into_iter().filter(own).collect();
            let names: Vec<_> = problem.bounds.iter().map(|bound| bound.0).collect();
            let table = table(solved, problem.variant, &names);
            let bounds = problem
                .bounds
                .iter()
                .map(|&(name, bound, reason)| error_gate(&rungs, solved, name, bound, reason));
            let mut gates: Vec<Gate> = bounds.collect();
            let reason = "the order of the method";
            gates.extend(
                (problem.orders.iter())
                    .map(|&(name, order)| order_gate(&table, name, order, reason)),
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
}
