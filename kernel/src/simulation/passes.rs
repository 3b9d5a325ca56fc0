//! The passes of a step over nodes and particles, slab by slab.

use super::conditions::{Acting, prescribed};
use super::error::{StepError, StepErrorKind};
use super::fields::Grid;
use super::interactions::{Again, Interaction, Interactions, Now, Visit, on_slabs};
use super::mapping::{bodies_onto, fold};
use super::motion::{solve, solve_mapped, solve_remapped, sums_after, total};
use super::phase::{Phase, SlabWatcher, Watcher};
use super::{Simulation, Work};
use crate::particles::ParticleSet;
use crate::stage::g2p::{self, Found, G2p, Task, dilation};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, PlaneSums};
use std::borrow::Cow;
use std::ops::Range;

/// Travel in cells after which particles are sorted again whatever it costs. Rows and slabs allow for one cell.
const SORT_AFTER: f64 = 0.45;
/// Superfluous groups per particle after which a sort has paid: particles that left their cell break groups
/// apart, and two such groups cost about as much as sorting one particle.
const SORT_AFTER_GROUPS: f64 = 0.5;

/// How many groups of particles with the same base node the mapping meets. The number depends on the scene alone,
/// not on threads or lanes, and so do the sorts that follow from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Groups {
    /// Groups in the first mapping after the last sort; 0 before it.
    pub sorted: usize,
    /// Groups beyond that number, summed over the mappings since the last sort.
    pub superfluous: usize,
}

impl Groups {
    pub(super) fn count(&mut self, groups: usize) {
        if self.sorted == 0 {
            self.sorted = groups;
        }
        self.superfluous += groups.saturating_sub(self.sorted);
    }
}

/// What the visit of a slab gave: the sums of its planes, and the groups in the layers of particles that it owns.
struct Solved {
    sums: Vec<PlaneSums>,
    groups: usize,
}

/// `count` particles in shares of about the same size, `most` at most.
fn shares(count: usize, most: usize) -> Vec<Range<usize>> {
    let shares = count.div_ceil(most.max(1)).max(1);
    let ends = (0..=shares).map(|share| count * share / shares);
    let starts: Vec<usize> = ends.collect();
    starts.windows(2).map(|ends| ends[0]..ends[1]).collect()
}

/// What slabs bring along, and who is told of the phases within the visit, where it is of one slab.
fn watched<P>(parts: Vec<P>, ended: Watcher<'_>) -> Vec<(P, SlabWatcher<'_>)> {
    let mut ended = (parts.len() == 1).then_some(ended);
    parts.into_iter().map(|part| (part, ended.take())).collect()
}

impl Simulation {
    /// Divides the simulation for a visit of the slabs: into what it reads, the grid, and the interactions.
    pub(super) fn divide<'a>(
        &'a mut self,
        carry: Carry,
        acting: &'a Acting,
    ) -> (Now<'a>, &'a mut Grid, &'a mut Interactions) {
        let origin = self.origin();
        let Work {
            grid,
            own_field,
            interactions,
            ..
        } = &mut self.work;
        let mapping = bodies_onto(&self.decided, &self.state, own_field, carry);
        let now = Now {
            mapping,
            acting,
            conditions: &self.decided.conditions,
            origin,
            walls: Cow::Borrowed(&acting.walls),
            prescribed: prescribed(&self.decided.bodies, acting),
            again: None,
            measure: self.decided.plan.measure,
            settles: false,
        };
        (now, grid, interactions)
    }

    /// Sorts particles once they have travelled far enough since the last sort; whether it did.
    pub(super) fn sort_if_stale(&mut self, ended: Watcher<'_>) -> bool {
        let superfluous = self.state.groups.superfluous as f64;
        let stale = self.state.travel > SORT_AFTER
            || superfluous > SORT_AFTER_GROUPS * self.particles() as f64;
        if stale {
            let reach = (self.decided.family(), self.state.stencil);
            let sets = &mut self.state.sets;
            self.work.grid.sort(sets, reach, self.decided.lanes);
            self.state.travel = 0.0;
            self.state.groups = Groups::default();
            self.sorted();
        }
        ended(Phase::Sort);
        stale
    }

    /// Mass, momentum and force to the nodes of all fields, where an interaction looks at them before the time step is
    /// chosen. Elsewhere the equation of motion follows at once, and the same visit does both.
    pub(super) fn map_to_nodes(&mut self) {
        self.set_body_force();
        self.work.mapped = None;
        if self.finds() {
            let acting = self.acting(self.state.clock.dt_before);
            let (now, grid, _) = self.divide(Carry::All, &acting);
            let groups = grid.visit(|mut slab| now.map(&mut slab));
            self.work.mapped = Some(groups.into_iter().sum());
        }
    }

    /// The equation of motion of all fields; the number of nodes or vertices where an interaction acts.
    pub(super) fn solve_nodes(
        &mut self,
        acting: &Acting,
        ended: Watcher<'_>,
    ) -> Result<usize, StepError> {
        for one in self.work.interactions.iter().flatten() {
            one.load(&mut self.work.grid, &self.decided.scene);
        }
        let mapped = self.work.mapped.take();
        let settles = self.interactions().any(Interaction::settles);
        let (mut now, grid, interactions) = self.divide(Carry::All, acting);
        now.settles = settles;
        let parts = watched(on_slabs(interactions, grid, Visit::Trial), ended);
        let results = grid.visit_with(parts, |mut slab, (mut parts, mut ended)| {
            let groups = match mapped {
                Some(_) => 0,
                None => now.map(&mut slab),
            };
            let sums = solve(&mut slab, &mut parts, &now, &mut ended)?;
            Ok(Solved { sums, groups })
        });
        let mut solved = vec![];
        for result in results {
            solved.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        self.work.sums = total(solved.iter().flat_map(|slab| &slab.sums));
        let groups = solved.iter().map(|slab| slab.groups).sum();
        self.state.groups.count(mapped.unwrap_or(groups));
        ended(Phase::NodesFromParticles);
        let touching = self.settle(acting)?;
        if settles {
            ended(Phase::Contact);
        }
        Ok(touching)
    }

    /// The equation of motion on the sums that lie on the nodes, without interactions. A load on an empty node, which a step
    /// would report, is left to the step.
    pub(super) fn solve_alone(&mut self, acting: &Acting) {
        let (now, grid, _) = self.divide(Carry::All, acting);
        grid.visit(|mut slab| {
            fold(&mut slab, &now.walls);
            solve(&mut slab, &mut [], &now, &mut None).is_ok()
        });
    }

    /// Ghost nodes and sums of the equation of motion once more, plane by plane, with the velocities that are there now.
    pub(super) fn sums_of_planes(&mut self, acting: &Acting) -> Vec<PlaneSums> {
        let (now, grid, _) = self.divide(Carry::All, acting);
        let per_slab = grid.visit(|mut slab| sums_after(&mut slab, &now));
        per_slab.into_iter().flatten().collect()
    }

    fn load_on_empty_node(&self, node: usize) -> StepError {
        let local = self.work.grid.shape.position(node);
        let position = std::array::from_fn(|axis| local[axis] + self.origin()[axis]);
        self.error(StepErrorKind::LoadOnEmptyNode { position })
    }

    /// The second mapping of a step, of the velocities after the kick: for MUSL at the old positions, for USF at the new
    /// ones.
    pub(super) fn map_again(
        &mut self,
        acting: &mut Acting,
        again: Again,
        ended: Watcher<'_>,
    ) -> Result<(), StepError> {
        let carry = match again {
            Again::OldPositions => Carry::Remap,
            Again::NewPositions => {
                if self.sort_if_stale(ended) {
                    // A sort may give a driven body a field, or take it.
                    *acting = self.acting(acting.drift);
                }
                Carry::Momentum
            }
        };
        let (now, grid, interactions) = self.divide(carry, acting);
        let now = now.again(again);
        let parts = watched(on_slabs(interactions, grid, Visit::Again(again)), ended);
        grid.visit_with(parts, |mut slab, (mut parts, mut ended)| match again {
            Again::OldPositions => solve_remapped(&mut slab, &mut parts, &now, &mut ended),
            Again::NewPositions => solve_mapped(&mut slab, &mut parts, &now, &mut ended),
        });
        ended(Phase::Remap);
        self.settle_again(acting, again)?;
        if self.interactions().any(Interaction::settles) {
            ended(Phase::Contact);
        }
        Ok(())
    }

    /// Nodal values to the particles of all bodies that are not driven.
    pub(super) fn interpolate(&mut self, task: Task) -> Result<(), StepError> {
        let nodes = self.decided.family().stage_nodes(self.state.stencil);
        let call = g2p::instance(self.decided.plan.axes, nodes, &task);
        let mesh = &self.decided.scene.mesh;
        let beyond =
            std::array::from_fn(|axis| (mesh.cells[axis] as f64 * mesh.cell[axis]).next_up());
        let (lanes, stencil) = (self.decided.lanes, self.state.stencil);
        let cell_average = self.decided.plan.cell_average && task.strain.is_some();
        let grid = &self.work.grid;
        let particles = self.state.sets.iter().map(ParticleSet::len).sum();
        let most = grid.share_of_particles(particles);
        let mut parts = vec![];
        for (index, set) in self.state.sets.iter_mut().enumerate() {
            if self.decided.bodies[index].motion.is_some() {
                continue;
            }
            let ranges = shares(set.len(), most);
            let layout = set.layout;
            let columns = set.split_mut(&ranges).into_iter().zip(ranges);
            parts.extend(columns.map(|(columns, range)| (index, range.start, layout, columns)));
        }
        let bodies = &self.decided.bodies;
        let found = grid.team.map(parts, |(index, start, layout, mut columns)| {
            let body = &bodies[index];
            let nodes = grid.fields[grid.number_of(index)].nodes.lines();
            // Before positions move.
            let excess = if cell_average {
                let upper = task.gradient_of_upper;
                let mapping = &body.mapping;
                dilation::excess(lanes, stencil, &columns, &layout, mapping, nodes, upper)
            } else {
                vec![]
            };
            let part = call(
                lanes,
                G2p {
                    lanes,
                    columns: &mut columns,
                    layout: &layout,
                    mapping: &body.mapping,
                    law: &*body.law,
                    density: body.density,
                    domain_update: body.domain_update,
                    nodes,
                    beyond,
                    excess: &excess,
                    task,
                },
            );
            let fault = part.fault.map(|(p, kind)| (start + p, kind));
            (index, Found { fault, ..part })
        });
        let mut travel = 0.0_f64;
        let mut faults = vec![];
        for of_body in found.chunk_by(|(one, _), (other, _)| one == other) {
            let index = of_body[0].0;
            let parts = of_body.iter().map(|&(_, part)| part);
            let all = parts.fold(Found::default(), Found::and);
            travel = travel.max(all.travel);
            let found = &mut self.state.found[index];
            if task.kick {
                found.speed_squared = all.speed_squared;
            }
            if task.strain.is_some() {
                found.wave_speed_squared = all.wave_speed_squared;
                found.increment_squared = all.increment_squared;
                let updated = bodies[index].domain_update.is_some();
                let before = if updated { 0.0 } else { found.half_length };
                found.half_length = all.half_length.max(before);
            }
            if let Some((p, kind)) = all.fault {
                faults.push((index, p, kind));
            }
        }
        self.state.travel += travel;
        self.judge(&faults)?;
        if task.strain.is_some() && self.decided.plan.domain_update.is_some() {
            self.widen_stencil()?;
        }
        Ok(())
    }
}
