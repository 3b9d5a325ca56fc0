//! The energy balance: external work, stored and kinetic energy, and the channels of dissipation.
//!
//! Velocities are half a step behind positions (leapfrog), while work and strain energy are those of the positions. So the
//! kinetic energy of the balance is brought to their time: the forces at the present positions are mapped once more, and
//! what they change in the half step that is missing is added. Nodes hold what a step left there, and interactions are as
//! they were, when that is done.
//!
//! Energy taken is summed where it is taken, as impulse times the mean of the velocities before and after it: damping at the
//! nodes, contact at the nodes where bodies meet, dissipation of laws in particles, and the energy of removed particles. What
//! no channel accounts for is the remainder: the transfer between particles and nodes, friction of some contacts, velocities
//! that boundary planes stop, and errors of the time integration.

use super::measure::kinetic_energy_of;
use crate::exact_sum::ExactSum;
use crate::fields::VelocityField;
use crate::grid::{ActiveRows, Line};
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::simulation::context::NodalConditions;
use crate::simulation::interactions::{Interaction, Interactions};
use crate::simulation::phase::PhaseTimer;
use crate::simulation::values::{Drift, Energy, Groups, StepError};
use crate::simulation::{Cycle, history_value};
use crate::stage::solve::{StepSums, Wall, is_ghost};
use std::ops::Range;

/// Cells that particles may have travelled since the last sort for the nodes in use to hold what they map.
const MAPPABLE: f64 = 1.0;

/// Work of the forces at the present positions in the half step that velocities are behind.
#[derive(Clone, Copy, Debug, Default)]
struct HalfStep {
    /// Change of the kinetic energy of free bodies \[J\].
    kinetic: f64,
    /// Energy that interactions store at the present positions \[J\].
    stored: f64,
    /// Energy that damping and contact take.
    sums: StepSums,
}

impl Cycle {
    /// Begins the energy balance.
    pub(crate) fn open_ledger(&mut self) {
        let [kinetic, strain, load] = self.energies();
        let [kinetic_of_water, stored] = self.water_energies();
        let ledger = &mut self.state.ledger;
        ledger.dead_load_origin = load;
        ledger.initial_energy = kinetic + strain + (kinetic_of_water + stored);
        self.state.start_spin = self.spin();
    }

    /// Adds the work and the losses of this step to the balance. Loads do work over the time that positions move.
    pub(crate) fn update_energy(&mut self, drift: &Drift) {
        let (ledger, sums) = (&mut self.state.ledger, &self.work.sums);
        ledger.external_work += sums.power * drift.time;
        ledger.damping += sums.damping;
        ledger.friction += sums.friction;
        ledger.impact += sums.impact;
        ledger.absorbed += sums.absorbed;
        ledger.drag += sums.drag;
    }

    /// The energy balance at the time of the positions. It costs about as much as a step, and changes nothing.
    #[must_use]
    pub fn energy(&mut self) -> Energy {
        let missing = self.half_step().unwrap_or_else(|| self.no_half_step());
        let driven = self.driven_ahead();
        let mut energy = self.balance(&missing);
        energy.kinetic += driven;
        energy.external_work += driven;
        energy
    }

    /// The balance with velocities as they are, half a step behind.
    pub(crate) fn energy_behind(&self) -> Energy {
        self.balance(&self.no_half_step())
    }

    fn no_half_step(&self) -> HalfStep {
        HalfStep {
            stored: self.interactions().map(Interaction::energy).sum(),
            ..HalfStep::default()
        }
    }

    fn balance(&self, missing: &HalfStep) -> Energy {
        let ledger = &self.state.ledger;
        let [kinetic, strain, load] = self.energies();
        let [kinetic_of_water, water] = self.water_energies();
        let kinetic = kinetic + kinetic_of_water + missing.kinetic;
        let external_work = ledger.external_work + load - ledger.dead_load_origin;
        // What is stored at the start is known from the first step on.
        let at_start = if self.state.clock.step == 0 {
            missing.stored
        } else {
            0.0
        };
        let present = kinetic + strain + missing.stored + water;
        let dissipated = ledger.initial_energy + at_start + external_work - present;
        let damping = ledger.damping + missing.sums.damping;
        let friction = ledger.friction + missing.sums.friction;
        let impact = ledger.impact + missing.sums.impact;
        let absorbed = ledger.absorbed + missing.sums.absorbed;
        let plastic = self.plastic_work();
        let drag = ledger.drag + missing.sums.drag;
        Energy {
            kinetic,
            strain,
            contact: missing.stored,
            external_work,
            dissipated,
            damping,
            friction,
            impact,
            plastic,
            absorbed,
            water,
            drag,
            removed: ledger.removed,
            algorithmic: self.algorithmic_work(),
            remainder: dissipated
                - damping
                - friction
                - impact
                - plastic
                - ledger.removed
                - absorbed
                - drag,
        }
    }

    /// Kinetic energy by which bodies whose motion is prescribed are ahead of their particles' velocities \[J\].
    fn driven_ahead(&self) -> f64 {
        let now = self.state.clock.time;
        let bodies = self.model.bodies.iter().enumerate();
        bodies
            .filter_map(|(index, body)| {
                let v = history_value(body.motion.as_ref()?, now);
                let axes = self.model.plan.axes;
                let square: f64 = v[..axes].iter().map(|c| c * c).sum();
                let of_body = |other: usize| other == index;
                let [mass, kinetic] = self.sums_by_body(of_body, |index, p| {
                    let set = &self.state.sets[index];
                    [set.columns[Layout::MASS][p], kinetic_energy_of(set, p)]
                });
                Some(0.5 * mass * square - kinetic)
            })
            .sum()
    }

    /// Maps the present forces and lets them act for the half step that is missing; `None` where they cannot be had: where
    /// particles are to be sorted before they are mapped, or the next step would stop.
    fn half_step(&mut self) -> Option<HalfStep> {
        let behind = self.state.clock.dt_before > 0.0;
        if !behind && self.work.interactions.is_empty() {
            return Some(HalfStep::default());
        }
        let mappable = self.state.travel <= MAPPABLE && self.work.failed.is_none();
        if !mappable {
            return None;
        }
        let kept = NodalSnapshot::take(self);
        let found = self.led(|simulation| simulation.act_for_half_step(behind));
        kept.put_back(self);
        found.ok()
    }

    fn act_for_half_step(&mut self, behind: bool) -> Result<HalfStep, StepError> {
        self.prepare_solve()?;
        let stored = self.interactions().map(Interaction::energy).sum();
        if !behind {
            return Ok(HalfStep {
                stored,
                ..HalfStep::default()
            });
        }
        let clock = self.state.clock;
        let times = [self.velocity_time(), clock.time];
        let nodal = self.nodal_conditions_over(0.5 * clock.dt_before, times, clock.dt_before);
        self.complete_solve(&nodal)?;
        let found = HalfStep {
            kinetic: self.change_of_kinetic_energy(&nodal),
            stored,
            sums: self.work.sums,
        };
        // The next step has its memory.
        self.work.nodal = nodal;
        Ok(found)
    }

    /// Change of the kinetic energy of all fields that move freely in the last equation of motion \[J\].
    fn change_of_kinetic_energy(&self, nodal: &NodalConditions) -> f64 {
        let grid = &self.work.grid;
        let driven = |body: usize| self.model.bodies[body].motion.is_some();
        let mut sum = ExactSum::ZERO;
        let mut add = |node: usize, line: &Line, walls: &[Wall]| {
            if is_ghost(&grid.shape, walls, grid.shape.indices(node)) {
                return;
            }
            for axis in 0..3 {
                let (v, dv) = (line[1 + axis], line[4 + axis]);
                sum.add(line[0] * dv * (v - 0.5 * dv));
            }
        };
        for (node, line) in grid.free_nodes(driven) {
            add(node, line, &nodal.walls);
        }
        for (node, line) in grid.water_nodes() {
            add(node, line, &nodal.water_walls);
        }
        self.join_sums(std::slice::from_mut(&mut sum));
        sum.value()
    }
}

/// Snapshot of all that acting for half a step changes, to be put back.
pub(crate) struct NodalSnapshot {
    interactions: Interactions,
    groups: Groups,
    sums: StepSums,
    phase_timer: PhaseTimer,
    /// Rows in use, field by field, where ranks share the simulation: messages of a neighbour widen them.
    rows: Option<Vec<ActiveRows>>,
    /// The nodes in use, field by field and row by row: pieces that fit where lists of a sort were.
    lines: Vec<Vec<Vec<Line>>>,
    /// Forces on particles, which may be functions of time, body by body.
    forces: Vec<Vec<Vec<f64>>>,
    /// Particles for which a sort had memory, which the nodes have meanwhile.
    sorted: usize,
}

impl NodalSnapshot {
    pub(crate) fn take(simulation: &mut Cycle) -> Self {
        // Memory that each visit fills anew may be as large as the mesh.
        let interactions = simulation.work.interactions.iter_mut();
        let interactions = interactions.map(|one| {
            let scratch = one.take_scratch();
            let copy = one.boxed();
            if let Some(scratch) = scratch {
                one.give_scratch(scratch);
            }
            copy
        });
        let interactions = interactions.collect();
        let sets = simulation.state.sets.iter();
        let forces = sets.map(|set| set.columns[force_columns(set)].to_vec());
        let forces = forces.collect();
        let grid = &mut simulation.work.grid;
        let sorted = grid.sorter.free_lists();
        let shared = simulation.work.share.is_some();
        let rows = shared.then(|| grid.fields.iter().map(|field| field.rows.clone()).collect());
        let rows_of = |field: &VelocityField| -> Vec<Vec<Line>> {
            let all = field.nodes.lines();
            let rows = field.rows.nodes(&grid.shape);
            rows.map(|row| all[row].to_vec()).collect()
        };
        let lines = grid.fields.iter().map(rows_of).collect();
        Self {
            interactions,
            groups: simulation.state.groups,
            sums: simulation.work.sums,
            // Nobody observes what is put back.
            phase_timer: std::mem::take(&mut simulation.work.phase_timer),
            rows,
            lines,
            forces,
            sorted,
        }
    }

    pub(crate) fn put_back(self, simulation: &mut Cycle) {
        let interactions = simulation.work.interactions.iter_mut();
        for (one, mut was) in interactions.zip(self.interactions) {
            if let Some(scratch) = one.take_scratch() {
                was.give_scratch(scratch);
            }
            *one = was;
        }
        for (set, was) in simulation.state.sets.iter_mut().zip(&self.forces) {
            let columns = force_columns(set);
            set.columns[columns].clone_from_slice(was);
        }
        simulation.state.groups = self.groups;
        simulation.work.sums = self.sums;
        simulation.work.phase_timer = self.phase_timer;
        let grid = &mut simulation.work.grid;
        for (field, rows) in grid.fields.iter_mut().zip(self.rows.into_iter().flatten()) {
            field.rows = rows;
        }
        for (field, lines) in grid.fields.iter_mut().zip(&self.lines) {
            let all = field.nodes.lines_mut();
            for (row, own) in field.rows.nodes(&grid.shape).zip(lines) {
                all[row].copy_from_slice(own);
            }
        }
        drop(self.lines);
        grid.sorter.reserve_lists(self.sorted);
    }
}

/// Columns of the force on each particle; none where the plan keeps none.
fn force_columns(set: &ParticleSet) -> Range<usize> {
    let first = set.layout.force;
    first.map_or(0..0, |first| first..first + set.layout.axes)
}
