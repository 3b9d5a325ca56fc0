//! Planes of nodes beside those of a rank, which its neighbours send after the equation of motion.

use crate::grid::Line;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::fields::Grid;
use std::ops::Range;

impl Cycle {
    /// Sends the nodes of the outer planes of this rank to its neighbours, and takes theirs.
    pub(in crate::simulation) fn exchange_planes(&mut self) {
        let Some(share) = &self.work.share else {
            return;
        };
        let (own, reach) = (share.planes(), self.state.stencil + 1);
        let grid = &mut self.work.grid;
        let outer = [own.start..own.start + reach, own.end - reach..own.end];
        let [first, last] = [share.rank() == 0, share.rank() + 1 == share.ranks.count()];
        let packed = |planes: Range<usize>, nobody: bool| {
            if nobody { vec![] } else { pack(grid, planes) }
        };
        let [below, above] = outer;
        let sent = [packed(below, first), packed(above, last)];
        for words in share.ranks.exchange(sent) {
            unpack(grid, &words);
        }
    }
}

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
