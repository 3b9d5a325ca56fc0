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
pub(crate) struct TouchedNodes {
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

    /// Nodes for which memory is to be asked, where they have become many more.
    pub(crate) fn growth(&mut self) -> Option<usize> {
        let growth = self.count.saturating_sub(self.granted);
        if growth < GROWTH {
            return None;
        }
        self.granted = self.count;
        Some(growth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Dimension, Mesh};

    /// A grid in the plane with so many cells per axis, and rows in which cells from one place to another are occupied.
    fn rows(cells: [usize; 2], place: [usize; 2], size: [usize; 2]) -> (GridShape, ActiveRows) {
        let mesh = Mesh {
            cells: [cells[0], cells[1], 1],
            ..Mesh::default()
        };
        let shape = GridShape::new(&mesh, Dimension::Two);
        let mut occupied = vec![None; shape.bases()[0]];
        for row in &mut occupied[place[0]..place[0] + size[0]] {
            *row = Some((place[1] as u32, (place[1] + size[1]) as u32));
        }
        let mut rows = ActiveRows::default();
        rows.fill(&shape, &occupied, 3);
        (shape, rows)
    }

    #[test]
    fn memory_goes_back_once_a_body_has_left_most_of_what_it_touched() {
        let mut touched = TouchedNodes::default();
        let mut given_back = 0;
        for x in (0..1500).step_by(4) {
            let (shape, rows) = rows([2000, 1000], [x, 10], [20, 20]);
            given_back += usize::from(touched.add(&rows, &shape));
            assert!(touched.count <= 2 * rows.count() + SLACK);
            assert_eq!(touched.growth(), None);
        }
        // In use are 25 rows of 25 nodes, so that 189 rows of 25 make more than twice as many and 4096.
        assert!((7..=9).contains(&given_back), "{given_back}");
    }

    #[test]
    fn a_small_grid_keeps_its_memory() {
        let mut touched = TouchedNodes::default();
        for x in 0..900 {
            let (shape, rows) = rows([1000, 1000], [x, 10], [20, 20]);
            assert!(!touched.add(&rows, &shape));
        }
        assert_eq!(touched.count, 0);
    }

    #[test]
    fn memory_is_asked_for_where_many_more_nodes_are_reached() {
        let mut touched = TouchedNodes::default();
        let (shape, small) = rows([2000, 1000], [10, 10], [20, 20]);
        assert!(!touched.add(&small, &shape));
        assert_eq!(touched.growth(), None);
        let (_, large) = rows([2000, 1000], [10, 10], [600, 600]);
        assert!(!touched.add(&large, &shape));
        assert_eq!(touched.growth(), Some(large.count() - small.count()));
        assert_eq!(touched.growth(), None);
    }
}
