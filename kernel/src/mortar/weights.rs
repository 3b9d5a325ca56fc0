//! Weights of a boundary vertex on the nodes around it.

use super::Point;
use crate::weights::{Family, axis_weights_at};
use std::array;

/// Nodes per axis that a vertex can reach.
const NODES: usize = 3;

/// Weights of a vertex on a patch of 3 x 3 nodes; node (i, j) of the patch has the place 3 i + j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexWeights {
    /// Indices of the lowest node per axis, counted from the origin of the mesh.
    pub base: [i64; 2],
    /// Weights. They are those of a particle until [`VertexWeights::augmented`].
    pub weights: [f64; 9],
    /// Position of the vertex minus that of the node, in cells.
    pub offsets: [Point; 9],
}

/// A vertex that no node with mass is near: nothing can move it or take its force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lost;

impl VertexWeights {
    /// Unmodified weights S_Iv at a position in cells of the mesh. `half_length` is that of the domain of the vertex in
    /// cells, at most 1/2; any value works, as it makes no difference that could be measured.
    #[must_use]
    pub fn new(family: Family, xi: &Point, half_length: f64) -> Self {
        let (base_x, w_x, _) = axis_weights_at::<NODES>(family, xi.x, half_length);
        let (base_y, w_y, _) = axis_weights_at::<NODES>(family, xi.y, half_length);
        Self {
            base: [base_x as i64, base_y as i64],
            weights: array::from_fn(|k| w_x[k / NODES] * w_y[k % NODES]),
            offsets: array::from_fn(|k| {
                Point::new(
                    xi.x - base_x - (k / NODES) as f64,
                    xi.y - base_y - (k % NODES) as f64,
                )
            }),
        }
    }

    /// Augmented weights (eq. 27), S_Iv m_I / sum_J S_Jv m_J: no share for nodes without mass, and still a partition
    /// of unity. `masses` are those of the nodes of the patch in this body's layer of the grid \[kg\].
    ///
    /// # Errors
    /// [`Lost`] where none of the nodes with a weight has mass.
    pub fn augmented(&self, masses: &[f64; 9]) -> Result<Self, Lost> {
        let weighted: [f64; 9] = array::from_fn(|k| self.weights[k] * masses[k]);
        let sum: f64 = weighted.iter().sum();
        if sum.is_nan() || sum <= 0.0 {
            return Err(Lost);
        }
        Ok(Self {
            weights: weighted.map(|w| w / sum),
            ..*self
        })
    }

    /// The weights of a particle on nodes with mass alone, for comparison: what empty nodes take is lost, and a vertex
    /// that has left all mass behind has none.
    #[must_use]
    pub fn on_mass(&self, masses: &[f64; 9]) -> Self {
        let kept = |k: usize| {
            if masses[k] > 0.0 {
                self.weights[k]
            } else {
                0.0
            }
        };
        Self {
            weights: array::from_fn(kept),
            ..*self
        }
    }
}
