//! Nodes whose memory particles have touched, on a grid that is much larger than its bodies.
//!
//! The system commits the memory of a node when it is first written. A body that crosses a large grid would leave all nodes on
//! its way committed; so the memory goes back to the system once it is more than twice that of the nodes in use. No value
//! lives there from one sort to the next.

use crate::grid::{ActiveRows, GridShape, Line};

/// Nodes of a grid from which on its memory is looked after: 64 MiB.
const LARGE: usize = (64 << 20) / size_of::<Line>();
/// Touched nodes beside those in use that are left alone: to touch them again takes time.
const SLACK: usize = 4096;
/// Growth in nodes from which on a step asks the system for memory: 16 MiB.
const GROWTH: usize = (16 << 20) / size_of::<Line>();

/// The rows of a grid that have been touched since its memory was new.
#[derive(Debug, Default)]
pub struct TouchedNodes {
    /// Of each row the part from the first to the last touched node.
    spans: Vec<(u32, u32)>,
    /// Nodes in all of them.
    count: usize,
    /// Nodes for which there was memory when it was looked at last.
    granted: usize,
}

impl TouchedNodes {
    /// Adds the rows in use after a sort; true if the memory of the grid is to be given back first.
    pub(crate) fn add(&mut self, rows: &ActiveRows, shape: &GridShape) -> bool {
        if shape.nodes.iter().product::<usize>() < LARGE {
            return false;
        }
        let first = self.spans.is_empty();
        self.spans.resize(shape.nodes[0] * shape.nodes[1], (0, 0));
        let active = rows.count();
        self.widen(rows, shape);
        let stale = self.count > 2 * active + SLACK;
        if stale {
            self.spans.fill((0, 0));
            self.widen(rows, shape);
        }
        if first || stale {
            self.granted = self.granted.max(self.count);
        }
        stale
    }

    fn widen(&mut self, rows: &ActiveRows, shape: &GridShape) {
        self.count = 0;
        for plane in 0..shape.nodes[0] {
            let own = &mut self.spans[plane * shape.nodes[1]..][..shape.nodes[1]];
            for row in rows.in_plane(plane) {
                let span = rows.span(plane, row);
                let (low, high) = (span.start as u32, span.end as u32);
                let (first, last) = &mut own[row];
                if low < high && *first < *last {
                    (*first, *last) = ((*first).min(low), (*last).max(high));
                } else if low < high {
                    (*first, *last) = (low, high);
                }
            }
            self.count += own.iter().map(|(a, b)| (b - a) as usize).sum::<usize>();
        }
    }

    /// Growth of the touched nodes since memory was last granted, where it is large.
    pub fn growth(&mut self) -> Option<usize> {
        let growth = self.count.saturating_sub(self.granted);
        if growth < GROWTH {
            return None;
        }
        self.granted = self.count;
        Some(growth)
    }
}
