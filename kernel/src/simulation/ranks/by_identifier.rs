//! Particles of all ranks in order of the identifier, a piece at a time: no rank has them all.

use super::packed::{append, pack};
use crate::particles::ParticleSet;
use crate::ranks::Words;
use crate::simulation::Cycle;
use crate::simulation::state_hash::{StateHash, by_identifier};

/// Identifiers of a piece.
const PIECE: u64 = 1 << 16;

impl Cycle {
    /// The hash of the particles of all ranks ([`Cycle::state_hash`]); `None` where no ranks share them.
    pub(in crate::simulation) fn hash_of_ranks(&self) -> Option<u64> {
        let share = self.work.share.as_ref()?;
        let ranks = share.ranks();
        let mut hash = StateHash::default();
        let mut places = vec![];
        for set in &self.state.sets {
            let own = self.own_particles(set);
            hash.add(self.join_count(own.len()) as u64);
            let ids: Vec<u64> = own.iter().map(|p| set.id[p]).collect();
            let [first, last] = self.identifiers(&ids);
            by_identifier(set, own.iter(), &mut places);
            let mut rest = &places[..];
            let mut begin = first;
            while begin <= last {
                let end = begin + PIECE;
                let count = rest.partition_point(|&p| set.id[p as usize] < end);
                let (piece, behind) = rest.split_at(count);
                rest = behind;
                begin = end;
                let mut parts = vec![vec![]; ranks.count()];
                let piece: Vec<usize> = piece.iter().map(|&p| p as usize).collect();
                pack(set, &piece, &self.work.grid.shape, &mut parts[0]);
                hash_piece(&mut hash, set, &ranks.all_to_all(parts));
            }
        }
        // The first rank alone has seen all.
        let all = ranks.all_gather(&[hash.value()]);
        all.first()?.first().copied()
    }

    /// The smallest and the largest identifier on all ranks; the larger one first where there are none.
    pub(in crate::simulation) fn identifiers(&self, here: &[u64]) -> [u64; 2] {
        let first = here.iter().copied().min().unwrap_or(u64::MAX);
        let last = here.iter().copied().max().unwrap_or(0);
        let mut all = [first, last];
        let Some(share) = &self.work.share else {
            return all;
        };
        for of_rank in share.ranks().all_gather(&all) {
            let mut of_rank = Words::of(&of_rank);
            all = [all[0].min(of_rank.word()), all[1].max(of_rank.word())];
        }
        all
    }
}

/// Adds the particles of a piece, as each rank has sent them, to the hash.
fn hash_piece(hash: &mut StateHash, like: &ParticleSet, received: &[Vec<u64>]) {
    let mut set = like.without_particles();
    for words in received.iter().filter(|words| !words.is_empty()) {
        append(&mut set, &mut Words::of(words));
    }
    let mut places = vec![];
    by_identifier(&set, 0..set.len(), &mut places);
    hash.add_particles(&set, &places);
}
