//! Particle state: one set per body, in columns, in order of base cell.

use crate::grid::{ActiveRows, GridShape};
use crate::layout::Layout;
use crate::team::Team;
use crate::weights::base_node;
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
}

impl ParticleSet {
    /// A set of `count` particles: internal variables as their law wants them, all other columns zero.
    #[must_use]
    pub fn zeros(layout: Layout, first_id: u64, count: usize) -> Self {
        let mut set = Self {
            layout,
            id: (first_id..first_id + count as u64).collect(),
            columns: vec![vec![0.0; count]; layout.columns],
            layers: vec![],
        };
        for (variable, _, column) in layout.components() {
            set.columns[column].fill(variable.initial);
        }
        set
    }

    /// The internal variables of a particle, component after component.
    #[must_use]
    pub fn variables(&self, p: usize) -> Vec<f64> {
        (self.columns[self.layout.variables..].iter())
            .map(|column| column[p])
            .collect()
    }

    /// The column of an internal variable by its name (with the number of the component where there are several), a value
    /// for each particle in the order of [`ParticleSet::id`]; `None` where the law has no such variable.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        (self.layout.components())
            .find(|(variable, i, _)| variable.component(*i) == name)
            .map(|(_, _, column)| self.columns[column].as_slice())
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is no particle.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// A vector of a particle, from `axes` columns; the missing third component is zero.
    #[must_use]
    pub fn vector(&self, first_column: usize, p: usize) -> [f64; 3] {
        let mut v = [0.0; 3];
        for axis in 0..self.layout.axes {
            v[axis] = self.columns[first_column + axis][p];
        }
        v
    }

    /// Position of a particle relative to the mesh origin \[m\].
    #[must_use]
    pub fn position(&self, p: usize) -> [f64; 3] {
        self.vector(Layout::POSITION, p)
    }

    /// Velocity of a particle \[m/s\].
    #[must_use]
    pub fn velocity(&self, p: usize) -> [f64; 3] {
        self.vector(Layout::velocity(self.layout.axes), p)
    }

    /// Cauchy stress of a particle \[Pa\]: xx, yy, zz, yz, xz, xy.
    #[must_use]
    pub fn stress(&self, p: usize) -> [f64; 6] {
        let s = |i: usize| self.columns[Layout::stress(self.layout.axes) + i][p];
        if self.layout.axes == 2 {
            [s(0), s(1), s(2), 0.0, 0.0, s(3)]
        } else {
            [s(0), s(1), s(2), s(3), s(4), s(5)]
        }
    }

    /// Particles of the base layers `layers`, as of the last sort.
    #[must_use]
    pub fn in_layers(&self, layers: Range<usize>) -> Range<usize> {
        let last = self.layers.len() - 1;
        self.layers[layers.start.min(last)]..self.layers[layers.end.min(last)]
    }

    /// Sorts by base cell for a stencil of `stencil` nodes, keeping the order within a cell, and widens
    /// `occupied` (see [`ActiveRows::new`]) by the cells in use.
    pub fn sort(
        &mut self,
        shape: &GridShape,
        stencil: usize,
        occupied: &mut [Option<(u32, u32)>],
        team: &Team,
    ) {
        let bases = shape.bases();
        let keys = self.base_keys(shape, stencil, team);
        occupy(&keys, bases[2], occupied);
        if !keys.is_sorted() {
            let order = stable_order(&keys, bases.iter().product(), team);
            self.permute(&order, team);
        }
        // Keys in sorted order are needed for the layers only; a layer is all keys below a bound.
        let per_layer = bases[1] * bases[2];
        let mut layers = vec![0_usize; bases[0] + 1];
        for &key in &keys {
            layers[key as usize / per_layer + 1] += 1;
        }
        for layer in 0..bases[0] {
            layers[layer + 1] += layers[layer];
        }
        self.layers = layers;
    }

    /// Puts the particles in an order that depends on their positions alone, not on the order in which they
    /// were given.
    pub fn sort_by_position(&mut self, team: &Team) {
        let axes = self.layout.axes;
        let mut order: Vec<u32> = (0..self.len() as u32).collect();
        team.sort_by(&mut order, |&a, &b| {
            (0..axes)
                .map(|axis| {
                    let x = &self.columns[Layout::POSITION + axis];
                    x[a as usize].total_cmp(&x[b as usize])
                })
                .find(|o| o.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        if !order.is_sorted() {
            self.permute(&order, team);
        }
    }

    /// Base cell of each particle as one number, slow axis first.
    fn base_keys(&self, shape: &GridShape, stencil: usize, team: &Team) -> Vec<u32> {
        let numbering = Numbering::new(shape, stencil);
        team.collect(0..self.len(), |p| numbering.key(self, p))
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
        for start in &mut self.layers {
            *start -= gone.partition_point(|p| *p < *start);
        }
    }

    /// Splits all columns at the given increasing particle ranges, which must not overlap.
    pub fn split_mut(&mut self, ranges: &[Range<usize>]) -> Vec<Vec<&mut [f64]>> {
        let mut parts: Vec<Vec<&mut [f64]>> = ranges
            .iter()
            .map(|_| Vec::with_capacity(self.layout.columns))
            .collect();
        for column in &mut self.columns {
            let mut rest = column.as_mut_slice();
            let mut at = 0;
            for (part, range) in parts.iter_mut().zip(ranges) {
                let (_, tail) = rest.split_at_mut(range.start - at);
                let (own, tail) = tail.split_at_mut(range.end - range.start);
                part.push(own);
                rest = tail;
                at = range.end;
            }
        }
        parts
    }
}

/// How base cells are numbered: what is the same for all particles.
struct Numbering {
    /// Cells per metre along each axis.
    per_metre: [f64; 3],
    /// What one cell along each axis adds to the number.
    strides: [usize; 3],
    stencil: usize,
}

impl Numbering {
    fn new(shape: &GridShape, stencil: usize) -> Self {
        let bases = shape.bases();
        let of_direction = [bases[1] * bases[2], bases[2], 1];
        Self {
            per_metre: std::array::from_fn(|axis| 1.0 / shape.cell[axis]),
            strides: std::array::from_fn(|axis| of_direction[shape.direction(axis)]),
            stencil,
        }
    }

    /// Base cell of a particle as one number, slow axis first.
    #[inline]
    fn key(&self, set: &ParticleSet, p: usize) -> u32 {
        let mut key = 0;
        for axis in 0..set.layout.axes {
            let xi = set.columns[Layout::POSITION + axis][p] * self.per_metre[axis];
            key += (base_node(xi, self.stencil) + 1.0) as usize * self.strides[axis];
        }
        key as u32
    }
}

/// Widens the occupied spans of base rows by the given base cells.
fn occupy(keys: &[u32], bases_per_row: usize, occupied: &mut [Option<(u32, u32)>]) {
    for &key in keys {
        let (row, fast) = (
            key as usize / bases_per_row,
            (key as usize % bases_per_row) as u32,
        );
        let span = occupied[row].get_or_insert((fast, fast));
        span.0 = span.0.min(fast);
        span.1 = span.1.max(fast);
    }
}

/// Indices in stable order of their keys (counting sort), keys below `bound`.
fn stable_order(keys: &[u32], bound: usize, team: &Team) -> Vec<u32> {
    // Counting is linear while the cells are not far more than the particles; an empty giant mesh is not.
    if bound > 8 * keys.len() + 1024 {
        let mut order: Vec<u32> = (0..keys.len() as u32).collect();
        team.sort_by(&mut order, |&a, &b| keys[a as usize].cmp(&keys[b as usize]));
        return order;
    }
    let mut next = vec![0_u32; bound + 1];
    for &key in keys {
        next[key as usize + 1] += 1;
    }
    for key in 0..bound {
        next[key + 1] += next[key];
    }
    let mut order = vec![0_u32; keys.len()];
    for (p, &key) in keys.iter().enumerate() {
        let slot = &mut next[key as usize];
        order[*slot as usize] = p as u32;
        *slot += 1;
    }
    order
}

/// Sorts all sets and returns the active rows.
pub fn sort_sets(
    sets: &mut [ParticleSet],
    shape: &GridShape,
    stencil: usize,
    team: &Team,
) -> ActiveRows {
    let bases = shape.bases();
    let mut occupied = vec![None; bases[0] * bases[1]];
    for set in sets {
        set.sort(shape, stencil, &mut occupied, team);
    }
    ActiveRows::new(shape, &occupied, stencil)
}

/// The active rows of sets that are not to be sorted now, after a restart. Their particles may cross less than
/// one cell before the next sort, so the rows of their present cells serve as well as those of the last sort.
#[must_use]
pub fn rows_of(sets: &[ParticleSet], shape: &GridShape, stencil: usize, team: &Team) -> ActiveRows {
    let bases = shape.bases();
    let mut occupied = vec![None; bases[0] * bases[1]];
    for set in sets {
        let keys = set.base_keys(shape, stencil, team);
        occupy(&keys, bases[2], &mut occupied);
    }
    ActiveRows::new(shape, &occupied, stencil)
}

/// The rows that some particles of a set can reach before the next sort.
#[must_use]
pub fn rows_of_some(
    set: &ParticleSet,
    particles: impl Iterator<Item = usize>,
    shape: &GridShape,
    stencil: usize,
) -> ActiveRows {
    let bases = shape.bases();
    let mut occupied = vec![None; bases[0] * bases[1]];
    let numbering = Numbering::new(shape, stencil);
    let keys: Vec<u32> = particles.map(|p| numbering.key(set, p)).collect();
    occupy(&keys, bases[2], &mut occupied);
    ActiveRows::new(shape, &occupied, stencil)
}
