//! Nodes beside those of a rank, which its neighbours send after the equation of motion: rows first, then planes.

use super::Share;
use super::cut::Cut;
use crate::fields::Grid;
use crate::grid::{Line, NodeBlock};
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::context::NodalConditions;
use crate::simulation::interactions::Interaction;
use crate::stage::solve::DrivenNode;
use std::ops::Range;

impl Cycle {
    /// Sends the outer nodes of this rank to its neighbours, and takes theirs.
    pub(in crate::simulation) fn exchange_nodes(&mut self) {
        let Some(share) = &self.work.share else {
            return;
        };
        let reach = self.state.stencil + 1;
        let grid = &mut self.work.grid;
        for (with, sent) in share.messages(reach) {
            let packed = sent.map(|block| block.map_or_else(Vec::new, |block| pack(grid, &block)));
            for words in share.ranks.exchange(with, packed) {
                unpack(grid, &words);
            }
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
        let own = share.block();
        let at = |one: &DrivenNode| self.work.grid.shape.indices(one.node);
        nodal.driven.retain(|one| own.contains(at(one)));
        for (with, sent) in share.messages(self.state.stencil + 1) {
            let packed = sent.map(|block| {
                let nodes = nodal.driven.iter();
                let nodes = nodes.filter(|one| block.as_ref().is_some_and(|b| b.contains(at(one))));
                let words = nodes.flat_map(|one| {
                    let velocities = [one.before, one.after].into_iter().flatten();
                    std::iter::once(one.node as u64).chain(velocities.map(f64::to_bits))
                });
                words.collect()
            });
            for words in share.ranks.exchange(with, packed) {
                for words in words.chunks_exact(DRIVEN) {
                    let mut words = Words::of(words);
                    nodal.driven.push(DrivenNode {
                        node: words.count(),
                        before: [(); 3].map(|()| words.number()),
                        after: [(); 3].map(|()| words.number()),
                    });
                }
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

/// The neighbours below and above a rank along an axis, and the nodes that each gets; none where there is no rank.
type Message = ([Option<usize>; 2], [Option<NodeBlock>; 2]);

impl Share {
    /// The messages in which neighbours get nodes of this rank that lie within a reach of theirs: along the rows, where they are
    /// cut, then along the planes, with the rows that have come before.
    fn messages(&self, reach: usize) -> impl Iterator<Item = Message> + use<> {
        self.cut.messages(self.rank(), reach)
    }
}

impl Cut {
    /// The messages of a rank: see [`Share::messages`].
    pub(super) fn messages(
        &self,
        rank: usize,
        reach: usize,
    ) -> impl Iterator<Item = Message> + use<> {
        let [of_rows, of_planes] = self.neighbours(rank);
        let own = self.block(rank);
        let ends = |all: &Range<usize>| {
            [
                all.start..all.start + reach,
                all.end.saturating_sub(reach)..all.end,
            ]
        };
        let rows = ends(&own.rows).map(|rows| NodeBlock {
            planes: own.planes.clone(),
            rows,
        });
        let beside = self.with_rows_beside(own.clone(), reach);
        let planes = ends(&own.planes).map(|planes| NodeBlock {
            planes,
            rows: beside.rows.clone(),
        });
        let message = |with: [Option<usize>; 2], [below, above]: [NodeBlock; 2]| -> Message {
            let to = [with[0].map(|_| below), with[1].map(|_| above)];
            (with, to)
        };
        let along_rows = self.cuts_rows().then(|| message(of_rows, rows));
        along_rows.into_iter().chain([message(of_planes, planes)])
    }
}

/// Words of a node that moves with a driven body: its index and two velocities.
pub(super) const DRIVEN: usize = 7;
/// Words before the values of a row: its field, its first node, the number of nodes.
const HEAD: usize = 3;
/// Values of a node.
const LINE: usize = size_of::<Line>() / size_of::<f64>();

/// The nodes in use of a block, field by field and row by row: a row, its span, its values.
pub(super) fn pack(grid: &Grid, block: &NodeBlock) -> Vec<u64> {
    let mut words = vec![];
    for (number, field) in grid.fields.iter().enumerate() {
        let lines = field.nodes.lines();
        for plane in block.planes.clone() {
            for row in block.rows.clone() {
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

/// Number of words of a packed block.
pub(super) fn words(grid: &Grid, block: &NodeBlock) -> usize {
    let fields = grid.fields.iter();
    let spans = fields.flat_map(|field| {
        let rows = block.planes.clone().flat_map(move |plane| {
            let rows = block.rows.clone();
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
