//! Results of contact on all slabs: those of this process, and those of all ranks that share the simulation.

use super::SlabContactState;
use super::contact_nodes::{
    ContactResult, ContactStatus, ContactStatuses, NodeTunnelling, Overlap, RowForce,
};
use proctor_kernel::model::Vector;
use proctor_kernel::ranks::{Ranks, Words};

/// Results of contact on all slabs of a step, in order of their planes.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactSums {
    /// Force on the slave of each pair \[N\].
    pub forces: Vec<Vector>,
    /// Nodes where a contact force acts.
    pub nodes: usize,
    /// The node where a pair approaches by most over its distance of contact in one step, if by more than that.
    pub tunnelling: Option<NodeTunnelling>,
    /// Deepest place of overlap of each pair, if it is deep.
    pub overlaps: Vec<Option<Overlap>>,
}

impl ContactSums {
    /// Sums of so many pairs that do nothing.
    pub(super) fn of_pairs(pairs: usize) -> Self {
        let mut sums = Self::default();
        sums.clear(pairs);
        sums
    }

    fn clear(&mut self, pairs: usize) {
        self.forces.clear();
        self.forces.resize(pairs, [0.0; 3]);
        self.overlaps.clear();
        self.overlaps.resize(pairs, None);
        (self.nodes, self.tunnelling) = (0, None);
    }

    /// Adds forces of rows that follow.
    fn add_forces(&mut self, forces: &[RowForce]) {
        for one in forces {
            let sum = &mut self.forces[one.pair];
            for axis in 0..3 {
                sum[axis] += one.force[axis];
            }
        }
    }

    /// Adds the results of nodes that follow, but for the forces.
    fn add(&mut self, result: &ContactResult) {
        self.nodes += result.nodes;
        if let Some(at) = result.tunnelling {
            let worst = self.tunnelling;
            let worse = worst.is_none_or(|w| at.approach * w.distance > w.approach * at.distance);
            self.tunnelling = if worse { Some(at) } else { worst };
        }
        for (deepest, found) in self.overlaps.iter_mut().zip(&result.overlaps) {
            if let Some(found) = found
                && deepest.is_none_or(|deepest| found.depth > deepest.depth)
            {
                *deepest = Some(*found);
            }
        }
    }

    /// Adds up the results of all slabs, and of all ranks.
    pub(super) fn sum(
        &mut self,
        pairs: usize,
        slabs: &[SlabContactState],
        ranks: Option<&dyn Ranks>,
    ) {
        self.clear(pairs);
        for slab in slabs {
            self.add(&slab.done);
            self.add_forces(&slab.done.forces);
        }
        let Some(ranks) = ranks else { return };
        let own = self.pack(slabs);
        self.clear(pairs);
        let mut forces = vec![];
        for words in ranks.all_gather(&own) {
            let result = unpack(pairs, &words);
            self.add(&result);
            forces.extend(result.forces);
        }
        // Each rank has its rows in order.
        forces.sort_by_key(|one| one.row);
        self.add_forces(&forces);
    }

    /// Own results as words: the nodes, the tunnelling, the overlap of each pair, then the forces row by row.
    fn pack(&self, slabs: &[SlabContactState]) -> Vec<u64> {
        let mut words = vec![self.nodes as u64];
        words.push(u64::from(self.tunnelling.is_some()));
        if let Some(one) = self.tunnelling {
            words.push(one.pair as u64);
            words.extend(one.at.map(|index| index as u64));
            words.extend([one.approach, one.distance].map(f64::to_bits));
        }
        for overlap in &self.overlaps {
            words.push(u64::from(overlap.is_some()));
            if let Some(one) = overlap {
                words.extend(one.at.map(|index| index as u64));
                words.push(one.depth.to_bits());
            }
        }
        for slab in slabs {
            for one in &slab.done.forces {
                words.extend([one.row, one.pair].map(|index| index as u64));
                words.extend(one.force.map(f64::to_bits));
            }
        }
        words
    }
}

/// Results of a rank from its words.
fn unpack(pairs: usize, words: &[u64]) -> ContactResult {
    let mut words = Words::of(words);
    let mut result = ContactResult {
        nodes: words.count(),
        ..ContactResult::default()
    };
    if words.word() != 0 {
        result.tunnelling = Some(NodeTunnelling {
            pair: words.count(),
            at: [(); 3].map(|()| words.count()),
            approach: words.number(),
            distance: words.number(),
        });
    }
    for _ in 0..pairs {
        let overlap = (words.word() != 0).then(|| Overlap {
            at: [(); 3].map(|()| words.count()),
            depth: words.number(),
        });
        result.overlaps.push(overlap);
    }
    let (forces, _) = words.rest().as_chunks::<5>();
    result
        .forces
        .extend(forces.iter().map(|&[row, pair, x, y, z]| RowForce {
            row: row as usize,
            pair: pair as usize,
            force: [x, y, z].map(f64::from_bits),
        }));
    result
}

/// Contact statuses at the nodes of all ranks.
pub(super) fn statuses_of_all(slabs: &[SlabContactState], ranks: &dyn Ranks) -> ContactStatuses {
    let own = slabs.iter().flat_map(|slab| slab.meetings.states());
    let words: Vec<u64> = own
        .flat_map(|((node, pair), status)| {
            let slides = u64::from(status == ContactStatus::Slides);
            [node as u64, pair as u64, slides]
        })
        .collect();
    let mut all = ContactStatuses::new();
    for words in ranks.all_gather(&words) {
        all.extend(words.as_chunks().0.iter().map(|&[node, pair, slides]| {
            let status = if slides == 0 {
                ContactStatus::Sticks
            } else {
                ContactStatus::Slides
            };
            ((node as usize, pair as usize), status)
        }));
    }
    // Ranks that share rows have nodes between those of each other.
    all.sort_unstable_by_key(|(place, _)| *place);
    all
}
