//! Runs of particles with one base node.

use crate::lanes::Lanes;
use crate::stage::{Block, Mapping, layer_of};
use std::ops::Range;

/// The runs of a block.
pub(super) struct Runs {
    /// Index of the base node of each particle, a whole number, and one that no particle has behind them.
    index: [f64; 9],
    /// Base node of each particle per axis, in cells of the mesh.
    base: [[f64; 8]; 3],
    /// Bit i is set where particle i + 1 has the base node of particle i.
    goes_on: u32,
    /// Number of particles.
    count: usize,
}

impl Runs {
    /// Runs of a block.
    #[inline(always)]
    pub(super) fn of<L: Lanes, const D: usize>(block: &Block<L>, mapping: &Mapping) -> Self {
        let index = block.index::<D>(mapping);
        let mut runs = Self {
            index: [f64::NAN; 9],
            base: [[0.0; 8]; 3],
            goes_on: 0,
            count: block.count,
        };
        index.store(&mut runs.index);
        for axis in 0..D {
            block.base[axis].store(&mut runs.base[axis]);
        }
        // What is not a number equals nothing, and is a run of its own.
        runs.goes_on = L::bits(index.eq(L::load(&runs.index[1..])));
        runs
    }

    /// The run that begins with a particle.
    #[inline(always)]
    pub(super) fn from(&self, first: usize) -> Range<usize> {
        let more = (self.goes_on >> first).trailing_ones() as usize;
        first..(first + more + 1).min(self.count)
    }

    /// Plane, row and place in the row of the base node of a particle, with `BEFORE` of the node before it along each axis;
    /// there are no rows in the plane.
    #[inline(always)]
    pub(super) fn base<const D: usize, const BEFORE: bool>(&self, particle: usize) -> [usize; 3] {
        let layer =
            |axis: usize| layer_of(self.base[axis][particle]).saturating_sub(usize::from(BEFORE));
        [layer(0), if D == 3 { layer(1) } else { 0 }, layer(D - 1)]
    }

    /// True if a particle reaches one of some planes.
    #[inline(always)]
    pub(super) fn reach<const D: usize, const N: usize, const BEFORE: bool>(
        &self,
        planes: &Range<usize>,
    ) -> bool {
        (0..self.count).any(|particle| {
            let [first, ..] = self.base::<D, BEFORE>(particle);
            first < planes.end && planes.start < first + N
        })
    }
}

/// Number of groups of at most eight particles that the runs of a layer would be. The number depends on the particles alone,
/// not on where blocks begin.
#[derive(Default)]
pub(super) struct GroupCount {
    groups: usize,
    /// The last run: its base node and how long it is.
    index: f64,
    length: usize,
}

impl GroupCount {
    /// Adds the runs of a block, which are no longer than a group: only the first may go on with the run before it, and
    /// only the last may go on behind the block.
    #[inline(always)]
    pub(super) fn add(&mut self, runs: &Runs) {
        let first = runs.from(0).len();
        if runs.index[0] == self.index {
            self.length += first;
        } else {
            self.groups += self.length.div_ceil(8);
            (self.index, self.length) = (runs.index[0], first);
        }
        if first == runs.count {
            return;
        }
        // Bit i is set where particle i + 1 begins a run.
        let begins = !runs.goes_on & ((1 << (runs.count - 1)) - 1);
        let last = (u32::BITS - begins.leading_zeros()) as usize;
        self.groups += self.length.div_ceil(8) + begins.count_ones() as usize - 1;
        (self.index, self.length) = (runs.index[last], runs.count - last);
    }

    /// All of them.
    #[inline(always)]
    pub(super) fn groups(&self) -> usize {
        self.groups + self.length.div_ceil(8)
    }
}
