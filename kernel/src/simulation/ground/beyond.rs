//! The ground at absorbing planes, as it is at the start: impedances, springs and reactions of their nodes.

use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::layout::Layout;
use crate::model::{CycleSettings, Damping, Vector};
use crate::simulation::Cycle;
use crate::simulation::conditions::{self, rings};
use crate::simulation::mapping::node_weights;
use crate::simulation::monitor::energy::NodalSnapshot;
use crate::simulation::values::{AbsorbingNode, StepError};
use std::f64::consts::TAU;

/// Cells from a plane within which particles can reach its nodes.
const REACH: f64 = 2.0;

impl Cycle {
    /// Finds impedances and reactions at the nodes of absorbing planes, from the particles as they are. A node that no
    /// particle reaches now stays free.
    pub(crate) fn start_absorbing(&mut self) {
        if !self.model.settings.has_reactions() {
            return;
        }
        let mut nodes = self.absorbing_nodes();
        let kept = NodalSnapshot::take(self);
        let conditions = std::mem::take(&mut self.model.conditions);
        // Reactions are those to stress and weight: loads that begin to act and damping are none of them.
        let settings = CycleSettings {
            point_loads: vec![],
            tractions: vec![],
            damping: Damping::None,
            ..self.model.settings.clone()
        };
        if let Ok(own) = conditions::of(&settings, &self.work.grid.shape, &[]) {
            self.model.conditions = own;
            let found = self.led(|cycle| cycle.forces_at(&nodes));
            for (one, force) in nodes.iter_mut().zip(found.unwrap_or_default()) {
                // What is held has no unbalanced force.
                one.reaction = force.map(|f| -f);
            }
        }
        self.model.conditions = conditions;
        kept.put_back(self);
        self.state.absorbing = nodes;
        self.start_free_ground();
    }

    /// Force of stress and weight at these nodes \[N\].
    fn forces_at(&mut self, nodes: &[AbsorbingNode]) -> Result<Vec<Vector>, StepError> {
        self.prepare_solve()?;
        // Any time will do: forces at the nodes do not depend on it.
        let kick = self.free_step();
        let now = self.state.clock.time;
        let nodal = self.nodal_conditions_over(kick, [now, now], kick);
        self.complete_solve(&nodal)?;
        let shape = &self.work.grid.shape;
        let force = |one: &AbsorbingNode| {
            let [plane, row, k] = shape.indices(one.node);
            let mut force = [0.0; 3];
            for (_, rows, lines) in self.fields() {
                let line = &lines[one.node];
                if rows.span(plane, row).contains(&k) && line[0] > 0.0 {
                    for axis in 0..3 {
                        force[axis] += line[0] * line[4 + axis] / kick;
                    }
                }
            }
            force
        };
        let mut forces: Vec<Vector> = nodes.iter().map(force).collect();
        self.join_at_nodes(nodes.iter().map(|one| one.node), &mut forces);
        Ok(forces)
    }

    /// The nodes of absorbing planes in their order, with impedances and stiffnesses.
    fn absorbing_nodes(&self) -> Vec<AbsorbingNode> {
        let settings = &self.model.settings;
        let mut all: Vec<AbsorbingNode> = vec![];
        for (axis, side) in settings.absorbing_planes() {
            let ground = self.ground_at(axis, side);
            for (one, covered) in Ground::covered(&ground) {
                let (impedance, stiffness) = self.dashpot(one, covered, axis);
                let node = AbsorbingNode {
                    node: one.node,
                    impedance,
                    stiffness,
                    ..AbsorbingNode::default()
                };
                all.push(node);
            }
        }
        for (axis, side) in settings.bearing_planes() {
            let ground = self.ground_at(axis, side);
            let with_mass = ground.iter().filter(|one| one.mass > 0.0);
            all.extend(with_mass.map(|one| AbsorbingNode {
                node: one.node,
                ..AbsorbingNode::default()
            }));
        }
        all.sort_by_key(|one| one.node);
        // A node of two planes bears what both bear.
        all.dedup_by(|later, first| {
            let same = later.node == first.node;
            if same {
                for axis in 0..3 {
                    first.impedance[axis] += later.impedance[axis];
                    first.stiffness[axis] += later.stiffness[axis];
                }
            }
            same
        });
        all
    }

    /// Impedances of the dashpots and stiffnesses of the springs at a node of a plane that stands for that area \[m²\].
    pub(crate) fn dashpot(&self, one: &Ground, covered: f64, axis: usize) -> (Vector, Vector) {
        let thickness = self.model.settings.ground_beyond.thickness;
        let (mut impedance, mut stiffness) = ([0.0; 3], [0.0; 3]);
        let axes = 0..self.work.grid.shape.axes;
        for along in axes.filter(|along| !self.is_held(one.node, *along)) {
            let kind = usize::from(along != axis);
            impedance[along] = covered * one.impedance[kind] / one.mass;
            if let Some(thickness) = thickness {
                stiffness[along] = covered * one.modulus[kind] / one.mass / thickness;
            }
        }
        (impedance, stiffness)
    }

    /// The ground at the nodes of an absorbing plane, in the order of the nodes.
    pub(crate) fn ground_at(&self, axis: usize, side: usize) -> Vec<Ground> {
        let settings = &self.model.settings;
        let (shape, mesh) = (&self.work.grid.shape, &settings.mesh);
        let mut ground = plane_nodes(settings, shape, axis, side);
        let place = if side == 0 {
            0.0
        } else {
            mesh.cells[axis] as f64 * mesh.cell[axis]
        };
        for (set, body) in self.state.sets.iter().zip(&self.model.bodies) {
            let speeds = [
                body.law.wave_speed(body.density),
                body.law.shear_wave_speed(body.density),
            ];
            let x = &set.columns[Layout::POSITION + axis];
            let near = (0..set.len()).filter(|p| (x[*p] - place).abs() < REACH * mesh.cell[axis]);
            for p in near {
                let mass = set.columns[Layout::MASS][p];
                let volume = set.columns[Layout::VOLUME][p];
                for &(node, weight) in node_weights(set, body, shape, self.state.stencil, p).iter()
                {
                    let Ok(at) = ground.binary_search_by_key(&node, |one| one.node) else {
                        continue;
                    };
                    let one = &mut ground[at];
                    one.mass += weight * mass;
                    one.damping_rate += weight * mass * body.viscous_rate;
                    one.volume += weight * volume;
                    for (i, c) in speeds.into_iter().enumerate() {
                        one.impedance[i] += weight * mass * body.density * c;
                        one.modulus[i] += weight * mass * body.density * c * c;
                    }
                }
            }
        }
        self.join_ground(&mut ground);
        ground
    }

    /// The ground as the ranks that own its nodes have it: they hold all particles that reach these, in their order.
    fn join_ground(&self, ground: &mut [Ground]) {
        if self.ranks().is_none() {
            return;
        }
        let mut sums: Vec<_> = ground.iter().map(Ground::sums).collect();
        self.join_at_nodes(ground.iter().map(|one| one.node), &mut sums);
        for (one, sums) in ground.iter_mut().zip(sums) {
            one.set_sums(sums);
        }
    }

    /// True if a plane or a held box prescribes the velocity of a node along an axis.
    fn is_held(&self, node: usize, along: usize) -> bool {
        let settings = &self.model.settings;
        let (shape, mesh) = (&self.work.grid.shape, &settings.mesh);
        let by_plane = (0..shape.axes).any(|axis| {
            [0, 1].into_iter().any(|side| {
                let moves = (settings.base_motion.as_ref())
                    .is_some_and(|base| (base.axis, base.side) == (axis, side));
                shape.lies_in_plane(node, axis, side)
                    && (moves || mesh.planes[axis][side].prescribes(along, axis))
            })
        });
        let at = shape.indices(node);
        let number = |axis: usize| at[shape.direction(axis)] - GHOSTS_BELOW;
        by_plane
            || settings.held_boxes.iter().any(|held| {
                (0..shape.axes).all(|axis| held.nodes_along(mesh, axis).contains(&number(axis)))
            })
    }
}

/// The ground at a node: sums over the particles that reach it.
pub(crate) struct Ground {
    pub(crate) node: usize,
    /// Area of the plane that the node stands for \[m²\].
    pub(crate) area: f64,
    pub(crate) mass: f64,
    pub(crate) volume: f64,
    /// Mass times density times the speed of compression and of shear.
    pub(crate) impedance: [f64; 2],
    /// Mass times density times the square of those speeds.
    modulus: [f64; 2],
    /// Mass times the rate of viscous damping.
    pub(crate) damping_rate: f64,
}

impl Ground {
    /// All sums over particles.
    fn sums(&self) -> [f64; 7] {
        let ([a, b], [c, d]) = (self.impedance, self.modulus);
        [self.mass, self.volume, a, b, c, d, self.damping_rate]
    }

    /// Takes those sums.
    fn set_sums(&mut self, [mass, volume, a, b, c, d, damping_rate]: [f64; 7]) {
        (self.mass, self.volume) = (mass, volume);
        (self.impedance, self.modulus) = ([a, b], [c, d]);
        self.damping_rate = damping_rate;
    }

    /// Nodes that particles reach, with the area that is covered there \[m²\]: ground covers a part of the cells around its edge.
    pub(crate) fn covered(all: &[Self]) -> impl Iterator<Item = (&Self, f64)> {
        let fullest = (all.iter()).fold(0.0_f64, |most, one| most.max(one.volume / one.area));
        let with_mass = all.iter().filter(|one| one.mass > 0.0);
        with_mass.map(move |one| {
            let covered = (one.volume / one.area / fullest).min(1.0) * one.area;
            (one, covered)
        })
    }
}

/// The nodes of a plane of the mesh with their areas, increasing. Around an axis they are those of rings, as the particles have
/// them.
fn plane_nodes(
    settings: &CycleSettings,
    shape: &GridShape,
    axis: usize,
    side: usize,
) -> Vec<Ground> {
    let radial = settings.mesh.axisymmetric;
    let circumference = if radial && axis == 0 {
        let edge = (side * shape.cells[0]) as f64 * shape.cell[0];
        TAU * (settings.mesh.origin[0] + edge)
    } else {
        1.0
    };
    let mut all = vec![];
    let counts: [usize; 3] = std::array::from_fn(|a| {
        if a < shape.axes {
            shape.cells[a] + 1
        } else {
            1
        }
    });
    for x in 0..counts[0] {
        for y in 0..counts[1] {
            for z in 0..counts[2] {
                let at = [x, y, z];
                if at[axis] != side * shape.cells[axis] {
                    continue;
                }
                let along = (0..shape.axes).filter(|other| *other != axis);
                let widths = along.map(|other| {
                    if radial && other == 0 {
                        return rings(settings, [0.0, shape.cells[0] as f64], at[0] as f64);
                    }
                    let is_edge = at[other] == 0 || at[other] == shape.cells[other];
                    shape.cell[other] * if is_edge { 0.5 } else { 1.0 }
                });
                all.push(Ground {
                    node: shape.index(shape.mesh_node(at)),
                    area: circumference * widths.product::<f64>(),
                    mass: 0.0,
                    volume: 0.0,
                    impedance: [0.0; 2],
                    modulus: [0.0; 2],
                    damping_rate: 0.0,
                });
            }
        }
    }
    all.sort_by_key(|one| one.node);
    all
}
