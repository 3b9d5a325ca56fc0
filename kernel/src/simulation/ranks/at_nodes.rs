//! Numbers at nodes of boundary planes, which every rank keeps for all nodes: each comes from the rank that owns the node.

use crate::simulation::Cycle;
use std::collections::BTreeMap;

impl Cycle {
    /// Numbers at the nodes of a list, which increase, from the ranks that own them.
    pub(in crate::simulation) fn join_at_nodes<const N: usize>(
        &self,
        nodes: impl Iterator<Item = usize>,
        numbers: &mut [[f64; N]],
    ) {
        let Some(ranks) = self.ranks() else { return };
        let own = (nodes.zip(&*numbers)).filter(|(node, _)| self.owns(*node));
        let words: Vec<u64> = own.flat_map(|(_, own)| own.map(f64::to_bits)).collect();
        // A node belongs to one rank, and planes of ranks increase as nodes do.
        let all = ranks.all_gather(&words);
        let all = all.iter().flat_map(|words| words.as_chunks().0);
        for (numbers, words) in numbers.iter_mut().zip(all) {
            *numbers = words.map(f64::from_bits);
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
