//! The passes of a step over nodes and particles, slab by slab.

use super::Simulation;
use super::acting::Acting;
use super::error::{StepError, StepErrorKind};
use super::interaction::{Now, Visit, on_slabs};
use super::mapping::{bodies_onto, first_carry};
use super::motion::{at_half_step_after, solve, solve_mapped, solve_remapped, sums_after, total};
use super::phase::Phase;
use super::step::Watcher;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::stage::g2p::{self, Found, G2p, Task};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, Forces, NodeForce, PlaneSums};
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
    /// Sorts particles once they have travelled far enough since the last sort; whether it did.
    pub(super) fn sort_if_stale(&mut self) -> bool {
        let superfluous = self.groups.superfluous as f64;
        let stale =
            self.travel > SORT_AFTER || superfluous > SORT_AFTER_GROUPS * self.particles() as f64;
        if stale {
            self.grid.sort(&mut self.sets, self.stencil);
            self.travel = 0.0;
            self.groups = Groups::default();
            self.sorted();
        }
        stale
    }

    /// Mass, momentum and force to the nodes of all fields, where something looks for contact before the time step is
    /// chosen. Elsewhere the equation of motion follows at once, and the same visit does both.
    pub(super) fn map_to_nodes(&mut self) {
        self.set_body_force();
        self.mapped = None;
        if self.finds() {
            let acting = self.acting(self.clock.dt_before);
            let mapping = bodies_onto(
                &self.plan,
                &self.sets,
                &self.bodies,
                self.lanes,
                self.stencil,
                first_carry(&self.plan),
            );
            let groups = self
                .grid
                .visit(|mut slab| mapping.run_first(&mut slab, &acting.walls));
            self.mapped = Some(groups.into_iter().sum());
        }
    }

    /// The equation of motion of all fields; the number of nodes or vertices where a contact force acts.
    pub(super) fn solve_nodes(&mut self, acting: &Acting) -> Result<usize, StepError> {
        self.load_nodes();
        let mapped = self.mapped.take();
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            first_carry(&self.plan),
        );
        let now = Now {
            settles: self.surfaces.is_some(),
            ..Now::new(&self.plan, &mapping, acting, &acting.walls)
        };
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        let parts = on_slabs(&mut self.contact, &self.grid, Visit::Trial);
        let results = self.grid.visit_with(parts, |mut slab, mut parts| {
            let groups = match mapped {
                Some(_) => 0,
                None => mapping.run_first(&mut slab, now.walls),
            };
            let sums = solve(&mut slab, &mut parts, &now, &forces)?;
            Ok(Solved { sums, groups })
        });
        let mut solved = vec![];
        for result in results {
            solved.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        self.ledger.sums = total(solved.iter().flat_map(|slab| &slab.sums));
        let groups = solved.iter().map(|slab| slab.groups).sum();
        self.groups.count(mapped.unwrap_or(groups));
        self.settle(acting)
    }

    /// The equation of motion on the sums that lie on the nodes, without contact. A load on an empty node, which a step
    /// would report, is left to the step.
    pub(super) fn solve_alone(&mut self, acting: &Acting) {
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
        let now = Now::new(&self.plan, &mapping, acting, &acting.walls);
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        self.grid.visit(|mut slab| {
            for planes in slab.planes() {
                planes.fold(now.walls, true, true);
                planes.velocities();
            }
            solve(&mut slab, &mut [], &now, &forces).is_ok()
        });
    }

    /// Ghost nodes and sums of the equation of motion once more, plane by plane, with the velocities that are there now.
    pub(super) fn sums_of_planes(&mut self, acting: &Acting) -> Vec<PlaneSums> {
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
        let now = Now::new(&self.plan, &mapping, acting, &acting.walls);
        let per_slab = self
            .grid
            .visit(|mut slab| sums_after(&mut slab, &now, &forces));
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
        visit: Visit,
        ended: Watcher<'_>,
    ) -> Result<(), StepError> {
        if visit == Visit::Mapped {
            if self.sort_if_stale() {
                // A sort may give a driven body a field, or take it.
                *acting = self.acting(acting.drift);
            }
            ended(Phase::Sort);
        }
        let carry = match visit {
            Visit::Trial | Visit::Mapped => Carry::Momentum,
            Visit::Remapped => Carry::Remap,
        };
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            carry,
        );
        let still = at_half_step_after(&acting.walls);
        let now = Now::new(&self.plan, &mapping, acting, &still);
        let parts = on_slabs(&mut self.contact, &self.grid, visit);
        self.grid
            .visit_with(parts, |mut slab, mut parts| match visit {
                Visit::Remapped => solve_remapped(&mut slab, &mut parts, &now),
                Visit::Trial | Visit::Mapped => solve_mapped(&mut slab, &mut parts, &now),
            });
        let lane = if visit == Visit::Remapped { 4 } else { 1 };
        self.settle_again(acting, lane)?;
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

/// What acts at the nodes for a change of velocity over `kick` \[s\].
pub(super) fn forces<'a>(
    scene: &Scene,
    plan: &Plan,
    loads: &'a [NodeForce],
    kick: f64,
) -> Forces<'a> {
    Forces {
        gravity: scene.gravity,
        loads,
        local_damping: plan.local_damping,
        kick,
    }
}
