//! Base nodes near a boundary, and the test of particles for them in lanes.

use proctor_kernel::grid::{GHOSTS_BELOW, GridShape};
use proctor_kernel::lanes::{Backend, Kernel, Lanes, load};
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::stage::Mapping;
use proctor_kernel::weights::base_offset;
use std::array;
use std::ops::Range;

/// Some of the nodes that may be the base of a particle.
#[derive(Clone, Debug, Default)]
pub(super) struct Bases {
    /// True for each node of the grid that is one.
    is_one: Vec<bool>,
    list: Vec<usize>,
}

impl Bases {
    /// None, in a grid of that shape.
    pub(super) fn clear(&mut self, shape: &GridShape) {
        self.is_one.resize(shape.nodes.iter().product(), false);
        for base in self.list.drain(..) {
            self.is_one[base] = false;
        }
    }

    /// Adds those from which a particle reaches a node. An image reaches a node from ghosts that its particle reaches, whose
    /// base is among these too.
    pub(super) fn add(&mut self, node: [usize; 3], stencil: usize, shape: &GridShape) {
        let bases = shape.bases();
        let [i, j, k]: [Range<usize>; 3] = array::from_fn(|direction| {
            node[direction].saturating_sub(stencil - 1)..(node[direction] + 1).min(bases[direction])
        });
        for i in i {
            for j in j.clone() {
                for k in k.clone() {
                    let base = shape.index([i, j, k]);
                    if !self.is_one[base] {
                        self.is_one[base] = true;
                        self.list.push(base);
                    }
                }
            }
        }
    }

    /// True if a node is one of them.
    #[inline(always)]
    pub(super) fn has(&self, node: usize) -> bool {
        self.is_one[node]
    }
}

/// True if particles have one of some bases.
pub(super) struct NearBases<'a, const D: usize> {
    /// The first of the particles, as numbered in their set.
    pub(super) first: usize,
    /// The set, and how it sees the grid.
    pub(super) set: &'a ParticleSet,
    pub(super) mapping: &'a Mapping,
    pub(super) shape: &'a GridShape,
    /// Nodes per axis of the stencil.
    pub(super) stencil: usize,
    /// The bases.
    pub(super) bases: &'a Bases,
    /// One for each particle, to be written.
    pub(super) found: &'a mut [bool],
}

impl<const D: usize> Kernel for NearBases<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        self.write::<B::Line>();
    }
}

impl<const D: usize> NearBases<'_, D> {
    #[inline(always)]
    fn write<L: Lanes>(self) {
        let Self {
            first,
            set,
            mapping,
            shape,
            stencil,
            bases,
            found,
        } = self;
        let [_, rows, nodes] = shape.nodes;
        let strides = [rows * nodes, nodes, 1].map(|stride| stride as f64);
        let below = strides.map(|stride| GHOSTS_BELOW as f64 * stride);
        for (part, found) in found.chunks_mut(L::WIDTH).enumerate() {
            let at = first + part * L::WIDTH;
            let mut index = L::splat(0.0);
            for axis in 0..D {
                let direction = shape.direction(axis);
                let x = load::<L>(&set.columns[Layout::POSITION + axis], at, found.len());
                let xi = x * L::splat(mapping.inverse_cell[axis]);
                let base = (xi - L::splat(base_offset(stencil))).floor();
                // Whole numbers below 2^52, so that nothing is rounded.
                index = base.mul_add(L::splat(strides[direction]), index);
                index = index + L::splat(below[direction]);
            }
            let mut indices = [0.0; 8];
            index.store(&mut indices);
            for (found, index) in found.iter_mut().zip(indices) {
                *found = bases.has(index as usize);
            }
        }
    }
}
