//! Sorting of particles by base cell.
//!
//! A stable counting sort. Threads own ranges of cells, not of particles: each looks at all keys and counts, then places,
//! those of its own cells, so that what it writes is one piece, and the order is that of one thread. Columns are reordered in
//! place, by way of a window of old values that each thread keeps: particles travel a cell at most between two sorts, so that
//! none comes from farther than a layer or two. Once its lists have grown to the particles, a sort takes no memory.

mod cells;

use crate::grid::{ActiveRows, GridShape};
use crate::lanes::SelectedLanes;
use crate::particles::ParticleSet;
use crate::team::Team;
use crate::weights::{Family, base_offset};
use cells::{CellNumbers, Cells, Numbering};
use smallvec::SmallVec;
use std::ops::Range;

/// Cells per particle up to which counting them all is cheaper than comparing keys, and cells that are always counted.
const COUNTED_CELLS: [usize; 2] = [8, 1024];
/// Values of a column that are kept, and replaced, at once; a power of two.
const PIECE: usize = 1 << 7;
/// Values that are compared at once.
const COMPARED: usize = 64;

/// Sorts particles, and keeps what it needs for that from one sort to the next.
#[derive(Debug, Default)]
pub struct Sorter {
    /// Number of the base cell of each particle.
    keys: Vec<u32>,
    /// Index of the particle that comes to each place.
    order: Vec<u32>,
    /// End of the particles of each cell in the order.
    ends: Vec<u32>,
    /// First and last cell in use of each row of base cells.
    occupied: Vec<Option<(u32, u32)>>,
    windows: Windows,
}

/// Old values of columns around the places that are filled now.
#[derive(Debug, Default)]
struct Windows {
    /// One for each thread.
    columns: Vec<Vec<f64>>,
    ids: Vec<u64>,
}

/// Cells that a thread owns: their numbers, and the particles that it found in them.
struct CellShare<'a> {
    cells: Range<usize>,
    ends: &'a mut [u32],
    /// Number of particles.
    count: u32,
}

/// A list of something for each thread, which takes no memory where they are few.
type ThreadList<T> = SmallVec<[T; 16]>;

impl Sorter {
    /// Sorts all sets by base cell for functions of a family that reach `stencil` nodes per axis, keeping the order within a
    /// cell; `rows` then are those of nodes that particles can reach until they have crossed one cell.
    pub fn sort(
        &mut self,
        sets: &mut [ParticleSet],
        shape: &GridShape,
        (family, stencil): (Family, usize),
        lanes: SelectedLanes,
        team: &Team,
        rows: &mut ActiveRows,
    ) {
        let bases = shape.bases();
        self.occupied.clear();
        self.occupied.resize(bases[0] * bases[1], None);
        let offset = family.sort_offset(stencil);
        for set in sets {
            let cells = Cells::in_use(set, shape, offset, lanes, team);
            self.number(set, &Numbering::new(shape, offset, &cells), lanes, team);
            let sorted = self.keys.is_sorted();
            let [per_particle, always] = COUNTED_CELLS;
            if cells.count.iter().product::<usize>() <= per_particle * set.len() + always {
                self.count(set, bases, &cells, sorted, team);
            } else {
                self.compare(set, bases, &cells, sorted, team);
            }
            if !sorted {
                permute(set, &self.order, &mut self.windows, team);
            }
        }
        rows.fill(shape, &self.occupied, stencil);
    }

    /// Frees the lists of particles, and returns how many they had room for.
    pub fn free_lists(&mut self) -> usize {
        let room = self.keys.capacity().max(self.order.capacity());
        (self.keys, self.order) = (vec![], vec![]);
        room
    }

    /// Takes memory for lists of so many particles.
    pub fn reserve_lists(&mut self, particles: usize) {
        self.keys.reserve(particles);
        self.order.reserve(particles);
    }

    /// Numbers the particles of a set by their base cells.
    fn number(
        &mut self,
        set: &ParticleSet,
        numbering: &Numbering,
        lanes: SelectedLanes,
        team: &Team,
    ) {
        self.keys.resize(set.len(), 0);
        let share = set.len().div_ceil(team.count()).max(1);
        team.each(self.keys.chunks_mut(share).enumerate(), |(part, keys)| {
            lanes.run(CellNumbers {
                numbering,
                set,
                start: part * share,
                keys,
            });
        });
    }

    /// Orders the particles by counting those of each cell. Cells few enough for that are walked without regard to how many
    /// are empty.
    fn count(
        &mut self,
        set: &mut ParticleSet,
        bases: [usize; 3],
        Cells { first, count }: &Cells,
        sorted: bool,
        team: &Team,
    ) {
        let per_layer = count[1] * count[2];
        self.ends.clear();
        self.ends.resize(count[0] * per_layer, 0);
        self.order.resize(set.len(), 0);
        let mut shares = ThreadList::new();
        let mut rest = self.ends.as_mut_slice();
        for layers in shares_of_layers(set, bases[0], team.count()) {
            let place = |layer: usize| layer.clamp(first[0], first[0] + count[0]) - first[0];
            let cells = place(layers.start) * per_layer..place(layers.end) * per_layer;
            let (ends, behind) = rest.split_at_mut(cells.len());
            shares.push(CellShare {
                cells,
                ends,
                count: 0,
            });
            rest = behind;
        }
        let keys = self.keys.as_slice();
        team.each(shares.iter_mut(), |share| {
            for &key in keys {
                // A cell before the first of the share is beyond its last, too.
                if let Some(cell) = share
                    .ends
                    .get_mut((key as usize).wrapping_sub(share.cells.start))
                {
                    *cell += 1;
                    share.count += 1;
                }
            }
        });
        let mut rest = self.order.as_mut_slice();
        let mut before = 0;
        let placed = shares.iter_mut().map(|share| {
            let (own, behind) = std::mem::take(&mut rest).split_at_mut(share.count as usize);
            let start = before;
            rest = behind;
            before += share.count;
            (share, own, start)
        });
        team.each(placed, |(share, places, start)| {
            if sorted {
                let mut end = start;
                for cell in &mut *share.ends {
                    end += *cell;
                    *cell = end;
                }
                return;
            }
            let mut next = start;
            for cell in &mut *share.ends {
                next += std::mem::replace(cell, next);
            }
            for (p, &key) in keys.iter().enumerate() {
                if let Some(cell) = share
                    .ends
                    .get_mut((key as usize).wrapping_sub(share.cells.start))
                {
                    places[(*cell - start) as usize] = p as u32;
                    *cell += 1;
                }
            }
        });
        drop(shares);
        let ends = self.ends.as_slice();
        let mut before = 0;
        for (row, ends) in ends.chunks(count[2]).enumerate() {
            let last = ends[count[2] - 1];
            if last > before {
                let cell = |fast: usize| (first[2] + fast) as u32;
                let low = cell(ends.partition_point(|&end| end == before));
                let high = cell(ends.partition_point(|&end| end < last));
                let (slow, middle) = (first[0] + row / count[1], first[1] + row % count[1]);
                widen(&mut self.occupied[slow * bases[1] + middle], low, high);
            }
            before = last;
        }
        set.layers.clear();
        set.layers.resize(first[0] + 1, 0);
        let layers = ends.chunks(per_layer).map(|layer| layer[per_layer - 1]);
        set.layers.extend(layers.map(|end| end as usize));
        set.layers.resize(bases[0] + 1, set.id.len());
    }

    /// Orders the particles by comparing their keys, where nearly all cells of a mesh are empty.
    fn compare(
        &mut self,
        set: &mut ParticleSet,
        bases: [usize; 3],
        Cells { first, count }: &Cells,
        sorted: bool,
        team: &Team,
    ) {
        let keys = self.keys.as_slice();
        self.order.clear();
        self.order.extend(0..set.len() as u32);
        if !sorted {
            team.sort_by(&mut self.order, |&a, &b| {
                keys[a as usize].cmp(&keys[b as usize])
            });
        }
        let mut at = 0;
        set.layers.clear();
        set.layers.push(0);
        for layer in 0..bases[0] {
            while let Some(&p) = self.order.get(at) {
                let (row, fast) = (
                    keys[p as usize] as usize / count[2],
                    keys[p as usize] as usize % count[2],
                );
                let (slow, middle) = (first[0] + row / count[1], first[1] + row % count[1]);
                if slow > layer {
                    break;
                }
                let fast = (first[2] + fast) as u32;
                widen(&mut self.occupied[slow * bases[1] + middle], fast, fast);
                at += 1;
            }
            set.layers.push(at);
        }
    }
}

/// The layers of base cells in `count` ranges at most, with about equal numbers of particles as of the last sort.
fn shares_of_layers(set: &ParticleSet, layers: usize, count: usize) -> ThreadList<Range<usize>> {
    let known = set.layers.len() == layers + 1 && set.layers[layers] == set.len();
    let end_of = |share: usize| match (share == count, known) {
        (true, _) => layers,
        (_, true) => (set.layers).partition_point(|&start| start * count < share * set.len()),
        (_, false) => share * layers / count,
    };
    let mut from = 0;
    let mut shares = ThreadList::new();
    for share in 1..=count {
        let to = end_of(share).clamp(from, layers);
        shares.push(from..to);
        from = to;
    }
    shares
}

/// Widens the first and last cell in use of a row to hold those from `low` to `high`, too.
fn widen(span: &mut Option<(u32, u32)>, low: u32, high: u32) {
    let span = span.get_or_insert((low, high));
    span.0 = span.0.min(low);
    span.1 = span.1.max(high);
}

/// Reorders all columns: particle `order[i]` becomes particle `i`.
fn permute(set: &mut ParticleSet, order: &[u32], windows: &mut Windows, team: &Team) {
    // The identifiers are one column more, and those of the last share are fewest.
    let share = (set.columns.len() + 1).div_ceil(team.count()).max(1);
    windows.columns.resize_with(team.count(), Vec::new);
    let last = set.columns.len().div_ceil(share) - 1;
    let mut ids = Some((&mut set.id, &mut windows.ids));
    let parts = set.columns.chunks_mut(share).zip(&mut windows.columns);
    let parts = (parts.enumerate())
        .map(|(number, part)| (part, if number == last { ids.take() } else { None }));
    let places = (0..).zip(order);
    let reach = places.map(|(place, &p): (u32, _)| place.abs_diff(p)).max();
    let reach = reach.unwrap_or(0) as usize;
    team.each(parts, |((columns, window), ids)| {
        for column in columns {
            if !has_one_value(column) {
                gather(column, order, reach, window);
            }
        }
        if let Some((ids, window)) = ids {
            gather(ids, order, reach, window);
        }
    });
}

/// True if all values of a column have the same bits, as masses mostly do, and most columns at the start: it has no order.
fn has_one_value(column: &[f64]) -> bool {
    let first = column.first().map_or(0, |x| x.to_bits());
    // Without a branch for each value.
    column.chunks(COMPARED).all(|some| {
        let bits = some.iter().map(|x| x.to_bits() ^ first);
        bits.fold(0, |any, bits| any | bits) == 0
    })
}

/// Reorders a column in place, where no value comes from farther than `reach` places.
fn gather<T: Copy + Default>(column: &mut [T], order: &[u32], reach: usize, window: &mut Vec<T>) {
    let count = column.len();
    // Old values from `reach` places before a piece to as many behind it, each where the low bits of its place say; or all.
    let ring = (2 * (reach + PIECE)).next_power_of_two();
    let (length, low_bits) = if ring < count {
        (ring, ring - 1)
    } else {
        (count, usize::MAX)
    };
    window.resize(window.len().max(length), T::default());
    let window = &mut window[..length];
    let mut kept = 0;
    for (piece, order) in order.chunks(PIECE).enumerate() {
        let start = piece * PIECE;
        let end = start + order.len();
        while kept < count.min(end + reach) {
            let old = &column[kept..count.min(kept + PIECE)];
            window[kept & low_bits..][..old.len()].copy_from_slice(old);
            kept += old.len();
        }
        let from = |p: u32| window[p as usize & low_bits];
        // Four at once: of one at a time a third of the instructions are those of the loop.
        let (fours, rest) = column[start..end].as_chunks_mut::<4>();
        let (order, order_of_rest) = order.as_chunks::<4>();
        for (values, order) in fours.iter_mut().zip(order) {
            *values = order.map(from);
        }
        for (value, &p) in rest.iter_mut().zip(order_of_rest) {
            *value = from(p);
        }
    }
}

/// Numbers of the base rows, among those of all layers, in which a sort would find some particles of a set now.
pub fn rows_now(
    set: &ParticleSet,
    particles: impl Iterator<Item = usize>,
    shape: &GridShape,
    (family, stencil): (Family, usize),
) -> Vec<usize> {
    let [.., fast] = shape.bases();
    let numbering = Numbering::new(shape, family.sort_offset(stencil), &Cells::all(shape));
    let row = |p| numbering.key(set, p) as usize / fast;
    particles.map(row).collect()
}

/// The first particle of each base row of all layers, and the number of particles, of a set that was sorted now.
pub(crate) fn starts_of_rows(
    set: &ParticleSet,
    shape: &GridShape,
    reach: (Family, usize),
) -> Vec<usize> {
    let [layers, rows, _] = shape.bases();
    let mut starts = Vec::with_capacity(layers * rows + 1);
    for (p, row) in rows_now(set, 0..set.len(), shape, reach)
        .into_iter()
        .enumerate()
    {
        starts.resize(starts.len().max(row + 1), p);
    }
    starts.resize(layers * rows + 1, set.len());
    starts
}

/// Finds the active rows of sets that are not to be sorted now, after a restart. Their particles may cross less than
/// one cell before the next sort, so the rows of their present cells serve as well as those of the last sort.
pub fn rows_of(sets: &[ParticleSet], shape: &GridShape, stencil: usize, rows: &mut ActiveRows) {
    let numbering = Numbering::new(shape, base_offset(stencil), &Cells::all(shape));
    let keys = sets.iter().flat_map(|set| {
        let numbering = &numbering;
        (0..set.len()).map(move |p| numbering.key(set, p))
    });
    rows_of_keys(keys, shape, stencil, rows);
}

/// Finds the rows that some particles of a set can reach before the next sort.
pub fn rows_of_some(
    set: &ParticleSet,
    particles: impl Iterator<Item = usize>,
    shape: &GridShape,
    stencil: usize,
    rows: &mut ActiveRows,
) {
    let numbering = Numbering::new(shape, base_offset(stencil), &Cells::all(shape));
    let keys = particles.map(|p| numbering.key(set, p));
    rows_of_keys(keys, shape, stencil, rows);
}

fn rows_of_keys(
    keys: impl Iterator<Item = u32>,
    shape: &GridShape,
    stencil: usize,
    rows: &mut ActiveRows,
) {
    let bases = shape.bases();
    let mut occupied = std::mem::take(&mut rows.occupied);
    occupied.clear();
    occupied.resize(bases[0] * bases[1], None);
    let mut before = None;
    for key in keys {
        // Of sorted particles most have the cell of the one before.
        if before.replace(key) == Some(key) {
            continue;
        }
        let (row, fast) = (key as usize / bases[2], (key as usize % bases[2]) as u32);
        widen(&mut occupied[row], fast, fast);
    }
    rows.fill(shape, &occupied, stencil);
    rows.occupied = occupied;
}
