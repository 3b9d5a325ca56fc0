//! Sums over the nodes of all slabs of all ranks.

use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::stage::solve::{EmptyNode, ExactStepSums, StepSums};

/// Word for no node.
const NO_NODE: u64 = u64::MAX;

/// Result of the equation of motion on all slabs of all ranks.
pub(in crate::simulation) struct SolvedSlabs {
    /// Groups of particles with a base node in common.
    pub(in crate::simulation) groups: usize,
    /// The first node without mass that a load acts on.
    pub(in crate::simulation) empty: Option<EmptyNode>,
    /// Sums over the nodes.
    pub(in crate::simulation) sums: StepSums,
}

impl Cycle {
    /// The result of the equation of motion, from that of each slab.
    pub(in crate::simulation) fn join_slabs(&self) -> SolvedSlabs {
        let slabs = &self.work.solved;
        let groups = slabs.iter().map(|slab| slab.groups).sum();
        let empty = slabs.iter().find_map(|slab| slab.empty);
        let of_slabs = slabs.iter().map(|slab| &slab.sums);
        let Some(ranks) = self.ranks() else {
            return SolvedSlabs {
                groups,
                empty,
                sums: sum_of(of_slabs),
            };
        };
        let mut words = vec![groups as u64, empty.map_or(NO_NODE, |empty| empty.0 as u64)];
        pack_sums(of_slabs, &mut words);
        let (mut all_groups, mut first) = (0, NO_NODE);
        let mut sums = ExactStepSums::default();
        for of_rank in ranks.all_gather(&words) {
            let mut words = Words::of(&of_rank);
            all_groups += words.count();
            first = first.min(words.word());
            sums.merge_packed(words.rest());
        }
        SolvedSlabs {
            groups: all_groups,
            empty: (first != NO_NODE).then_some(EmptyNode(first as usize)),
            sums: sums.value(),
        }
    }

    /// The sums over the nodes of all slabs, and of all ranks.
    pub(in crate::simulation) fn join_step_sums<'a>(
        &self,
        slabs: impl Iterator<Item = &'a ExactStepSums>,
    ) -> StepSums {
        let Some(ranks) = self.ranks() else {
            return sum_of(slabs);
        };
        let mut words = vec![];
        pack_sums(slabs, &mut words);
        let mut sums = ExactStepSums::default();
        for of_rank in ranks.all_gather(&words) {
            sums.merge_packed(&of_rank);
        }
        sums.value()
    }
}

/// The sums of some slabs together.
fn sum_of<'a>(mut slabs: impl Iterator<Item = &'a ExactStepSums>) -> StepSums {
    let Some(first) = slabs.next() else {
        return StepSums::default();
    };
    let Some(second) = slabs.next() else {
        return first.value();
    };
    let mut all = first.clone();
    std::iter::once(second)
        .chain(slabs)
        .for_each(|one| all.merge(one));
    all.value()
}

/// Adds the sums of some slabs to words.
fn pack_sums<'a>(slabs: impl Iterator<Item = &'a ExactStepSums>, words: &mut Vec<u64>) {
    let mut all = ExactStepSums::default();
    slabs.for_each(|one| all.merge(one));
    all.pack(words);
}
