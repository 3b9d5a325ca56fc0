//! Velocity gradients at the nodes that vertices hang on (eq. 28).

use super::surface::Patch;
use crate::grid::{GHOSTS_BELOW, GridShape, Line};
use crate::mortar::Point;
use crate::mortar::motion::NodalGradient;
use crate::particles::{Layout, ParticleSet};
use crate::simulation::BodyRun;
use crate::weights::{axis_weights_at, base_offset};
use nalgebra::Matrix2;

/// Velocity gradients at the nodes that the vertices need (eq. 28).
pub(super) struct NodalGradients {
    /// Place of each node of the grid in `sums`, plus one; zero for nodes that no vertex needs.
    slots: Vec<u32>,
    sums: Vec<NodalGradient>,
}

impl NodalGradients {
    pub(super) fn at(&self, node: usize) -> Matrix2<f64> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.sums[slot as usize - 1].mean(),
            _ => Matrix2::zeros(),
        }
    }

    /// None, for vertices that follow velocities alone.
    pub(super) fn none() -> Self {
        Self {
            slots: vec![],
            sums: vec![],
        }
    }

    /// Sums over the particles that reach a node of a patch; they are found by their base, without their weights.
    pub(super) fn new(
        patches: &[Patch],
        set: &ParticleSet,
        body: &BodyRun,
        shape: &GridShape,
        lines: &[Line],
        stencil: usize,
    ) -> Self {
        let mut slots = vec![0_u32; lines.len()];
        let mut sums = vec![];
        let bases = shape.bases();
        let mut near = vec![false; bases[0] * bases[2]];
        for patch in patches {
            for k in 0..9 {
                let node = patch.nodes[k];
                if patch.weights.weights[k] > 0.0 && slots[node] == 0 {
                    sums.push(NodalGradient::default());
                    slots[node] = sums.len() as u32;
                    let [i, _, j] = shape.indices(node);
                    for a in i.saturating_sub(stencil - 1)..=i.min(bases[0] - 1) {
                        for b in j.saturating_sub(stencil - 1)..=j.min(bases[2] - 1) {
                            near[a * bases[2] + b] = true;
                        }
                    }
                }
            }
        }
        let mapping = &body.mapping;
        let offset = base_offset(stencil);
        for p in 0..set.len() {
            let xi = [0, 1]
                .map(|axis| set.columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis]);
            let base = xi.map(|xi| ((xi - offset).floor() + GHOSTS_BELOW as f64) as usize);
            if !near[base[0] * bases[2] + base[1]] {
                continue;
            }
            let axes = [0, 1].map(|axis| {
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
            let [(w_x, g_x), (w_y, g_y)] = axes;
            let first = |a: usize| (base[0] + a) * shape.nodes[2] + base[1];
            let mut gradient = Matrix2::zeros();
            for a in 0..stencil {
                for (b, line) in lines[first(a)..][..stencil].iter().enumerate() {
                    let slope = Point::new(
                        g_x[a] * w_y[b] * mapping.inverse_cell[0],
                        w_x[a] * g_y[b] * mapping.inverse_cell[1],
                    );
                    gradient += Point::new(line[1], line[2]) * slope.transpose();
                }
            }
            let mass = set.columns[Layout::MASS][p];
            for a in 0..stencil {
                for (b, &slot) in slots[first(a)..][..stencil].iter().enumerate() {
                    if slot > 0 {
                        sums[slot as usize - 1].add(w_x[a] * w_y[b], mass, &gradient);
                    }
                }
            }
        }
        Self { slots, sums }
    }
}
