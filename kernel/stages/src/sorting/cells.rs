//! The base cells in which particles lie, and their numbers.

use super::ThreadList;
use crate::grid::GridShape;
use crate::lanes::{Backend, Kernel, Lanes, SelectedLanes, load};
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::stage::index_of;
use crate::team::Team;
use crate::weights::below;
use std::ops::Range;

/// A box of base cells, by its first one and the number of them along slow, middle and fast direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    pub(super) first: [usize; 3],
    pub(super) count: [usize; 3],
}

impl Cells {
    /// All that a mesh has.
    pub(super) fn all(shape: &GridShape) -> Self {
        Self {
            first: [0; 3],
            count: shape.bases(),
        }
    }

    /// Cells in which the particles of a set lie: the cost of a sort does not depend on the size of the mesh around them.
    pub(super) fn in_use(
        set: &ParticleSet,
        shape: &GridShape,
        offset: f64,
        lanes: SelectedLanes,
        team: &Team,
    ) -> Self {
        let mut cells = Self::all(shape);
        let share = set.len().div_ceil(team.count()).max(1);
        let starts = (0..set.len()).step_by(share);
        let of_part = |start: usize| {
            lanes.run(Extent {
                set,
                range: start..(start + share).min(set.len()),
                axes: shape.axes,
            })
        };
        let join = |[low, high]: [[f64; 3]; 2], [l, h]: [[f64; 3]; 2]| {
            [
                std::array::from_fn(|axis| low[axis].min(l[axis])),
                std::array::from_fn(|axis| high[axis].max(h[axis])),
            ]
        };
        let nothing = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let mut extents: ThreadList<_> = starts.clone().map(|_| nothing).collect();
        team.each(starts.zip(&mut extents), |(start, extent)| {
            *extent = of_part(start);
        });
        let [low, high] = extents.into_iter().fold(nothing, join);
        for axis in 0..shape.axes {
            let direction = shape.direction(axis);
            let cell = |x: f64| {
                let base = below(x * (1.0 / shape.cell[axis]) - offset) + 1.0;
                (base as usize).min(cells.count[direction] - 1)
            };
            // No particle at all, or none whose position is a number.
            if low[axis] > high[axis] {
                continue;
            }
            let (first, last) = (cell(low[axis]), cell(high[axis]));
            cells.first[direction] = first;
            cells.count[direction] = last - first + 1;
        }
        cells
    }
}

/// The least and the largest position of particles along each axis, whatever their order; of what is no number nothing is seen.
struct Extent<'a> {
    set: &'a ParticleSet,
    range: Range<usize>,
    axes: usize,
}

impl Kernel for Extent<'_> {
    type Output = [[f64; 3]; 2];

    #[inline(always)]
    fn run<B: Backend>(self) -> Self::Output {
        let width = <B::Line as Lanes>::WIDTH;
        let mut extent = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for axis in 0..self.axes {
            let column = &self.set.columns[Layout::POSITION + axis][self.range.clone()];
            let mut low = B::Line::splat(f64::INFINITY);
            let mut high = B::Line::splat(f64::NEG_INFINITY);
            let mut whole = column.chunks_exact(width);
            for lanes in &mut whole {
                let x = B::Line::load(lanes);
                low = x.min(low);
                high = x.max(high);
            }
            let mut lanes = [[0.0; 8]; 2];
            low.store(&mut lanes[0]);
            high.store(&mut lanes[1]);
            for x in lanes[0].iter().chain(whole.remainder()) {
                extent[0][axis] = x.min(extent[0][axis]);
            }
            for x in lanes[1].iter().chain(whole.remainder()) {
                extent[1][axis] = x.max(extent[1][axis]);
            }
        }
        extent
    }
}

/// Numbering of base cells of a box, slow axis first: the part that is the same for all particles.
pub(crate) struct Numbering {
    axes: usize,
    /// Cells per metre along each axis.
    per_metre: [f64; 3],
    /// The first cell along each axis, as a node less one.
    first: [f64; 3],
    /// Number that one cell along each axis adds.
    strides: [usize; 3],
    /// Offset of the base cell, as in [`Family::sort_offset`](crate::weights::Family::sort_offset).
    offset: f64,
}

impl Numbering {
    pub(super) fn new(shape: &GridShape, offset: f64, cells: &Cells) -> Self {
        let [_, middle, fast] = cells.count;
        let of_direction = [middle * fast, fast, 1];
        Self {
            axes: shape.axes,
            per_metre: shape.cell.map(|cell| 1.0 / cell),
            first: std::array::from_fn(|axis| cells.first[shape.direction(axis)] as f64 - 1.0),
            strides: std::array::from_fn(|axis| of_direction[shape.direction(axis)]),
            offset,
        }
    }

    /// Number of the base cell of a particle.
    #[inline]
    pub(crate) fn key(&self, set: &ParticleSet, p: usize) -> u32 {
        let mut key = 0;
        for axis in 0..self.axes {
            let xi = set.columns[Layout::POSITION + axis][p] * self.per_metre[axis];
            key += (below(xi - self.offset) - self.first[axis]) as usize * self.strides[axis];
        }
        key as u32
    }
}

/// The numbers of the base cells of particles from `start` on, in lanes.
pub(super) struct CellNumbers<'a> {
    pub(super) numbering: &'a Numbering,
    pub(super) set: &'a ParticleSet,
    pub(super) start: usize,
    pub(super) keys: &'a mut [u32],
}

impl Kernel for CellNumbers<'_> {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        let width = <B::Native as Lanes>::WIDTH;
        let offset = B::Native::splat(self.numbering.offset);
        let end = self.start + self.keys.len();
        for (block, keys) in self.keys.chunks_mut(width).enumerate() {
            let at = self.start + block * width;
            let count = (end - at).min(width);
            let mut key = B::Native::splat(0.0);
            for axis in 0..self.numbering.axes {
                let column = &self.set.columns[Layout::POSITION + axis];
                let per_metre = B::Native::splat(self.numbering.per_metre[axis]);
                let xi = load::<B::Native>(column, at, count) * per_metre;
                let first = B::Native::splat(self.numbering.first[axis]);
                let stride = B::Native::splat(self.numbering.strides[axis] as f64);
                key = ((xi - offset).floor() - first).mul_add(stride, key);
            }
            let mut lanes = [0.0; 8];
            key.store(&mut lanes);
            for (key, lane) in keys.iter_mut().zip(lanes) {
                *key = index_of(lane) as u32;
            }
        }
    }
}
