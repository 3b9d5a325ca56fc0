//! Particle state: one set per body, in columns, in order of base cell.

use crate::layout::Layout;
use crate::team::Team;
use smallvec::SmallVec;
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
    pub(crate) fn sort_by_position(&mut self, team: &Team) {
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

    /// Reorders all columns: particle `order[i]` becomes particle `i`.
    fn permute(&mut self, order: &[u32], team: &Team) {
        let columns = std::mem::take(&mut self.columns);
        self.columns = team.map(columns, |column| {
            order.iter().map(|&p| column[p as usize]).collect()
        });
        self.id = order.iter().map(|&p| self.id[p as usize]).collect();
    }

    /// Removes the particles at the given increasing indices.
    pub(crate) fn remove(&mut self, gone: &[usize], team: &Team) {
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

    /// A set of the same columns without particles.
    pub(crate) fn without_particles(&self) -> Self {
        Self {
            layout: self.layout,
            id: vec![],
            columns: vec![vec![]; self.columns.len()],
            layers: vec![],
        }
    }

    /// Keeps the particles of some base layers alone, as of the last sort.
    pub(crate) fn keep_layers(&mut self, layers: Range<usize>) {
        let kept = self.in_layers(layers);
        for column in &mut self.columns {
            column.truncate(kept.end);
            column.drain(..kept.start);
        }
        self.id.truncate(kept.end);
        self.id.drain(..kept.start);
        for start in &mut self.layers {
            *start = (*start).clamp(kept.start, kept.end) - kept.start;
        }
    }

    /// All columns at the given increasing particle ranges, which must not overlap.
    pub(crate) fn parts_mut(
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

/// Internal variables of a particle.
pub(crate) type Variables = SmallVec<[f64; 16]>;

/// Columns of some particles.
pub type Columns<'a> = SmallVec<[&'a mut [f64]; 48]>;
