//! Velocity gradients at the nodes that vertices hang on (eq. 28).

use super::surface::{Patch, velocity_at};
use crate::grid::{GHOSTS_BELOW, GridShape, Line};
use crate::mortar::PointIn;
use crate::mortar::motion::NodalGradient;
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::simulation::BodyRun;
use crate::team::Team;
use crate::weights::{axis_weights_at, base_offset};
use nalgebra::SMatrix;
use std::array;

/// Velocity gradients at the nodes that the vertices need (eq. 28).
pub(super) struct NodalGradients<const D: usize> {
    /// Place of each node of the grid in `sums`, plus one; zero for nodes that no vertex needs.
    slots: Vec<u32>,
    sums: Vec<NodalGradient<D>>,
}

impl<const D: usize> NodalGradients<D> {
    pub(super) fn at(&self, node: usize) -> SMatrix<f64, D, D> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.sums[slot as usize - 1].mean(),
            _ => SMatrix::zeros(),
        }
    }

    /// Sums over the particles that reach a node of a patch; they are found by their base, without their weights.
    pub(super) fn new<const N: usize>(
        patches: &[Patch<D, N>],
        set: &ParticleSet,
        body: &BodyRun,
        shape: &GridShape,
        lines: &[Line],
        stencil: usize,
        team: &Team,
    ) -> Self {
        let mut slots = vec![0_u32; lines.len()];
        let mut sums: Vec<NodalGradient<D>> = vec![];
        let bases = shape.bases();
        let place = |at: [usize; 3]| (at[0] * bases[1] + at[1]) * bases[2] + at[2];
        let mut near = vec![false; bases.iter().product()];
        for patch in patches {
            for k in 0..N {
                let node = patch.nodes[k];
                if patch.weights.weights[k] > 0.0 && slots[node] == 0 {
                    sums.push(NodalGradient::default());
                    slots[node] = sums.len() as u32;
                    let at = shape.indices(node);
                    let [i, j, k] = array::from_fn(|direction| {
                        at[direction].saturating_sub(stencil - 1)
                            ..=at[direction].min(bases[direction] - 1)
                    });
                    for i in i {
                        for j in j.clone() {
                            for k in k.clone() {
                                near[place([i, j, k])] = true;
                            }
                        }
                    }
                }
            }
        }
        let mapping = &body.mapping;
        let offset = base_offset(stencil);
        // Storage indices of the nodes of a stencil from its base, the last axis fastest.
        let reached: Vec<[usize; D]> = (0..stencil.pow(D as u32))
            .map(|k| array::from_fn(|axis| k / stencil.pow((D - 1 - axis) as u32) % stencil))
            .collect();
        let scaled = |p: usize| -> [f64; D] {
            array::from_fn(|axis| {
                set.columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis]
            })
        };
        let base_of = |xi: &[f64; D]| {
            let mut base = [0; 3];
            for axis in 0..D {
                base[shape.direction(axis)] =
                    ((xi[axis] - offset).floor() + GHOSTS_BELOW as f64) as usize;
            }
            base
        };
        let is_near: Vec<bool> = team.collect(0..set.len(), |p| near[place(base_of(&scaled(p)))]);
        let particles: Vec<usize> = (0..set.len()).filter(|&p| is_near[p]).collect();
        let gradient_of = |p: usize| {
            let xi = scaled(p);
            let base = base_of(&xi);
            let axes: [([f64; 4], [f64; 4]); D] = array::from_fn(|axis| {
                let l = mapping
                    .half_length_column
                    .map_or(mapping.half_length[axis], |c| set.columns[c + axis][p]);
                if stencil == 3 {
                    let (_, w, g) = axis_weights_at::<3>(mapping.family, xi[axis], l);
                    ([w[0], w[1], w[2], 0.0], [g[0], g[1], g[2], 0.0])
                } else {
                    let (_, w, g) = axis_weights_at::<4>(mapping.family, xi[axis], l);
                    (w, g)
                }
            });
            let node = |at: &[usize; D]| {
                let mut storage = base;
                for axis in 0..D {
                    storage[shape.direction(axis)] += at[axis];
                }
                shape.index(storage)
            };
            let weight = |at: &[usize; D]| {
                (1..D).fold(axes[0].0[at[0]], |w, axis| w * axes[axis].0[at[axis]])
            };
            let mut gradient = SMatrix::zeros();
            for at in &reached {
                let slope = PointIn::<D>::from_fn(|direction, _| {
                    let of = |axis: usize| {
                        let (w, g) = &axes[axis];
                        if axis == direction {
                            g[at[axis]]
                        } else {
                            w[at[axis]]
                        }
                    };
                    (1..D).fold(of(0), |product, axis| product * of(axis))
                        * mapping.inverse_cell[direction]
                });
                gradient += velocity_at(&lines[node(at)]) * slope.transpose();
            }
            let of_nodes = reached.iter().map(|at| (node(at), weight(at)));
            let wanted = of_nodes.filter(|(node, _)| slots[*node] > 0);
            (gradient, wanted.collect::<Vec<(usize, f64)>>())
        };
        // Each particle by whatever thread; the sums by one, in the order of the particles.
        let found = team.search(0..particles.len(), |i| gradient_of(particles[i]));
        for (p, (gradient, nodes)) in particles.into_iter().zip(found) {
            let mass = set.columns[Layout::MASS][p];
            for (node, weight) in nodes {
                sums[slots[node] as usize - 1].add(weight, mass, &gradient);
            }
        }
        Self { slots, sums }
    }
}
