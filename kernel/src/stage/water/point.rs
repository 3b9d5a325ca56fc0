//! The nodes of one particle with their weights and derivatives.

use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::layout::Layout;
use crate::model::Vector;
use crate::stage::Mapping;
use crate::weights::{axis_weights_at, base_node};

/// The nodes of one particle: products of weights along the axes, which lie along slow, middle and fast direction.
pub(crate) struct PointNodes {
    /// Storage indices of the first.
    pub base: [usize; 3],
    /// Number per direction.
    pub count: [usize; 3],
    weights: [[f64; 4]; 3],
    /// Derivatives \[1/m\].
    derivatives: [[f64; 4]; 3],
    /// Direction of each axis.
    direction: [usize; 3],
    axes: usize,
}

impl PointNodes {
    /// Nodes of particle `p` of some columns.
    #[must_use]
    pub(crate) fn of<C: AsRef<[f64]>>(
        columns: &[C],
        mapping: &Mapping,
        (shape, stencil): (&GridShape, usize),
        p: usize,
    ) -> Self {
        let axes = shape.axes;
        let mut nodes = Self {
            base: [0; 3],
            count: [1; 3],
            weights: [[1.0, 0.0, 0.0, 0.0]; 3],
            derivatives: [[0.0; 4]; 3],
            direction: [0; 3],
            axes,
        };
        for axis in 0..axes {
            let direction = shape.direction(axis);
            let xi = columns[Layout::POSITION + axis].as_ref()[p] * mapping.inverse_cell[axis];
            let l = (mapping.half_length_column).map_or(mapping.half_length[axis], |column| {
                columns[column + axis].as_ref()[p]
            });
            let (weights, derivatives) = if stencil == 3 {
                let (_, [a, b, c], [d, e, f]) = axis_weights_at::<3>(mapping.family, xi, l);
                ([a, b, c, 0.0], [d, e, f, 0.0])
            } else {
                let (_, weights, derivatives) = axis_weights_at::<4>(mapping.family, xi, l);
                (weights, derivatives)
            };
            nodes.base[direction] = (base_node(xi, stencil) + GHOSTS_BELOW as f64) as usize;
            nodes.count[direction] = stencil;
            nodes.weights[direction] = weights;
            nodes.derivatives[direction] = derivatives.map(|g| g * mapping.inverse_cell[axis]);
            nodes.direction[axis] = direction;
        }
        nodes
    }

    /// Weight of a node, by its place in the stencil, and its gradient \[1/m\].
    #[must_use]
    pub(crate) fn at(&self, [i, j, k]: [usize; 3]) -> (f64, Vector) {
        let w = [self.weights[0][i], self.weights[1][j], self.weights[2][k]];
        let g = [
            self.derivatives[0][i],
            self.derivatives[1][j],
            self.derivatives[2][k],
        ];
        let mut gradient = [0.0; 3];
        for axis in 0..self.axes {
            gradient[axis] = match self.direction[axis] {
                0 => g[0] * w[1] * w[2],
                1 => w[0] * g[1] * w[2],
                _ => w[0] * w[1] * g[2],
            };
        }
        (w[0] * w[1] * w[2], gradient)
    }
}
