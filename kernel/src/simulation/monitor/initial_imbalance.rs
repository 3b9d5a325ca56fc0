//! Bodies whose stress at the start is not in balance with what acts on them.
//!
//! Stress that includes weight which is not there, or that pushes against a side which is free, sets the body in motion at once.
//! It shows at the nodes before the first step: where all is in balance no free node is accelerated.

use super::energy::NodalSnapshot;
use crate::exact_sum::ExactSum;
use crate::layout::Layout;
use crate::simulation::Cycle;
use crate::simulation::values::StepError;
use crate::stage::solve::is_ghost;

/// Largest sum of the unbalanced forces at the nodes over the weight, or over the force of the stress where nothing weighs.
/// Level ground at rest between sliding sides has 0.1 % to 1 %.
const MOST: f64 = 0.05;

impl Cycle {
    /// A warning where stress at the start is out of balance; `None` where there is none, or where it cannot be measured.
    pub(crate) fn initial_imbalance(&mut self) -> Option<String> {
        if !self.model.settings.starts_stressed {
            return None;
        }
        let share = self.unbalanced_share()?;
        let (_, of) = self.force_of_start();
        (share > MOST).then(|| {
            format!(
                "the initial stress is out of balance: unbalanced forces at the nodes add up to {:.1} % of the {of}, and the bodies \
                 move at once. It includes weight that is not there (\"level\" above the ground, or above a toe of it), or pushes \
                 against a side that is free; give each body the level of its own surface, hold the side, or let gravity come on \
                 with damping in a stage before",
                100.0 * share
            )
        })
    }

    /// Sum of the unbalanced forces at the nodes over the weight, or over the force of the stress where nothing weighs; `None`
    /// where it cannot be measured. It costs about as much as a step, and changes nothing.
    pub fn unbalanced_share(&mut self) -> Option<f64> {
        let kept = NodalSnapshot::take(self);
        let found = self.led(Self::unbalanced_force);
        kept.put_back(self);
        let (scale, _) = self.force_of_start();
        (scale > 0.0).then_some(found.ok()? / scale)
    }

    /// Sum of the magnitudes of the unbalanced forces at the nodes that move freely \[N\].
    fn unbalanced_force(&mut self) -> Result<f64, StepError> {
        self.prepare_solve()?;
        // Any time will do: forces at the nodes do not depend on it.
        let kick = self.free_step();
        let now = self.state.clock.time;
        let nodal = self.nodal_conditions_over(kick, [now, now], kick);
        self.complete_solve(&nodal)?;
        let grid = &self.work.grid;
        let driven = |body: usize| self.model.bodies[body].motion.is_some();
        let nodes = grid.free_nodes(driven);
        let inside = nodes
            .filter(|(node, _)| !is_ghost(&grid.shape, &nodal.walls, grid.shape.indices(*node)));
        // A fluid that is to flow out of a side has the pressure of its weight at the start: its balance is that along gravity.
        let fluid = self.model.bodies.iter().all(|body| body.law.is_fluid());
        let gravity = self.model.settings.gravity;
        let counts = |axis: usize| !fluid || gravity == [0.0; 3] || gravity[axis] != 0.0;
        let force = |line: &crate::grid::Line| {
            let along = (0..3).filter(|axis| counts(*axis));
            let square: f64 = along.map(|axis| line[4 + axis] * line[4 + axis]).sum();
            line[0] * square.sqrt() / kick
        };
        let mut sum = ExactSum::ZERO;
        inside.for_each(|(_, line)| sum.add(force(line)));
        self.join_sums(std::slice::from_mut(&mut sum));
        Ok(sum.value())
    }

    /// The weight of the bodies, or the force of the largest stress or pore pressure on one side of them where nothing weighs \[N\],
    /// and its name.
    fn force_of_start(&self) -> (f64, &'static str) {
        let gravity = self
            .model
            .settings
            .gravity
            .iter()
            .map(|g| g * g)
            .sum::<f64>();
        if gravity > 0.0 {
            return (self.mass() * gravity.sqrt(), "weight");
        }
        let axes = if self.model.plan.axisymmetric {
            3
        } else {
            self.model.plan.axes
        };
        let force = self.state.sets.iter().map(|set| {
            let [volume] = self.sums_over(set, |p| [set.columns[Layout::VOLUME][p]]);
            let stress = (0..set.len()).flat_map(|p| set.stress(p));
            let pressures = set.layout.pore_pressure();
            let pressures = pressures.map_or(&[][..], |column| &set.columns[column]);
            let all = stress.chain(pressures.iter().copied());
            let mut most = all.fold(0.0_f64, |most, s| most.max(s.abs()));
            self.join_most(std::slice::from_mut(&mut most));
            most * libm::pow(volume, 1.0 - 1.0 / axes as f64)
        });
        let of = if self.work.grid.has_water {
            "force of the stress or the pore pressure on a side"
        } else {
            "force of the stress on a side"
        };
        (force.sum(), of)
    }
}
