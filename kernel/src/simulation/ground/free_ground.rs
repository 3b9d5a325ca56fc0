//! The free ground beside absorbing sides, where a base shakes: columns that move as level ground without end does.
//!
//! Dashpots that stand still at a side would hold shaken ground back. Those of an absorbing side act against the velocity of a
//! column of ground beyond it (Zienkiewicz, Bicanic and Shen 1989): f = -Z (v - `v_free`) + A s n, with the stress s of the column
//! on the outward normal n of the side. What the body does beside that motion leaves through the side; level ground feels no
//! side at all.
//!
//! A column has a node for each node of the side, with the mass and the elastic moduli of the ground there at the start. It is a
//! row of masses and links of shear and compression that the base shakes as it shakes the body: by a wave through a dashpot, or
//! as a rigid base. Its kick and its movement are those of the step.

use super::beyond::Ground;
use crate::layout::Layout;
use crate::model::{Damping, Vector};
use crate::simulation::Cycle;
use crate::simulation::context::NodalConditions;
use crate::simulation::mapping::node_weights;
use crate::simulation::values::{Drift, FreeGroundNode};
use std::collections::BTreeMap;

/// Cells from a side within which particles can reach its nodes.
const REACH: f64 = 2.0;
/// Least share of a cell that ground covers at a node of a column: it ends below the others.
const LEAST_SHARE: f64 = 0.05;
/// Least length of a column that a node stands for, in cells: less mass would swing faster than a step resolves.
const LEAST_LENGTH: f64 = 0.25;

/// Sums over the particles that reach two nodes: volume, volume times shear and compression modulus.
type LinkSums = [f64; 3];

impl Cycle {
    /// Sets up the columns beside absorbing sides, at rest, once the nodes of absorbing planes are known.
    pub(crate) fn start_free_ground(&mut self) {
        let settings = &self.model.settings;
        let Some((up, base_side)) = settings.shaken_plane() else {
            return;
        };
        let shape = &self.work.grid.shape;
        let cell = shape.cell[up];
        let rigid = settings.base_motion.is_some();
        let mut columns: BTreeMap<[usize; 3], (usize, FreeGroundNode)> = BTreeMap::new();
        let mut links: BTreeMap<usize, LinkSums> = BTreeMap::new();
        for (axis, side) in settings.free_sides(up) {
            let ground = self.ground_at(axis, side);
            self.add_links(&ground, (axis, side), up, &mut links);
            let covered = Ground::covered(&ground);
            for (one, covered) in covered.filter(|(one, area)| *area > LEAST_SHARE * one.area) {
                let Ok(absorbing) =
                    (self.state.absorbing).binary_search_by_key(&one.node, |node| node.node)
                else {
                    continue;
                };
                let at = shape.indices(one.node);
                let mut key: [usize; 3] = std::array::from_fn(|axis| at[shape.direction(axis)]);
                if shape.axes == 2 {
                    key[2] = 0;
                }
                key.swap(up, 2);
                let in_base = shape.lies_in_plane(one.node, up, base_side);
                let in_end = in_base || shape.lies_in_plane(one.node, up, 1 - base_side);
                let whole = if in_end { 0.5 * cell } else { cell };
                let length = (covered / one.area * whole).max(LEAST_LENGTH * cell);
                let (number, node) = columns.entry(key).or_default();
                *number = one.node;
                node.absorbing = absorbing;
                node.is_held = in_base && rigid;
                node.enters = in_base && !rigid;
                node.mass = one.mass / one.volume * length;
                node.damping_rate = one.damping_rate / one.mass;
                if node.enters {
                    node.base = [1, 0].map(|kind: usize| one.impedance[kind] / one.mass);
                }
                node.area[axis] += if side == 0 { -covered } else { covered };
                let (impedance, spring) = self.dashpot(one, covered, axis);
                for along in 0..3 {
                    node.impedance[along] += impedance[along];
                    node.spring[along] += spring[along];
                }
            }
        }
        self.join_by_node(&mut links);
        let mut all: Vec<FreeGroundNode> = vec![];
        let mut below: Option<([usize; 3], usize)> = None;
        for (key, (number, mut node)) in columns {
            let joins = below.filter(|(at, _)| [at[0], at[1], at[2] + 1] == key);
            if let Some([volume, shear, compression]) =
                joins.and_then(|(_, below)| links.get(&below).copied())
            {
                node.stiffness = [shear, compression].map(|sum| sum / volume / cell);
            }
            below = Some((key, number));
            all.push(node);
        }
        self.state.free_ground = all;
    }

    /// Adds what the particles near a side give to the links between its nodes, by the lower node of each.
    fn add_links(
        &self,
        ground: &[Ground],
        (axis, side): (usize, usize),
        up: usize,
        links: &mut BTreeMap<usize, LinkSums>,
    ) {
        let (shape, mesh) = (&self.work.grid.shape, &self.model.settings.mesh);
        let mut next = [0; 3];
        next[up] = 1;
        let stride = shape.index(shape.mesh_node(next)) - shape.index(shape.mesh_node([0; 3]));
        let place = if side == 0 {
            0.0
        } else {
            mesh.cells[axis] as f64 * mesh.cell[axis]
        };
        for (set, body) in self.state.sets.iter().zip(&self.model.bodies) {
            let moduli = [
                body.law.shear_wave_speed(body.density),
                body.law.wave_speed(body.density),
            ]
            .map(|c| body.density * c * c);
            let x = &set.columns[Layout::POSITION + axis];
            let near = (0..set.len()).filter(|p| (x[*p] - place).abs() < REACH * mesh.cell[axis]);
            for p in near {
                let volume = set.columns[Layout::VOLUME][p];
                let weights = node_weights(set, body, shape, self.state.stencil, p);
                for &(node, weight) in weights.iter() {
                    let above = weights.iter().find(|(other, _)| *other == node + stride);
                    let on_side = ground.binary_search_by_key(&node, |one| one.node).is_ok();
                    if let (Some((_, other)), true) = (above, on_side) {
                        let part = weight * other * volume;
                        let sums = links.entry(node).or_default();
                        sums[0] += part;
                        sums[1] += part * moduli[0];
                        sums[2] += part * moduli[1];
                    }
                }
            }
        }
    }

    /// Forces of free ground on the nodes of absorbing sides: those of the dashpots and springs that its motion moves, and its
    /// stress.
    pub(crate) fn add_free_ground(&self, nodal: &mut NodalConditions, wave: Vector) {
        let Some((up, _)) = self.model.settings.shaken_plane() else {
            return;
        };
        let all = &self.state.free_ground;
        let first = nodal.absorbing.len() - self.state.absorbing.len();
        let motion = (nodal.kick, nodal.half_steps, wave);
        for (number, node) in all.iter().enumerate() {
            let after = self.free_velocity(number, up, motion);
            // Stiffness times strain along the column, in the mean of the cells at the node.
            let (mut stress, mut count) = ([[0.0; 2]; 3], 0.0_f64);
            for upper in [number, number + 1] {
                let Some(link) = all.get(upper).filter(|link| link.stiffness[0] > 0.0) else {
                    continue;
                };
                count += 1.0;
                for axis in 0..3 {
                    let longer = link.displacement[axis] - all[upper - 1].displacement[axis];
                    for kind in 0..2 {
                        stress[axis][kind] += link.stiffness[kind] * longer;
                    }
                }
            }
            let share = 1.0 / count.max(1.0);
            let force = &mut nodal.absorbing[first + node.absorbing].force;
            for axis in 0..3 {
                let mean = 0.5 * (node.velocity[axis] + after[axis]);
                let wave = if node.enters { wave[axis] } else { 0.0 };
                // The wave has been counted with the dashpots of all planes at the node.
                force[axis] += node.impedance[axis] * (mean - 2.0 * wave)
                    + node.spring[axis] * node.displacement[axis];
                if axis == up {
                    let normals = (0..3).filter(|normal| *normal != up);
                    let shears = normals.map(|normal| node.area[normal] * stress[normal][0]);
                    force[axis] += share * shears.sum::<f64>();
                } else {
                    let lateral = stress[up][1] - 2.0 * stress[up][0];
                    force[axis] += share * node.area[axis] * lateral;
                }
            }
        }
    }

    /// Velocity of a node of free ground half a step after this time \[m/s\].
    fn free_velocity(
        &self,
        number: usize,
        up: usize,
        (kick, half_steps, wave): (f64, [f64; 2], Vector),
    ) -> Vector {
        let all = &self.state.free_ground;
        let node = &all[number];
        if node.is_held {
            let base = self.model.base.as_ref();
            return base.map_or([0.0; 3], |base| base.at(half_steps[1]));
        }
        let local = match self.model.settings.damping {
            Damping::Local { alpha } => alpha,
            _ => 0.0,
        };
        std::array::from_fn(|axis| {
            let kind = usize::from(axis == up);
            let (v, d) = (node.velocity[axis], node.displacement[axis]);
            let mut force = -node.damping_rate * node.mass * v;
            if number > 0 {
                force += node.stiffness[kind] * (all[number - 1].displacement[axis] - d);
            }
            if let Some(above) = all.get(number + 1) {
                force += above.stiffness[kind] * (above.displacement[axis] - d);
            }
            if node.enters {
                force += 2.0 * node.base[kind] * wave[axis];
            }
            let mut a = force / node.mass;
            if v != 0.0 {
                a -= local * a.abs() * v.signum();
            }
            let beta = 0.5 * node.base[kind] * kick / node.mass;
            v + (a * kick - 2.0 * beta * v) / (1.0 + beta)
        })
    }

    /// The largest step in which columns are stable \[s\]: 2/w, with w² at most twice the stiffness of the links at a node over
    /// its mass.
    pub(crate) fn free_ground_step(&self) -> f64 {
        let all = &self.state.free_ground;
        let of = |number: usize| {
            let above = all.get(number + 1).map_or(0.0, |link| link.stiffness[1]);
            let stiffness = all[number].stiffness[1] + above;
            if stiffness > 0.0 {
                (2.0 * all[number].mass / stiffness).sqrt()
            } else {
                f64::INFINITY
            }
        };
        (0..all.len()).map(of).fold(f64::INFINITY, f64::min)
    }

    /// Moves the free ground by a step.
    pub(crate) fn move_free_ground(&mut self, nodal: &NodalConditions, drift: &Drift) {
        let Some((up, _)) = self.model.settings.shaken_plane() else {
            return;
        };
        let motion = (nodal.kick, nodal.half_steps, self.wave_of(nodal));
        // Forces depend on displacements alone, which stay until all velocities are known.
        for number in 0..self.state.free_ground.len() {
            self.state.free_ground[number].velocity = self.free_velocity(number, up, motion);
        }
        for node in &mut self.state.free_ground {
            for axis in 0..3 {
                node.displacement[axis] += node.velocity[axis] * drift.time;
            }
        }
    }
}
