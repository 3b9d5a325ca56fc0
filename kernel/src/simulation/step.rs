//! One step of the explicit cycle.

use super::clock::StepInfo;
use super::error::{Event, EventKind, ParticleAt, StepError, StepErrorKind};
use super::{BodyRun, Simulation, history_value};
use crate::constitutive::Configuration;
use crate::grid::GHOSTS_BELOW;
use crate::particles::{Layout, ParticleSet};
use crate::scene::{Outside, PlaneCondition, StressScheme};
use crate::stage::g2p::{self, Affine, FaultKind, Found, G2p, Task};
use crate::stage::p2g::{self, Carry, P2g};
use crate::stage::solve::{DrivenNode, EmptyNode, Forces, PlaneSums, Wall};
use crate::weights::{axis_weights_at, base_offset};
use rayon::prelude::*;
use std::ops::Range;

/// Travel in cells after which particles are sorted again. Rows and slabs allow for one cell.
const SORT_AFTER: f64 = 0.45;

/// Memory of dynamic relaxation: kinetic energies of the last two half-steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Relaxation {
    /// One half-step ago and two half-steps ago \[J\].
    pub last: [f64; 2],
    /// Number of peaks so far.
    pub peaks: u64,
}

/// What acts at the nodes in this step.
struct Acting {
    walls: Vec<Wall>,
    driven: Vec<DrivenNode>,
    kick: f64,
}

impl Simulation {
    /// One step of the cycle, at most to the time `stop` (a constant time step may pass it by less than half a
    /// step).
    ///
    /// Velocities live at half-steps: the first step kicks them by dt/2, later ones by the mean of the two
    /// steps that they join, which is second order also where the step changes.
    ///
    /// # Errors
    /// See [`StepErrorKind`]. The state is not to be used after an error.
    pub fn step(&mut self, stop: f64) -> Result<StepInfo, StepError> {
        let mut info = self.choose_time_step(stop)?;
        self.sort_if_stale();
        let acting = self.acting(&info);
        self.set_body_force();

        self.map_to_nodes(&acting)?;
        info.measured = self.measured();
        let relax = self.peak_of_kinetic_energy(&info);
        let drift = relax.unwrap_or(info.dt);
        match self.scene.scheme {
            StressScheme::Usl => {
                self.interpolate(Task { kick: true, ..self.task(Some(drift), Some(drift)) })?;
            }
            StressScheme::Musl => {
                self.interpolate(Task { kick: true, ..self.task(None, None) })?;
                self.remap(&acting);
                self.interpolate(Task {
                    gradient_of_upper: true,
                    affine: Affine::Leave,
                    ..self.task(Some(drift), Some(drift))
                })?;
            }
            StressScheme::Usf => {
                self.interpolate(Task { kick: true, ..self.task(Some(drift), None) })?;
                self.sort_if_stale();
                self.map_momentum(&acting);
                let strain = Some((drift, Configuration::End));
                self.interpolate(Task { strain, affine: Affine::Leave, ..self.task(None, None) })?;
            }
        }
        self.move_driven_bodies(&info)?;
        self.finish(&info, relax.is_some());
        Ok(info)
    }

    /// A pass over the particles that moves them by `drift` and strains them by `strain` \[s\].
    fn task(&self, drift: Option<f64>, strain: Option<f64>) -> Task {
        Task {
            kick: false,
            pic_fraction: self.scene.transfer.pic_fraction,
            drift,
            strain: strain.map(|dt| (dt, Configuration::Beginning)),
            gradient_of_upper: false,
            affine: self.plan.affine,
        }
    }

    /// Sorts particles once they have travelled far enough since the last sort.
    pub(super) fn sort_if_stale(&mut self) {
        if self.travel > SORT_AFTER {
            let (field, sets) = (&mut self.field, &mut self.sets);
            let (stencil, threads) = (self.stencil, self.threads);
            match &self.pool {
                Some(pool) => pool.install(|| field.sort(sets, stencil, threads)),
                None => field.sort(sets, stencil, threads),
            }
            self.travel = 0.0;
        }
    }

    /// Walls with their velocities at the two half-steps, and the nodes of driven bodies.
    fn acting(&self, info: &StepInfo) -> Acting {
        let (before, after) = (self.velocity_time(), self.clock.time + 0.5 * info.dt);
        let mut walls = vec![];
        for axis in 0..self.plan.axes {
            for side in 0..2 {
                let condition = self.scene.mesh.planes[axis][side];
                let moving =
                    self.scene.base_motion.as_ref().is_some_and(|b| b.axis == axis && b.side == side);
                let mut wall = Wall {
                    axis,
                    side,
                    fixed: moving || condition == PlaneCondition::Fixed,
                    before: [0.0; 3],
                    after: [0.0; 3],
                };
                if let (true, Some(base)) = (moving, &self.base) {
                    (wall.before, wall.after) = (base.at(before), base.at(after));
                }
                if moving || condition != PlaneCondition::Free {
                    walls.push(wall);
                }
            }
        }
        let mut driven = vec![];
        for (set, body) in self.sets.iter().zip(&self.bodies) {
            if let Some(motion) = &body.motion {
                let (before, after) = (history_value(motion, before), history_value(motion, after));
                let nodes = nodes_of(set, body, &self.field.shape, self.stencil);
                driven.extend(nodes.into_iter().map(|node| DrivenNode { node, before, after }));
            }
        }
        // Where two driven bodies share a node the later body decides, whatever the order of particles.
        driven.sort_by_key(|d| d.node);
        Acting { walls, driven, kick: 0.5 * (self.clock.dt_before + info.dt) }
    }

    /// Evaluates the body force at the positions of this step.
    fn set_body_force(&mut self) {
        let Some(body_force) = &self.body_force else { return };
        let (time, origin) = (self.clock.time, self.scene.mesh.origin);
        for set in &mut self.sets {
            let axes = set.layout.axes;
            let (Some(force), Some(start)) = (set.layout.force, set.layout.displacement_origin) else {
                continue;
            };
            let evaluate = |p: usize| {
                let global = |x: [f64; 3]| std::array::from_fn(|axis| x[axis] + origin[axis]);
                body_force(&global(set.vector(start, p)), &global(set.position(p)), time)
            };
            let values: Vec<[f64; 3]> = match &self.pool {
                Some(pool) => pool.install(|| (0..set.len()).into_par_iter().map(evaluate).collect()),
                None => (0..set.len()).map(evaluate).collect(),
            };
            for axis in 0..axes {
                let masses = set.columns[Layout::MASS].clone();
                for ((out, value), m) in set.columns[force + axis].iter_mut().zip(&values).zip(masses) {
                    *out = m * value[axis];
                }
            }
        }
    }

    /// Mass, momentum and force to the nodes, then the equation of motion.
    fn map_to_nodes(&mut self, acting: &Acting) -> Result<(), StepError> {
        let call = p2g::instance(self.plan.axes, self.stencil, self.plan.full_mapping, Carry::All);
        let forces = Forces {
            gravity: self.scene.gravity,
            loads: &self.loads,
            local_damping: self.plan.local_damping,
            kick: acting.kick,
        };
        let measure = self.plan.measure;
        let (sets, bodies, lanes, stencil) = (&self.sets, &self.bodies, self.lanes, self.stencil);
        let results = self.field.visit(self.pool.as_ref(), |mut planes| {
            planes.clear();
            for (set, body) in sets.iter().zip(bodies).filter(|(_, body)| body.motion.is_none()) {
                call(lanes, mapping_call(set, body, stencil, Carry::All, &mut planes));
            }
            planes.fold(&acting.walls, true, true);
            planes.velocities();
            planes.load(forces.loads)?;
            planes.accelerate(&forces);
            planes.drive(&acting.driven, true);
            let mut power = planes.constrain(&acting.walls, true, forces.kick);
            planes.unfold(&acting.walls, true);
            let sums = planes.sums(&forces, measure);
            power += sums.iter().map(|s| s.power).sum::<f64>();
            Ok((sums, power))
        });
        let mut total = PlaneSums::default();
        for result in results {
            let (sums, power) = result.map_err(|EmptyNode(node)| {
                let local = self.field.shape.position(node);
                let position = std::array::from_fn(|axis| local[axis] + self.scene.mesh.origin[axis]);
                self.error(StepErrorKind::LoadOnEmptyNode { position })
            })?;
            total.power += power;
            for plane in sums {
                total.kinetic += plane.kinetic;
                total.unbalanced_squared += plane.unbalanced_squared;
            }
        }
        self.ledger.sums = total;
        Ok(())
    }

    /// The second mapping of MUSL: momentum of the new particle velocities at the old positions.
    fn remap(&mut self, acting: &Acting) {
        let call = p2g::instance(self.plan.axes, self.stencil, self.plan.full_mapping, Carry::Remap);
        let (sets, bodies, lanes, stencil) = (&self.sets, &self.bodies, self.lanes, self.stencil);
        let still: Vec<Wall> = acting.walls.iter().map(|w| Wall { before: w.after, ..*w }).collect();
        self.field.visit(self.pool.as_ref(), |mut planes| {
            planes.clear_upper();
            for (set, body) in sets.iter().zip(bodies).filter(|(_, body)| body.motion.is_none()) {
                call(lanes, mapping_call(set, body, stencil, Carry::Remap, &mut planes));
            }
            planes.fold_remapped(&still);
            planes.remapped_velocities();
            planes.drive_remapped(&acting.driven);
            planes.constrain_remapped(&still);
        });
    }

    /// The mapping of USF: momentum at the new positions.
    fn map_momentum(&mut self, acting: &Acting) {
        let call = p2g::instance(self.plan.axes, self.stencil, self.plan.full_mapping, Carry::Momentum);
        let (sets, bodies, lanes, stencil) = (&self.sets, &self.bodies, self.lanes, self.stencil);
        let still: Vec<Wall> = acting.walls.iter().map(|w| Wall { before: w.after, ..*w }).collect();
        self.field.visit(self.pool.as_ref(), |mut planes| {
            planes.clear();
            for (set, body) in sets.iter().zip(bodies).filter(|(_, body)| body.motion.is_none()) {
                call(lanes, mapping_call(set, body, stencil, Carry::Momentum, &mut planes));
            }
            planes.fold(&still, true, false);
            planes.velocities();
            planes.drive(&acting.driven, false);
            planes.constrain(&still, false, 0.0);
            planes.unfold(&still, false);
        });
    }

    /// Nodal values to the particles of all bodies that are not driven.
    fn interpolate(&mut self, task: Task) -> Result<(), StepError> {
        let call = g2p::instance(self.plan.axes, self.stencil, &task);
        let mesh = &self.scene.mesh;
        let extent = std::array::from_fn(|axis| mesh.cells[axis] as f64 * mesh.cell[axis]);
        let nodes = self.field.nodes.lines();
        let lanes = self.lanes;
        let mut travel = 0.0_f64;
        let mut faults = vec![];
        for (index, (set, body)) in self.sets.iter_mut().zip(&mut self.bodies).enumerate() {
            if body.motion.is_some() {
                continue;
            }
            let ranges: Vec<Range<usize>> =
                self.field.slabs.iter().map(|slab| set.in_layers(slab.clone())).collect();
            let layout = set.layout;
            let run = &*body;
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
                        extent,
                        task,
                    },
                )
            };
            let parts = set.split_mut(&ranges);
            let found: Vec<Found> = match &self.pool {
                Some(pool) => pool.install(|| parts.into_par_iter().with_max_len(1).map(act).collect()),
                None => parts.into_iter().map(act).collect(),
            };
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
                body.found.half_length = all.half_length.max(
                    if body.domain_update.is_some() { 0.0 } else { body.found.half_length },
                );
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

    /// Stops for a fault, or removes particles outside the mesh where the scene says so.
    fn judge(&mut self, faults: &[(usize, usize, FaultKind)]) -> Result<(), StepError> {
        for &(set, p, kind) in faults {
            let at = self.particle_at(set, p);
            match kind {
                FaultKind::NotFinite => return Err(self.error(StepErrorKind::NotFinite(at))),
                FaultKind::Inverted => return Err(self.error(StepErrorKind::Inverted(at))),
                FaultKind::Outside if self.scene.outside == Outside::Stop => {
                    return Err(self.error(StepErrorKind::Outside(at)));
                }
                FaultKind::Outside => self.remove_outside(set)?,
            }
        }
        Ok(())
    }

    fn remove_outside(&mut self, set: usize) -> Result<(), StepError> {
        let mesh = &self.scene.mesh;
        let mut gone = vec![];
        for p in 0..self.sets[set].len() {
            let x = self.sets[set].position(p);
            let sound = Layout::VOLUME..Layout::stress(self.plan.axes) + self.sets[set].layout.stress_components();
            // The first fault of the set was a particle outside; others may lie behind it.
            if self.sets[set].columns[sound].iter().any(|column| !column[p].is_finite()) {
                let at = self.particle_at(set, p);
                return Err(self.error(StepErrorKind::NotFinite(at)));
            }
            if self.sets[set].columns[Layout::VOLUME][p] <= 0.0 {
                let at = self.particle_at(set, p);
                return Err(self.error(StepErrorKind::Inverted(at)));
            }
            let inside = (0..self.plan.axes)
                .all(|axis| x[axis] >= 0.0 && x[axis] <= mesh.cells[axis] as f64 * mesh.cell[axis]);
            if !inside {
                gone.push(p);
            }
        }
        for &p in &gone {
            let at = self.particle_at(set, p);
            self.close_account(set, p);
            self.events.push(Event {
                step: self.clock.step + 1,
                time: self.clock.time,
                kind: EventKind::Removed(at),
            });
        }
        self.sets[set].remove(&gone);
        Ok(())
    }

    fn particle_at(&self, set: usize, p: usize) -> ParticleAt {
        let (mass, volume) = self.mass_and_volume(set, p);
        ParticleAt {
            id: self.sets[set].id[p],
            body: self.bodies[set].id,
            position: self.position(set, p),
            volume,
            mass,
        }
    }

    /// Takes four nodes per axis once a particle domain exceeds half a cell.
    fn widen_stencil(&mut self) -> Result<(), StepError> {
        let half_length = self.bodies.iter().map(|b| b.found.half_length).fold(0.0, f64::max);
        if half_length > 1.0 {
            return Err(self.error(StepErrorKind::DomainTooLarge { half_length }));
        }
        if half_length > 0.5 && self.stencil == 3 {
            self.stencil = 4;
            self.travel = f64::INFINITY;
            self.events.push(Event {
                step: self.clock.step + 1,
                time: self.clock.time,
                kind: EventKind::WiderStencil,
            });
        }
        Ok(())
    }

    /// Kinetic energy and residual norm of this step, where measured.
    fn measured(&self) -> Option<(f64, f64)> {
        let sums = self.ledger.sums;
        self.plan.measure.then(|| (sums.kinetic, sums.unbalanced_squared.sqrt()))
    }

    /// Dynamic relaxation: where the kinetic energy has passed a peak, the drift (negative or zero) that takes
    /// the positions back to it \[s\].
    ///
    /// The energies at t - 3dt/2, t - dt/2 and t + dt/2 define a parabola whose vertex lies in (t - dt, t).
    fn peak_of_kinetic_energy(&mut self, info: &StepInfo) -> Option<f64> {
        if !self.plan.kinetic_damping {
            return None;
        }
        let now = self.ledger.sums.kinetic;
        let [last, earlier] = self.relaxation.last;
        if now >= last || last == 0.0 {
            self.relaxation.last = [now, last];
            return None;
        }
        let curvature = earlier - 2.0 * last + now;
        let vertex = if curvature < 0.0 { 0.5 * (earlier - now) / curvature } else { 0.0 };
        self.relaxation.last = [0.0; 2];
        self.relaxation.peaks += 1;
        Some((vertex.clamp(-0.5, 0.5) - 0.5) * info.dt)
    }

    /// Bodies with a prescribed velocity move by it.
    fn move_driven_bodies(&mut self, info: &StepInfo) -> Result<(), StepError> {
        let mut faults: Vec<(usize, usize, FaultKind)> = vec![];
        let half = self.clock.time + 0.5 * info.dt;
        let mesh = &self.scene.mesh;
        for (index, (set, body)) in self.sets.iter_mut().zip(&self.bodies).enumerate() {
            let Some(motion) = &body.motion else { continue };
            let v = history_value(motion, half);
            for axis in 0..set.layout.axes {
                let move_ = v[axis] * info.dt;
                let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
                for (p, x) in set.columns[Layout::POSITION + axis].iter_mut().enumerate() {
                    *x += move_;
                    if !(0.0..=extent).contains(x) && faults.last().is_none_or(|&(i, ..)| i != index) {
                        faults.push((index, p, FaultKind::Outside));
                    }
                }
                set.columns[Layout::velocity(set.layout.axes) + axis].fill(v[axis]);
                self.travel += (move_ / mesh.cell[axis]).abs();
            }
        }
        self.judge(&faults)
    }

    /// Advances the clock, keeps the books, and after a peak of kinetic energy sets velocities to zero.
    fn finish(&mut self, info: &StepInfo, reset: bool) {
        self.ledger.external_work += self.ledger.sums.power * info.dt;
        if let Some(base) = &self.base {
            if self.clock.time < base.end() && info.time >= base.end() {
                self.events.push(Event {
                    step: info.step,
                    time: info.time,
                    kind: EventKind::RecordEnded,
                });
            }
        }
        self.clock.step = info.step;
        self.clock.time = info.time;
        self.clock.dt_before = info.dt;
        if reset {
            self.clock.dt_before = 0.0;
            for set in &mut self.sets {
                let first = Layout::velocity(set.layout.axes);
                for column in &mut set.columns[first..first + set.layout.axes] {
                    column.fill(0.0);
                }
                if let Some(affine) = set.layout.affine {
                    for column in &mut set.columns[affine..affine + set.layout.axes.pow(2)] {
                        column.fill(0.0);
                    }
                }
            }
        }
    }
}

/// The particles of a set that reach the planes of a slab, layer by layer.
fn mapping_call<'a>(
    set: &'a ParticleSet,
    body: &'a BodyRun,
    stencil: usize,
    carry: Carry,
    planes: &'a mut crate::stage::solve::Planes<'_>,
) -> P2g<'a> {
    // A particle may have left its layer by one cell since the last sort.
    let first = planes.range.start.saturating_sub(stencil);
    let last = (planes.range.end + 1).min(set.layers.len() - 1);
    let layers = (first..last).map(|layer| set.in_layers(layer..layer + 1)).filter(|r| !r.is_empty());
    P2g {
        columns: &set.columns,
        layout: &set.layout,
        mapping: &body.mapping,
        layers: layers.collect(),
        planes: planes.range.clone(),
        nodes: planes.nodes,
        carry,
        viscous_rate: body.viscous_rate,
    }
}

/// Nodes with a positive weight of any particle of a driven body, increasing.
fn nodes_of(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &crate::grid::GridShape,
    stencil: usize,
) -> Vec<usize> {
    let mut nodes = vec![];
    let axes = shape.axes;
    for p in 0..set.len() {
        let x = set.position(p);
        let mut touched: [Vec<usize>; 3] = [vec![], vec![0], vec![]];
        for axis in 0..axes {
            let xi = x[axis] * body.mapping.inverse_cell[axis];
            let l = body
                .mapping
                .half_length_column
                .map_or(body.mapping.half_length[axis], |column| set.columns[column + axis][p]);
            let family = body.mapping.family;
            let base = ((xi - base_offset(stencil)).floor() + GHOSTS_BELOW as f64) as usize;
            let weights = if stencil == 3 {
                axis_weights_at::<3>(family, xi, l).1.to_vec()
            } else {
                axis_weights_at::<4>(family, xi, l).1.to_vec()
            };
            touched[shape.direction(axis)] = weights
                .iter()
                .enumerate()
                .filter(|(_, w)| **w > 0.0)
                .map(|(n, _)| base + n)
                .collect();
        }
        for &i in &touched[0] {
            for &j in &touched[1] {
                for &k in &touched[2] {
                    nodes.push(shape.index([i, j, k]));
                }
            }
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
