//! Water that stands beside bodies and presses on their surfaces, wherever these go.
//!
//! The virtual power of a pressure p on the surface of a body is minus the integral of p n . v over it, which is minus the integral
//! of p div v + v . grad p over the body, for any field p that has the pressure at the surface. So a node gets
//! -sum V (p grad S + S grad p) over the particles, and nobody looks for a surface (Given et al. 2022 have it on virtual
//! particles outside). The sum over the nodes is -sum V grad p to round-off: the buoyancy of Archimedes. A body whose
//! stress is -p is in equilibrium node by node: the load on its surface cancels with the stress behind it and does not shake
//! nodes that are nearly empty.
//!
//! Pore water shares the force at the node, n of it, and the skeleton has the rest: the total traction is the pressure, and
//! the water in the pores meets the same pressure at the surface. Fields are folded at boundary planes as the pressure of the pores is.

use super::{ConditionResult, ConditionType};
use crate::grid::{ActiveRows, GHOSTS_BELOW, GridShape, Line};
use crate::layout::Layout;
use crate::model::{CycleSettings, PlaneCondition, Shore, StandingWater, Vector, VolumetricStrain};
use crate::particles::ParticleSet;
use crate::simulation::context::{Condition, FieldForces, FieldNodes, NodalConditions};
use crate::simulation::fields::Owner;
use crate::simulation::history::value;
use crate::simulation::step_view::StepView;
use crate::simulation::values::BodyRun;
use crate::simulation::water::porosity_at;
use crate::stage::solve::{EmptyNode, NodeForce, PlaneSums};
use crate::weights::{Family, axis_weights_at};
use std::sync::Arc;

/// Standing water.
pub(super) const STANDING_WATER: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        if !settings.standing_waters.is_empty() {
            list.keep(
                "stage",
                "standing water",
                "water presses on the surfaces of bodies",
            );
        }
    },
    make: Some(of),
    planes: false,
};

/// The waters, and what they need of the scene.
struct StandingWaters {
    waters: Vec<StandingWater>,
    /// Axis of gravity, and its acceleration along it \[m/s²\].
    gravity: (usize, f64),
    /// True where forces of mean stresses are mapped by means over cells.
    averaged: bool,
    /// Axes along which the image beyond each boundary plane is odd; `None` for a plane without one.
    images: [[Option<[bool; 3]>; 2]; 3],
}

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    if settings.standing_waters.is_empty() {
        return None;
    }
    let gravity = &settings.gravity;
    let steepest = |a: &usize, b: &usize| gravity[*a].abs().total_cmp(&gravity[*b].abs());
    let along = (0..settings.dimension.axes()).max_by(steepest).unwrap_or(0);
    let planes = settings.water_planes.unwrap_or(settings.mesh.planes);
    let images = std::array::from_fn(|axis| {
        planes[axis].map(|plane| (plane != PlaneCondition::Free).then(|| plane.prescribed(axis)))
    });
    Some(Ok(Arc::new(StandingWaters {
        waters: settings.standing_waters.clone(),
        gravity: (along, gravity[along]),
        averaged: settings.volumetric_strain == VolumetricStrain::CellAverage,
        images,
    })))
}

impl Condition for StandingWaters {
    fn acts_on_water(&self) -> bool {
        true
    }

    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        let [before, after] = nodal.half_steps;
        let pressures = self.at(0.5 * (before + after));
        for (index, body) in view.bodies.iter().enumerate() {
            let on_it: Vec<_> = (pressures.iter())
                .filter(|one| one.bodies.is_empty() || one.bodies.contains(&body.id))
                .collect();
            if on_it.is_empty() || body.motion.is_some() {
                continue;
            }
            let number = view.grid.number_of(index);
            let mut sums = NodeSums::new(&view.grid.shape, &view.grid.fields[number].rows);
            self.press(view, index, &on_it, &mut sums);
            sums.fold(&self.images);
            let forces = sums.forces();
            match nodal.standing.iter_mut().find(|one| one.number == number) {
                Some(field) => merge(&mut field.forces, &forces),
                None => nodal.standing.push(FieldForces { number, forces }),
            }
        }
    }

    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        for_forces(field, |line, force, _| {
            for axis in 0..3 {
                line[4 + axis] += force[axis];
            }
        });
        Ok(())
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        for_forces(field, |line, force, sums| {
            if let Some(sums) = sums {
                sums.power += (0..3).map(|axis| force[axis] * line[1 + axis]).sum::<f64>();
            }
        });
    }
}

/// A water at a time.
struct WaterPressure<'a> {
    bodies: &'a [i64],
    shore: Option<Shore>,
    /// Level \[m\].
    level: f64,
    /// Axis of gravity, and the increase of the pressure along it \[Pa/m\].
    weight: (usize, f64),
}

impl WaterPressure<'_> {
    /// Pressure at a place \[Pa\] and its gradient \[Pa/m\], as means over a piece of half the length `half` \[m\] along each axis:
    /// so the gradients of pieces side by side sum up to the pressure.
    fn at(&self, x: &Vector, half: &Vector) -> (f64, Vector) {
        let (along, slope) = self.weight;
        let (across, half) = (half, half[along]);
        // Of the axis that points down.
        let depth = (self.level - x[along]) * -slope.signum();
        let (mean, wet) = if depth >= half {
            (depth, 1.0)
        } else if depth <= -half {
            (0.0, 0.0)
        } else {
            let wet = 0.5 * (depth + half) / half;
            (wet * wet * half, wet)
        };
        let mut pressure = slope.abs() * mean;
        let mut gradient = [0.0; 3];
        gradient[along] = slope * wet;
        if let Some(shore) = &self.shore {
            let (at, half) = (x[shore.axis], across[shore.axis]);
            let share = shore.share(at);
            let rise = (shore.share(at + half) - shore.share(at - half)) / (2.0 * half);
            gradient = gradient.map(|g| g * share);
            gradient[shore.axis] += pressure * rise;
            pressure *= share;
        }
        (pressure, gradient)
    }
}

impl StandingWaters {
    /// The waters at a time \[s\].
    fn at(&self, time: f64) -> Vec<WaterPressure<'_>> {
        let (along, gravity) = self.gravity;
        let waters = self.waters.iter().map(|water| WaterPressure {
            bodies: &water.bodies,
            shore: water.shore,
            level: value(&water.level, time)[0],
            weight: (along, water.density * gravity),
        });
        waters.collect()
    }

    /// Adds what the waters give a body to the nodes.
    fn press(
        &self,
        view: &StepView<'_>,
        index: usize,
        waters: &[&WaterPressure<'_>],
        sums: &mut NodeSums<'_>,
    ) {
        let (set, body) = (&view.particles[index], &view.bodies[index]);
        let (origin, axes) = (view.origin(), view.grid.shape.axes);
        for p in 0..set.len() {
            let local = set.position(p);
            let x: Vector = std::array::from_fn(|axis| local[axis] + origin[axis]);
            let mut half = [0.0; 3];
            for axis in 0..axes {
                let cells = match body.mapping.family {
                    Family::Hat => OF_POINTS,
                    Family::Gimp => half_length(set, body, axis, p),
                };
                half[axis] = cells * body.mapping.cell[axis];
            }
            let (mut pressure, mut gradient) = (0.0, [0.0; 3]);
            for water in waters {
                let (own, slope) = water.at(&x, &half);
                pressure += own;
                for axis in 0..3 {
                    gradient[axis] += slope[axis];
                }
            }
            if pressure == 0.0 && gradient == [0.0; 3] {
                continue;
            }
            let volume = set.columns[Layout::VOLUME][p];
            let term = (-volume * pressure, gradient.map(|g| -volume * g));
            if view.stencil == 3 {
                sums.add::<3>(set, body, p, &local, term, self.averaged);
            } else {
                sums.add::<4>(set, body, p, &local, term, self.averaged);
            }
        }
    }
}

/// Half-length in cells of the piece that stands for a particle without a domain: that of two to a cell.
const OF_POINTS: f64 = 0.25;

/// Half-length of the domain of a particle along an axis in cells.
fn half_length(set: &ParticleSet, body: &BodyRun, axis: usize, p: usize) -> f64 {
    let own = body.mapping.half_length_column;
    own.map_or(body.mapping.half_length[axis], |column| {
        set.columns[column + axis][p]
    })
}

/// Forces on the nodes of a field that are in use.
struct NodeSums<'a> {
    shape: &'a GridShape,
    rows: &'a ActiveRows,
    /// Place of the first node of each row.
    starts: Vec<usize>,
    forces: Vec<Vector>,
}

impl<'a> NodeSums<'a> {
    fn new(shape: &'a GridShape, rows: &'a ActiveRows) -> Self {
        let mut count = 0;
        let mut starts = vec![0; shape.nodes[0] * shape.nodes[1]];
        for plane in 0..shape.nodes[0] {
            for row in rows.in_plane(plane) {
                starts[plane * shape.nodes[1] + row] = count;
                count += rows.span(plane, row).len();
            }
        }
        Self {
            shape,
            rows,
            starts,
            forces: vec![[0.0; 3]; count],
        }
    }

    /// Place of a node by its storage indices, if it is in use.
    fn place(&self, [plane, row, k]: [usize; 3]) -> Option<usize> {
        let is_there = plane < self.shape.nodes[0] && row < self.shape.nodes[1];
        let span = is_there.then(|| self.rows.span(plane, row))?;
        let start = self.starts[plane * self.shape.nodes[1] + row];
        span.contains(&k).then(|| start + k - span.start)
    }

    /// Adds a number times the derivatives of the weights of a particle, and a vector times the weights.
    fn add<const N: usize>(
        &mut self,
        set: &ParticleSet,
        body: &BodyRun,
        p: usize,
        local: &Vector,
        (scalar, vector): (f64, Vector),
        averaged: bool,
    ) {
        let (shape, mapping) = (self.shape, &body.mapping);
        let mut base = [0; 3];
        // By the direction of storage: weights, derivatives, and weights beside a derivative.
        let mut weights = [[0.0; N]; 3];
        let mut slopes = [[0.0; N]; 3];
        let mut beside = [[0.0; N]; 3];
        weights[1][0] = 1.0;
        beside[1][0] = 1.0;
        for axis in 0..shape.axes {
            let xi = local[axis] * mapping.inverse_cell[axis];
            let l = half_length(set, body, axis, p);
            let (first, w, g) = axis_weights_at::<N>(mapping.family, xi, l);
            let direction = shape.direction(axis);
            base[direction] = (first + GHOSTS_BELOW as f64) as usize;
            weights[direction] = w;
            slopes[direction] = g.map(|g| g * mapping.inverse_cell[axis]);
            beside[direction] = if averaged { means_over_cells(&g) } else { w };
        }
        let middle = if shape.axes == 2 { 1 } else { N };
        for i in 0..N {
            for j in 0..middle {
                for k in 0..N {
                    let Some(place) = self.place([base[0] + i, base[1] + j, base[2] + k]) else {
                        continue;
                    };
                    let at = [i, j, k];
                    let weight: f64 = (0..3).map(|d| weights[d][at[d]]).product();
                    for axis in 0..shape.axes {
                        let own = shape.direction(axis);
                        let factor = |d: usize| {
                            let of = if d == own { &slopes } else { &beside };
                            of[d][at[d]]
                        };
                        let slope: f64 = (0..3).map(factor).product();
                        self.forces[place][axis] += scalar * slope + vector[axis] * weight;
                    }
                }
            }
        }
    }

    /// Gives what lies on the images beyond boundary planes to the nodes that they mirror.
    fn fold(&mut self, images: &[[Option<[bool; 3]>; 2]; 3]) {
        let shape = self.shape;
        for axis in 0..shape.axes {
            for (side, odd) in images[axis].iter().enumerate() {
                let Some(odd) = odd else { continue };
                let direction = shape.direction(axis);
                let plane = GHOSTS_BELOW + side * shape.cells[axis];
                let (ghost, mirror) = if side == 0 {
                    (plane - 1, plane + 1)
                } else {
                    (plane + 1, plane - 1)
                };
                let mut ranges = shape.nodes.map(|count| 0..count);
                ranges[direction] = ghost..ghost + 1;
                let [planes, rows, along] = ranges;
                for plane in planes {
                    for row in rows.clone() {
                        for k in along.clone() {
                            let from = [plane, row, k];
                            let mut to = from;
                            to[direction] = mirror;
                            let (Some(from), Some(to)) = (self.place(from), self.place(to)) else {
                                continue;
                            };
                            let force = std::mem::take(&mut self.forces[from]);
                            for c in 0..3 {
                                self.forces[to][c] += if odd[c] { -force[c] } else { force[c] };
                            }
                        }
                    }
                }
            }
        }
    }

    /// Those that are not zero, in order of the nodes.
    fn forces(&self) -> Vec<NodeForce> {
        let nodes = self.rows.nodes(self.shape).flatten();
        let all = nodes.zip(&self.forces);
        let acting = all.filter(|(_, force)| **force != [0.0; 3]);
        let load = |(node, force): (usize, &Vector)| NodeForce {
            node,
            force: *force,
        };
        acting.map(load).collect()
    }
}

/// Weights of the mean of a linear field over the cells of a domain, as
/// [`cell_mean_weights`](crate::weights::cell_mean_weights) has them in lanes.
fn means_over_cells<const N: usize>(g: &[f64; N]) -> [f64; N] {
    let mut below = 0.0;
    g.map(|g| {
        let above = below - g;
        let mean = 0.5 * (below + above);
        below = above;
        mean
    })
}

/// Adds forces to others, both in order of the nodes.
fn merge(all: &mut Vec<NodeForce>, more: &[NodeForce]) {
    all.extend_from_slice(more);
    all.sort_by_key(|load| load.node);
    all.dedup_by(|later, first| {
        let same = later.node == first.node;
        if same {
            for axis in 0..3 {
                first.force[axis] += later.force[axis];
            }
        }
        same
    });
}

/// Calls `act` for each node of a field with mass on which water presses, with its part of the force \[N\] and the sums of its plane.
fn for_forces(
    field: &mut FieldNodes<'_, '_>,
    mut act: impl FnMut(&mut Line, Vector, Option<&mut PlaneSums>),
) {
    let owner = field.owner();
    // Both phases share the forces of the first field.
    let number = if owner == Owner::Water {
        0
    } else {
        field.number
    };
    let context = field.context;
    let standing = &context.nodal().standing;
    let Some(found) = standing.iter().find(|one| one.number == number) else {
        return;
    };
    let (per_plane, planes) = (field.slab.shape().plane_nodes(), field.slab.range());
    let first = planes.start * per_plane;
    let begin = (found.forces).partition_point(|load| load.node < first);
    let end = (found.forces).partition_point(|load| load.node < planes.end * per_plane);
    for load in &found.forces[begin..end] {
        let n = if number == 0 {
            porosity_at(field.slab, context, load.node)
        } else {
            None
        };
        let share = match (owner, n) {
            (Owner::Water, n) => n.unwrap_or(0.0),
            (_, n) => 1.0 - n.unwrap_or(0.0),
        };
        let (planes, _, sums) = field.parts();
        let [plane, row, k] = planes.shape.indices(load.node);
        let line = &mut planes.nodes[load.node - first];
        if planes.rows.span(plane, row).contains(&k) && line[0] > 0.0 {
            let force = load.force.map(|f| f * share);
            act(line, force, sums.get_mut(plane - planes.range.start));
        }
    }
}
