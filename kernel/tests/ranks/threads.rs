//! Ranks that are threads of one process.

use proctor_kernel::ranks::Ranks;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;

/// Time after which a rank that waits for another gives up.
const PATIENCE: Duration = Duration::from_secs(120);

/// A change of the words that a rank sends to another.
pub type Meddle = fn(from: usize, to: usize, words: &mut Vec<u64>);

/// Words from each rank to each other one, of one round of messages.
struct Round {
    posted: Vec<Option<Vec<Vec<u64>>>>,
    taken: usize,
}

struct Post {
    round: Mutex<Round>,
    changed: Condvar,
    meddle: Option<Meddle>,
}

/// One of some ranks that are threads.
pub struct Thread {
    rank: usize,
    count: usize,
    /// Bytes sent to neighbours so far.
    sent: Arc<AtomicUsize>,
    post: Arc<Post>,
}

/// Ranks that are threads; `meddle` changes particles on their way.
pub fn ranks(count: usize, meddle: Option<Meddle>) -> Vec<Thread> {
    let post = Arc::new(Post {
        round: Mutex::new(Round {
            posted: vec![None; count],
            taken: 0,
        }),
        changed: Condvar::new(),
        meddle,
    });
    let thread = |rank| Thread {
        rank,
        count,
        sent: Arc::default(),
        post: Arc::clone(&post),
    };
    (0..count).map(thread).collect()
}

impl Thread {
    /// Bytes that it has sent to neighbours, but for those of sums and maxima.
    pub fn sent(&self) -> Arc<AtomicUsize> {
        Arc::clone(&self.sent)
    }

    fn swap(&self, parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        let post = &*self.post;
        let wait = |round, until: &dyn Fn(&Round) -> bool| {
            let waited = post
                .changed
                .wait_timeout_while(round, PATIENCE, |r| !until(r));
            let (round, result) = waited.expect("no rank has failed");
            assert!(!result.timed_out(), "rank {} waits in vain", self.rank);
            round
        };
        let round = post.round.lock().expect("no rank has failed");
        let mut round = wait(round, &|round| round.posted[self.rank].is_none());
        round.posted[self.rank] = Some(parts);
        post.changed.notify_all();
        let mut round = wait(round, &|round| round.posted.iter().all(Option::is_some));
        let posted = round.posted.iter();
        let received =
            posted.map(|parts| parts.as_ref().expect("all have posted")[self.rank].clone());
        let received = received.collect();
        round.taken += 1;
        if round.taken == self.count {
            round.taken = 0;
            round.posted.fill(None);
        }
        post.changed.notify_all();
        received
    }
}

impl Ranks for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.count
    }

    fn all_gather(&self, own: &[u64]) -> Vec<Vec<u64>> {
        self.swap(vec![own.to_vec(); self.count])
    }

    fn all_to_all(&self, mut parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        if let Some(meddle) = self.post.meddle {
            for (to, words) in parts.iter_mut().enumerate() {
                meddle(self.rank, to, words);
            }
        }
        self.swap(parts)
    }

    fn exchange(&self, [below, above]: [Vec<u64>; 2]) -> [Vec<u64>; 2] {
        let bytes = 8 * (below.len() + above.len());
        self.sent.fetch_add(bytes, Ordering::Relaxed);
        let mut parts = vec![vec![]; self.count];
        let mut received = {
            if self.rank > 0 {
                parts[self.rank - 1] = below;
            }
            if self.rank + 1 < self.count {
                parts[self.rank + 1] = above;
            }
            self.swap(parts)
        };
        let mut from = |rank: Option<usize>| {
            let words = rank.and_then(|rank| received.get_mut(rank));
            words.map(std::mem::take).unwrap_or_default()
        };
        [from(self.rank.checked_sub(1)), from(Some(self.rank + 1))]
    }
}
