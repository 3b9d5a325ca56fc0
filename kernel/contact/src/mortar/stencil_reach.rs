//! The nodes that a particle near a boundary reaches.

use super::mirrors::Mirrors;
use crate::geometry::mortar::PointIn;
use proctor_kernel::grid::{GHOSTS_BELOW, GridShape};
use proctor_kernel::lanes::{Backend, Kernel, Lanes, Quad};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::stage::Mapping;
use proctor_kernel::weights::{axis_weights, axis_weights_at, base_node, base_offset};
use std::array;
use std::ops::Range;

/// A node of the stencil of a particle.
#[derive(Clone, Copy, Debug)]
pub(super) struct StencilNode<const D: usize> {
    /// Place along each axis, counted from the base.
    at: [usize; D],
    /// Index in the grid less that of the base.
    offset: usize,
}

/// Nodes of a stencil with so many nodes per axis, the last axis fastest.
pub(super) fn stencil_nodes<const D: usize>(
    stencil: usize,
    shape: &GridShape,
) -> Vec<StencilNode<D>> {
    let node = |k: usize| {
        let at: [usize; D] =
            array::from_fn(|axis| k / stencil.pow((D - 1 - axis) as u32) % stencil);
        let mut storage = [0; 3];
        for axis in 0..D {
            storage[shape.direction(axis)] = at[axis];
        }
        let offset = shape.index(storage);
        StencilNode { at, offset }
    };
    (0..stencil.pow(D as u32)).map(node).collect()
}

/// The first node of each row of a stencil along the last axis, whose nodes follow one another in the grid.
pub(super) fn stencil_rows<const D: usize>(
    stencil: usize,
    shape: &GridShape,
) -> Vec<StencilNode<D>> {
    let nodes = stencil_nodes(stencil, shape);
    nodes.into_iter().step_by(stencil).collect()
}

/// Position of a particle in cells of the mesh.
#[inline]
pub(super) fn scaled<const D: usize>(set: &ParticleSet, p: usize, mapping: &Mapping) -> [f64; D] {
    array::from_fn(|axis| set.columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis])
}

/// Storage indices of the base of a particle at a place in cells.
#[inline]
pub(super) fn base_of<const D: usize>(
    xi: &[f64; D],
    stencil: usize,
    shape: &GridShape,
) -> [usize; 3] {
    let mut base = [0; 3];
    for axis in 0..D {
        base[shape.direction(axis)] = (base_node(xi[axis], stencil) + GHOSTS_BELOW as f64) as usize;
    }
    base
}

/// True if a particle with that base reaches a ghost, where bases that do not are `inner`.
#[inline(always)]
fn is_mirrored(base: [usize; 3], inner: &[Range<usize>; 3]) -> bool {
    !(0..3).all(|direction| inner[direction].contains(&base[direction]))
}

/// Weights of a particle on the nodes of its stencil.
#[derive(Clone, Debug)]
pub(super) struct StencilReach<const D: usize> {
    /// Index of its base in the grid.
    base: usize,
    /// True if it reaches a ghost, so that it has an image.
    pub(super) mirrored: bool,
    /// Weights along each axis, and their slopes \[1/m\].
    axes: [([f64; 4], [f64; 4]); D],
}

impl<const D: usize> StencilReach<D> {
    /// Reach of a particle of a set where it is now.
    pub(super) fn of(
        (set, p): (&ParticleSet, usize),
        mapping: &Mapping,
        shape: &GridShape,
        mirrors: &Mirrors,
        stencil: usize,
    ) -> Self {
        let xi = scaled::<D>(set, p, mapping);
        let base = base_of(&xi, stencil, shape);
        Self {
            base: shape.index(base),
            mirrored: is_mirrored(base, &mirrors.inner(shape, stencil)),
            axes: array::from_fn(|axis| {
                let l = mapping
                    .half_length_column
                    .map_or(mapping.half_length[axis], |c| set.columns[c + axis][p]);
                let (w, g) = if stencil == 3 {
                    let (_, w, g) = axis_weights_at::<3>(mapping.family, xi[axis], l);
                    ([w[0], w[1], w[2], 0.0], [g[0], g[1], g[2], 0.0])
                } else {
                    let (_, w, g) = axis_weights_at::<4>(mapping.family, xi[axis], l);
                    (w, g)
                };
                (w, g.map(|g| g * mapping.inverse_cell[axis]))
            }),
        }
    }

    /// Reach of no particle, for [`StencilReaches`] to write over.
    pub(super) const NOWHERE: Self = Self {
        base: 0,
        mirrored: false,
        axes: [([0.0; 4], [0.0; 4]); D],
    };

    /// Index of its base in the grid.
    #[inline(always)]
    pub(super) fn base(&self) -> usize {
        self.base
    }

    /// Weights and slopes along the last axis, of the nodes of a row.
    #[inline(always)]
    pub(super) fn along_row(&self) -> &([f64; 4], [f64; 4]) {
        &self.axes[D - 1]
    }

    /// Factors on the weights of a row for the weight, and for the slope along each axis but the last.
    #[inline(always)]
    pub(super) fn across_row(&self, StencilNode { at, .. }: &StencilNode<D>) -> (f64, [f64; D]) {
        let (w, g) = &self.axes[0];
        let mut weight = w[at[0]];
        let mut slopes = [weight; D];
        slopes[0] = g[at[0]];
        for axis in 1..D - 1 {
            let (w, g) = &self.axes[axis];
            for (along, slope) in slopes.iter_mut().enumerate() {
                *slope *= if along == axis {
                    g[at[axis]]
                } else {
                    w[at[axis]]
                };
            }
            weight *= w[at[axis]];
        }
        (weight, slopes)
    }

    /// Index of a node of the stencil in the grid, ghost or not.
    #[inline(always)]
    pub(super) fn node(&self, node: &StencilNode<D>) -> usize {
        self.base + node.offset
    }

    /// The node that has its velocity, with -1 for each axis along which it is its mirror image.
    #[inline]
    pub(super) fn inside(
        &self,
        node: &StencilNode<D>,
        shape: &GridShape,
        mirrors: &Mirrors,
    ) -> (usize, PointIn<D>) {
        let node = self.node(node);
        if !self.mirrored {
            return (node, PointIn::repeat(1.0));
        }
        let (at, sides) = mirrors.inside(shape, shape.indices(node));
        (shape.index(at), sides)
    }

    /// -1 along axes in which a node of the stencil has the velocity of the node inside the other way round.
    #[inline]
    pub(super) fn prescribed(
        &self,
        node: &StencilNode<D>,
        shape: &GridShape,
        mirrors: &Mirrors,
    ) -> PointIn<D> {
        if self.mirrored {
            mirrors.prescribed(shape, shape.indices(self.node(node)))
        } else {
            PointIn::repeat(1.0)
        }
    }

    /// Weight on a node of the stencil.
    #[inline]
    pub(super) fn weight(&self, StencilNode { at, .. }: &StencilNode<D>) -> f64 {
        (1..D).fold(self.axes[0].0[at[0]], |w, axis| {
            w * self.axes[axis].0[at[axis]]
        })
    }

    /// Its gradient \[1/m\].
    #[inline]
    pub(super) fn slope(&self, StencilNode { at, .. }: &StencilNode<D>) -> PointIn<D> {
        PointIn::from_fn(|direction, _| {
            let of = |axis: usize| {
                let (w, g) = &self.axes[axis];
                if axis == direction {
                    g[at[axis]]
                } else {
                    w[at[axis]]
                }
            };
            (1..D).fold(of(0), |product, axis| product * of(axis))
        })
    }
}

/// Weights of particles on the nodes of their stencils, found for eight of them at once.
pub(super) struct StencilReaches<'a, const D: usize> {
    /// The particles of a set.
    pub(super) particles: &'a [usize],
    /// Particles that it belongs to.
    pub(super) set: &'a ParticleSet,
    /// Their view of the grid.
    pub(super) mapping: &'a Mapping,
    /// The grid, and what lies beyond it.
    pub(super) shape: &'a GridShape,
    pub(super) mirrors: &'a Mirrors,
    /// Nodes per axis of the stencil.
    pub(super) stencil: usize,
    /// One for each particle, to be written.
    pub(super) found: &'a mut [StencilReach<D>],
}

impl<const D: usize> Kernel for StencilReaches<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        if self.stencil == 3 {
            self.write::<B, 3>();
        } else {
            self.write::<B, 4>();
        }
    }
}

impl<const D: usize> StencilReaches<'_, D> {
    #[inline(always)]
    fn write<B: Backend, const N: usize>(self) {
        let Self {
            particles,
            set,
            mapping,
            shape,
            mirrors,
            stencil,
            found,
        } = self;
        let inner = mirrors.inner(shape, stencil);
        let eights = particles.chunks(B::Line::WIDTH);
        for (particles, reaches) in eights.zip(found.chunks_mut(B::Line::WIDTH)) {
            let mut bases = [[0; 3]; 8];
            for axis in 0..D {
                let inverse = B::Line::splat(mapping.inverse_cell[axis]);
                let xi = values::<B::Line>(set, Layout::POSITION + axis, particles) * inverse;
                let base = (xi - B::Line::splat(base_offset(N))).floor();
                let l = match mapping.half_length_column {
                    Some(first) => values::<B::Line>(set, first + axis, particles),
                    None => B::Line::splat(mapping.half_length[axis]),
                };
                let (w, g) = axis_weights::<B::Line, N>(mapping.family, xi - base, l);
                let mut lanes = [0.0; 8];
                base.store(&mut lanes);
                for (base, lane) in bases.iter_mut().zip(lanes) {
                    base[shape.direction(axis)] = (lane + GHOSTS_BELOW as f64) as usize;
                }
                let (mut weights, mut slopes) = ([[0.0; 8]; 4], [[0.0; 8]; 4]);
                for n in 0..N {
                    w[n].store(&mut weights[n]);
                    (g[n] * inverse).store(&mut slopes[n]);
                }
                for (half, reaches) in reaches.chunks_mut(4).enumerate() {
                    let w = turned::<B::Half>(&weights, 4 * half);
                    let g = turned::<B::Half>(&slopes, 4 * half);
                    for (reach, (w, g)) in reaches.iter_mut().zip(w.into_iter().zip(g)) {
                        w.store(&mut reach.axes[axis].0);
                        g.store(&mut reach.axes[axis].1);
                    }
                }
            }
            for (reach, base) in reaches.iter_mut().zip(bases) {
                reach.base = shape.index(base);
                reach.mirrored = is_mirrored(base, &inner);
            }
        }
    }
}

/// Weights of four particles from the one in lane `from` at all nodes, from those of all particles at one node.
#[inline(always)]
fn turned<Q: Quad>(rows: &[[f64; 8]; 4], from: usize) -> [Q; 4] {
    let mut quads = [Q::splat(0.0); 4];
    for n in 0..4 {
        quads[n] = Q::load(&rows[n][from..]);
    }
    Q::transpose(quads)
}

/// Values of a column, and of the first particle again where there are fewer than lanes.
#[inline(always)]
fn values<L: Lanes>(set: &ParticleSet, column: usize, particles: &[usize]) -> L {
    let column = &set.columns[column];
    let mut values = [column[particles[0]]; 8];
    for (value, &p) in values.iter_mut().zip(particles) {
        *value = column[p];
    }
    L::load(&values)
}
