//! The passes of a step over nodes and particles, slab by slab.

use super::motion::{SlabInteractions, fold, solve, solve_mapped, solve_remapped, sums_after};
use crate::fields::{Grid, shares};
use crate::grid::Line;
use crate::memory::Memory;
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::conditions::load_on;
use crate::simulation::context::{NodalConditions, Remap, StepContext, VelocityMapping};
use crate::simulation::interactions::{Interaction, Interactions, SlabParts, in_turn, on_slabs};
use crate::simulation::mapping::particle_to_grid;
use crate::simulation::phase::{Phase, PhaseTimer};
use crate::simulation::values::{Groups, StepError, StepErrorKind};
use crate::simulation::work_state::{G2pShare, SlabSolution, WorkState};
use crate::stage::g2p::{self, G2p, ParticleMaxima, Task, dilation};
use crate::stage::p2g::Carry;
use crate::stage::solve::EmptyNode;
use smallvec::SmallVec;
use std::sync::atomic::{self, AtomicUsize};

/// Travel in cells after which particles are sorted again whatever it costs. Rows and slabs allow for one cell.
const SORT_AFTER: f64 = 0.45;
/// Superfluous groups per particle after which a sort has paid: particles that left their cell break groups
/// apart, and two such groups cost about as much as sorting one particle.
const SORT_AFTER_GROUPS: f64 = 0.5;

/// Maxima over the particles of bodies, with their places; few take no memory.
type BodyMaxima = SmallVec<[(usize, ParticleMaxima); 8]>;

/// The parts of a simulation in a visit of the slabs.
pub(crate) struct VisitParts<'a> {
    /// Input of the visit.
    pub(crate) context: StepContext<'a>,
    /// The grid.
    pub(crate) grid: &'a mut Grid,
    /// The interactions.
    interactions: &'a mut Interactions,
    /// The timer of the phases.
    timer: &'a mut PhaseTimer,
}

impl Cycle {
    /// Divides the simulation for a visit of the slabs.
    pub(crate) fn divide<'a>(
        &'a mut self,
        carry: Carry,
        nodal: &'a NodalConditions,
    ) -> VisitParts<'a> {
        let origin = self.origin();
        let WorkState {
            grid,
            own_field,
            interactions,
            phase_timer: timer,
            ..
        } = &mut self.work;
        let (model, state) = (&self.model, &self.state);
        let mapping = particle_to_grid(
            (&model.plan, model.lanes),
            &model.bodies,
            (&state.sets, state.stencil),
            own_field,
            carry,
        );
        let context = StepContext {
            mapping,
            nodal,
            conditions: &self.model.conditions,
            origin,
            walls: nodal.walls.clone(),
            prescribed: &nodal.prescribed,
            remap: None,
            measure: self.model.plan.measure,
            settles: false,
        };
        VisitParts {
            context,
            grid,
            interactions,
            timer,
        }
    }

    /// Sorts particles once they have travelled far enough since the last sort; whether it did.
    pub(crate) fn sort_if_stale(&mut self) -> bool {
        let superfluous = self.state.groups.superfluous as f64;
        let stale = self.state.travel > SORT_AFTER
            || superfluous > SORT_AFTER_GROUPS * self.particles() as f64;
        if stale {
            self.migrate();
            let reach = (self.model.family(), self.state.stencil);
            let sets = &mut self.state.sets;
            self.work.grid.sort(sets, reach, self.model.lanes);
            self.state.travel = 0.0;
            self.state.groups = Groups::default();
            self.sorted();
        }
        self.work.phase_timer.end(Phase::Sort);
        stale
    }

    /// Asks the system for the memory of nodes that particles reach since a sort, where they have become many more: without it a
    /// process ends without a word.
    pub(crate) fn require_memory_of_nodes(&mut self) -> Result<(), StepError> {
        let growth = self.work.grid.touched.growth();
        let asked = growth.map_or(Ok(()), |nodes| {
            let bytes = nodes as f64 * (size_of::<Line>() * self.work.grid.fields.len()) as f64;
            Memory::of_machine()
                .require(format!("{nodes} more nodes that particles reach"), bytes)
                .map_err(|error| self.error(StepErrorKind::Memory(error)))
        });
        self.fail_together(asked)
    }

    /// True if P2G is a pass of its own, since an interaction or a condition reads the nodes before the equation of motion.
    /// Elsewhere one visit of each slab does both.
    pub(crate) fn has_separate_p2g(&self) -> bool {
        self.detects() || self.model.conditions.iter().any(|one| one.reads_masses())
    }

    /// P2G: mass, momentum and force to the nodes of all fields.
    pub(crate) fn p2g(&mut self) {
        let nodal = self.nodal_conditions(self.state.clock.dt_before);
        let VisitParts { context, grid, .. } = self.divide(Carry::All, &nodal);
        let groups = AtomicUsize::new(context.groups_of_rows(grid));
        grid.visit(|mut slab| {
            groups.fetch_add(context.map(&mut slab), atomic::Ordering::Relaxed);
        });
        self.work.nodal = nodal;
        let groups = self.join_count(groups.into_inner());
        self.state.groups.count(groups);
        // Loads look at the masses of the nodes around theirs.
        self.exchange_nodes();
        self.work.phase_timer.end(Phase::P2gAndSolve);
    }

    /// P2G and contact detection, where they come before the equation of motion.
    pub(crate) fn prepare_solve(&mut self) -> Result<(), StepError> {
        self.evaluate_body_force();
        if self.has_separate_p2g() {
            self.p2g();
            self.detect_contact()?;
        }
        Ok(())
    }

    /// The equation of motion of all fields, with P2G where it has not come before; the number of nodes or vertices where an
    /// interaction acts.
    pub(crate) fn complete_solve(&mut self, nodal: &NodalConditions) -> Result<usize, StepError> {
        if self.has_separate_p2g() {
            self.solve(nodal)
        } else {
            self.p2g_and_solve(nodal)
        }
    }

    /// The equation of motion of all fields on the nodal sums; the number of nodes or vertices where an interaction acts.
    pub(crate) fn solve(&mut self, nodal: &NodalConditions) -> Result<usize, StepError> {
        let (touching, _) = self.visit_and_solve(nodal, false)?;
        Ok(touching)
    }

    /// P2G and the equation of motion, slab by slab in one visit; the number of nodes or vertices where an interaction acts.
    pub(crate) fn p2g_and_solve(&mut self, nodal: &NodalConditions) -> Result<usize, StepError> {
        let (touching, groups) = self.visit_and_solve(nodal, true)?;
        self.state.groups.count(groups);
        Ok(touching)
    }

    /// The equation of motion in one visit of the slabs, with P2G before it on each or without; the number of nodes or vertices
    /// where an interaction acts, and that of groups that P2G met.
    fn visit_and_solve(
        &mut self,
        nodal: &NodalConditions,
        with_p2g: bool,
    ) -> Result<(usize, usize), StepError> {
        for one in &mut self.work.interactions {
            one.add_forces(&mut self.work.grid, &self.model.settings);
            if one.detects() {
                self.work.phase_timer.end(Phase::Contact);
            }
        }
        let settles = self.interactions().any(Interaction::settles);
        let mut solved = self.solved();
        let VisitParts {
            mut context,
            grid,
            interactions,
            timer,
        } = self.divide(Carry::All, nodal);
        context.settles = settles;
        let mut parts = SlabParts::new();
        on_slabs(interactions, grid, VelocityMapping::Trial, &mut parts);
        let timers = timer.of_slabs(grid.slabs.len());
        let groups_of_rows = if with_p2g {
            context.groups_of_rows(grid)
        } else {
            0
        };
        let all = (solved.iter_mut().zip(in_turn(&mut parts))).zip(timers);
        grid.visit_with(all, |mut slab, ((solved, parts), timer)| {
            solved.groups = if with_p2g { context.map(&mut slab) } else { 0 };
            let interactions = SlabInteractions { parts, timer };
            solved.empty = solve(&mut slab, interactions, &context, &mut solved.sums).err();
        });
        drop(parts);
        if let Some(first) = solved.first_mut() {
            first.groups += groups_of_rows;
        }
        self.work.solved = solved;
        let all = self.join_slabs();
        if let Some(EmptyNode(node)) = all.empty {
            return Err(self.load_on_empty_node(node));
        }
        self.work.sums = all.sums;
        self.work.phase_timer.end(Phase::P2gAndSolve);
        let touching = self.settle(nodal)?;
        if settles {
            self.work.phase_timer.end(Phase::Contact);
        }
        self.exchange_nodes();
        Ok((touching, all.groups))
    }

    /// Places for what the visit of each slab gives.
    fn solved(&mut self) -> Vec<SlabSolution> {
        let mut solved = std::mem::take(&mut self.work.solved);
        solved.resize_with(self.work.grid.slabs.len(), SlabSolution::default);
        solved
    }

    /// The equation of motion on the sums that lie on the nodes, without interactions. A load on an empty node, which a step
    /// would report, is left to the step.
    pub(crate) fn solve_alone(&mut self, nodal: &NodalConditions) {
        let mut solved = self.solved();
        let VisitParts { context, grid, .. } = self.divide(Carry::All, nodal);
        grid.visit_with(solved.iter_mut(), |mut slab, solved| {
            fold(&mut slab, &context);
            let none = SlabInteractions::none();
            solved.empty = solve(&mut slab, none, &context, &mut solved.sums).err();
        });
        self.work.solved = solved;
    }

    /// Ghost nodes of the equation of motion once more, with the velocities that are there now, and their sums, which are added
    /// to those of the step.
    pub(crate) fn add_settled_sums(&mut self, nodal: &NodalConditions) {
        let mut solved = self.solved();
        let VisitParts { context, grid, .. } = self.divide(Carry::All, nodal);
        grid.visit_with(solved.iter_mut(), |mut slab, solved| {
            sums_after(&mut slab, &context, &mut solved.sums);
        });
        self.work.sums += &self.join_step_sums(solved.iter().map(|slab| &slab.sums));
        self.work.solved = solved;
    }

    fn load_on_empty_node(&self, node: usize) -> StepError {
        let local = self.work.grid.shape.position(node);
        let position = std::array::from_fn(|axis| local[axis] + self.origin()[axis]);
        let load = load_on(&self.model.settings, &self.work.grid.shape, node);
        self.error(StepErrorKind::LoadOnEmptyNode { load, position })
    }

    /// The remap: a second P2G of the velocities after the kick, for MUSL at the old positions, for USF at the new ones.
    pub(crate) fn remap(
        &mut self,
        nodal: &mut NodalConditions,
        remap: Remap,
    ) -> Result<(), StepError> {
        let carry = match remap {
            Remap::OldPositions => Carry::Remap,
            Remap::NewPositions => {
                if self.sort_if_stale() {
                    self.require_memory_of_nodes()?;
                    // A sort may give a driven body a field, or take it.
                    self.work.nodal = std::mem::take(nodal);
                    *nodal = self.nodal_conditions(self.work.nodal.drift);
                }
                Carry::Momentum
            }
        };
        let VisitParts {
            context,
            grid,
            interactions,
            timer,
        } = self.divide(carry, nodal);
        let context = context.remap(remap);
        let mut parts = SlabParts::new();
        on_slabs(
            interactions,
            grid,
            VelocityMapping::Remap(remap),
            &mut parts,
        );
        let all = in_turn(&mut parts).zip(timer.of_slabs(grid.slabs.len()));
        grid.visit_with(all, |mut slab, (parts, timer)| {
            let interactions = SlabInteractions { parts, timer };
            match remap {
                Remap::OldPositions => solve_remapped(&mut slab, interactions, &context),
                Remap::NewPositions => solve_mapped(&mut slab, interactions, &context),
            }
        });
        drop(parts);
        self.work.phase_timer.end(Phase::Remap);
        self.settle_remapped(nodal, remap)?;
        if self.interactions().any(Interaction::settles) {
            self.work.phase_timer.end(Phase::Contact);
        }
        self.exchange_nodes();
        Ok(())
    }

    /// Runs a G2P task on the particles of all bodies that are not driven.
    pub(crate) fn run_g2p(&mut self, task: Task) -> Result<(), StepError> {
        let nodes = self.model.family().stage_nodes(self.state.stencil);
        let plan = &self.model.plan;
        let call = g2p::instance(plan.axes, plan.axisymmetric, nodes, &task);
        let mesh = &self.model.settings.mesh;
        let beyond =
            std::array::from_fn(|axis| (mesh.cells[axis] as f64 * mesh.cell[axis]).next_up());
        let (lanes, stencil) = (self.model.lanes, self.state.stencil);
        let cell_average = self.model.plan.cell_average && task.strain.is_some();
        let grid = &self.work.grid;
        let particles = self.state.sets.iter().map(ParticleSet::len).sum();
        let most = grid.share_of_particles(particles);
        let bodies = &self.model.bodies;
        let is_free = |index: usize| bodies[index].motion.is_none();
        let gathered = &mut self.work.gathered;
        let sets = self.state.sets.iter().enumerate();
        let free = sets.filter(|(index, _)| is_free(*index));
        let count = free.map(|(_, set)| shares(set.len(), most).len()).sum();
        gathered.resize_with(count, G2pShare::default);
        let sets = self.state.sets.iter_mut().enumerate();
        let parts = sets
            .filter(|(index, _)| is_free(*index))
            .flat_map(|(index, set)| {
                let (ranges, layout) = (shares(set.len(), most), set.layout);
                set.parts_mut(ranges)
                    .map(move |(range, columns)| (index, range.start, layout, columns))
            });
        let parts = parts.zip(gathered.iter_mut());
        grid.team
            .each(parts, |((index, start, layout, mut columns), gathered)| {
                let body = &bodies[index];
                let nodes = grid.fields[grid.number_of(index)].nodes.lines();
                let (mapping, upper) = (&body.mapping, task.gradient_of_upper);
                let excess = &mut gathered.excess;
                excess.clear();
                if cell_average {
                    // Before positions move.
                    let columns = &columns;
                    dilation::excess(
                        lanes, stencil, columns, &layout, mapping, nodes, upper, excess,
                    );
                }
                let part = call(
                    lanes,
                    G2p {
                        lanes,
                        columns: &mut columns,
                        layout: &layout,
                        mapping,
                        law: &*body.law,
                        density: body.density,
                        domain_update: body.domain_update,
                        nodes,
                        beyond,
                        excess,
                        task,
                    },
                );
                let fault = part.fault.map(|(p, kind)| (start + p, kind));
                (gathered.body, gathered.found) = (index, ParticleMaxima { fault, ..part });
            });
        let mut maxima: BodyMaxima = gathered
            .chunk_by(|one, other| one.body == other.body)
            .map(|of_body| {
                let parts = of_body.iter().map(|part| part.found);
                let all = parts.fold(ParticleMaxima::default(), ParticleMaxima::and);
                (of_body[0].body, all)
            })
            .collect();
        self.join_maxima(&mut maxima);
        let mut travel = 0.0_f64;
        let mut faults = vec![];
        for (index, all) in maxima {
            travel = travel.max(all.travel);
            let found = &mut self.state.found[index];
            if task.kick {
                found.speed_squared = all.speed_squared;
            }
            if task.strain.is_some() {
                found.wave_speed_squared = all.wave_speed_squared;
                found.increment_squared = all.increment_squared;
                let updated = self.model.bodies[index].domain_update.is_some();
                let before = if updated { 0.0 } else { found.half_length };
                found.half_length = all.half_length.max(before);
            }
            if let Some((p, kind)) = all.fault {
                faults.push((index, p, kind));
            }
        }
        self.state.travel += travel;
        self.judge_together(&faults)?;
        if task.strain.is_some() && self.model.plan.domain_update.is_some() {
            self.widen_stencil()?;
        }
        Ok(())
    }
}
