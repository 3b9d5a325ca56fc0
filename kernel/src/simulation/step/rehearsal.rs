//! One part of a step again and again on the same state, for measurements.

use super::passes::VisitParts;
use crate::fields::Owner;
use crate::grid::ActiveRows;
use crate::simulation::Cycle;
use crate::simulation::context::{NodalConditions, Remap};
use crate::simulation::interactions::Interactions;
use crate::simulation::phase::PhaseTimer;
use crate::simulation::values::{SavedState, StepError, StepInfo};
use crate::stage::g2p::Task;
use crate::stage::p2g::Carry;
use crate::stage::solve::StepSums;
use crate::stage::weigh;
use std::ops::Range;

/// A part of a step that can be done alone. Of contact nothing takes part in the first mapping and the equation of motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Weights and derivatives of all particles, which the cycle computes on the way.
    Weights,
    /// A sort of the particles as they are: the time of finding that few of them have to move.
    Sort,
    /// Particles to nodes: clear, then mass, momentum and force.
    P2g,
    /// The equation of motion at the nodes, with boundary conditions.
    Solve,
    /// The second mapping of momentum.
    Remap,
    /// Nodes to particles: velocity, position, strain and stress.
    G2p,
}

impl Part {
    /// All parts, in the order of a step.
    pub const ALL: [Self; 6] = [
        Self::Weights,
        Self::Sort,
        Self::P2g,
        Self::Solve,
        Self::Remap,
        Self::G2p,
    ];

    /// Name for tables, records and configurations: lower case.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Weights => "weights",
            Self::Sort => "sort",
            Self::P2g => "p2g",
            Self::Solve => "solve",
            Self::Remap => "remap",
            Self::G2p => "g2p",
        }
    }
}

/// Snapshot that a rehearsal restores: the state that a step changes, and the results of the last step beside it.
struct StepSnapshot {
    saved: SavedState,
    fields: Vec<(Owner, ActiveRows)>,
    slabs: Vec<Range<usize>>,
    sums: StepSums,
    interactions: Interactions,
    phase_timer: PhaseTimer,
}

/// A part of the next step, played as often as one likes: [`Rehearsal::set`] makes the state in which the part
/// begins, [`Rehearsal::play`] does the part. When it is dropped the simulation is as it was before.
pub struct Rehearsal<'a> {
    simulation: &'a mut Cycle,
    part: Part,
    info: StepInfo,
    nodal: NodalConditions,
    kept: StepSnapshot,
}

impl Cycle {
    /// Rehearses a part of the next step.
    ///
    /// # Errors
    /// If the next step cannot be begun; see [`StepErrorKind`](crate::simulation::StepErrorKind).
    pub fn rehearse(&mut self, part: Part) -> Result<Rehearsal<'_>, StepError> {
        let kept = StepSnapshot {
            saved: self.save(),
            fields: self.work.grid.rows(),
            slabs: self.work.grid.slabs.clone(),
            sums: self.work.sums,
            interactions: self.work.interactions.clone(),
            phase_timer: std::mem::take(&mut self.work.phase_timer),
        };
        self.prepare_solve()?;
        let info = self.choose_time_step(f64::INFINITY)?;
        let nodal = self.nodal_conditions(info.dt);
        let mut rehearsal = Rehearsal {
            simulation: self,
            part,
            info,
            nodal,
            kept,
        };
        rehearsal.set()?;
        Ok(rehearsal)
    }
}

impl Rehearsal<'_> {
    /// Makes the state in which the part begins.
    ///
    /// # Errors
    /// As a step.
    pub fn set(&mut self) -> Result<(), StepError> {
        let (simulation, kept) = (&mut *self.simulation, &self.kept);
        match self.part {
            Part::Weights | Part::Sort | Part::P2g => {}
            Part::Solve => simulation.p2g_alone(&self.nodal),
            Part::Remap | Part::G2p => {
                for (set, was) in simulation.state.sets.iter_mut().zip(&kept.saved.state.sets) {
                    for (column, was) in set.columns.iter_mut().zip(&was.columns) {
                        column.copy_from_slice(was);
                    }
                }
                simulation.prepare_solve()?;
                simulation.complete_solve(&self.nodal)?;
            }
        }
        Ok(())
    }

    /// Plays the part once.
    ///
    /// # Errors
    /// As a step.
    pub fn play(&mut self) -> Result<(), StepError> {
        let (part, dt, nodal) = (self.part, Some(self.info.dt), &mut self.nodal);
        self.simulation.led(|simulation| {
            match part {
                Part::Weights => {
                    std::hint::black_box(simulation.weigh());
                }
                Part::Sort => {
                    simulation.state.travel = f64::INFINITY;
                    simulation.sort_if_stale();
                }
                Part::P2g => simulation.p2g_alone(nodal),
                Part::Solve => simulation.solve_alone(nodal),
                Part::Remap => simulation.remap(nodal, Remap::OldPositions)?,
                Part::G2p => {
                    simulation.run_g2p(Task {
                        kick: true,
                        ..simulation.g2p_task(dt, dt)
                    })?;
                }
            }
            Ok(())
        })
    }
}

impl Drop for Rehearsal<'_> {
    fn drop(&mut self) {
        let (simulation, kept) = (&mut *self.simulation, &mut self.kept);
        let restored = simulation.restore(kept.saved.clone());
        debug_assert!(restored.is_ok(), "{restored:?}");
        simulation
            .work
            .grid
            .set_rows(std::mem::take(&mut kept.fields));
        simulation.work.grid.slabs = std::mem::take(&mut kept.slabs);
        simulation.work.sums = kept.sums;
        simulation.work.interactions = std::mem::take(&mut kept.interactions);
        simulation.work.phase_timer = std::mem::take(&mut kept.phase_timer);
    }
}

impl Cycle {
    /// Particles to nodes without the equation of motion.
    fn p2g_alone(&mut self, nodal: &NodalConditions) {
        let VisitParts { context, grid, .. } = self.divide(Carry::All, nodal);
        grid.visit(|mut slab| {
            context.mapping.run(&mut slab);
        });
    }

    /// Weights of all particles, slab by slab.
    fn weigh(&self) -> f64 {
        let (lanes, axes, stencil) = (self.model.lanes, self.model.plan.axes, self.state.stencil);
        let (slabs, team) = (&self.work.grid.slabs, &self.work.grid.team);
        let mut sum = 0.0;
        for (set, body) in self.state.sets.iter().zip(&self.model.bodies) {
            let of_slab = |slab: &Range<usize>| {
                let range = set.in_layers(slab.clone());
                weigh::weights(lanes, axes, stencil, set, &body.mapping, range)
            };
            sum += team
                .map(slabs.iter().collect(), of_slab)
                .iter()
                .sum::<f64>();
        }
        sum
    }
}
