//! The threads that share the work of a simulation.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cmp::Ordering;
use std::ops::Range;

/// Fewest items that are worth handing to another thread.
const SHORTEST_SHARE: usize = 1 << 10;
/// The same for items that each take a search or a system of equations.
const SHORTEST_SHARE_OF_SEARCHES: usize = 1 << 5;

/// Threads that work together. What they do does not depend on how many they are; one alone is the caller's, and then
/// no other thread is ever woken.
#[derive(Debug)]
pub struct Team {
    count: usize,
    pool: Option<ThreadPool>,
}

impl Team {
    /// The calling thread alone.
    pub const ALONE: Self = Self {
        count: 1,
        pool: None,
    };

    /// Most threads that are worth asking for: 1024, or all of a machine that has more. Each has a stack of its own, and
    /// a system that runs out of them while they are started does not say so in time.
    #[must_use]
    pub fn most() -> usize {
        let machine = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        machine.max(1024)
    }

    /// A team of `count` threads, at least one.
    ///
    /// # Errors
    /// If the system gives no more threads.
    pub fn new(count: usize) -> Result<Self, ThreadPoolBuildError> {
        if count <= 1 {
            return Ok(Self::ALONE);
        }
        let pool = ThreadPoolBuilder::new().num_threads(count).build()?;
        Ok(Self {
            count,
            pool: Some(pool),
        })
    }

    /// Number of threads.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Has a thread of the team do `work`. To hand work over to the team takes longer than to share it out within, so
    /// that what shares several times is to be led as a whole.
    pub fn lead<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// `act` on each of a few large parts; the results in order.
    pub fn map<T: Send, R: Send>(
        &self,
        parts: Vec<T>,
        act: impl Fn(T) -> R + Send + Sync,
    ) -> Vec<R> {
        match &self.pool {
            Some(pool) if parts.len() > 1 => {
                pool.install(|| parts.into_par_iter().with_max_len(1).map(act).collect())
            }
            _ => parts.into_iter().map(act).collect(),
        }
    }

    /// `value` of many small items; the results in order.
    pub fn collect<R: Send>(
        &self,
        items: Range<usize>,
        value: impl Fn(usize) -> R + Send + Sync,
    ) -> Vec<R> {
        self.collect_in_shares(items, SHORTEST_SHARE, value)
    }

    /// `value` of items that each take a search or a system of equations; the results in order.
    pub fn search<R: Send>(
        &self,
        items: Range<usize>,
        value: impl Fn(usize) -> R + Send + Sync,
    ) -> Vec<R> {
        self.collect_in_shares(items, SHORTEST_SHARE_OF_SEARCHES, value)
    }

    fn collect_in_shares<R: Send>(
        &self,
        items: Range<usize>,
        shortest: usize,
        value: impl Fn(usize) -> R + Send + Sync,
    ) -> Vec<R> {
        match &self.pool {
            Some(pool) if items.len() > shortest => pool.install(|| {
                let items = items.into_par_iter().with_min_len(shortest);
                items.map(value).collect()
            }),
            _ => items.map(value).collect(),
        }
    }

    /// Stable sort.
    pub fn sort_by<T: Send>(
        &self,
        items: &mut [T],
        compare: impl Fn(&T, &T) -> Ordering + Send + Sync,
    ) {
        match &self.pool {
            Some(pool) if items.len() > SHORTEST_SHARE => {
                pool.install(|| items.par_sort_by(compare));
            }
            _ => items.sort_by(compare),
        }
    }
}
