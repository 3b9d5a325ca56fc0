//! The background grid: one 64-byte line per node, and the rows that are in use.
//!
//! Nodes carry the index of the mesh plus one: one layer of ghost nodes lies below the lower planes and two
//! above the upper ones, where the stencil of a particle beside the boundary reaches. The slowest axis is x;
//! in two dimensions the middle axis has length 1.

use crate::model::{Dimension, Mesh};
use crate::ranks::Words;
use std::ops::Range;

/// Values of a node. Lanes 0 to 3: mass and momentum, after the solve mass and velocity; lanes 4 to 6: force, after the solve
/// the increment of velocity; lane 7 is spare. While particles are mapped in the plane, lanes 4 and 5 hold the force through
/// derivatives along the first axis, lanes 6 and 7 that through those along the second ([`join`](crate::stage::p2g::join)).
pub type Line = [f64; 8];

/// Ghost layers below the lower plane of each axis.
pub const GHOSTS_BELOW: usize = 1;
/// Ghost layers above the upper plane of each axis.
pub(crate) const GHOSTS_ABOVE: usize = 2;

/// Shape of the grid and its relation to the mesh.
#[derive(Clone, Debug)]
pub struct GridShape {
    /// Number of axes, 2 or 3.
    pub axes: usize,
    /// Cells of the mesh per axis of the scene.
    pub cells: [usize; 3],
    /// Edges of a cell \[m\].
    pub cell: [f64; 3],
    /// Nodes along the slow, the middle and the fast direction of storage, ghosts included.
    pub nodes: [usize; 3],
}

impl GridShape {
    /// Shape for a mesh.
    #[must_use]
    pub fn new(mesh: &Mesh, dimension: Dimension) -> Self {
        let axes = dimension.axes();
        let with_ghosts = |axis: usize| mesh.cells[axis] + 1 + GHOSTS_BELOW + GHOSTS_ABOVE;
        let nodes = match dimension {
            Dimension::Two => [with_ghosts(0), 1, with_ghosts(1)],
            Dimension::Three => [with_ghosts(0), with_ghosts(1), with_ghosts(2)],
        };
        Self {
            axes,
            cells: mesh.cells,
            cell: mesh.cell,
            nodes,
        }
    }

    /// Direction of storage of an axis of the scene: 0 slow, 1 middle, 2 fast.
    #[must_use]
    #[inline]
    pub fn direction(&self, axis: usize) -> usize {
        if self.axes == 2 && axis == 1 { 2 } else { axis }
    }

    /// Nodes in a plane of the slow axis.
    #[must_use]
    #[inline]
    pub fn plane_nodes(&self) -> usize {
        self.nodes[1] * self.nodes[2]
    }

    /// Index of the node at the storage indices.
    #[must_use]
    #[inline]
    pub fn index(&self, at: [usize; 3]) -> usize {
        (at[0] * self.nodes[1] + at[1]) * self.nodes[2] + at[2]
    }

    /// Storage indices of a node.
    #[must_use]
    #[inline]
    pub fn indices(&self, node: usize) -> [usize; 3] {
        let fast = node % self.nodes[2];
        let row = node / self.nodes[2];
        [row / self.nodes[1], row % self.nodes[1], fast]
    }

    /// Storage indices of the mesh node with the given index per axis (ghosts not counted).
    #[must_use]
    #[inline]
    pub fn mesh_node(&self, at: [usize; 3]) -> [usize; 3] {
        let mut storage = [0; 3];
        for axis in 0..self.axes {
            storage[self.direction(axis)] = at[axis] + GHOSTS_BELOW;
        }
        storage
    }

    /// True if a node lies in a plane of the mesh, 0 the lower, 1 the upper one of the axis.
    #[must_use]
    #[inline]
    pub fn lies_in_plane(&self, node: usize, axis: usize, side: usize) -> bool {
        self.indices(node)[self.direction(axis)] == GHOSTS_BELOW + side * self.cells[axis]
    }

    /// Position of a node relative to the mesh origin \[m\].
    #[must_use]
    #[inline]
    pub fn position(&self, node: usize) -> [f64; 3] {
        self.position_of(self.indices(node))
    }

    /// Position of the node at the storage indices, relative to the mesh origin \[m\].
    #[must_use]
    #[inline]
    pub fn position_of(&self, storage: [usize; 3]) -> [f64; 3] {
        let mut x = [0.0; 3];
        for axis in 0..self.axes {
            x[axis] =
                (storage[self.direction(axis)] as f64 - GHOSTS_BELOW as f64) * self.cell[axis];
        }
        x
    }

    /// Number of base positions per direction: a base node lies from the lower ghost to one below the upper
    /// plane.
    #[must_use]
    #[inline]
    pub fn bases(&self) -> [usize; 3] {
        let mut bases = [1; 3];
        for axis in 0..self.axes {
            bases[self.direction(axis)] = self.cells[axis] + 1;
        }
        bases
    }
}

/// Planes of nodes, and rows in each of them. Rows are never cut.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeBlock {
    pub planes: Range<usize>,
    pub rows: Range<usize>,
}

impl NodeBlock {
    /// All nodes of a grid.
    #[must_use]
    pub fn all(shape: &GridShape) -> Self {
        Self {
            planes: 0..shape.nodes[0],
            rows: 0..shape.nodes[1],
        }
    }

    /// True for a node by its storage indices.
    #[must_use]
    pub fn contains(&self, [plane, row, _]: [usize; 3]) -> bool {
        self.planes.contains(&plane) && self.rows.contains(&row)
    }
}

/// Values of all nodes.
///
/// The memory is zeroed by the operating system when first touched, so a mesh far larger than the bodies costs
/// address space only; it starts on a cache line, so that a node is one line.
#[derive(Debug)]
pub struct Nodes {
    data: Vec<f64>,
    offset: usize,
    count: usize,
}

impl Nodes {
    /// `count` nodes, all zero.
    #[must_use]
    #[inline]
    pub fn new(count: usize) -> Self {
        let data = vec![0.0; 8 * count + 8];
        let offset = data.as_ptr().align_offset(64).min(8);
        Self {
            data,
            offset,
            count,
        }
    }

    /// All nodes.
    #[must_use]
    #[inline]
    pub fn lines(&self) -> &[Line] {
        self.data[self.offset..self.offset + 8 * self.count]
            .as_chunks()
            .0
    }

    /// All nodes, to change.
    #[inline]
    pub fn lines_mut(&mut self) -> &mut [Line] {
        self.data[self.offset..self.offset + 8 * self.count]
            .as_chunks_mut()
            .0
    }
}

impl Clone for Nodes {
    /// A copy that starts on a cache line of its own memory.
    fn clone(&self) -> Self {
        let mut copy = Self::new(self.count);
        copy.lines_mut().copy_from_slice(self.lines());
        copy
    }
}

/// The part of each row (along the fast direction) that particles can reach until the next sort.
#[derive(Clone, Debug, Default)]
pub struct ActiveRows {
    spans: Vec<(u32, u32)>,
    rows_per_plane: usize,
    /// Rows of each plane before and after which all spans are empty.
    in_planes: Vec<(u32, u32)>,
    /// First and last base cell in use of each base row, while they are sought.
    pub(crate) occupied: Vec<Option<(u32, u32)>>,
    /// Rows that this process owns in each of its planes; all where there is none.
    owned: Option<Range<usize>>,
}

impl ActiveRows {
    /// The rows with spans from the occupied base spans of each base row, in place of those that it had.
    ///
    /// `occupied[slow * bases[1] + middle]` is the range of fast base indices in use, or `None`. A particle
    /// may cross one cell before the next sort, so the stencil of `stencil` nodes is widened by one each way.
    pub(crate) fn fill(
        &mut self,
        shape: &GridShape,
        occupied: &[Option<(u32, u32)>],
        stencil: usize,
    ) {
        let bases = shape.bases();
        let rows = shape.nodes[1];
        let spans = &mut self.spans;
        spans.clear();
        spans.resize(shape.nodes[0] * rows, (u32::MAX, 0));
        let reach =
            |base: usize, count: usize| base.saturating_sub(1)..(base + stencil + 1).min(count);
        for slow in 0..bases[0] {
            for middle in 0..bases[1] {
                let Some((low, high)) = occupied[slow * bases[1] + middle] else {
                    continue;
                };
                let low = low.saturating_sub(1);
                let high = (high + stencil as u32 + 1).min(shape.nodes[2] as u32);
                let middles = if shape.axes == 2 {
                    0..1
                } else {
                    reach(middle, rows)
                };
                for i in reach(slow, shape.nodes[0]) {
                    for j in middles.clone() {
                        let span = &mut spans[i * rows + j];
                        span.0 = span.0.min(low);
                        span.1 = span.1.max(high);
                    }
                }
            }
        }
        for span in &mut *spans {
            if span.0 >= span.1 {
                *span = (0, 0);
            }
        }
        self.rows_per_plane = rows;
        self.find_in_planes();
    }

    /// Finds the rows of each plane among which those with an active part are.
    fn find_in_planes(&mut self) {
        let owned = self.owned.clone();
        let in_plane = |spans: &[(u32, u32)]| {
            let in_use = |(low, high): &(u32, u32)| low < high;
            let first = spans.iter().position(in_use).unwrap_or(0);
            let last = spans.iter().rposition(in_use).map_or(first, |row| row + 1);
            let Some(owned) = &owned else {
                return (first as u32, last as u32);
            };
            let first = first.clamp(owned.start, owned.end);
            (first as u32, last.clamp(first, owned.end) as u32)
        };
        self.in_planes.clear();
        self.in_planes
            .extend(self.spans.chunks(self.rows_per_plane.max(1)).map(in_plane));
    }

    /// Owns these rows of each plane from here on, or all.
    pub(crate) fn own(&mut self, rows: Option<Range<usize>>) {
        if self.owned != rows {
            self.owned = rows;
            self.find_in_planes();
        }
    }

    /// True where other ranks own some rows of the planes.
    #[inline]
    #[must_use]
    pub fn is_cut(&self) -> bool {
        self.owned.is_some()
    }

    /// True for a row that this process owns.
    #[inline]
    #[must_use]
    pub fn owns(&self, row: usize) -> bool {
        self.owned.as_ref().is_none_or(|owned| owned.contains(&row))
    }

    /// Owned rows of a plane among which those with an active part are, however many the mesh has.
    #[inline]
    #[must_use]
    pub fn in_plane(&self, plane: usize) -> Range<usize> {
        let (first, last) = self.in_planes[plane];
        first as usize..last as usize
    }

    /// Indices of the active nodes, row by row.
    #[inline]
    pub fn nodes(&self, shape: &GridShape) -> impl Iterator<Item = Range<usize>> {
        self.nodes_of(0..shape.nodes[0], shape)
    }

    /// The same of some planes.
    #[inline]
    pub(crate) fn nodes_of(
        &self,
        planes: Range<usize>,
        shape: &GridShape,
    ) -> impl Iterator<Item = Range<usize>> {
        let all = planes.flat_map(|plane| self.in_plane(plane).map(move |row| (plane, row)));
        all.map(|(plane, row)| {
            let (first, span) = (shape.index([plane, row, 0]), self.span(plane, row));
            first + span.start..first + span.end
        })
    }

    /// Active part of the row in a plane; empty where no particle can reach.
    #[inline]
    #[must_use]
    pub fn span(&self, plane: usize, row: usize) -> Range<usize> {
        let (low, high) = self.spans[plane * self.rows_per_plane + row];
        low as usize..high as usize
    }

    /// Rows of which none has an active part.
    #[must_use]
    pub fn empty(&self, shape: &GridShape) -> Self {
        Self {
            spans: vec![(0, 0); shape.nodes[0] * self.rows_per_plane],
            rows_per_plane: self.rows_per_plane,
            in_planes: vec![(0, 0); shape.nodes[0]],
            occupied: vec![],
            owned: None,
        }
    }

    /// Widens the span of a row to hold `count` nodes from one of this index on.
    pub fn widen(&mut self, shape: &GridShape, node: usize, count: usize) {
        let [plane, row, first] = shape.indices(node);
        let (first, last) = (first as u32, (first + count) as u32);
        let span = &mut self.spans[plane * self.rows_per_plane + row];
        *span = if span.0 < span.1 {
            (span.0.min(first), span.1.max(last))
        } else {
            (first, last)
        };
        if !self.owns(row) {
            return;
        }
        let (first, last) = &mut self.in_planes[plane];
        let row = row as u32;
        (*first, *last) = if *first < *last {
            ((*first).min(row), (*last).max(row + 1))
        } else {
            (row, row + 1)
        };
    }

    /// Adds the spans of a block that this process owns to words: of each plane the rows in use, then two words for each of them.
    pub fn pack(&self, block: &NodeBlock, words: &mut Vec<u64>) {
        for plane in block.planes.clone() {
            let rows = self.in_plane(plane);
            words.extend([rows.start as u64, rows.end as u64]);
            for row in rows {
                let span = self.span(plane, row);
                words.extend([span.start as u64, span.end as u64]);
            }
        }
    }

    /// Takes up packed spans of some planes, where there were none.
    pub fn unpack(&mut self, planes: Range<usize>, words: &mut Words<'_>) {
        for plane in planes {
            let (first, last) = (words.count(), words.count());
            // Other ranks may own other rows of the plane.
            let (low, high) = &mut self.in_planes[plane];
            if first < last && *low < *high {
                (*low, *high) = ((*low).min(first as u32), (*high).max(last as u32));
            } else if first < last {
                (*low, *high) = (first as u32, last as u32);
            }
            for row in first..last {
                let span = (words.word() as u32, words.word() as u32);
                self.spans[plane * self.rows_per_plane + row] = span;
            }
        }
    }

    /// Number of nodes in all active spans.
    #[must_use]
    #[inline]
    pub fn count(&self) -> usize {
        self.spans
            .iter()
            .map(|(low, high)| (high - low) as usize)
            .sum()
    }
}
