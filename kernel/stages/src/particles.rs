//! Particle state: one set per body, in columns, in order of base cell.

use crate::grid::{GridShape, NodeBlock};
use crate::layout::Layout;
use crate::team::Team;
use smallvec::SmallVec;
use std::cmp::Ordering;
use std::ops::Range;

/// The particles of one body.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleSet {
    /// Columns and where they are.
    pub layout: Layout,
    /// Identifiers, unique over the scene.
    pub id: Vec<u64>,
    /// State, one vector per column.
    pub columns: Vec<Vec<f64>>,
    /// First particle of each base layer along the slow axis, as of the last sort, and the number of
    /// particles.
    pub layers: Vec<usize>,
    /// First particle of each base row, layer by layer, as of the last sort, and the number of particles; empty where no ranks
    /// share rows.
    pub rows: Vec<usize>,
}

/// Particles of a set that a process owns, in their order.
#[derive(Clone, Debug)]
pub struct OwnParticles(SmallVec<[Range<usize>; 1]>);

impl OwnParticles {
    /// All particles of a set of so many.
    #[must_use]
    pub fn all(count: usize) -> Self {
        std::iter::once(0..count).collect()
    }

    /// Their places.
    pub fn iter(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.0.iter().cloned().flatten()
    }

    /// Their places, as ranges that increase.
    #[must_use]
    pub fn ranges(&self) -> &[Range<usize>] {
        &self.0
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.iter().map(ExactSizeIterator::len).sum()
    }

    /// True if there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True for the place of one of them.
    #[must_use]
    #[inline]
    pub fn contains(&self, p: usize) -> bool {
        let behind = self.0.partition_point(|range| range.start <= p);
        behind > 0 && self.0[behind - 1].contains(&p)
    }

    /// From the first to the last of them.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        match (self.0.first(), self.0.last()) {
            (Some(first), Some(last)) => first.start..last.end,
            _ => 0..0,
        }
    }
}

impl FromIterator<Range<usize>> for OwnParticles {
    fn from_iter<I: IntoIterator<Item = Range<usize>>>(ranges: I) -> Self {
        Self(
            ranges
                .into_iter()
                .filter(|range| !range.is_empty())
                .collect(),
        )
    }
}

impl ParticleSet {
    /// A set of `count` particles: internal variables as their law wants them, all other columns zero.
    #[must_use]
    pub fn zeros(layout: Layout, first_id: u64, count: usize) -> Self {
        Self::of_columns(layout, first_id, count, vec![])
    }

    /// A set of `count` particles with the first columns given; of those that follow, internal variables are as their law wants
    /// them, all others zero.
    #[must_use]
    pub fn of_columns(
        layout: Layout,
        first_id: u64,
        count: usize,
        mut columns: Vec<Vec<f64>>,
    ) -> Self {
        columns.resize(layout.columns, vec![0.0; count]);
        let mut set = Self {
            layout,
            id: (first_id..first_id + count as u64).collect(),
            columns,
            layers: vec![],
            rows: vec![],
        };
        for (variable, _, column) in layout.components() {
            set.columns[column].fill(variable.initial);
        }
        set
    }

    /// The internal variables of a particle, component after component.
    #[must_use]
    #[inline]
    pub fn variables(&self, p: usize) -> Variables {
        (self.columns[self.layout.variables..].iter())
            .map(|column| column[p])
            .collect()
    }

    /// The column of an internal variable by its name (with the number of the component where there are several), a value
    /// for each particle in the order of [`ParticleSet::id`]; `None` where the law has no such variable.
    #[must_use]
    #[inline]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        (self.layout.components())
            .find(|(variable, i, _)| match variable.components {
                // Without a text: a step may ask.
                1 => variable.name == name,
                _ => variable.component(*i) == name,
            })
            .map(|(_, _, column)| self.columns[column].as_slice())
    }

    /// Number of particles.
    #[must_use]
    #[inline]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// True if there is no particle.
    #[must_use]
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// A vector of a particle, from `axes` columns; the missing third component is zero.
    #[inline]
    #[must_use]
    pub fn vector(&self, first_column: usize, p: usize) -> [f64; 3] {
        let mut v = [0.0; 3];
        for axis in 0..self.layout.axes {
            v[axis] = self.columns[first_column + axis][p];
        }
        v
    }

    /// Position of a particle relative to the mesh origin \[m\].
    #[inline]
    #[must_use]
    pub fn position(&self, p: usize) -> [f64; 3] {
        self.vector(Layout::POSITION, p)
    }

    /// Velocity of a particle \[m/s\].
    #[inline]
    #[must_use]
    pub fn velocity(&self, p: usize) -> [f64; 3] {
        self.vector(Layout::velocity(self.layout.axes), p)
    }

    /// Cauchy stress of a particle \[Pa\]: xx, yy, zz, yz, xz, xy.
    #[inline(always)]
    #[must_use]
    pub fn stress(&self, p: usize) -> [f64; 6] {
        let s = |i: usize| self.columns[Layout::stress(self.layout.axes) + i][p];
        if self.layout.axes == 2 {
            [s(0), s(1), s(2), 0.0, 0.0, s(3)]
        } else {
            [s(0), s(1), s(2), s(3), s(4), s(5)]
        }
    }

    /// Deformation gradient of a particle, where its law keeps one.
    #[inline(always)]
    #[must_use]
    pub fn deformation(&self, p: usize) -> Option<[[f64; 3]; 3]> {
        let first = self.layout.deformation?;
        let axes = self.layout.axes;
        let mut f = [[0.0; 3]; 3];
        f[2][2] = 1.0;
        for a in 0..axes {
            for b in 0..axes {
                f[a][b] = self.columns[first + a * axes + b][p];
            }
        }
        if let Some(hoop) = self.layout.hoop_stretch() {
            f[2][2] = self.columns[hoop][p];
        }
        Some(f)
    }

    /// Particles of the base layers `layers`, as of the last sort.
    #[must_use]
    #[inline]
    pub fn in_layers(&self, layers: Range<usize>) -> Range<usize> {
        let last = self.layers.len() - 1;
        self.layers[layers.start.min(last)]..self.layers[layers.end.min(last)]
    }

    /// Puts the particles in an order that depends on their positions alone, not on the order in which they
    /// were given.
    pub fn sort_by_position(&mut self, team: &Team) {
        let axes = self.layout.axes;
        let x = &self.columns[Layout::POSITION..Layout::POSITION + axes];
        // Coordinates compare by their bits: two are equal only if these are.
        let compare = |a: usize, b: usize| {
            let differ = (x.iter().map(|x| (x[a], x[b])))
                .find(|(one, other)| one.to_bits() != other.to_bits());
            differ.map_or(Ordering::Equal, |(one, other)| one.total_cmp(&other))
        };
        // Shapes are filled in this order.
        if (1..self.len()).all(|p| compare(p - 1, p).is_le()) {
            return;
        }
        let mut order: Vec<u32> = (0..self.len() as u32).collect();
        team.sort_by(&mut order, |&a, &b| compare(a as usize, b as usize));
        self.permute(&order, team);
    }

    /// Reorders all columns: particle `order[i]` becomes particle `i`.
    fn permute(&mut self, order: &[u32], team: &Team) {
        let columns = std::mem::take(&mut self.columns);
        self.columns = team.map(columns, |column| {
            order.iter().map(|&p| column[p as usize]).collect()
        });
        self.id = order.iter().map(|&p| self.id[p as usize]).collect();
    }

    /// Removes the particles at the given increasing indices.
    pub fn remove(&mut self, gone: &[usize], team: &Team) {
        let keep: Vec<u32> = (0..self.len())
            .filter(|p| gone.binary_search(p).is_err())
            .map(|p| p as u32)
            .collect();
        self.permute(&keep, team);
        // Each layer begins earlier by the number of particles that were removed before it.
        for start in self.layers.iter_mut().chain(&mut self.rows) {
            *start -= gone.partition_point(|p| *p < *start);
        }
    }

    /// A set of the same columns without particles.
    #[must_use]
    pub fn without_particles(&self) -> Self {
        Self {
            layout: self.layout,
            id: vec![],
            columns: vec![vec![]; self.columns.len()],
            layers: vec![],
            rows: vec![],
        }
    }

    /// Particles of the base layers and rows of a block, as of the last sort. Without rows all particles of a layer are in the
    /// first of them.
    #[must_use]
    pub fn in_block(
        &self,
        NodeBlock { planes, rows }: &NodeBlock,
        shape: &GridShape,
    ) -> OwnParticles {
        let per_layer = shape.bases()[1];
        let rows = rows.start.min(per_layer)..rows.end.min(per_layer);
        if rows.is_empty() {
            return OwnParticles::from_iter([]);
        }
        if rows == (0..per_layer) {
            return OwnParticles::from_iter([self.in_layers(planes.clone())]);
        }
        let layers = self.layers.len() - 1;
        let planes = planes.start.min(layers)..planes.end.min(layers);
        if self.rows.is_empty() {
            let whole = if rows.start == 0 { planes } else { 0..0 };
            return OwnParticles::from_iter([self.in_layers(whole)]);
        }
        let start = |layer: usize, row: usize| self.rows[layer * per_layer + row];
        planes
            .map(|layer| start(layer, rows.start)..start(layer, rows.end))
            .collect()
    }

    /// Number of the base row of a particle among those of all layers, as of the last sort.
    #[must_use]
    pub fn base_row(&self, p: usize, shape: &GridShape) -> usize {
        if self.rows.is_empty() {
            (self.layers.partition_point(|start| *start <= p) - 1) * shape.bases()[1]
        } else {
            self.rows.partition_point(|start| *start <= p) - 1
        }
    }

    /// First particle behind a base row, by its number among those of all layers, as of the last sort.
    #[must_use]
    pub fn end_of_base_row(&self, row: usize, shape: &GridShape) -> usize {
        if self.rows.is_empty() {
            self.layers[row / shape.bases()[1] + 1]
        } else {
            self.rows[row + 1]
        }
    }

    /// Knows the particles of each base row, from those that have any, in their order, and where asked for the rows themselves.
    pub fn set_rows(
        &mut self,
        in_rows: impl Iterator<Item = (usize, usize)>,
        keeps_rows: bool,
        shape: &GridShape,
    ) {
        let [layers, per_layer, _] = shape.bases();
        let mut rows = vec![];
        let mut before = 0;
        for (row, count) in in_rows {
            rows.resize(row + 1, before);
            before += count;
        }
        rows.resize(layers * per_layer + 1, before);
        self.layers = rows.iter().copied().step_by(per_layer).collect();
        self.rows = if keeps_rows { rows } else { vec![] };
    }

    /// Takes the first particle of each base layer, and the number of particles, as another process has found them.
    pub fn set_layers(&mut self, layers: Vec<usize>) {
        self.layers = layers;
        // Its rows are not known.
        self.rows.clear();
    }

    /// Keeps some particles alone.
    pub fn keep(&mut self, kept: &OwnParticles) {
        let of = |starts: &mut Vec<usize>| {
            // Kept particles before a place.
            let (mut before, mut ranges) = (0, kept.ranges().iter().peekable());
            for start in starts {
                while let Some(range) = ranges.next_if(|range| range.end <= *start) {
                    before += range.len();
                }
                let begun = ranges
                    .peek()
                    .map_or(0, |range| start.saturating_sub(range.start));
                *start = before + begun;
            }
        };
        of(&mut self.layers);
        of(&mut self.rows);
        for column in &mut self.columns {
            keep_ranges(column, kept.ranges());
        }
        keep_ranges(&mut self.id, kept.ranges());
    }

    /// All columns at the given increasing particle ranges, which must not overlap.
    pub fn parts_mut(
        &mut self,
        ranges: impl Iterator<Item = Range<usize>>,
    ) -> impl Iterator<Item = (Range<usize>, Columns<'_>)> {
        let mut rest: Columns<'_> = self.columns.iter_mut().map(Vec::as_mut_slice).collect();
        let mut at = 0;
        ranges.map(move |range| {
            let own = rest.iter_mut().map(|rest| {
                let own = rest.split_off_mut(..range.end - at).unwrap_or_default();
                &mut own[range.start - at..]
            });
            let own = own.collect();
            at = range.end;
            (range, own)
        })
    }
}

/// Keeps some ranges of a list, which increase.
fn keep_ranges<T: Copy>(list: &mut Vec<T>, ranges: &[Range<usize>]) {
    let mut count = 0;
    for range in ranges {
        list.copy_within(range.clone(), count);
        count += range.len();
    }
    list.truncate(count);
}

/// Internal variables of a particle.
pub(crate) type Variables = SmallVec<[f64; 16]>;

/// Columns of some particles.
pub type Columns<'a> = SmallVec<[&'a mut [f64]; 48]>;
