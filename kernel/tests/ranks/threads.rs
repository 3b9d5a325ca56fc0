//! Ranks that are threads of one process, which count what they send and may change it.

use proctor_kernel::ranks::{Ranks, ThreadRank, of_threads};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A change of the words that a rank sends to another.
pub type Meddle = fn(from: usize, to: usize, words: &mut Vec<u64>);

/// One of some ranks that are threads.
pub struct Thread {
    rank: ThreadRank,
    /// Bytes sent to neighbours so far.
    sent: Arc<AtomicUsize>,
    meddle: Option<Meddle>,
}

/// Ranks that are threads; `meddle` changes particles on their way.
pub fn ranks(count: usize, meddle: Option<Meddle>) -> Vec<Thread> {
    let thread = |rank| Thread {
        rank,
        sent: Arc::default(),
        meddle,
    };
    of_threads(count).into_iter().map(thread).collect()
}

impl Thread {
    /// Bytes that it has sent to neighbours, but for those of sums and maxima.
    pub fn sent(&self) -> Arc<AtomicUsize> {
        Arc::clone(&self.sent)
    }
}

impl Ranks for Thread {
    fn rank(&self) -> usize {
        self.rank.rank()
    }

    fn count(&self) -> usize {
        self.rank.count()
    }

    fn all_gather(&self, own: &[u64]) -> Vec<Vec<u64>> {
        self.rank.all_gather(own)
    }

    fn all_to_all(&self, mut parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        if let Some(meddle) = self.meddle {
            for (to, words) in parts.iter_mut().enumerate() {
                meddle(self.rank.rank(), to, words);
            }
        }
        self.rank.all_to_all(parts)
    }

    fn exchange(&self, with: [Option<usize>; 2], to: [Vec<u64>; 2]) -> [Vec<u64>; 2] {
        let bytes = 8 * to.iter().map(Vec::len).sum::<usize>();
        self.sent.fetch_add(bytes, Ordering::Relaxed);
        self.rank.exchange(with, to)
    }
}
