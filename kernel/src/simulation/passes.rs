//! The passes of a step over nodes and particles, slab by slab.

use super::Simulation;
use super::conditions::{Acting, prescribed};
use super::error::{StepError, StepErrorKind};
use super::fields::Grid;
use super::interactions::{Again, Interaction, Interactions, Now, Visit, on_slabs};
use super::mapping::bodies_onto;
use super::motion::{solve, solve_mapped, solve_remapped, sums_after, total};
use super::phase::Phase;
use super::step::Watcher;
use crate::stage::g2p::{self, Found, G2p, Task};
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

impl Simulation {
    /// Divides the simulation for a visit of the slabs: into what it reads, the grid, and the interactions.
    pub(super) fn divide<'a>(
        &'a mut self,
        carry: Carry,
        acting: &'a Acting,
    ) -> (Now<'a>, &'a mut Grid, &'a mut Interactions) {
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            carry,
        );
        let now = Now {
            mapping,
            acting,
            conditions: &self.conditions,
            origin: self.origin(),
            walls: Cow::Borrowed(&acting.walls),
            prescribed: prescribed(&self.bodies, acting),
            again: None,
            measure: self.plan.measure,
            settles: false,
        };
        (now, &mut self.grid, &mut self.interactions)
    }

    /// Sorts particles once they have travelled far enough since the last sort; whether it did.
    pub(super) fn sort_if_stale(&mut self, ended: Watcher<'_>) -> bool {
        let superfluous = self.groups.superfluous as f64;
        let stale =
            self.travel > SORT_AFTER || superfluous > SORT_AFTER_GROUPS * self.particles() as f64;
        if stale {
            self.grid.sort(&mut self.sets, self.stencil);
            self.travel = 0.0;
            self.groups = Groups::default();
            self.sorted();
        }
        ended(Phase::Sort);
        stale
    }

    /// Mass, momentum and force to the nodes of all fields, where an interaction looks at them before the time step is
    /// chosen. Elsewhere the equation of motion follows at once, and the same visit does both.
    pub(super) fn map_to_nodes(&mut self) {
        self.set_body_force();
        self.mapped = None;
        if self.finds() {
            let acting = self.acting(self.clock.dt_before);
            let (now, grid, _) = self.divide(Carry::All, &acting);
            let groups = grid.visit(|mut slab| now.map(&mut slab));
            self.mapped = Some(groups.into_iter().sum());
        }
    }

    /// The equation of motion of all fields; the number of nodes or vertices where an interaction acts.
    pub(super) fn solve_nodes(
        &mut self,
        acting: &Acting,
        ended: Watcher<'_>,
    ) -> Result<usize, StepError> {
        for one in self.interactions.iter().flatten() {
            one.load(&mut self.grid);
        }
        let mapped = self.mapped.take();
        let settles = self.interactions().any(Interaction::settles);
        let (mut now, grid, interactions) = self.divide(Carry::All, acting);
        now.settles = settles;
        let parts = on_slabs(interactions, grid, Visit::Trial);
        let results = grid.visit_with(parts, |mut slab, mut parts| {
            let groups = match mapped {
                Some(_) => 0,
                None => now.map(&mut slab),
            };
            let sums = solve(&mut slab, &mut parts, &now)?;
            Ok(Solved { sums, groups })
        });
        let mut solved = vec![];
        for result in results {
            solved.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        self.ledger.sums = total(solved.iter().flat_map(|slab| &slab.sums));
        let groups = solved.iter().map(|slab| slab.groups).sum();
        self.groups.count(mapped.unwrap_or(groups));
        let touching = self.settle(acting)?;
        ended(Phase::NodesFromParticles);
        Ok(touching)
    }

    /// The equation of motion on the sums that lie on the nodes, without interactions. A load on an empty node, which a step
    /// would report, is left to the step.
    pub(super) fn solve_alone(&mut self, acting: &Acting) {
        let (now, grid, _) = self.divide(Carry::All, acting);
        grid.visit(|mut slab| {
            now.mapping.fold(&mut slab, &now.walls);
            solve(&mut slab, &mut [], &now).is_ok()
        });
    }

    /// Ghost nodes and sums of the equation of motion once more, plane by plane, with the velocities that are there now.
    pub(super) fn sums_of_planes(&mut self, acting: &Acting) -> Vec<PlaneSums> {
        let (now, grid, _) = self.divide(Carry::All, acting);
        let per_slab = grid.visit(|mut slab| sums_after(&mut slab, &now));
        per_slab.into_iter().flatten().collect()
    }

    fn load_on_empty_node(&self, node: usize) -> StepError {
        let local = self.grid.shape.position(node);
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
        let parts = on_slabs(interactions, grid, Visit::Again(again));
        grid.visit_with(parts, |mut slab, mut parts| match again {
            Again::OldPositions => solve_remapped(&mut slab, &mut parts, &now),
            Again::NewPositions => solve_mapped(&mut slab, &mut parts, &now),
        });
        self.settle_again(acting, again)?;
        ended(Phase::Remap);
        Ok(())
    }

    /// Nodal values to the particles of all bodies that are not driven.
    pub(super) fn interpolate(&mut self, task: Task) -> Result<(), StepError> {
        let call = g2p::instance(self.plan.axes, self.stencil, &task);
        let mesh = &self.scene.mesh;
        let beyond =
            std::array::from_fn(|axis| (mesh.cells[axis] as f64 * mesh.cell[axis]).next_up());
        let lanes = self.lanes;
        let mut travel = 0.0_f64;
        let mut faults = vec![];
        for (index, (set, body)) in self.sets.iter_mut().zip(&mut self.bodies).enumerate() {
            if body.motion.is_some() {
                continue;
            }
            let ranges: Vec<Range<usize>> = self
                .grid
                .slabs
                .iter()
                .map(|slab| set.in_layers(slab.clone()))
                .collect();
            let layout = set.layout;
            let run = &*body;
            let nodes = self.grid.fields[self.grid.number_of(index)].nodes.lines();
            let act = |mut columns: Vec<&mut [f64]>| {
                call(
                    lanes,
                    G2p {
                        lanes,
                        columns: &mut columns,
                        layout: &layout,
                        mapping: &run.mapping,
                        law: &*run.law,
                        density: run.density,
                        domain_update: run.domain_update,
                        nodes,
                        beyond,
                        task,
                    },
                )
            };
            let parts = set.split_mut(&ranges);
            let found: Vec<Found> = self.grid.team.map(parts, act);
            let mut all = Found::default();
            for (part, range) in found.into_iter().zip(&ranges) {
                let fault = part.fault.map(|(p, kind)| (range.start + p, kind));
                all = all.and(Found { fault, ..part });
            }
            travel = travel.max(all.travel);
            if task.kick {
                body.found.speed_squared = all.speed_squared;
            }
            if task.strain.is_some() {
                body.found.wave_speed_squared = all.wave_speed_squared;
                body.found.half_length = all.half_length.max(if body.domain_update.is_some() {
                    0.0
                } else {
                    body.found.half_length
                });
            }
            if let Some((p, kind)) = all.fault {
                faults.push((index, p, kind));
            }
        }
        self.travel += travel;
        self.judge(&faults)?;
        if task.strain.is_some() && self.plan.domain_update.is_some() {
            self.widen_stencil()?;
        }
        Ok(())
    }
}
