//! Numbers at nodes of boundary planes, which every rank keeps for all nodes: each comes from the rank that owns the node.

use crate::ranks::Words;
use crate::simulation::Cycle;
use std::collections::BTreeMap;

impl Cycle {
    /// Numbers at the nodes of a list, which increase, from the ranks that own them.
    pub(in crate::simulation) fn join_at_nodes<const N: usize>(
        &self,
        nodes: impl Iterator<Item = usize>,
        numbers: &mut [[f64; N]],
    ) {
        let Some(share) = &self.work.share else {
            return;
        };
        let shape = &self.work.grid.shape;
        let owners = nodes.map(|node| share.cut.owner(shape.indices(node)));
        let owners: Vec<usize> = owners.collect();
        let own = owners.iter().zip(&*numbers);
        let own = own.filter(|(owner, _)| **owner == share.rank());
        let words: Vec<u64> = own.flat_map(|(_, own)| own.map(f64::to_bits)).collect();
        let all = share.ranks.all_gather(&words);
        let mut all: Vec<Words<'_>> = all.iter().map(|words| Words::of(words)).collect();
        for (numbers, owner) in numbers.iter_mut().zip(owners) {
            *numbers = [(); N].map(|()| all[owner].number());
        }
    }

    /// Numbers by the node that they belong to, of all nodes that ranks own.
    pub(in crate::simulation) fn join_by_node<const N: usize>(
        &self,
        by_node: &mut BTreeMap<usize, [f64; N]>,
    ) {
        let Some(ranks) = self.ranks() else { return };
        let own = by_node.iter().filter(|(node, _)| self.owns(**node));
        let words = own.flat_map(|(node, numbers)| {
            let numbers = numbers.map(f64::to_bits);
            std::iter::once(*node as u64).chain(numbers)
        });
        let words: Vec<u64> = words.collect();
        by_node.clear();
        for words in ranks.all_gather(&words) {
            for words in words.chunks_exact(1 + N) {
                let numbers = std::array::from_fn(|i| f64::from_bits(words[1 + i]));
                by_node.insert(words[0] as usize, numbers);
            }
        }
    }
}
