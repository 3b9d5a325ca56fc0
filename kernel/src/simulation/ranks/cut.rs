//! The cut of the planes of a grid into ranges of ranks.

use std::ops::Range;

/// Fewest planes of a rank: the ghosts of a neighbour, and the planes that it reads, lie in one rank with the widest stencil.
pub(super) const LEAST_PLANES: usize = 5;
/// Most particles that a rank holds over those of the best cut, from which on planes are cut anew.
const MOST_UNEVEN: f64 = 1.1;

/// Planes of each rank.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cut {
    /// First plane of each rank, and the number of planes.
    starts: Vec<usize>,
    /// Nodes that a particle reaches along an axis.
    stencil: usize,
}

/// Particles below each plane, and the reach of one.
struct PlaneCounts {
    below: Vec<u64>,
    stencil: usize,
}

impl PlaneCounts {
    fn new(counts: &[u64], stencil: usize) -> Self {
        let mut below = vec![0];
        for count in counts {
            below.push(below[below.len() - 1] + count);
        }
        Self { below, stencil }
    }

    fn planes(&self) -> usize {
        self.below.len() - 1
    }

    /// Particles that a rank with these planes holds, ghosts among them.
    fn held(&self, planes: &Range<usize>) -> u64 {
        let layers = held(planes, self.stencil, self.planes());
        self.below[layers.end] - self.below[layers.start]
    }

    /// First planes of ranks that hold at most so many particles each, as many as fit into each but the last; `None` where
    /// the last holds more.
    fn starts(&self, ranks: usize, most: u64) -> Option<Vec<usize>> {
        let mut starts = vec![0];
        for rank in 1..ranks {
            let first = starts[rank - 1];
            // Planes enough are left for the ranks behind.
            let last = self.planes() - LEAST_PLANES * (ranks - rank);
            let fits = |end: usize| self.held(&(first..end)) <= most;
            let (mut end, mut beyond) = (first + LEAST_PLANES, last + 1);
            if !fits(end) {
                return None;
            }
            while end + 1 < beyond {
                let middle = end + (beyond - end) / 2;
                if fits(middle) {
                    end = middle;
                } else {
                    beyond = middle;
                }
            }
            starts.push(end);
        }
        let last = starts[ranks - 1]..self.planes();
        (self.held(&last) <= most).then_some(starts)
    }
}

impl Cut {
    /// The planes of ranks of which the one with most particles, ghosts among them, holds as few as can be: each computes its
    /// ghosts once more. `counts` has the particles of each plane. There are planes enough for the ranks.
    pub(super) fn new(counts: &[u64], ranks: usize, stencil: usize) -> Self {
        let counts = PlaneCounts::new(counts, stencil);
        // The whole fits, and nothing does not where there are particles.
        let (mut below, mut fits) = (0, counts.below[counts.planes()]);
        while below + 1 < fits {
            let middle = below + (fits - below) / 2;
            if counts.starts(ranks, middle).is_some() {
                fits = middle;
            } else {
                below = middle;
            }
        }
        let even = || {
            (0..ranks)
                .map(|rank| counts.planes() * rank / ranks)
                .collect()
        };
        let mut starts = counts.starts(ranks, fits).unwrap_or_else(even);
        starts.push(counts.planes());
        Self { starts, stencil }
    }

    /// Planes of a rank.
    pub(super) fn planes(&self, rank: usize) -> Range<usize> {
        self.starts[rank]..self.starts[rank + 1]
    }

    /// The stencil for which the planes were cut.
    pub(super) fn reach(&self) -> usize {
        self.stencil
    }

    /// Layers of particles that reach the planes of a rank.
    pub(super) fn held(&self, rank: usize) -> Range<usize> {
        let all = self.starts[self.starts.len() - 1];
        held(&self.planes(rank), self.stencil, all)
    }

    /// True if the rank with most particles holds far more than the one of another cut would.
    pub(super) fn is_uneven(&self, counts: &[u64], other: &Self) -> bool {
        let counts = PlaneCounts::new(counts, self.stencil);
        let most = |cut: &Self| {
            let ranks = 0..cut.starts.len() - 1;
            ranks.map(|rank| counts.held(&cut.planes(rank))).max()
        };
        most(self).unwrap_or(0) as f64 > MOST_UNEVEN * most(other).unwrap_or(0) as f64
    }
}

/// Layers of particles that reach some planes of so many.
fn held(planes: &Range<usize>, stencil: usize, all: usize) -> Range<usize> {
    planes.start.saturating_sub(stencil)..(planes.end + 1).min(all)
}
