//! The whole of a shared simulation on the first rank, for files and measures.

use super::packed::{pack, take_up_received};
use super::{Share, exchange};
use crate::grid::{ActiveRows, NodeBlock};
use crate::particles::ParticleSet;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::interactions::Interaction;
use crate::simulation::values::NodalForce;
use std::any::Any;

/// The part of the first rank, while it has the whole simulation.
pub struct OwnPart {
    share: Share,
    sets: Vec<ParticleSet>,
    /// Rows in use of each field.
    rows: Vec<ActiveRows>,
    /// Memory of each interaction, for the own particles.
    scratch: Vec<Option<Box<dyn Any + Send + Sync>>>,
}

impl Cycle {
    /// Gathers the whole simulation on the first rank, where it is then that of one process: until the part that is given back
    /// is put back ([`Cycle::put_back`]), no step may be taken there. Elsewhere, and where no ranks share the simulation, it
    /// stays as it is and `None` comes back. All ranks call this at the same time.
    #[must_use]
    pub fn gather(&mut self) -> Option<OwnPart> {
        let share = self.work.share.as_ref()?;
        let first = share.rank() == 0;
        let forces = self.nodal_forces_of_ranks()?;
        let mut parts = vec![vec![]; share.ranks.count()];
        parts[0] = self.pack_part(share);
        let received = share.ranks.all_to_all(parts);
        if !first {
            return None;
        }
        let share = self.work.share.take()?;
        Some(self.take_up(share, &received, forces, false))
    }

    /// Gathers the whole simulation on each rank; the part that this one had.
    pub(super) fn gather_everywhere(&mut self) -> Option<Share> {
        let share = self.work.share.as_ref()?;
        let forces = self.nodal_forces_of_ranks()?;
        let received = share.ranks.all_gather(&self.pack_part(share));
        let share = self.work.share.take()?;
        // The next step cuts the rows as the last sort found them.
        let keeps_rows = share.cut.cuts_rows() && !share.cut.waits();
        Some(self.take_up(share, &received, forces, keeps_rows).share)
    }

    /// The particles and nodes that a rank owns, as words.
    fn pack_part(&self, share: &Share) -> Vec<u64> {
        let block = share.block();
        let mut words = vec![];
        for set in &self.state.sets {
            let own: Vec<usize> = self.own_particles(set).iter().collect();
            pack(set, &own, &self.work.grid.shape, &mut words);
        }
        for field in &self.work.grid.fields {
            field.rows.pack(&block, &mut words);
        }
        words.extend(exchange::pack(&self.work.grid, &block));
        words
    }

    /// Takes up the parts of all ranks, with the rows of particles or without; the own part as it was.
    fn take_up(
        &mut self,
        share: Share,
        received: &[Vec<u64>],
        forces: Vec<NodalForce>,
        keeps_rows: bool,
    ) -> OwnPart {
        let whole = self.state.sets.iter().map(ParticleSet::without_particles);
        let whole = whole.collect();
        let sets = std::mem::replace(&mut self.state.sets, whole);
        let grid = &mut self.work.grid;
        let fields = grid.fields.iter_mut();
        let rows = fields.map(|field| {
            let whole = field.rows.empty(&grid.shape);
            std::mem::replace(&mut field.rows, whole)
        });
        let rows = rows.collect();
        let mut received: Vec<Words<'_>> = received.iter().map(|words| Words::of(words)).collect();
        for set in &mut self.state.sets {
            take_up_received(set, &mut received, keeps_rows, &grid.shape);
        }
        for (rank, words) in received.iter_mut().enumerate() {
            for field in &mut grid.fields {
                field.rows.unpack(share.cut.block(rank).planes, words);
            }
            exchange::unpack(grid, words.rest());
        }
        grid.own(NodeBlock::all(&grid.shape), &self.state.sets);
        self.work.forces_of_ranks = Some(forces);
        let interactions = self.work.interactions.iter_mut();
        let scratch = interactions.map(|one| one.take_scratch()).collect();
        self.each(Interaction::fields_given);
        OwnPart {
            share,
            sets,
            rows,
            scratch,
        }
    }

    /// Gives the first rank its part again, after [`Cycle::gather`].
    pub fn put_back(&mut self, part: OwnPart) {
        let OwnPart {
            share,
            sets,
            rows,
            scratch,
        } = part;
        self.state.sets = sets;
        let grid = &mut self.work.grid;
        for (field, rows) in grid.fields.iter_mut().zip(rows) {
            field.rows = rows;
        }
        grid.own(share.block(), &self.state.sets);
        self.work.share = Some(share);
        self.work.forces_of_ranks = None;
        for (one, scratch) in self.work.interactions.iter_mut().zip(scratch) {
            if let Some(scratch) = scratch {
                one.give_scratch(scratch);
            }
        }
    }

    /// The forces of contact at the nodes of all ranks, in the order in which one process has those of a node; `None` where no ranks
    /// share the simulation. A rank keeps those that it found, also where a sort since has given the nodes to another.
    pub(in crate::simulation) fn nodal_forces_of_ranks(&self) -> Option<Vec<NodalForce>> {
        let ranks = self.ranks()?;
        let mut forces = vec![];
        for one in self.interactions() {
            let mut words = vec![0];
            // Each rank knows all forces of what acts across ranks.
            let knows_all = one.settles_across_ranks();
            one.nodal_forces(&self.work.grid, &mut |one| {
                if knows_all && !self.owns(one.node) {
                    return;
                }
                words[0] += 1;
                let [x, y, z] = one.force;
                words.extend([one.body as u64, one.node as u64]);
                words.extend([x, y, z, one.gap].map(f64::to_bits));
            });
            for words in ranks.all_gather(&words) {
                unpack_nodal_forces(&mut Words::of(&words), &mut forces);
            }
        }
        Some(forces)
    }
}

/// Appends packed forces at nodes.
fn unpack_nodal_forces(words: &mut Words<'_>, forces: &mut Vec<NodalForce>) {
    let count = words.count();
    forces.extend((0..count).map(|_| NodalForce {
        body: words.count(),
        node: words.count(),
        force: [(); 3].map(|()| words.number()),
        gap: words.number(),
    }));
}
