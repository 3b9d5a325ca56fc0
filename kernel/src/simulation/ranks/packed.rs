//! Particles in messages, and those of several ranks in the order in which one process has them.
//!
//! A sort keeps the order of particles within a cell, so that a bit may depend on the order before it: that of the base rows of
//! the last sort, and in a row that of the rank that owns it. Particles so travel with their base rows.

use crate::grid::GridShape;
use crate::particles::ParticleSet;
use crate::ranks::Words;
use std::ops::Range;

/// Particles with one base row at the last sort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowCount {
    /// Number of the row among those of all layers.
    pub(super) row: usize,
    /// Number of particles.
    pub(super) count: usize,
}

/// Particles of a set that one rank has packed, or that stay here.
pub(super) struct PackedParticles<'a> {
    rows: Vec<RowCount>,
    values: Values<'a>,
}

/// Identifiers and columns.
enum Values<'a> {
    Words {
        ids: &'a [u64],
        columns: Vec<&'a [u64]>,
    },
    /// Places in the set.
    Here(&'a [usize]),
}

impl<'a> PackedParticles<'a> {
    /// Reads what [`pack`] wrote.
    pub(super) fn read(words: &mut Words<'a>, columns: usize) -> Self {
        let rows = words.count();
        let rows = words.take(2 * rows).as_chunks().0.iter();
        let rows = rows.map(|&[row, count]| RowCount {
            row: row as usize,
            count: count as usize,
        });
        let rows: Vec<RowCount> = rows.collect();
        let count = rows.iter().map(|one| one.count).sum();
        Self {
            rows,
            values: Values::Words {
                ids: words.take(count),
                columns: (0..columns).map(|_| words.take(count)).collect(),
            },
        }
    }

    /// Particles of a set that stay in it.
    pub(super) fn that_stay(set: &ParticleSet, places: &'a [usize], shape: &GridShape) -> Self {
        Self {
            rows: rows_of(set, places, shape),
            values: Values::Here(places),
        }
    }

    /// Identifiers of those that come from another rank.
    pub(super) fn ids(&self) -> &'a [u64] {
        match self.values {
            Values::Words { ids, .. } => ids,
            Values::Here(_) => &[],
        }
    }
}

/// Base rows of some particles of a set, whose places increase.
fn rows_of(set: &ParticleSet, places: &[usize], shape: &GridShape) -> Vec<RowCount> {
    let mut rows: Vec<RowCount> = vec![];
    // The particles of the last row end here.
    let mut end = 0;
    for &p in places {
        match rows.last_mut() {
            Some(last) if p < end => last.count += 1,
            _ => {
                let row = set.base_row(p, shape);
                end = set.end_of_base_row(row, shape);
                rows.push(RowCount { row, count: 1 });
            }
        }
    }
    rows
}

/// Adds some particles of a set to words, whose places increase: their base rows, their identifiers, then column by column.
pub(super) fn pack(set: &ParticleSet, places: &[usize], shape: &GridShape, words: &mut Vec<u64>) {
    let rows = rows_of(set, places, shape);
    words.reserve(1 + 2 * rows.len() + places.len() * (1 + set.columns.len()));
    words.push(rows.len() as u64);
    words.extend(
        rows.iter()
            .flat_map(|one| [one.row, one.count].map(|word| word as u64)),
    );
    words.extend(places.iter().map(|&p| set.id[p]));
    for column in &set.columns {
        words.extend(places.iter().map(|&p| column[p].to_bits()));
    }
}

/// Puts the particles of all ranks, which come in their order, in the place of those of a set: by base row, column by column, so that no
/// column is there twice but one. Their rows.
pub(super) fn take_up(set: &mut ParticleSet, parts: &[PackedParticles<'_>]) -> Vec<RowCount> {
    // Rows of all parts with the part and the places in it.
    let mut pieces: Vec<(usize, usize, Range<usize>)> = vec![];
    for (number, part) in parts.iter().enumerate() {
        let mut start = 0;
        for one in &part.rows {
            pieces.push((one.row, number, start..start + one.count));
            start += one.count;
        }
    }
    // A row has one owner, and before the first sort ranks have bodies one after the other.
    pieces.sort_by_key(|(row, ..)| *row);
    let count = pieces.iter().map(|(.., places)| places.len()).sum();
    let mut id = Vec::with_capacity(count);
    for (_, number, places) in &pieces {
        match &parts[*number].values {
            Values::Words { ids, .. } => id.extend_from_slice(&ids[places.clone()]),
            Values::Here(here) => id.extend(here[places.clone()].iter().map(|&p| set.id[p])),
        }
    }
    set.id = id;
    for (c, column) in set.columns.iter_mut().enumerate() {
        let mut all = Vec::with_capacity(count);
        for (_, number, places) in &pieces {
            match &parts[*number].values {
                Values::Words { columns, .. } => {
                    let words = columns[c][places.clone()].iter();
                    all.extend(words.map(|&word| f64::from_bits(word)));
                }
                Values::Here(here) => all.extend(here[places.clone()].iter().map(|&p| column[p])),
            }
        }
        *column = all;
    }
    let rows = pieces.into_iter();
    rows.map(|(row, _, places)| RowCount {
        row,
        count: places.len(),
    })
    .collect()
}

/// Puts the packed particles of a set that ranks sent, in their order, in its place, with the rows of particles or without.
pub(super) fn take_up_received(
    set: &mut ParticleSet,
    received: &mut [Words<'_>],
    keeps_rows: bool,
    shape: &GridShape,
) {
    let columns = set.columns.len();
    let parts = received.iter_mut();
    let parts: Vec<_> = parts
        .map(|words| PackedParticles::read(words, columns))
        .collect();
    let rows = take_up(set, &parts);
    let rows = rows.iter().map(|one| (one.row, one.count));
    set.set_rows(rows, keeps_rows, shape);
}

/// Appends packed particles to a set.
pub(super) fn append(set: &mut ParticleSet, words: &mut Words<'_>) {
    let part = PackedParticles::read(words, set.columns.len());
    if let Values::Words { ids, columns } = part.values {
        set.id.extend_from_slice(ids);
        for (column, words) in set.columns.iter_mut().zip(columns) {
            column.extend(words.iter().map(|&word| f64::from_bits(word)));
        }
    }
}
