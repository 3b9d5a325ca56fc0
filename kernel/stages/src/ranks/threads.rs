//! Ranks that are threads of one process: messages are lists that change hands.

use super::Ranks;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Words from each rank to each other one, of one round of messages.
struct Round {
    /// The parts that each rank has sent, for all ranks.
    sent: Vec<Option<Vec<Vec<u64>>>>,
    /// Ranks that have taken their parts.
    taken: usize,
    /// True once a rank has ended.
    ended: bool,
}

struct Post {
    round: Mutex<Round>,
    changed: Condvar,
}

/// One of some ranks that are threads of one process. It belongs to one thread at a time.
pub struct ThreadRank {
    rank: usize,
    count: usize,
    post: Arc<Post>,
}

/// Some ranks that are threads of this process, one for each thread that will have one. A thread whose rank waits for one that
/// was dropped unwinds, without a message.
#[must_use]
pub fn of_threads(count: usize) -> Vec<ThreadRank> {
    let post = Arc::new(Post {
        round: Mutex::new(Round {
            sent: vec![None; count],
            taken: 0,
            ended: false,
        }),
        changed: Condvar::new(),
    });
    let rank = |rank| ThreadRank {
        rank,
        count,
        post: Arc::clone(&post),
    };
    (0..count).map(rank).collect()
}

impl ThreadRank {
    fn round(&self) -> MutexGuard<'_, Round> {
        let round = self.post.round.lock();
        round.unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until something holds of the round.
    fn wait<'a>(
        &'a self,
        round: MutexGuard<'a, Round>,
        until: impl Fn(&Round) -> bool,
    ) -> MutexGuard<'a, Round> {
        let waiting = |round: &mut Round| !until(round) && !round.ended;
        let waited = self.post.changed.wait_while(round, waiting);
        let round = waited.unwrap_or_else(PoisonError::into_inner);
        if !until(&round) {
            // Whatever ended the other rank has its own message.
            std::panic::resume_unwind(Box::new("a rank waits for one that has ended"));
        }
        round
    }

    /// Sends a part to each rank; the parts that all ranks sent here.
    fn swap(&self, parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        let mut round = self.wait(self.round(), |round| round.sent[self.rank].is_none());
        round.sent[self.rank] = Some(parts);
        self.post.changed.notify_all();
        let mut round = self.wait(round, |round| round.sent.iter().all(Option::is_some));
        let sent = round.sent.iter_mut().flatten();
        let received = sent
            .map(|parts| std::mem::take(&mut parts[self.rank]))
            .collect();
        round.taken += 1;
        if round.taken == self.count {
            round.taken = 0;
            round.sent.fill(None);
            self.post.changed.notify_all();
        }
        received
    }
}

impl Drop for ThreadRank {
    fn drop(&mut self) {
        self.round().ended = true;
        self.post.changed.notify_all();
    }
}

impl Ranks for ThreadRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.count
    }

    fn all_gather(&self, own: &[u64]) -> Vec<Vec<u64>> {
        self.swap(vec![own.to_vec(); self.count])
    }

    fn all_to_all(&self, parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        self.swap(parts)
    }

    fn exchange(&self, with: [Option<usize>; 2], to: [Vec<u64>; 2]) -> [Vec<u64>; 2] {
        let mut parts = vec![vec![]; self.count];
        for (rank, words) in with.iter().zip(to) {
            if let Some(rank) = *rank {
                parts[rank] = words;
            }
        }
        let mut received = self.swap(parts);
        with.map(|rank| rank.map_or_else(Vec::new, |rank| std::mem::take(&mut received[rank])))
    }
}
