//! A boundary in motion, and the nodes that its vertices hang on.

use crate::grid::{ActiveRows, GridShape, Line};
use crate::mortar::Point;
use crate::mortar::boundary::Boundary;
use crate::mortar::motion::Follow;
use crate::mortar::weights::VertexWeights;
use crate::scene::History;

/// What moves the vertices of a surface.
#[derive(Clone, Debug)]
pub(super) enum Carrier {
    /// The nodes of a body's layer.
    Body {
        /// Index of the body.
        index: usize,
        follow: Follow,
    },
    /// A prescribed velocity.
    Prescribed(Option<History>),
}

/// A boundary in motion; positions relative to the origin of the mesh.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub(crate) id: i64,
    pub(super) carrier: Carrier,
    pub(crate) boundary: Boundary,
    /// Displacement of the vertices in the last step \[m\].
    pub(crate) moved: Vec<Point>,
    /// Contact force on the vertices in this step \[N\].
    pub(super) force: Vec<Point>,
    /// Augmented weights and masses of the patches, for surfaces of bodies.
    pub(super) patches: Vec<Patch>,
}

/// The nodes that a vertex hangs on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Augmented weights.
    pub(super) weights: VertexWeights,
    /// Masses of the nodes \[kg\].
    pub(super) masses: [f64; 9],
    /// Their indices.
    pub(super) nodes: [usize; 9],
}

/// Indices of the nodes of a patch; none outside the mesh, also for ghosts, which repeat what lies inside.
pub(super) fn nodes_of_patch(base: [i64; 2], shape: &GridShape) -> [Option<usize>; 9] {
    std::array::from_fn(|k| {
        let at = [base[0] + (k / 3) as i64, base[1] + (k % 3) as i64];
        let inside = (0..2).all(|axis| at[axis] >= 0 && at[axis] <= shape.cells[axis] as i64);
        inside.then(|| shape.index(shape.mesh_node([at[0] as usize, at[1] as usize, 0])))
    })
}

/// Mass of a node in use; a node outside the active rows still holds what it had when a particle was near.
pub(super) fn mass_of(node: usize, shape: &GridShape, rows: &ActiveRows, lines: &[Line]) -> f64 {
    let [plane, row, k] = shape.indices(node);
    if rows.span(plane, row).contains(&k) {
        lines[node][0]
    } else {
        0.0
    }
}
