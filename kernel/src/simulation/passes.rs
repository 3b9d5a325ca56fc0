//! The passes of a step over nodes and particles, slab by slab.

use super::acting::Acting;
use super::error::{StepError, StepErrorKind};
use super::{BodyRun, Simulation};
use crate::contact::interface::Interface;
use crate::lanes::Selected;
use crate::particles::{Layout, ParticleSet};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::stage::g2p::{self, Affine, Found, G2p, Task};
use crate::stage::p2g::{self, Carry, P2g, P2gFn};
use crate::stage::solve::{DrivenNode, EmptyNode, Forces, NodeForce, PlaneSums, Planes, Wall};
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

impl Simulation {
    /// Sorts particles once they have travelled far enough since the last sort.
    pub(super) fn sort_if_stale(&mut self) {
        let superfluous = self.groups.superfluous as f64;
        if self.travel > SORT_AFTER || superfluous > SORT_AFTER_GROUPS * self.particles() as f64 {
            let (field, sets) = (&mut self.field, &mut self.sets);
            field.sort(sets, self.stencil);
            self.travel = 0.0;
            self.groups = Groups::default();
            if !self.contact.pairs.is_empty() {
                self.find_near_pairs();
            }
            if self.mortar.acts() {
                self.set_mortar_layers();
            }
            if let Some(surfaces) = &mut self.surfaces {
                surfaces.forget();
            }
        }
    }

    /// Mass, momentum and force to the nodes, then the equation of motion, then contact; the number of nodes where a
    /// contact force acts.
    pub(super) fn map_to_nodes(&mut self, acting: &Acting, dt: f64) -> Result<usize, StepError> {
        if self.mortar.acts() {
            return self.solve_with_mortar(acting);
        }
        if !self.contact.layers.is_empty() {
            let (groups, touching) = self.map_to_layers(acting, dt)?;
            self.groups.count(groups);
            self.touch_surfaces(acting)?;
            return Ok(touching);
        }
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        let measure = self.plan.measure;
        // Contact with surfaces still changes the velocities, and takes the sums after it.
        let measured = self.surfaces.is_none().then_some(measure);
        let results = self.field.visit(|mut planes| {
            planes.clear();
            let groups = mapping.run(&mut planes);
            let sums = equation_of_motion(&mut planes, acting, &forces, measured)?;
            Ok(Sums { sums, groups })
        });
        let mut sums = vec![];
        for result in results {
            sums.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        let Mapped { total, groups } = total(sums);
        self.ledger.sums = total;
        self.groups.count(groups);
        self.touch_surfaces(acting)?;
        Ok(0)
    }

    pub(super) fn load_on_empty_node(&self, node: usize) -> StepError {
        let local = self.field.shape.position(node);
        let position = std::array::from_fn(|axis| local[axis] + self.origin()[axis]);
        self.error(StepErrorKind::LoadOnEmptyNode { position })
    }

    /// The second mapping of MUSL: momentum of the new particle velocities at the old positions.
    pub(super) fn remap(&mut self, acting: &Acting) {
        if self.mortar.acts() {
            return self.remap_with_mortar(acting);
        }
        if !self.contact.layers.is_empty() {
            return self.remap_layers(acting);
        }
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::Remap,
        );
        let still = at_half_step_after(&acting.walls);
        self.field.visit(|mut planes| {
            planes.clear_upper();
            mapping.run(&mut planes);
            settle_remapped(&mut planes, &still, &acting.driven);
        });
    }

    /// The mapping of USF: momentum at the new positions.
    pub(super) fn map_momentum(&mut self, acting: &Acting) {
        if !self.contact.layers.is_empty() {
            return self.map_momentum_to_layers(acting);
        }
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::Momentum,
        );
        let still = at_half_step_after(&acting.walls);
        self.field.visit(|mut planes| {
            planes.clear();
            mapping.run(&mut planes);
            planes.fold(&still, true, false);
            planes.velocities();
            planes.drive(&acting.driven, false);
            planes.constrain(&still, false);
            planes.unfold(&still, false);
        });
    }

    /// Nodal values to the particles of all bodies that are not driven.
    pub(super) fn interpolate(&mut self, task: Task) -> Result<(), StepError> {
        let call = g2p::instance(self.plan.axes, self.stencil, &task);
        let mesh = &self.scene.mesh;
        let beyond =
            std::array::from_fn(|axis| (mesh.cells[axis] as f64 * mesh.cell[axis]).next_up());
        let common = self.field.nodes.lines();
        let lanes = self.lanes;
        let mut travel = 0.0_f64;
        let mut faults = vec![];
        for (index, (set, body)) in self.sets.iter_mut().zip(&mut self.bodies).enumerate() {
            if body.motion.is_some() {
                continue;
            }
            let ranges: Vec<Range<usize>> = self
                .field
                .slabs
                .iter()
                .map(|slab| set.in_layers(slab.clone()))
                .collect();
            let layout = set.layout;
            let run = &*body;
            let nodes = self.contact.layers.nodes_of(index).unwrap_or(common);
            let act = |mut columns: Vec<&mut [f64]>| {
                call(
                    lanes,
                    G2p {
                        columns: &mut columns,
                        layout: &layout,
                        mapping: &run.mapping,
                        law: &run.law,
                        domain_update: run.domain_update,
                        nodes,
                        beyond,
                        task,
                    },
                )
            };
            let parts = set.split_mut(&ranges);
            let found: Vec<Found> = self.field.team.map(parts, act);
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
                body.found.stiffness = all.stiffness;
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

/// Velocities, accelerations and boundary conditions on one slab, from its masses, momenta and forces; what was
/// measured on each plane, or without `measured` what boundary conditions did alone.
pub(super) fn equation_of_motion(
    planes: &mut Planes<'_>,
    acting: &Acting,
    forces: &Forces<'_>,
    measured: Option<bool>,
) -> Result<Vec<PlaneSums>, EmptyNode> {
    planes.fold(&acting.walls, true, true);
    planes.velocities();
    let mut sums = vec![PlaneSums::default(); planes.range.len()];
    trial(planes, acting, &acting.driven, forces, &mut sums)?;
    planes.unfold(&acting.walls, true);
    if let Some(measure) = measured {
        planes.add_sums(forces, measure, &mut sums);
    }
    Ok(sums)
}

/// From sums mapped a second time to velocities that keep to driven bodies and to the walls.
pub(super) fn settle_remapped(planes: &mut Planes<'_>, still: &[Wall], driven: &[DrivenNode]) {
    planes.fold_remapped(still);
    planes.remapped_velocities();
    planes.drive_remapped(driven);
    planes.constrain_remapped(still);
}

/// Walls for a mapping of the velocities after the kick: both half-steps are the later one.
pub(super) fn at_half_step_after(walls: &[Wall]) -> Vec<Wall> {
    walls
        .iter()
        .map(|wall| Wall {
            before: wall.after,
            ..*wall
        })
        .collect()
}

/// From mapped sums to trial velocities that keep to the walls and to driven bodies.
pub(super) fn trial(
    planes: &mut Planes<'_>,
    acting: &Acting,
    driven: &[DrivenNode],
    forces: &Forces<'_>,
    sums: &mut [PlaneSums],
) -> Result<(), EmptyNode> {
    planes.load(forces.loads)?;
    planes.accelerate(forces);
    planes.add_power_of_driven(driven, forces.kick, sums);
    planes.drive(driven, true);
    planes.add_power_of_walls(&acting.walls, forces.kick, sums);
    planes.constrain(&acting.walls, true);
    Ok(())
}

/// What a mapping onto one slab gave.
pub(super) struct Sums {
    /// Sums of each plane.
    pub(super) sums: Vec<PlaneSums>,
    /// Groups in the layers that the slab owns.
    pub(super) groups: usize,
}

/// What a mapping onto all slabs gave.
pub(super) struct Mapped {
    pub(super) total: PlaneSums,
    pub(super) groups: usize,
}

/// Adds up plane after plane, so that the slabs do not matter.
pub(super) fn total(slabs: Vec<Sums>) -> Mapped {
    let mut all = Mapped {
        total: PlaneSums::default(),
        groups: 0,
    };
    for slab in slabs {
        all.groups += slab.groups;
        for plane in slab.sums {
            all.total.power += plane.power;
            all.total.kinetic += plane.kinetic;
            all.total.unbalanced_squared += plane.unbalanced_squared;
        }
    }
    all
}

/// The mapping of a kind. Borrows the particles alone, so that the nodes can be written meanwhile.
pub(super) fn bodies_onto<'a>(
    plan: &Plan,
    sets: &'a [ParticleSet],
    bodies: &'a [BodyRun],
    lanes: Selected,
    stencil: usize,
    carry: Carry,
) -> BodiesOnto<'a> {
    BodiesOnto {
        sets,
        bodies,
        lanes,
        stencil,
        carry,
        affine: plan.affine != Affine::Leave,
        call: p2g::instance(plan.axes, stencil, plan.full_mapping, carry),
    }
}

/// A mapping of bodies onto one slab after the other.
pub(super) struct BodiesOnto<'a> {
    sets: &'a [ParticleSet],
    bodies: &'a [BodyRun],
    lanes: Selected,
    stencil: usize,
    carry: Carry,
    /// Whether momentum has an affine part.
    affine: bool,
    call: P2gFn,
}

impl<'a> BodiesOnto<'a> {
    /// The same bodies with another carry.
    pub(super) fn with(&self, plan: &Plan, carry: Carry) -> BodiesOnto<'a> {
        bodies_onto(
            plan,
            self.sets,
            self.bodies,
            self.lanes,
            self.stencil,
            carry,
        )
    }

    /// Maps all bodies that are not driven and have no layer onto the planes of a slab; returns the number of groups in
    /// the layers of particles that the slab owns.
    pub(super) fn run(&self, planes: &mut Planes<'_>) -> usize {
        let mut groups = 0;
        for (index, body) in self.bodies.iter().enumerate() {
            if body.motion.is_none() && !body.in_layer {
                groups += self.map(index, planes);
            }
        }
        groups
    }

    /// Maps one body.
    pub(super) fn map(&self, index: usize, planes: &mut Planes<'_>) -> usize {
        let set = &self.sets[index];
        let layers = self.layers_onto(planes);
        let layers = (layers.start..layers.end.min(set.layers.len() - 1))
            .map(|layer| {
                (
                    set.in_layers(layer..layer + 1),
                    planes.range.contains(&layer),
                )
            })
            .filter(|(particles, _)| !particles.is_empty());
        self.map_runs(index, layers.collect(), planes)
    }

    /// Maps the particles of one body that are near its partners of contact.
    pub(super) fn map_interface(
        &self,
        index: usize,
        interface: &Interface,
        planes: &mut Planes<'_>,
    ) {
        let runs = interface.in_layers(self.layers_onto(planes));
        self.map_runs(index, runs.map(|run| (run, false)).collect(), planes);
    }

    /// Layers of particles that reach planes. A particle may have left its layer by one cell since the last sort.
    fn layers_onto(&self, planes: &Planes<'_>) -> Range<usize> {
        planes.range.start.saturating_sub(self.stencil)..planes.range.end + 1
    }

    fn map_runs(
        &self,
        index: usize,
        layers: Vec<(Range<usize>, bool)>,
        planes: &mut Planes<'_>,
    ) -> usize {
        let (set, body) = (&self.sets[index], &self.bodies[index]);
        let layout = Layout {
            affine: set.layout.affine.filter(|_| self.affine),
            ..set.layout
        };
        (self.call)(
            self.lanes,
            P2g {
                columns: &set.columns,
                layout: &layout,
                mapping: &body.mapping,
                layers,
                planes: planes.range.clone(),
                nodes: planes.nodes,
                carry: self.carry,
                spin: set.layout.affine,
                viscous_rate: body.viscous_rate,
            },
        )
    }
}
