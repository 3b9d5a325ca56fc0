//! Contact with rigid surfaces in the cycle.

mod gap;
mod near;

use super::Simulation;
use super::acting::{Acting, node_weights};
use super::error::{StepError, StepErrorKind};
use super::history::integral;
use super::passes::{at_half_step_after, forces};
use crate::grid::{GridShape, Line};
use crate::scene::{Scene, Vector};
use crate::stage::solve::{PlaneSums, Wall};
use crate::stage::touch::{Touch, TouchedNode, apply, resolve, resolve_damped};
use gap::velocity;
use near::{Near, Place};
use std::collections::BTreeMap;

/// Sweeps end when none changes a velocity by more than this share of the largest change of the first one.
const TOLERANCE: f64 = 1e-6;
/// Most sweeps of a step. What is left then is made good in the next step: see [`Touch::bound`].
const SWEEPS: usize = 50;

/// What the cycle keeps of the surfaces. Nothing of it decides a result: the list of particles near a surface only
/// spares searches, and the impulses are records.
#[derive(Debug)]
pub(crate) struct Surfaces {
    near: Option<Near>,
    /// Touches of the present step, with where they belong.
    touches: Vec<Touch>,
    places: Vec<Place>,
    /// Particles that a surface pushes in this step, and whether friction holds them, by surface, set and identifier.
    pushed: BTreeMap<(usize, usize, u64), bool>,
    /// Impulse on each body from each surface in the last step \[N s\], and its time \[s\].
    pub(crate) last: Vec<Vec<Vector>>,
    pub(crate) last_kick: f64,
    /// The same summed since the start \[N s\].
    pub(crate) total: Vec<Vec<Vector>>,
}

impl Surfaces {
    pub(super) fn new(scene: &Scene) -> Option<Self> {
        let zero = vec![vec![[0.0; 3]; scene.bodies.len()]; scene.surfaces.len()];
        (!scene.surfaces.is_empty()).then(|| Self {
            near: None,
            touches: vec![],
            places: vec![],
            pushed: BTreeMap::new(),
            last: zero.clone(),
            last_kick: 0.0,
            total: zero,
        })
    }

    /// Particles have new places.
    pub(super) fn forget(&mut self) {
        self.near = None;
    }
}

impl Simulation {
    /// Force of the bodies on a surface in the last step \[N\].
    #[must_use]
    pub fn surface_force(&self, surface: usize) -> Vector {
        let mut force = [0.0; 3];
        for set in 0..self.sets.len() {
            let own = self.surface_force_on(surface, set);
            force = std::array::from_fn(|axis| force[axis] - own[axis]);
        }
        force
    }

    pub(super) fn surface_force_on(&self, surface: usize, set: usize) -> Vector {
        match &self.surfaces {
            Some(s) if s.last_kick > 0.0 => s.last[surface][set].map(|i| i / s.last_kick),
            _ => [0.0; 3],
        }
    }

    /// Impulse of a surface on a body since the start \[N s\].
    #[must_use]
    pub fn surface_impulse(&self, surface: usize, set: usize) -> Vector {
        self.surfaces
            .as_ref()
            .map_or([0.0; 3], |s| s.total[surface][set])
    }

    /// Displacement of a surface since the start \[m\].
    #[must_use]
    pub fn surface_shift(&self, surface: usize, time: f64) -> Vector {
        let motion = self.scene.surfaces[surface].motion.as_ref();
        motion.map_or([0.0; 3], |motion| integral(motion, time))
    }

    /// Corrects the nodal velocities after the solve so that no particle goes through a surface.
    pub(super) fn touch_surfaces(&mut self, acting: &Acting) -> Result<(), StepError> {
        let Some(mut surfaces) = self.surfaces.take() else {
            return Ok(());
        };
        let found = self.touches(&mut surfaces, acting, 1);
        self.surfaces = Some(surfaces);
        let mut nodes = found?;
        let Some(surfaces) = &mut self.surfaces else {
            return Ok(());
        };
        let touches = &mut surfaces.touches;
        match self.plan.local_damping {
            None => {
                resolve(touches, &mut nodes, TOLERANCE, SWEEPS);
            }
            Some(alpha) => {
                let lines = self.field.nodes.lines();
                resolve_damped(touches, &mut nodes, lines, alpha, TOLERANCE, SWEEPS);
            }
        }
        for bodies in &mut surfaces.last {
            bodies.fill([0.0; 3]);
        }
        surfaces.last_kick = acting.kick;
        surfaces.pushed.clear();
        for (touch, place) in touches.iter().zip(&surfaces.places) {
            if let (true, held) = touch.pushes_and_holds() {
                let id = self.sets[place.set].id[place.p];
                surfaces.pushed.insert((place.surface, place.set, id), held);
            }
            let impulse = touch.impulse();
            for axis in 0..3 {
                surfaces.last[place.surface][place.set][axis] += impulse[axis];
            }
        }
        let mut power = 0.0;
        for surface in 0..surfaces.last.len() {
            let v = velocity(&self.scene.surfaces[surface], self.clock.time, acting.drift);
            for set in 0..self.sets.len() {
                for axis in 0..3 {
                    let impulse = surfaces.last[surface][set][axis];
                    surfaces.total[surface][set][axis] += impulse;
                    power += impulse * v[axis] / acting.kick;
                }
            }
        }
        apply(&nodes, self.field.nodes.lines_mut(), 1, true);
        self.sum_after_contact(acting, power);
        Ok(())
    }

    /// Ghost nodes and sums of the last mapping once more, with the velocities after contact.
    fn sum_after_contact(&mut self, acting: &Acting, power: f64) {
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        let measure = self.plan.measure;
        let per_slab = self.field.visit(self.pool.as_ref(), |mut planes| {
            planes.unfold(&acting.walls, true);
            let mut sums = vec![PlaneSums::default(); planes.range.len()];
            planes.add_sums(&forces, measure, &mut sums);
            sums
        });
        let sums = &mut self.ledger.sums;
        sums.power += power;
        for plane in per_slab.into_iter().flatten() {
            sums.power += plane.power;
            sums.kinetic += plane.kinetic;
            sums.unbalanced_squared += plane.unbalanced_squared;
        }
    }

    /// Gives the velocities of a second mapping, which strain the particles, to the surfaces as the boundary planes do:
    /// without a record, and only where a surface pushes in this step. There the normal velocity is prescribed, and
    /// the tangential one too where friction holds. A bound instead, which lets noise away from the surface pass and
    /// stops noise towards it, would swell the layer of particles on the surface step by step.
    ///
    /// `lane` is where the nodes hold the velocities.
    pub(super) fn hold_at_surfaces(
        &mut self,
        acting: &Acting,
        lane: usize,
    ) -> Result<(), StepError> {
        let Some(mut surfaces) = self.surfaces.take() else {
            return Ok(());
        };
        let found = self.touches(&mut surfaces, acting, lane);
        let mut nodes = match found {
            Ok(nodes) => nodes,
            Err(error) => {
                self.surfaces = Some(surfaces);
                return Err(error);
            }
        };
        let mut held = surfaces.places.iter().map(|place| {
            let id = self.sets[place.set].id[place.p];
            surfaces.pushed.get(&(place.surface, place.set, id))
        });
        surfaces.touches.retain_mut(|touch| {
            let Some(&held) = held.next().flatten() else {
                return false;
            };
            touch.floor = f64::NEG_INFINITY;
            touch.friction = if held { f64::INFINITY } else { 0.0 };
            true
        });
        resolve(&mut surfaces.touches, &mut nodes, TOLERANCE, SWEEPS);
        self.surfaces = Some(surfaces);
        apply(&nodes, self.field.nodes.lines_mut(), lane, false);
        let still = at_half_step_after(&acting.walls);
        self.field.visit(self.pool.as_ref(), |mut planes| {
            if lane == 4 {
                planes.constrain_remapped(&still);
            } else {
                planes.unfold(&still, false);
            }
        });
        Ok(())
    }

    /// The particles within the threshold of a surface, with their velocities over it from the lanes of the nodes that
    /// begin at `lane`; and the nodes that they reach.
    fn touches(
        &mut self,
        surfaces: &mut Surfaces,
        acting: &Acting,
        lane: usize,
    ) -> Result<Vec<TouchedNode>, StepError> {
        surfaces.touches.clear();
        surfaces.places.clear();
        let near = self.near_surfaces(surfaces.near.take(), acting.drift);
        let mut at_node = BTreeMap::new();
        let mut nodes = vec![];
        for place in &near.particles {
            if let Some(touch) = self.touch(*place, acting, lane, &mut at_node, &mut nodes)? {
                surfaces.touches.push(touch);
                surfaces.places.push(*place);
            }
        }
        surfaces.near = Some(near);
        Ok(nodes)
    }

    /// The touch of one particle, if it is within the threshold.
    fn touch(
        &self,
        place: Place,
        acting: &Acting,
        lane: usize,
        at_node: &mut BTreeMap<usize, usize>,
        nodes: &mut Vec<TouchedNode>,
    ) -> Result<Option<Touch>, StepError> {
        let Place { surface, set, p } = place;
        let rigid = &self.scene.surfaces[surface];
        let margin = rigid.distance_threshold + self.smallest_cell();
        let Some((gap, nearest)) = self.surface_gap(surface, set, p, margin) else {
            return Ok(None);
        };
        if nearest.distance < 0.0 {
            return Err(self.error(StepErrorKind::ThroughSurface {
                particle: self.particle_at(set, p),
                surface: rigid.name.clone(),
                depth: -nearest.distance,
            }));
        }
        let shape = &self.field.shape;
        let weights = node_weights(&self.sets[set], &self.bodies[set], shape, self.stencil, p);
        let lines = self.field.nodes.lines();
        let v_s = velocity(rigid, self.clock.time, acting.drift);
        let mut relative = v_s.map(|v| -v);
        for &(node, w) in &weights {
            for axis in 0..3 {
                relative[axis] += w * lines[node][lane + axis];
            }
        }
        let normal = nearest.normal;
        let approach = -acting.drift
            * (0..3)
                .map(|axis| normal[axis] * relative[axis])
                .sum::<f64>();
        if approach > gap.max(0.0) && approach > rigid.distance_threshold {
            return Err(self.error(StepErrorKind::TooFastForSurface {
                particle: self.particle_at(set, p),
                surface: rigid.name.clone(),
                approach,
                threshold: rigid.distance_threshold,
            }));
        }
        if gap >= rigid.distance_threshold {
            return Ok(None);
        }
        let mut folded: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
        for (node, w) in weights {
            let (node, sign) = fold(shape, &acting.walls, node);
            let sum = folded.entry(node).or_insert([0.0; 3]);
            for axis in 0..3 {
                sum[axis] += sign[axis] * w;
            }
        }
        let weights = folded
            .into_iter()
            .map(|(node, w)| {
                let place = *at_node.entry(node).or_insert_with(|| {
                    nodes.push(TouchedNode {
                        node,
                        mobility: mobility(shape, acting, node, &lines[node]),
                        change: [0.0; 3],
                    });
                    nodes.len() - 1
                });
                (place, w)
            })
            .collect();
        let floor = rigid.penalty_stiffness.unwrap_or(0.0) * (-gap).max(0.0) * acting.kick;
        Ok(Some(Touch {
            weights,
            normal,
            relative,
            bound: -gap.max(0.0) / acting.drift,
            floor,
            friction: rigid.friction,
            normal_impulse: 0.0,
            tangential_impulse: [0.0; 3],
        }))
    }
}

/// The node inside the mesh whose velocity a node has, and the sign of each component; the node itself where it is no
/// ghost.
fn fold(shape: &GridShape, walls: &[Wall], node: usize) -> (usize, [f64; 3]) {
    let mut at = shape.indices(node);
    let mut sign = [1.0; 3];
    for wall in walls {
        let (ghost, _, mirror) = wall.layers(shape);
        let direction = shape.direction(wall.axis);
        if at[direction] == ghost {
            at[direction] = mirror;
            for axis in 0..3 {
                if wall.prescribes(axis) {
                    sign[axis] = -sign[axis];
                }
            }
        }
    }
    (shape.index(at), sign)
}

/// 1/m, zero where a boundary plane or a driven body prescribes the velocity.
fn mobility(shape: &GridShape, acting: &Acting, node: usize, line: &Line) -> [f64; 3] {
    if line[0] <= 0.0
        || acting
            .driven
            .binary_search_by_key(&node, |d| d.node)
            .is_ok()
    {
        return [0.0; 3];
    }
    let at = shape.indices(node);
    let mut mobility = [1.0 / line[0]; 3];
    for wall in &acting.walls {
        let (_, plane, _) = wall.layers(shape);
        if at[shape.direction(wall.axis)] == plane {
            for axis in 0..3 {
                if wall.prescribes(axis) {
                    mobility[axis] = 0.0;
                }
            }
        }
    }
    mobility
}
