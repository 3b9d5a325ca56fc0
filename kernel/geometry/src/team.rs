//! The threads that share the work of a simulation.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cmp::Ordering;
use std::iter::Fuse;
use std::ops::Range;
use std::sync::atomic::{self, AtomicUsize};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Fewest items that are worth handing to another thread.
const SHORTEST_SHARE: usize = 1 << 10;
/// The same for items that each take a search or a system of equations.
const SHORTEST_SHARE_OF_SEARCHES: usize = 1 << 5;

/// Parts per thread of many small items.
const PARTS_PER_THREAD: usize = 4;
/// Time for which a thread without work stays awake until the others end. To wake one takes a twentieth of a millisecond or
/// more, and the next work that is shared out follows at once in most of a step.
const PATIENCE: Duration = Duration::from_micros(200);

/// Amount of work for one of many items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemCost {
    /// Next to nothing.
    Small,
    /// A search or a system of equations.
    Search,
}

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

    /// A team of `count` threads of which the caller is one, from here to its end: what it leads stays on it. A thread can be
    /// in one such team.
    ///
    /// # Errors
    /// If the system gives no more threads, or the caller is in a team.
    pub fn of_caller(count: usize) -> Result<Self, ThreadPoolBuildError> {
        if count <= 1 {
            return Ok(Self::ALONE);
        }
        let pool = ThreadPoolBuilder::new().num_threads(count);
        Ok(Self {
            count,
            pool: Some(pool.use_current_thread().build()?),
        })
    }

    /// Number of threads.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Gives `work` to a thread of the team. To hand work over to the team takes longer than to share it out within, so that
    /// what shares several times is to be led as a whole.
    pub fn lead<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// `act` on each of a few large parts, which threads take in their order. What a part gives it writes to where it was told
    /// to; nothing is taken from the allocator.
    pub fn each<I: Iterator + Send>(&self, parts: I, act: impl Fn(I::Item) + Send + Sync) {
        let most = parts.size_hint().1.unwrap_or(usize::MAX);
        match &self.pool {
            Some(pool) if most > 1 => {
                let work = Work::new(parts);
                pool.install(|| among(self.count.min(most) - 1, &|| work.help(&act)));
            }
            _ => parts.for_each(act),
        }
    }

    /// `act` on each of a few large parts; the results in order.
    pub fn map<T: Send, R: Send>(
        &self,
        parts: Vec<T>,
        act: impl Fn(T) -> R + Send + Sync,
    ) -> Vec<R> {
        let mut results: Vec<Option<R>> = parts.iter().map(|_| None).collect();
        let places = parts.into_iter().zip(&mut results);
        self.each(places, |(part, result)| *result = Some(act(part)));
        results.into_iter().flatten().collect()
    }

    /// `value` of each item into a list that is kept, whose old content goes; where it grows it has `blank` at first.
    pub fn fill<R: Send + Clone>(
        &self,
        items: Range<usize>,
        work: ItemCost,
        value: impl Fn(usize) -> R + Send + Sync,
        blank: &R,
        results: &mut Vec<R>,
    ) {
        results.resize_with(items.len(), || blank.clone());
        let share = self.share(items.len(), work);
        self.each(results.chunks_mut(share).enumerate(), |(part, results)| {
            for (item, result) in (items.start + part * share..).zip(results) {
                *result = value(item);
            }
        });
    }

    /// Number of items that a thread takes at once, of so many.
    #[must_use]
    pub fn share(&self, items: usize, work: ItemCost) -> usize {
        let shortest = match work {
            ItemCost::Small => SHORTEST_SHARE,
            ItemCost::Search => SHORTEST_SHARE_OF_SEARCHES,
        };
        let most = (items / shortest).max(1);
        let parts = (self.count * PARTS_PER_THREAD).min(most);
        items.div_ceil(parts).max(1)
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

/// Lets as many helpers as that and the caller help.
fn among(helpers: usize, help: &(impl Fn() + Sync)) {
    if helpers == 0 {
        help();
    } else {
        rayon::join(help, || among(helpers - 1, help));
    }
}

/// Parts of some work that threads take one after the other.
struct Work<I> {
    parts: Mutex<Fuse<I>>,
    /// Number of items that are taken.
    taken: AtomicUsize,
    /// Number of items that are done.
    done: AtomicUsize,
}

impl<I: Iterator> Work<I> {
    fn new(parts: I) -> Self {
        Self {
            parts: Mutex::new(parts.fuse()),
            taken: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
        }
    }

    /// The next part that nobody has taken.
    fn take(&self) -> Option<I::Item> {
        let mut parts = unpoisoned(self.parts.lock());
        let part = parts.next()?;
        self.taken.fetch_add(1, atomic::Ordering::AcqRel);
        Some(part)
    }

    /// Takes parts until none is left, and then waits a while for the others.
    fn help(&self, act: impl Fn(I::Item)) {
        while let Some(part) = self.take() {
            act(part);
            self.done.fetch_add(1, atomic::Ordering::Release);
        }
        let mut waits_until = None;
        while self.done.load(atomic::Ordering::Acquire) < self.taken.load(atomic::Ordering::Acquire)
        {
            let end = *waits_until.get_or_insert_with(|| Instant::now() + PATIENCE);
            if Instant::now() > end {
                break;
            }
            std::thread::yield_now();
        }
    }
}

/// Guarded value of a lock. No act runs while one is held, so that none is ever left behind half written.
fn unpoisoned<G>(lock: Result<G, PoisonError<G>>) -> G {
    lock.unwrap_or_else(PoisonError::into_inner)
}
