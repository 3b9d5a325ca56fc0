//! Weights of a boundary vertex on the nodes around it.

use super::PointIn;
use std::array;

/// Nodes per axis that a vertex can reach.
pub const NODES: usize = 3;

/// Weight of a face on a row of nodes beyond it up to which [`VertexWeights::as_reached`] goes by their mass, from half of it
/// on less and less.
const LIGHT: f64 = 0.1;

/// Difference of the two up to which it does; a point that is off the body by twice as much is not on a face of its particles.
const NEAR: f64 = 0.01;

/// Weights of a vertex on a patch of three nodes per axis, N = 3^D in all; node (i, j) of a patch of the plane has the
/// place 3 i + j, node (i, j, k) in space 9 i + 3 j + k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexWeights<const D: usize, const N: usize> {
    /// Indices of the lowest node per axis, counted from the origin of the mesh.
    pub base: [i64; D],
    /// Weights. They are those of a particle until [`VertexWeights::augmented`].
    pub weights: [f64; N],
    /// Position of the vertex minus that of the lowest node, in cells.
    pub from_base: PointIn<D>,
}

/// Place of a node in its patch along each axis, 0 to 2; the last axis runs fastest.
///
/// # Panics
/// If there is no such node in a patch in space.
#[must_use]
#[inline]
pub fn in_patch<const D: usize>(node: usize) -> [usize; D] {
    Places::<D>::OF_NODES[node]
}

struct Places<const D: usize>;

impl<const D: usize> Places<D> {
    /// Computed once: it is asked for by each weight of each vertex.
    const OF_NODES: [[usize; D]; 27] = {
        let mut places = [[0; D]; 27];
        let mut node = 0;
        while node < 27 {
            let (mut axis, mut rest) = (D, node);
            while axis > 0 {
                axis -= 1;
                places[node][axis] = rest % NODES;
                rest /= NODES;
            }
            node += 1;
        }
        places
    };
}

/// A vertex that no node with mass is near: nothing can move it or take its force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostVertex;

impl<const D: usize, const N: usize> VertexWeights<D, N> {
    /// Weights of no vertex: all zero.
    pub const NOWHERE: Self = Self {
        base: [0; D],
        weights: [0.0; N],
        from_base: PointIn::<D>::from_array_storage(nalgebra::ArrayStorage([[0.0; D]; 1])),
    };

    /// Weights at a position in cells of the mesh, from those along each axis, whose lowest nodes are `base`.
    #[must_use]
    pub fn new(xi: &PointIn<D>, base: [f64; D], w: &[[f64; NODES]; D]) -> Self {
        Self {
            base: base.map(|b| b as i64),
            weights: array::from_fn(|k| {
                let at = in_patch::<D>(k);
                (1..D).fold(w[0][at[0]], |product, axis| product * w[axis][at[axis]])
            }),
            from_base: PointIn::from_fn(|axis, _| xi[axis] - base[axis]),
        }
    }

    /// Position of the vertex minus that of a node of the patch, in cells.
    #[must_use]
    pub fn offset(&self, node: usize) -> PointIn<D> {
        let place = in_patch::<D>(node);
        PointIn::from_fn(|axis, _| self.from_base[axis] - place[axis] as f64)
    }

    /// Gives the shares of the first (0) or last (2) nodes along an axis to their mirror images on the other side of the
    /// node between, which lies on a plane of symmetry. Exact for a vertex on the plane; that of another one, which must
    /// be nearer to the plane than its half-length, takes its share of the normal velocity with the wrong sign.
    #[must_use]
    pub fn folded(mut self, axis: usize, outside: usize) -> Self {
        let stride = NODES.pow((D - 1 - axis) as u32);
        for k in 0..N {
            if in_patch::<D>(k)[axis] == outside {
                let mirror = k + stride * (NODES - 1 - outside) - stride * outside;
                self.weights[mirror] += self.weights[k];
                self.weights[k] = 0.0;
            }
        }
        self
    }

    /// Augmented weights (eq. 27), S_Iv m_I / sum_J S_Jv m_J: no share for nodes without mass, and still a partition
    /// of unity. `masses` are those of the nodes of the patch in this body's layer of the grid \[kg\], with that of its
    /// image where a plane mirrors the body.
    ///
    /// # Errors
    /// [`LostVertex`] where none of the nodes with a weight has mass.
    pub fn augmented(&self, masses: &[f64; N]) -> Result<Self, LostVertex> {
        let weighted: [f64; N] = array::from_fn(|k| self.weights[k] * masses[k]);
        let sum: f64 = weighted.iter().sum();
        if sum.is_nan() || sum <= 0.0 {
            return Err(LostVertex);
        }
        Ok(Self {
            weights: weighted.map(|w| w / sum),
            ..*self
        })
    }

    /// The same weights, of a point of a face, with those of the light nodes beyond it as the mass says how far the body reaches
    /// there. A body that ends d beyond a node along an axis gives a row of nodes the mass `full` d²/2, with the mass of a full
    /// cell times the number of particles that a domain is long [`full`, kg], and its stress the weight d over that number. A
    /// point that is off that end by much less than a cell has not that weight where d is as small.
    #[must_use]
    pub fn as_reached(&self, masses: &[f64; N], full: &[f64; D]) -> Self {
        let mut all = *self;
        for axis in 0..D {
            let stride = NODES.pow((D - 1 - axis) as u32);
            for end in [0, NODES - 1] {
                let (mut along, mut mass) = (0.0, 0.0);
                for k in (0..N).filter(|k| in_patch::<D>(*k)[axis] == 0) {
                    let row: [f64; NODES] = array::from_fn(|n| all.weights[k + n * stride]);
                    along += row[end];
                    mass += row.iter().sum::<f64>() * masses[k + end * stride];
                }
                let reached = (2.0 * mass / full[axis]).sqrt();
                if along >= LIGHT || reached >= LIGHT || along == reached {
                    continue;
                }
                // From the one to the other without a jump.
                let light = (2.0 * (1.0 - reached / LIGHT)).min(1.0);
                let near = (2.0 - (reached - along).abs() / NEAR).clamp(0.0, 1.0);
                let more = light * near * (reached - along);
                if more == 0.0 {
                    continue;
                }
                for k in (0..N).filter(|k| in_patch::<D>(*k)[axis] == 0) {
                    let of_row: f64 = (0..NODES).map(|n| all.weights[k + n * stride]).sum();
                    all.weights[k + end * stride] += more * of_row;
                    all.weights[k + stride] -= more * of_row;
                }
            }
        }
        all
    }

    /// The same weights where the nodes bear them: a node bears a weight w where w² is at most `bears` times its mass \[1/kg\].
    /// The rest goes to the nodes by the weights of `others`, whose sum is one.
    #[must_use]
    pub fn borne(&self, masses: &[f64; N], bears: f64, others: &Self) -> Self {
        let (mut kept, mut rest) = (*self, 0.0);
        for k in 0..N {
            let (w, most) = (self.weights[k], bears * masses[k]);
            if w * w > most {
                kept.weights[k] = most.max(0.0).sqrt();
                rest += w - kept.weights[k];
            }
        }
        if rest > 0.0 {
            for k in 0..N {
                kept.weights[k] += rest * others.weights[k];
            }
        }
        kept
    }

    /// Distance of the vertex from the mean place of the nodes by these weights, in cells, where those of `exact` reproduce
    /// affine fields; exactly zero where no weight differs from those.
    #[must_use]
    pub fn distance(&self, exact: &Self) -> PointIn<D> {
        let mut off = PointIn::zeros();
        for k in 0..N {
            let more = self.weights[k] - exact.weights[k];
            if more != 0.0 {
                off += more * self.offset(k);
            }
        }
        off
    }

    /// The weights of a particle on nodes with mass alone, for comparison: what empty nodes take is lost, and a vertex
    /// that has left all mass behind has none.
    #[must_use]
    pub fn on_mass(&self, masses: &[f64; N]) -> Self {
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
