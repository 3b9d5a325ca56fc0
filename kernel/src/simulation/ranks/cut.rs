//! The cut of the nodes of a grid into blocks of ranks: ranges of planes, and where these end ranges of rows in them.

use crate::grid::{GridShape, NodeBlock};
use std::ops::Range;

/// Fewest planes, or rows, of a rank: the ghosts of a neighbour, and the nodes that it reads, lie in one rank with the widest
/// stencil.
pub(super) const LEAST: usize = 5;
/// Most particles that a rank holds over those of the best cut, from which on planes and rows are cut anew.
const MOST_UNEVEN: f64 = 1.1;
/// Share of the particles that a rank holds by planes alone, which it must hold at most for rows to be cut, too: they cost a
/// second message.
const WORTH_ROWS: f64 = 0.9;

/// Particles in each plane, and in each row of all planes together.
#[derive(Clone, Debug)]
pub(super) struct ParticleCounts {
    pub(super) planes: Vec<u64>,
    pub(super) rows: Vec<u64>,
}

impl ParticleCounts {
    /// The same number in all.
    pub(super) fn even(shape: &GridShape) -> Self {
        Self {
            planes: vec![1; shape.nodes[0]],
            rows: vec![1; shape.nodes[1]],
        }
    }
}

/// Planes and rows of each rank. Ranks with the same planes follow each other, in order of their rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cut {
    planes: Ranges,
    rows: Ranges,
    /// Nodes that a particle reaches along an axis.
    stencil: usize,
    /// True for rows that wait for a sort: the first rank of each range of planes has them all.
    waits: bool,
}

/// Ranges along one axis.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Ranges {
    /// First of each range, and the number of all.
    starts: Vec<usize>,
}

impl Ranges {
    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn all(&self) -> usize {
        self.starts[self.count()]
    }

    fn at(&self, number: usize) -> Range<usize> {
        self.starts[number]..self.starts[number + 1]
    }

    /// Layers or rows of particles that reach a range.
    fn held(&self, range: &Range<usize>, stencil: usize) -> Range<usize> {
        held(range, stencil, self.all())
    }

    /// Number of the range that has a plane or row.
    fn of(&self, place: usize) -> usize {
        self.starts.partition_point(|start| *start <= place) - 1
    }
}

/// Particles below each plane or row of an axis, and the reach of one.
struct CountsBelow {
    below: Vec<u64>,
    stencil: usize,
}

impl CountsBelow {
    fn new(counts: &[u64], stencil: usize) -> Self {
        let mut below = vec![0];
        for count in counts {
            below.push(below[below.len() - 1] + count);
        }
        Self { below, stencil }
    }

    fn count(&self) -> usize {
        self.below.len() - 1
    }

    /// Particles that reach a range, ghosts among them.
    fn held(&self, range: &Range<usize>) -> u64 {
        let layers = held(range, self.stencil, self.count());
        self.below[layers.end] - self.below[layers.start]
    }

    /// The most particles that a range holds, over all.
    fn share(&self, ranges: &Ranges) -> f64 {
        let all = self.below[self.count()].max(1);
        let held = (0..ranges.count()).map(|number| self.held(&ranges.at(number)));
        held.max().unwrap_or(0) as f64 / all as f64
    }

    /// Ranges of which the one with most particles, ghosts among them, holds as few as can be: each computes its ghosts once
    /// more. There is room for so many.
    fn ranges(&self, count: usize) -> Ranges {
        // The whole fits, and nothing does not where there are particles.
        let (mut below, mut fits) = (0, self.below[self.count()]);
        while below + 1 < fits {
            let middle = below + (fits - below) / 2;
            if self.starts(count, middle).is_some() {
                fits = middle;
            } else {
                below = middle;
            }
        }
        let even = || {
            (0..count)
                .map(|number| self.count() * number / count)
                .collect()
        };
        let mut starts = self.starts(count, fits).unwrap_or_else(even);
        starts.push(self.count());
        Ranges { starts }
    }

    /// Starts of ranges that hold at most so many particles each, as many as fit into each but the last; `None` where
    /// the last holds more.
    fn starts(&self, ranks: usize, most: u64) -> Option<Vec<usize>> {
        let mut starts = vec![0];
        for rank in 1..ranks {
            let first = starts[rank - 1];
            // Room enough is left for the ranges behind.
            let last = self.count() - LEAST * (ranks - rank);
            let fits = |end: usize| self.held(&(first..end)) <= most;
            let (mut end, mut beyond) = (first + LEAST, last + 1);
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
        let last = starts[ranks - 1]..self.count();
        (self.held(&last) <= most).then_some(starts)
    }
}

impl Cut {
    /// The blocks of ranks of which the one with most particles, ghosts among them, holds about as few as can be: planes alone,
    /// or planes and rows where that is clearly less. `None` where there are too few of both for so many ranks.
    pub(super) fn new(counts: &ParticleCounts, ranks: usize, stencil: usize) -> Option<Self> {
        let of_planes = CountsBelow::new(&counts.planes, stencil);
        let of_rows = CountsBelow::new(&counts.rows, stencil);
        let cuts = splits(ranks, [of_planes.count(), of_rows.count()]).map(|[planes, rows]| {
            let (planes, rows) = (of_planes.ranges(planes), of_rows.ranges(rows));
            let share = of_planes.share(&planes) * of_rows.share(&rows);
            (share, planes, rows)
        });
        let (_, planes, rows) = cuts.reduce(|best, other| {
            // Planes alone come first.
            let limit = if best.2.count() == 1 { WORTH_ROWS } else { 1.0 };
            if other.0 < limit * best.0 {
                other
            } else {
                best
            }
        })?;
        Some(Self {
            planes,
            rows,
            stencil,
            waits: false,
        })
    }

    /// The largest number of ranks, up to this one, for which there is room.
    pub(super) fn most(ranks: usize, shape: &GridShape) -> usize {
        let [planes, rows, _] = shape.nodes;
        let fits = |ranks: &usize| splits(*ranks, [planes, rows]).next().is_some();
        let most = ranks.min((planes / LEAST).max(1) * (rows / LEAST).max(1));
        (1..=most).rev().find(fits).unwrap_or(1)
    }

    /// The same, where nobody knows in which rows particles were at the last sort: the first rank of each range of planes has
    /// them all until the next.
    pub(super) fn waiting(self) -> Self {
        Self {
            waits: self.rows.count() > 1,
            ..self
        }
    }

    /// True where rows wait for a sort.
    pub(super) fn waits(&self) -> bool {
        self.waits
    }

    /// True where rows are cut.
    pub(super) fn cuts_rows(&self) -> bool {
        self.rows.count() > 1
    }

    /// Number of the range of planes of a rank, and of the range of rows.
    fn numbers(&self, rank: usize) -> [usize; 2] {
        [rank / self.rows.count(), rank % self.rows.count()]
    }

    /// Planes and rows of a rank.
    pub(super) fn block(&self, rank: usize) -> NodeBlock {
        let [planes, rows] = self.numbers(rank);
        NodeBlock {
            planes: self.planes.at(planes),
            rows: match (self.waits, rows) {
                (false, _) => self.rows.at(rows),
                (true, 0) => 0..self.rows.all(),
                (true, _) => 0..0,
            },
        }
    }

    /// The rank that owns a node, by its storage indices.
    pub(super) fn owner(&self, [plane, row, _]: [usize; 3]) -> usize {
        let rows = if self.waits { 0 } else { self.rows.of(row) };
        self.planes.of(plane) * self.rows.count() + rows
    }

    /// The first rank with the planes of a rank, and the number of these ranks.
    pub(super) fn beside(&self, rank: usize) -> Range<usize> {
        let first = rank - rank % self.rows.count();
        first..first + self.rows.count()
    }

    /// The ranks below and above one along the rows, then along the planes.
    pub(super) fn neighbours(&self, rank: usize) -> [[Option<usize>; 2]; 2] {
        let per_plane = self.rows.count();
        let [planes, rows] = self.numbers(rank);
        let along = |number: usize, count: usize, stride: usize| {
            let below = (number > 0).then(|| rank - stride);
            [below, (number + 1 < count).then(|| rank + stride)]
        };
        let along_rows = if self.waits {
            [None; 2]
        } else {
            along(rows, per_plane, 1)
        };
        [along_rows, along(planes, self.planes.count(), per_plane)]
    }

    /// The stencil for which the nodes were cut.
    pub(super) fn reach(&self) -> usize {
        self.stencil
    }

    /// Base layers and rows of particles that reach the nodes of a rank.
    pub(super) fn held(&self, rank: usize) -> NodeBlock {
        let NodeBlock { planes, rows } = self.block(rank);
        NodeBlock {
            planes: self.planes.held(&planes, self.stencil),
            rows: if rows.is_empty() {
                rows
            } else {
                self.rows.held(&rows, self.stencil)
            },
        }
    }

    /// Particles that a rank and its neighbours hold, along the rows, where they are cut, and along the planes: the own ones
    /// that a neighbour holds, too, and the ghosts here that it owns.
    pub(super) fn ghosts(&self, rank: usize) -> Vec<CommonParticles> {
        let own = self.block(rank);
        let [of_rows, of_planes] = self.neighbours(rank);
        let ends = |range: &Range<usize>| {
            let own = [
                range.start..range.start + 1,
                range.end.saturating_sub(self.stencil)..range.end,
            ];
            let below = range.start.saturating_sub(self.stencil)..range.start;
            (own, [below, range.end..range.end + 1])
        };
        let mut all = vec![];
        if self.cuts_rows() {
            let block = |rows: Range<usize>| NodeBlock {
                planes: own.planes.clone(),
                rows,
            };
            let (mine, ghosts) = ends(&own.rows);
            all.push(CommonParticles {
                with: of_rows,
                own: mine.map(block),
                ghosts: ghosts.map(block),
            });
        }
        let block = |planes: Range<usize>| NodeBlock {
            planes,
            rows: own.rows.clone(),
        };
        let (mine, ghosts) = ends(&own.planes);
        all.push(CommonParticles {
            with: of_planes,
            own: mine.map(block),
            ghosts: ghosts.map(block),
        });
        all
    }

    /// A block with nodes on either side along the rows, where a neighbour has them.
    pub(super) fn with_rows_beside(&self, block: NodeBlock, reach: usize) -> NodeBlock {
        let NodeBlock { planes, rows } = block;
        let rows = if rows.is_empty() {
            rows
        } else {
            rows.start.saturating_sub(reach)..(rows.end + reach).min(self.rows.all())
        };
        NodeBlock { planes, rows }
    }

    /// True if the rank with most particles holds far more than the one of another cut would.
    pub(super) fn is_uneven(&self, counts: &ParticleCounts, other: &Self) -> bool {
        let of_planes = CountsBelow::new(&counts.planes, self.stencil);
        let of_rows = CountsBelow::new(&counts.rows, self.stencil);
        let most = |cut: &Self| of_planes.share(&cut.planes) * of_rows.share(&cut.rows);
        most(self) > MOST_UNEVEN * most(other)
    }
}

/// Particles that a rank and its two neighbours along an axis hold.
pub(super) struct CommonParticles {
    /// The neighbours below and above.
    pub(super) with: [Option<usize>; 2],
    /// Base layers and rows of the own particles that each holds.
    pub(super) own: [NodeBlock; 2],
    /// Base layers and rows of its particles that are ghosts here.
    pub(super) ghosts: [NodeBlock; 2],
}

/// The ways to cut planes and rows of these numbers for so many ranks, planes alone first.
fn splits(ranks: usize, [planes, rows]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
    let room = move |all: usize, count: usize| count == 1 || count * LEAST <= all;
    let divisors = (1..=ranks).filter(move |rows| ranks.is_multiple_of(*rows));
    divisors
        .map(move |rows| [ranks / rows, rows])
        .filter(move |[a, b]| room(planes, *a) && room(rows, *b))
}

/// Layers or rows of particles that reach a range of so many.
fn held(range: &Range<usize>, stencil: usize, all: usize) -> Range<usize> {
    range.start.saturating_sub(stencil)..(range.end + 1).min(all)
}
