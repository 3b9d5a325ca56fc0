//! The grid as the cycle uses it: velocity fields, their active rows, and slabs of planes that threads own.
//!
//! All fields are equal: each has mass, momentum and force at its nodes, and one equation of motion serves them all. The
//! first is that of the phase, which all bodies share that have none of their own. A body has a field of its own where
//! contact asks for it. Its memory is that of the nodes which the body touches; the rest is never committed, and goes back where
//! a body has left most of it. All fields are cut into the same slabs, so that whoever owns a slab owns all fields of its nodes.

mod slab_cut;
mod touched_nodes;

use crate::grid::{ActiveRows, GridShape, Line, NodeBlock, Nodes};
use crate::lanes::SelectedLanes;
use crate::particles::ParticleSet;
use crate::sorting::{Sorter, rows_of, starts_of_rows};
use crate::stage::solve::Planes;
use crate::team::Team;
use crate::weights::Family;
use slab_cut::{cut_into, work_of_planes};
use smallvec::SmallVec;
use std::ops::Range;
use std::sync::Arc;
use touched_nodes::TouchedNodes;

/// Planes of a slab from which on a thread gets several, so that an uneven share can move to an idle thread.
const THICK_SLAB: usize = 16;
/// Most slabs per thread.
const SLABS_PER_THREAD: usize = 3;
/// Fewest particles of a slab: to wake a thread takes as long as a step of some of them.
const LEAST_SHARE: usize = 2048;
/// Fields up to which a visit of the slabs takes no memory for its lists of them.
const FEW_FIELDS: usize = 4;
/// Shares of the particles per thread, where any cut will do.
const SHARES_PER_THREAD: usize = 8;

static ALONE: Team = Team::ALONE;

/// Owner of the velocities of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// All bodies without a field of their own.
    Phase,
    /// One body, by its index.
    Body(usize),
    /// The pore water of all bodies.
    Water,
}

impl Owner {
    /// The body, if it is one.
    #[must_use]
    #[inline]
    pub fn body(self) -> Option<usize> {
        match self {
            Self::Phase | Self::Water => None,
            Self::Body(index) => Some(index),
        }
    }
}

/// A velocity field of the grid.
#[derive(Clone, Debug)]
pub struct VelocityField {
    /// Owner of the field.
    pub owner: Owner,
    /// Values.
    pub nodes: Nodes,
    /// Rows in use, as of the last sort.
    pub rows: ActiveRows,
}

impl VelocityField {
    /// Mass at a node \[kg\]; zero outside the rows in use, where old values lie.
    #[must_use]
    #[inline]
    pub fn mass(&self, shape: &GridShape, node: usize) -> f64 {
        let [plane, row, k] = shape.indices(node);
        if self.rows.span(plane, row).contains(&k) {
            self.nodes.lines()[node][0]
        } else {
            0.0
        }
    }
}

/// Velocity fields with who owns which part of them.
#[derive(Debug)]
pub struct Grid {
    /// Shape of each field.
    pub shape: GridShape,
    /// The fields: that of the phase, those of bodies in order of their identifiers, then that of the pore water.
    pub fields: Vec<VelocityField>,
    /// Planes of each slab; together the planes that this process owns.
    pub slabs: Vec<Range<usize>>,
    /// Planes that this process owns: all, where no ranks share the simulation.
    pub owned: Range<usize>,
    /// Rows that it owns in each of them; all where there is none.
    owned_rows: Option<Range<usize>>,
    /// True where two fields share their velocity where they meet, by number, row by row.
    pub joined: Vec<bool>,
    /// Threads that share the slabs.
    pub team: Arc<Team>,
    /// True where bodies have water in their pores.
    pub has_water: bool,
    pub touched: TouchedNodes,
    least_share: usize,
    /// Sorter of the particles.
    pub sorter: Sorter,
    cutting: PlaneCounts,
}

/// Numbers of particles that begin in each plane, and work in it, while the planes are cut.
#[derive(Debug, Default)]
struct PlaneCounts {
    particles: Vec<usize>,
    work: Vec<usize>,
}

/// The part of a field that one visit owns.
pub struct SlabField<'a> {
    /// Owner of the field.
    pub owner: Owner,
    /// Nodes.
    pub planes: Planes<'a>,
}

/// All fields of the planes that one visit owns, known by their number in [`Grid::fields`].
pub struct Slab<'a> {
    /// The fields.
    pub fields: SmallVec<[SlabField<'a>; FEW_FIELDS]>,
    /// [`Grid::joined`].
    pub joined: &'a [bool],
}

impl<'a> Slab<'a> {
    /// Shape of the grid.
    #[must_use]
    #[inline]
    pub fn shape(&self) -> &'a GridShape {
        self.fields[0].planes.shape
    }

    /// Indices of the planes.
    #[must_use]
    #[inline]
    pub fn range(&self) -> Range<usize> {
        self.fields[0].planes.range.clone()
    }

    /// True for a row of nodes that this process owns.
    #[must_use]
    #[inline]
    pub fn owns_row(&self, row: usize) -> bool {
        self.fields[0].planes.rows.owns(row)
    }

    /// Number of the field of a body.
    #[must_use]
    #[inline]
    pub fn number_of(&self, body: usize) -> Option<usize> {
        let of_body = |field: &SlabField<'_>| field.owner == Owner::Body(body);
        self.fields.iter().position(of_body)
    }

    /// The planes of all fields.
    #[inline]
    pub fn planes(&mut self) -> impl Iterator<Item = &mut Planes<'a>> {
        self.fields.iter_mut().map(|field| &mut field.planes)
    }
}

impl Grid {
    /// A grid without particles.
    #[must_use]
    pub fn new(shape: GridShape, team: Arc<Team>, least_share: Option<usize>) -> Self {
        let owned = 0..shape.nodes[0];
        Self {
            fields: vec![VelocityField {
                owner: Owner::Phase,
                nodes: Nodes::new(shape.nodes.iter().product()),
                rows: ActiveRows::default(),
            }],
            slabs: std::iter::once(owned.clone()).collect(),
            owned,
            owned_rows: None,
            joined: vec![true],
            shape,
            team,
            has_water: false,
            touched: TouchedNodes::default(),
            least_share: least_share.unwrap_or(LEAST_SHARE).max(1),
            sorter: Sorter::default(),
            cutting: PlaneCounts::default(),
        }
    }

    /// Sorts the particles, of which functions of a family reach so many nodes per axis, and cuts the planes into slabs of about equal numbers of particles.
    pub fn sort(&mut self, sets: &mut [ParticleSet], reach: (Family, usize), lanes: SelectedLanes) {
        let particles = sets.iter().map(ParticleSet::len).sum::<usize>();
        let team = if particles < 2 * self.least_share {
            &ALONE
        } else {
            &*self.team
        };
        let rows = &mut self.fields[0].rows;
        (self.sorter).sort(sets, &self.shape, reach, lanes, team, rows);
        for set in &mut *sets {
            set.rows.clear();
            if self.owned_rows.is_some() {
                set.rows = starts_of_rows(set, &self.shape, reach);
            }
        }
        if self.touched.add(rows, &self.shape) {
            for field in &mut self.fields {
                // Old memory first.
                field.nodes = Nodes::new(0);
                field.nodes = Nodes::new(self.shape.nodes.iter().product());
            }
        }
        self.cut(sets);
    }

    /// Owns these planes and rows from here on, and cuts the planes into slabs.
    pub fn own(&mut self, block: NodeBlock, sets: &[ParticleSet]) {
        self.set_owned(block);
        self.cut(sets);
    }

    /// Owns these planes and rows from the next sort on.
    pub fn set_owned(&mut self, NodeBlock { planes, rows }: NodeBlock) {
        self.owned = planes;
        self.owned_rows = (rows != (0..self.shape.nodes[1])).then_some(rows);
        for field in &mut self.fields {
            field.rows.own(self.owned_rows.clone());
        }
    }

    /// True where other ranks own some rows of the planes.
    #[must_use]
    pub fn shares_rows(&self) -> bool {
        self.owned_rows.is_some()
    }

    /// The planes and rows that this process owns.
    #[must_use]
    pub fn block(&self) -> NodeBlock {
        let all = 0..self.shape.nodes[1];
        NodeBlock {
            planes: self.owned.clone(),
            rows: self.owned_rows.clone().unwrap_or(all),
        }
    }

    /// Takes up sets in the order in which they are, after a restart.
    #[inline]
    pub fn resume(&mut self, sets: &[ParticleSet], stencil: usize) {
        let rows = &mut self.fields[0].rows;
        rows_of(sets, &self.shape, stencil, rows);
        self.cut(sets);
    }

    /// Makes fields for exactly these bodies (indices in order of the identifier) beside that of the phase, with rows for where
    /// their particles are now.
    pub fn set_owners(&mut self, bodies: &[usize], sets: &[ParticleSet], stencil: usize) {
        let owners = self.fields[1..].iter().map(|field| field.owner);
        let water = self.has_water.then_some(Owner::Water);
        let wanted = bodies.iter().map(|&body| Owner::Body(body)).chain(water);
        if owners.eq(wanted) {
            for field in &mut self.fields[1..] {
                let own = field.owner.body().map_or(sets, |body| &sets[body..=body]);
                rows_of(own, &self.shape, stencil, &mut field.rows);
            }
            return;
        }
        let phase = (Owner::Phase, std::mem::take(&mut self.fields[0].rows));
        let of_body = |&body| {
            let mut rows = ActiveRows::default();
            rows.own(self.owned_rows.clone());
            rows_of(&sets[body..=body], &self.shape, stencil, &mut rows);
            (Owner::Body(body), rows)
        };
        let mut of_bodies: Vec<_> = bodies.iter().map(of_body).collect();
        of_bodies.extend(water.map(|water| (water, phase.1.clone())));
        let before = self.fields.len();
        self.set_rows(std::iter::once(phase).chain(of_bodies).collect());
        if (before > 1) != (self.fields.len() > 1) {
            self.cut(sets);
        }
    }

    /// Owners of the fields, and their rows in use.
    #[must_use]
    #[inline]
    pub fn rows(&self) -> Vec<(Owner, ActiveRows)> {
        let fields = self.fields.iter();
        fields.map(|f| (f.owner, f.rows.clone())).collect()
    }

    /// Makes these fields again.
    pub fn set_rows(&mut self, rows: Vec<(Owner, ActiveRows)>) {
        let mut old = std::mem::take(&mut self.fields);
        for (owner, rows) in rows {
            let known = old.iter().position(|field| field.owner == owner);
            let nodes = match known {
                Some(at) => old.swap_remove(at).nodes,
                None => Nodes::new(self.shape.nodes.iter().product()),
            };
            self.fields.push(VelocityField { owner, nodes, rows });
        }
    }

    /// Owned nodes with mass of the fields of bodies that move freely, with their index, field by field and row by row; `driven` says of a
    /// body whether its motion is prescribed.
    pub fn free_nodes(
        &self,
        driven: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = (usize, &Line)> {
        let free = move |field: &VelocityField| {
            field.owner != Owner::Water && !field.owner.body().is_some_and(&driven)
        };
        let numbers = (0..self.fields.len()).filter(move |number| free(&self.fields[*number]));
        self.nodes_of(numbers)
    }

    /// The same of the pore water.
    pub fn water_nodes(&self) -> impl Iterator<Item = (usize, &Line)> {
        let numbers = 0..self.fields.len();
        self.nodes_of(numbers.filter(|number| self.fields[*number].owner == Owner::Water))
    }

    /// Nodes with mass of the fields of these numbers.
    fn nodes_of(
        &self,
        numbers: impl Iterator<Item = usize>,
    ) -> impl Iterator<Item = (usize, &Line)> {
        numbers.flat_map(|number| {
            let lines = self.fields[number].nodes.lines();
            let rows = &self.fields[number].rows;
            let nodes = rows.nodes_of(self.owned.clone(), &self.shape).flatten();
            nodes
                .map(|node| (node, &lines[node]))
                .filter(|(_, line)| line[0] > 0.0)
        })
    }

    /// Number of the field in which a body moves.
    #[must_use]
    #[inline]
    pub fn number_of(&self, body: usize) -> usize {
        let of_body = |field: &VelocityField| field.owner == Owner::Body(body);
        self.fields.iter().position(of_body).unwrap_or(0)
    }

    /// The field of a body alone, if it has one.
    #[must_use]
    #[inline]
    pub fn own_field(&self, body: usize) -> Option<&VelocityField> {
        let number = self.number_of(body);
        (number > 0).then(|| &self.fields[number])
    }

    /// Threads that share the particles: the caller alone where they are too few to be worth a second thread.
    #[must_use]
    #[inline]
    pub fn team_of_particles(&self) -> &Team {
        if self.slabs.len() == 1 {
            &ALONE
        } else {
            &self.team
        }
    }

    /// Most particles that one thread takes at once in a pass over particles, of so many.
    #[must_use]
    #[inline]
    pub fn share_of_particles(&self, particles: usize) -> usize {
        if self.slabs.len() == 1 {
            return particles;
        }
        let shares = self.team.count() * SHARES_PER_THREAD;
        particles.div_ceil(shares).max(self.least_share.div_ceil(4))
    }

    /// Cuts the planes that this process owns into slabs of which the largest is as small as can be.
    fn cut(&mut self, sets: &[ParticleSet]) {
        let threads = self.team.count();
        let of_plane = |plane: usize| -> usize {
            let sets = sets.iter();
            sets.map(|set| set.in_layers(plane..plane + 1).len()).sum()
        };
        let PlaneCounts { particles, work } = &mut self.cutting;
        particles.clear();
        if threads > 1 {
            particles.extend(self.owned.clone().map(of_plane));
        }
        let total: usize = particles.iter().sum();
        let in_use = particles.iter().filter(|count| **count > 0).count();
        // Where bodies may meet, some planes have more to do than others.
        let of_thread = if self.fields.len() > 1 {
            SLABS_PER_THREAD
        } else {
            (in_use / (threads * THICK_SLAB)).clamp(1, SLABS_PER_THREAD)
        };
        let most = (threads * of_thread).min(total / self.least_share);
        self.slabs.clear();
        if threads == 1 || most <= 1 {
            self.slabs.push(self.owned.clone());
        } else {
            work.clear();
            work.extend(work_of_planes(particles));
            cut_into(work, most, &mut self.slabs);
            for slab in &mut self.slabs {
                *slab = self.owned.start + slab.start..self.owned.start + slab.end;
            }
        }
    }

    /// Calls `act` for every slab with all its fields, shared out among the team.
    #[inline]
    pub fn visit(&mut self, act: impl Fn(Slab<'_>) + Send + Sync) {
        self.visit_with(std::iter::repeat(()), |slab, ()| act(slab));
    }

    /// The same, where each slab brings something along, which also takes what it gives.
    pub fn visit_with<P>(
        &mut self,
        parts: impl Iterator<Item = P> + Send,
        act: impl Fn(Slab<'_>, P) + Send + Sync,
    ) {
        let per_plane = self.shape.plane_nodes();
        let (shape, joined) = (&self.shape, &self.joined[..]);
        let before = self.owned.start * per_plane;
        let fields = self.fields.iter_mut();
        let mut rest: SmallVec<[_; FEW_FIELDS]> = fields
            .map(|field| {
                let lines = field.nodes.lines_mut();
                (field.owner, &field.rows, &mut lines[before..])
            })
            .collect();
        let slabs = self.slabs.iter().map(move |range| {
            let fields = rest.iter_mut().map(|(owner, rows, rest)| SlabField {
                owner: *owner,
                planes: Planes {
                    shape,
                    rows,
                    range: range.clone(),
                    nodes: rest
                        .split_off_mut(..range.len() * per_plane)
                        .unwrap_or_default(),
                },
            });
            let fields = fields.collect();
            Slab { fields, joined }
        });
        self.team
            .each(slabs.zip(parts), |(slab, part)| act(slab, part));
    }
}

/// `count` particles in shares of about the same size, `most` at most.
#[must_use]
pub fn shares(count: usize, most: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    let shares = count.div_ceil(most.max(1)).max(1);
    (0..shares).map(move |share| count * share / shares..count * (share + 1) / shares)
}
