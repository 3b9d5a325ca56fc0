//! Sums of the forces of standing water on the nodes of a field that are in use.

use crate::grid::{ActiveRows, GHOSTS_BELOW, GridShape};
use crate::model::Vector;
use crate::particles::ParticleSet;
use crate::simulation::context::FieldForces;
use crate::simulation::values::BodyRun;
use crate::stage::solve::plane_layers;
use crate::weights::axis_weights_at;
use std::ops::Range;

/// Forces on the nodes of some planes of a field.
pub(super) struct NodeSums<'a> {
    shape: &'a GridShape,
    rows: &'a ActiveRows,
    planes: Range<usize>,
    /// Places of the first nodes of all rows, of all planes.
    starts: &'a [usize],
    /// Place of the first node of these planes.
    first: usize,
    forces: &'a mut [Vector],
    images: &'a Images,
}

/// For each boundary plane the axes along which the image beyond it is odd; `None` for a plane without one.
pub(super) type Images = [[Option<[bool; 3]>; 2]; 3];

impl<'a> NodeSums<'a> {
    /// Those of all planes, which are zero.
    pub(super) fn of(
        shape: &'a GridShape,
        rows: &'a ActiveRows,
        into: &'a mut FieldForces,
        images: &'a Images,
    ) -> Self {
        let FieldForces { starts, forces } = into;
        starts.clear();
        let mut count = 0;
        for plane in 0..shape.nodes[0] {
            for row in 0..shape.nodes[1] {
                starts.push(count);
                count += rows.span(plane, row).len();
            }
        }
        starts.push(count);
        forces.clear();
        forces.resize(count, [0.0; 3]);
        Self {
            shape,
            rows,
            planes: 0..shape.nodes[0],
            starts,
            first: 0,
            forces,
            images,
        }
    }

    /// Those of each slab, which are in order of their planes.
    pub(super) fn of_slabs<'s>(
        &'s mut self,
        slabs: &'s [Range<usize>],
    ) -> impl Iterator<Item = NodeSums<'s>> + Send {
        let Self {
            shape,
            rows,
            starts,
            forces,
            images,
            ..
        } = self;
        let (shape, rows, starts, images) = (*shape, *rows, *starts, *images);
        let start = move |plane: usize| starts[plane * shape.nodes[1]];
        let mut first = slabs.first().map_or(0, |slab| start(slab.start));
        let mut rest = &mut forces[first..];
        slabs.iter().map(move |slab| {
            let count = start(slab.end) - first;
            let own = NodeSums {
                shape,
                rows,
                planes: slab.clone(),
                starts,
                first,
                forces: rest.split_off_mut(..count).unwrap_or_default(),
                images,
            };
            first += count;
            own
        })
    }

    /// Particles of a set that may reach the planes. Each may have left its layer by one cell since the last sort.
    pub(super) fn particles(&self, set: &ParticleSet, stencil: usize) -> Range<usize> {
        set.in_layers(self.planes.start.saturating_sub(stencil)..self.planes.end + 1)
    }

    /// Nodes of a row that are in use, with the place of the first of them; none beside the planes.
    fn row(&self, plane: usize, row: usize) -> (Range<usize>, usize) {
        if !self.planes.contains(&plane) || row >= self.shape.nodes[1] {
            return (0..0, 0);
        }
        let start = self.starts[plane * self.shape.nodes[1] + row];
        (self.rows.span(plane, row), start - self.first)
    }

    /// Place of a node by its storage indices, if it is in use.
    fn place(&self, [plane, row, k]: [usize; 3]) -> Option<usize> {
        let (span, start) = self.row(plane, row);
        span.contains(&k).then(|| start + k - span.start)
    }

    /// Adds a number times the derivatives of the weights of a particle, and a vector times the weights. Beyond a boundary plane the
    /// first goes on as a stress does, whose image is odd along the normal, the second as a weight, whose image is even: with
    /// the sign of the images here [`NodeSums::fold`] gives both to the nodes inside as the mapping gives them stress and mass. A
    /// weight `rho g V` beside a buoyancy that were odd would pull at the node inside with twice what lies on the image.
    pub(super) fn add<const N: usize>(
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
        let signs: [[[f64; 3]; N]; 3] = std::array::from_fn(|direction| {
            std::array::from_fn(|n| self.signs(direction, base[direction] + n))
        });
        let middle = if shape.axes == 2 { 1 } else { N };
        for i in 0..N {
            for j in 0..middle {
                let (span, start) = self.row(base[0] + i, base[1] + j);
                for k in 0..N {
                    let along = base[2] + k;
                    if !span.contains(&along) {
                        continue;
                    }
                    let force = &mut self.forces[start + along - span.start];
                    let at = [i, j, k];
                    let weight: f64 = (0..3).map(|d| weights[d][at[d]]).product();
                    for axis in 0..shape.axes {
                        let own = shape.direction(axis);
                        let factor = |d: usize| {
                            let of = if d == own { &slopes } else { &beside };
                            of[d][at[d]]
                        };
                        let slope: f64 = (0..3).map(factor).product();
                        let sign: f64 = (0..3).map(|d| signs[d][at[d]][axis]).product();
                        force[axis] += scalar * slope + sign * vector[axis] * weight;
                    }
                }
            }
        }
    }

    /// Minus one for the components of which the image is odd where a layer along a direction of storage lies beyond a plane.
    fn signs(&self, direction: usize, layer: usize) -> [f64; 3] {
        let mut signs = [1.0; 3];
        for axis in (0..self.shape.axes).filter(|axis| self.shape.direction(*axis) == direction) {
            for (side, odd) in self.images[axis].iter().enumerate() {
                let (beyond, _, _) = plane_layers(self.shape, axis, side);
                if let (Some(odd), true) = (odd, layer == beyond) {
                    signs = odd.map(|odd| if odd { -1.0 } else { 1.0 });
                }
            }
        }
        signs
    }

    /// Gives what lies on the images beyond boundary planes to the nodes that they mirror.
    pub(super) fn fold(&mut self) {
        let (shape, images) = (self.shape, self.images);
        for axis in 0..shape.axes {
            for (side, odd) in images[axis].iter().enumerate() {
                let Some(odd) = odd else { continue };
                let direction = shape.direction(axis);
                let (ghost, _, mirror) = plane_layers(shape, axis, side);
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
}

/// Half-length of the domain of a particle along an axis in cells.
pub(super) fn half_length(set: &ParticleSet, body: &BodyRun, axis: usize, p: usize) -> f64 {
    let own = body.mapping.half_length_column;
    own.map_or(body.mapping.half_length[axis], |column| {
        set.columns[column + axis][p]
    })
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
