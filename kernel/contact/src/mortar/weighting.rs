//! Weights of the nodes at a vertex of a boundary.

use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::weights::{NODES, VertexWeights};
use proctor_kernel::weights::{Family, base_node, weights_at};

/// Weights of a point of a face: those of the stress behind it, at which a row of particles of that length ends. `parts` are,
/// along each axis, how many particles a domain is long and how far apart their middles are in cells; a domain that is longer
/// than the particle, as that of the B-spline, is as many domains side by side.
///
/// A traction on the face gives a node this weight, as the uniform stress of a body that ends there does: the sum of V grad `S_Ip`
/// over a row of particles is the hat of the node at the end of the row.
#[must_use]
pub fn face_weights<const D: usize, const N: usize>(
    xi: &PointIn<D>,
    parts: &[(usize, f64); D],
) -> VertexWeights<D, N> {
    let base = std::array::from_fn(|axis| base_node(xi[axis], NODES));
    let along = |axis: usize| {
        let (count, apart) = parts[axis];
        let at = xi[axis] - base[axis];
        let hat = |x: f64| (1.0 - x.abs()).max(0.0);
        if count == 1 {
            return std::array::from_fn(|n| hat(at - n as f64));
        }
        let middle = 0.5 * (count as f64 - 1.0);
        let share = 1.0 / count as f64;
        std::array::from_fn(|n| {
            let of = |part: usize| share * hat(at - n as f64 + apart * (part as f64 - middle));
            (0..count).map(of).sum()
        })
    };
    let weights: [[f64; NODES]; D] = std::array::from_fn(along);
    VertexWeights::new(xi, base, &weights)
}

/// Unmodified weights `S_Iv` of a vertex of a boundary at a position in cells of the mesh. `half_length` is that of the
/// domain of the vertex in cells, at most 1/2; any value works, as it makes no difference that could be measured.
#[must_use]
pub fn vertex_weights<const D: usize, const N: usize>(
    family: Family,
    xi: &PointIn<D>,
    half_length: f64,
) -> VertexWeights<D, N> {
    let at = std::array::from_fn(|axis| xi[axis]);
    let (base, w, _) = weights_at::<NODES, D>(family, at, half_length);
    VertexWeights::new(xi, base, &w)
}
