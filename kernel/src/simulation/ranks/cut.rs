//! The cut of the planes of a grid into ranges of ranks.

use std::ops::Range;

/// Fewest planes of a rank: the ghosts of a neighbour, and the planes that it reads, lie in one rank with the widest stencil.
pub(super) const LEAST_PLANES: usize = 5;
/// Largest share of a rank over the mean from which on planes are cut anew.
const MOST_UNEVEN: f64 = 1.1;

/// Planes of each rank.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cut {
    /// First plane of each rank, and the number of planes.
    starts: Vec<usize>,
}

impl Cut {
    /// Planes with about equal numbers of particles; `counts` has those of each plane. There are planes enough for the ranks.
    pub(super) fn new(counts: &[u64], ranks: usize) -> Self {
        let (planes, total) = (counts.len(), counts.iter().sum::<u64>());
        let mut starts = vec![0];
        let (mut plane, mut before) = (0, 0);
        for rank in 1..ranks {
            let wanted = total * rank as u64 / ranks as u64;
            while plane < planes && before + counts[plane] / 2 < wanted {
                before += counts[plane];
                plane += 1;
            }
            let least = starts[rank - 1] + LEAST_PLANES;
            let most = planes - LEAST_PLANES * (ranks - rank);
            starts.push(plane.clamp(least, most));
        }
        starts.push(planes);
        Self { starts }
    }

    /// Planes of a rank.
    pub(super) fn planes(&self, rank: usize) -> Range<usize> {
        self.starts[rank]..self.starts[rank + 1]
    }

    /// Layers of particles that reach the planes of a rank, with a stencil of so many nodes.
    pub(super) fn held(&self, rank: usize, stencil: usize) -> Range<usize> {
        let own = self.planes(rank);
        own.start.saturating_sub(stencil)..(own.end + 1).min(self.starts[self.starts.len() - 1])
    }

    /// True if the largest share of the particles is far above the mean.
    pub(super) fn is_uneven(&self, counts: &[u64]) -> bool {
        let shares = self.starts.windows(2);
        let shares = shares.map(|ends| counts[ends[0]..ends[1]].iter().sum::<u64>());
        let mean = counts.iter().sum::<u64>() as f64 / (self.starts.len() - 1) as f64;
        shares.max().unwrap_or(0) as f64 > MOST_UNEVEN * mean
    }
}
