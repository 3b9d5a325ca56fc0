//! Planes of nodes beside those of a rank, which its neighbours send after the equation of motion.

use super::Share;
use crate::grid::Line;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::context::NodalConditions;
use crate::simulation::fields::Grid;
use crate::simulation::interactions::Interaction;
use crate::stage::solve::DrivenNode;
use std::ops::Range;

impl Cycle {
    /// Sends the nodes of the outer planes of this rank to its neighbours, and takes theirs.
    pub(in crate::simulation) fn exchange_planes(&mut self) {
        let Some(share) = &self.work.share else {
            return;
        };
        let reach = self.state.stencil + 1;
        let grid = &mut self.work.grid;
        let sent = to_neighbours(share, reach, |planes| pack(grid, planes));
        for words in share.ranks.exchange(sent) {
            unpack(grid, &words);
        }
    }

    /// Gives each rank the nodes beside its own that driven bodies hold, where an interaction reads these: a rank knows which
    /// particles reach its own nodes, not which ones reach those of a neighbour.
    pub(in crate::simulation) fn exchange_driven(&self, nodal: &mut NodalConditions) {
        let Some(share) = &self.work.share else {
            return;
        };
        if !self.exchanges_driven() {
            return;
        }
        let own = share.planes();
        let plane = |one: &DrivenNode| self.work.grid.shape.indices(one.node)[0];
        nodal.driven.retain(|one| own.contains(&plane(one)));
        let sent = to_neighbours(share, self.state.stencil + 1, |planes| {
            let nodes = nodal.driven.iter();
            let nodes = nodes.filter(|one| planes.contains(&plane(one)));
            let words = nodes.flat_map(|one| {
                let velocities = [one.before, one.after].into_iter().flatten();
                std::iter::once(one.node as u64).chain(velocities.map(f64::to_bits))
            });
            words.collect()
        });
        for words in share.ranks.exchange(sent) {
            for words in words.chunks_exact(DRIVEN) {
                let mut words = Words::of(words);
                nodal.driven.push(DrivenNode {
                    node: words.count(),
                    before: [(); 3].map(|()| words.number()),
                    after: [(); 3].map(|()| words.number()),
                });
            }
        }
        nodal.driven.sort_unstable_by_key(|one| one.node);
    }

    /// True where ranks give each other the nodes that driven bodies hold.
    pub(super) fn exchanges_driven(&self) -> bool {
        let mut interactions = self.interactions();
        self.model.settings.drives_bodies && interactions.any(Interaction::settles_across_ranks)
    }
}

/// Words of the outer planes of a rank, so many on either side, for the rank below and for the one above; none where there is no rank.
fn to_neighbours(
    share: &Share,
    reach: usize,
    pack: impl Fn(Range<usize>) -> Vec<u64>,
) -> [Vec<u64>; 2] {
    let own = share.planes();
    let [first, last] = [share.rank() == 0, share.rank() + 1 == share.ranks.count()];
    let packed = |planes: Range<usize>, nobody: bool| {
        if nobody { vec![] } else { pack(planes) }
    };
    let below = packed(own.start..own.start + reach, first);
    [below, packed(own.end - reach..own.end, last)]
}

/// Words of a node that moves with a driven body: its index and two velocities.
pub(super) const DRIVEN: usize = 7;
/// Words before the values of a row: its field, its first node, the number of nodes.
const HEAD: usize = 3;
/// Values of a node.
const LINE: usize = size_of::<Line>() / size_of::<f64>();

/// The nodes in use of some planes, field by field and row by row: a row, its span, its values.
pub(super) fn pack(grid: &Grid, planes: Range<usize>) -> Vec<u64> {
    let mut words = vec![];
    for (number, field) in grid.fields.iter().enumerate() {
        let lines = field.nodes.lines();
        for plane in planes.clone() {
            for row in field.rows.in_plane(plane) {
                let span = field.rows.span(plane, row);
                if span.is_empty() {
                    continue;
                }
                let first = grid.shape.index([plane, row, span.start]);
                words.extend([number, first, span.len()].map(|word| word as u64));
                let values = lines[first..first + span.len()].as_flattened();
                words.extend(values.iter().map(|value| value.to_bits()));
            }
        }
    }
    words
}

/// Number of words of some packed planes.
pub(super) fn words(grid: &Grid, planes: Range<usize>) -> usize {
    let fields = grid.fields.iter();
    let spans = fields.flat_map(|field| {
        let rows = planes.clone().flat_map(move |plane| {
            let rows = field.rows.in_plane(plane);
            rows.map(move |row| field.rows.span(plane, row).len())
        });
        rows.filter(|span| *span > 0)
    });
    spans.map(|span| HEAD + span * LINE).sum()
}

/// Takes packed nodes up.
pub(super) fn unpack(grid: &mut Grid, words: &[u64]) {
    let mut words = Words::of(words);
    loop {
        let [number, first, count] = [(); HEAD].map(|()| words.count());
        if count == 0 {
            return;
        }
        // Loads ask which of these nodes are in use.
        grid.fields[number].rows.widen(&grid.shape, first, count);
        let lines = &mut grid.fields[number].nodes.lines_mut()[first..first + count];
        let values = lines.as_flattened_mut();
        let sent = words.take(values.len());
        for (value, word) in values.iter_mut().zip(sent) {
            *value = f64::from_bits(*word);
        }
    }
}
