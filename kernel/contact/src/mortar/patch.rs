//! Patches of nodes that vertices hang on, and vectors of D dimensions.

use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::weights::{NODES, VertexWeights, in_patch};
use proctor_kernel::grid::{ActiveRows, GridShape, Line};
use proctor_kernel::model::{History, Vector};
use proctor_kernel::simulation::history_value;

/// The nodes that a vertex hangs on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch<const D: usize, const N: usize> {
    /// Augmented weights; of a vertex that contact presses on those of the face, where the nodes bear them.
    pub(super) weights: VertexWeights<D, N>,
    /// Distance, with weights of the face, from the mean place of the nodes by them to the vertex \[m\]; zero where all nodes
    /// bear them.
    pub(super) off: Option<PointIn<D>>,
    /// Masses of the nodes \[kg\].
    pub(super) masses: [f64; N],
    /// Their indices.
    pub(super) nodes: [usize; N],
}

impl<const D: usize, const N: usize> Patch<D, N> {
    /// Patch of no vertex.
    pub(super) const NOWHERE: Self = Self {
        weights: VertexWeights::NOWHERE,
        off: None,
        masses: [0.0; N],
        nodes: [0; N],
    };

    /// Velocity of the vertex by its weights \[m/s\].
    #[inline]
    pub(super) fn velocity(&self, lines: &[Line]) -> PointIn<D> {
        let mut v = PointIn::zeros();
        for k in 0..N {
            let w = self.weights.weights[k];
            if w != 0.0 {
                v += w * velocity_at(&lines[self.nodes[k]]);
            }
        }
        v
    }

    /// Nodes through which the vertex feels how the body turns and stretches, each with the distance that it counts for times its
    /// share \[m\]. By augmented weights each node carries to the vertex; by those of a face the vertex has a distance from the
    /// mean place of the nodes, which they share by their mass.
    pub(super) fn carried(&self, cell: &PointIn<D>) -> impl Iterator<Item = (usize, PointIn<D>)> {
        let weights = &self.weights.weights;
        let mass: f64 = match self.off {
            Some(off) if off != PointIn::<D>::zeros() => {
                weights.iter().zip(self.masses).map(|(w, m)| w * m).sum()
            }
            _ => 0.0,
        };
        let of = move |k: usize| match self.off {
            None => weights[k] * self.weights.offset(k).component_mul(cell),
            Some(off) => weights[k] * self.masses[k] / mass * off,
        };
        let none = self.off.is_some() && mass <= 0.0;
        let nodes = if none { 0..0 } else { 0..N };
        let nodes = nodes.filter(|&k| weights[k] > 0.0);
        nodes.map(move |k| (self.nodes[k], of(k)))
    }
}

/// Finds indices and masses of the nodes of a patch. A node outside the mesh has none, also a ghost, which repeats what lies
/// inside, nor has one outside the active rows, which still holds what it had when a particle was near.
pub(super) fn nodes_of_patch<const D: usize, const N: usize>(
    base: [i64; D],
    shape: &GridShape,
    rows: &ActiveRows,
    lines: &[Line],
    Patch { nodes, masses, .. }: &mut Patch<D, N>,
) {
    (*nodes, *masses) = ([0; N], [0.0; N]);
    let is_inside = |axis: usize, node: i64| (0..=shape.cells[axis] as i64).contains(&node);
    // Nodes along the last axis follow one another in the grid.
    let last = D - 1;
    let below = base[last].min(0).unsigned_abs() as usize;
    let beyond = (shape.cells[last] as i64 + 1 - base[last]).clamp(0, NODES as i64) as usize;
    for first in (0..N).step_by(NODES) {
        let place = in_patch::<D>(first);
        let mut at = [0; 3];
        let mut inside = true;
        for axis in 0..last {
            let node = base[axis] + place[axis] as i64;
            inside &= is_inside(axis, node);
            at[axis] = node.max(0) as usize;
        }
        if !inside {
            continue;
        }
        at[last] = base[last].max(0) as usize;
        let [plane, row, fast] = shape.mesh_node(at);
        let index = shape.index([plane, row, fast]);
        let span = rows.span(plane, row);
        for n in below..beyond {
            let after = n - below;
            nodes[first + n] = index + after;
            if span.contains(&(fast + after)) {
                masses[first + n] = lines[index + after][0];
            }
        }
    }
}

/// Velocity of a node \[m/s\].
pub(super) fn velocity_at<const D: usize>(line: &Line) -> PointIn<D> {
    PointIn::from_fn(|axis, _| line[1 + axis])
}

/// Force on a node \[N\].
pub(super) fn force_at<const D: usize>(line: &Line) -> PointIn<D> {
    PointIn::from_fn(|axis, _| line[4 + axis])
}

/// Prescribed velocity at a time; zero without one \[m/s\].
pub(super) fn velocity_of<const D: usize>(motion: Option<&History>, time: f64) -> PointIn<D> {
    from_vector(&motion.map_or([0.0; 3], |m| history_value(m, time)))
}

/// The components of a vector that there are in D dimensions.
pub(super) fn from_vector<const D: usize>(v: &Vector) -> PointIn<D> {
    PointIn::from_fn(|axis, _| v[axis])
}

/// A vector with three components, the third zero in the plane.
pub(super) fn to_vector<const D: usize>(x: &PointIn<D>) -> Vector {
    std::array::from_fn(|axis| x.get(axis).copied().unwrap_or(0.0))
}

/// A point relative to the origin of the mesh in the coordinates of the scene \[m\].
pub(super) fn in_scene<const D: usize>(x: &PointIn<D>, origin: &Vector) -> Vector {
    let x = to_vector(x);
    std::array::from_fn(|axis| {
        if axis < D {
            x[axis] + origin[axis]
        } else {
            0.0
        }
    })
}
