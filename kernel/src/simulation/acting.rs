//! What is prescribed in a step: moving planes and driven bodies.

use super::clock::StepInfo;
use super::error::StepError;
use super::{BodyRun, Simulation, history_value};
use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::particles::{Layout, ParticleSet};
use crate::scene::PlaneCondition;
use crate::stage::g2p::FaultKind;
use crate::stage::solve::{DrivenNode, Wall};
use crate::weights::{axis_weights_at, base_offset};

/// What acts at the nodes in this step.
pub(super) struct Acting {
    pub(super) walls: Vec<Wall>,
    pub(super) driven: Vec<DrivenNode>,
    /// Nodes of all fields that stand still.
    pub(super) held: Vec<DrivenNode>,
    pub(super) kick: f64,
    /// Half a step before and half a step after \[s\].
    pub(super) half_steps: [f64; 2],
    /// Time over which positions move \[s\].
    pub(super) drift: f64,
}

impl Simulation {
    /// Walls with their velocities at the two half-steps, and the nodes of driven bodies and held boxes in the common
    /// field.
    pub(super) fn acting(&self, dt: f64) -> Acting {
        let (before, after) = (self.velocity_time(), self.clock.time + 0.5 * dt);
        let mut walls = vec![];
        for axis in 0..self.plan.axes {
            for side in 0..2 {
                let condition = self.scene.mesh.planes[axis][side];
                let moving = self
                    .scene
                    .base_motion
                    .as_ref()
                    .is_some_and(|b| b.axis == axis && b.side == side);
                let mut wall = Wall {
                    axis,
                    side,
                    fixed: moving || condition == PlaneCondition::Fixed,
                    before: [0.0; 3],
                    after: [0.0; 3],
                };
                if let Some(base) = &self.base {
                    (wall.before, wall.after) = if moving {
                        (base.at(before), base.at(after))
                    } else {
                        (
                            self.mesh_part(base.at(before)),
                            self.mesh_part(base.at(after)),
                        )
                    };
                }
                if moving || condition != PlaneCondition::Free {
                    walls.push(wall);
                }
            }
        }
        let mut driven = vec![];
        for (set, body) in self.sets.iter().zip(&self.bodies) {
            if let (Some(motion), false) = (&body.motion, body.in_layer) {
                let (before, after) = (history_value(motion, before), history_value(motion, after));
                let nodes = nodes_of(set, body, &self.grid.shape, self.stencil);
                driven.extend(nodes.into_iter().map(|node| DrivenNode {
                    node,
                    before,
                    after,
                }));
            }
        }
        driven.extend_from_slice(&self.held);
        // Where two driven bodies share a node the later body decides, whatever the order of particles, and a held
        // node stands still.
        driven.sort_by_key(|d| d.node);
        Acting {
            walls,
            driven,
            held: self.held.clone(),
            kick: 0.5 * (self.clock.dt_before + dt),
            half_steps: [before, after],
            drift: dt,
        }
    }

    /// The part of a velocity of the base that the mesh takes part in: that along the normal of the base, so that
    /// the base stays on its plane of nodes however far it moves, and the plane opposite moves with it.
    fn mesh_part(&self, v: [f64; 3]) -> [f64; 3] {
        let normal = self.scene.base_motion.as_ref().map(|base| base.axis);
        std::array::from_fn(|axis| if Some(axis) == normal { v[axis] } else { 0.0 })
    }

    /// Velocity of the mesh in the middle of the step \[m/s\].
    pub(super) fn mesh_velocity(&self, info: &StepInfo) -> [f64; 3] {
        let middle = self.clock.time + 0.5 * info.dt;
        self.base
            .as_ref()
            .map_or([0.0; 3], |base| self.mesh_part(base.at(middle)))
    }

    /// Bodies with a prescribed velocity move by it.
    pub(super) fn move_driven_bodies(
        &mut self,
        info: &StepInfo,
        mesh_shift: &[f64; 3],
    ) -> Result<(), StepError> {
        let half = self.clock.time + 0.5 * info.dt;
        let mesh = &self.scene.mesh;
        let mut travel = 0.0_f64;
        let mut faults: Vec<(usize, usize, FaultKind)> = vec![];
        for (index, (set, body)) in self.sets.iter_mut().zip(&self.bodies).enumerate() {
            let Some(motion) = &body.motion else { continue };
            let v = history_value(motion, half);
            for axis in 0..set.layout.axes {
                let shift = v[axis] * info.dt - mesh_shift[axis];
                let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
                for (p, x) in set.columns[Layout::POSITION + axis].iter_mut().enumerate() {
                    *x += shift;
                    let inside = (0.0..=extent).contains(x);
                    if !inside && faults.last().is_none_or(|&(i, ..)| i != index) {
                        faults.push((index, p, FaultKind::Outside));
                    }
                }
                set.columns[Layout::velocity(set.layout.axes) + axis].fill(v[axis]);
                travel = travel.max((shift / mesh.cell[axis]).abs());
            }
        }
        self.travel += travel;
        self.judge(&faults)
    }
}

/// Velocity half a step before and after of each body whose motion is prescribed \[m/s\].
pub(super) fn prescribed(bodies: &[BodyRun], acting: &Acting) -> Vec<Option<[[f64; 3]; 2]>> {
    let mut all = vec![];
    for body in bodies {
        let motion = body.motion.as_ref();
        all.push(motion.map(|motion| acting.half_steps.map(|t| history_value(motion, t))));
    }
    all
}

/// Nodes with a positive weight of any particle of a driven body, increasing.
fn nodes_of(set: &ParticleSet, body: &BodyRun, shape: &GridShape, stencil: usize) -> Vec<usize> {
    let mut nodes: Vec<usize> = (0..set.len())
        .flat_map(|p| node_weights(set, body, shape, stencil, p))
        .map(|(node, _)| node)
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Nodes with a positive weight of one particle, increasing, with their weights.
pub(super) fn node_weights(
    set: &ParticleSet,
    body: &BodyRun,
    shape: &GridShape,
    stencil: usize,
    p: usize,
) -> Vec<(usize, f64)> {
    let axes = shape.axes;
    let x = set.position(p);
    let mut touched: [Vec<(usize, f64)>; 3] = [vec![], vec![(0, 1.0)], vec![]];
    for axis in 0..axes {
        let xi = x[axis] * body.mapping.inverse_cell[axis];
        let l = body
            .mapping
            .half_length_column
            .map_or(body.mapping.half_length[axis], |column| {
                set.columns[column + axis][p]
            });
        let family = body.mapping.family;
        let base = ((xi - base_offset(stencil)).floor() + GHOSTS_BELOW as f64) as usize;
        let weights = if stencil == 3 {
            axis_weights_at::<3>(family, xi, l).1.to_vec()
        } else {
            axis_weights_at::<4>(family, xi, l).1.to_vec()
        };
        touched[shape.direction(axis)] = weights
            .into_iter()
            .enumerate()
            .filter(|(_, w)| *w > 0.0)
            .map(|(n, w)| (base + n, w))
            .collect();
    }
    let mut nodes = Vec::with_capacity(27);
    for &(i, u) in &touched[0] {
        for &(j, v) in &touched[1] {
            for &(k, w) in &touched[2] {
                nodes.push((shape.index([i, j, k]), u * v * w));
            }
        }
    }
    nodes
}
