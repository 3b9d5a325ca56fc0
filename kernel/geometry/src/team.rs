//! The threads that share the work of a simulation.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cmp::Ordering;
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
/// How long a thread that has nothing left to do stays awake for the others to end. To wake one takes a twentieth of a
/// millisecond or more, and the next work that is shared out follows at once in most of a step.
const PATIENCE: Duration = Duration::from_micros(200);

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
                let helpers = self.count.min(parts.len()) - 1;
                let work = Work::new(parts);
                pool.install(|| {
                    rayon::scope(|scope| {
                        for _ in 0..helpers {
                            scope.spawn(|_| work.help(&act));
                        }
                        work.help(&act);
                    });
                });
                work.results()
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
        let mut results = vec![];
        self.in_shares(items, SHORTEST_SHARE, value, &mut results);
        results
    }

    /// `value` of items that each take a search or a system of equations; the results in order.
    pub fn search<R: Send>(
        &self,
        items: Range<usize>,
        value: impl Fn(usize) -> R + Send + Sync,
    ) -> Vec<R> {
        let mut results = vec![];
        self.search_into(items, value, &mut results);
        results
    }

    /// The same into a list that is kept, whose old content goes.
    pub fn search_into<R: Send>(
        &self,
        items: Range<usize>,
        value: impl Fn(usize) -> R + Send + Sync,
        results: &mut Vec<R>,
    ) {
        self.in_shares(items, SHORTEST_SHARE_OF_SEARCHES, value, results);
    }

    fn in_shares<R: Send>(
        &self,
        items: Range<usize>,
        shortest: usize,
        value: impl Fn(usize) -> R + Send + Sync,
        results: &mut Vec<R>,
    ) {
        results.clear();
        match &self.pool {
            Some(_) if items.len() > shortest => {
                let most = items.len() / shortest;
                let parts = (self.count * PARTS_PER_THREAD).min(most).max(1);
                let end_of = |part: usize| items.start + items.len() * part / parts;
                let parts = (0..parts).map(|part| end_of(part)..end_of(part + 1));
                let found = self.map(parts.collect(), |part| part.map(&value).collect::<Vec<R>>());
                results.extend(found.into_iter().flatten());
            }
            _ => results.extend(items.map(value)),
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

/// Parts of some work that threads take one after the other.
struct Work<T, R> {
    parts: Vec<Mutex<Part<T, R>>>,
    /// The first that nobody has taken.
    next: AtomicUsize,
    /// How many are not done.
    left: AtomicUsize,
}

/// A part before it is done and after.
struct Part<T, R> {
    given: Option<T>,
    result: Option<R>,
}

impl<T, R> Work<T, R> {
    fn new(parts: Vec<T>) -> Self {
        let count = parts.len();
        let part = |given| {
            let given = Some(given);
            Mutex::new(Part {
                given,
                result: None,
            })
        };
        Self {
            parts: parts.into_iter().map(part).collect(),
            next: AtomicUsize::new(0),
            left: AtomicUsize::new(count),
        }
    }

    /// Does parts until none is left to take, and then waits a while for the others.
    fn help(&self, act: impl Fn(T) -> R) {
        while let Some(part) = self
            .parts
            .get(self.next.fetch_add(1, atomic::Ordering::Relaxed))
        {
            // Nobody else takes this part, so that no lock is ever waited for.
            let given = unpoisoned(part.lock()).given.take();
            let result = given.map(&act);
            unpoisoned(part.lock()).result = result;
            self.left.fetch_sub(1, atomic::Ordering::Release);
        }
        let mut waits_until = None;
        while self.left.load(atomic::Ordering::Acquire) > 0 {
            let end = *waits_until.get_or_insert_with(|| Instant::now() + PATIENCE);
            if Instant::now() > end {
                break;
            }
            std::thread::yield_now();
        }
    }

    /// Of all parts, in order; a part whose thread panicked has none, and then this is not reached.
    fn results(self) -> Vec<R> {
        let results = self.parts.into_iter();
        results
            .filter_map(|part| unpoisoned(part.into_inner()).result)
            .collect()
    }
}

/// What a lock holds. No act runs while one is held, so that none is ever left behind half written.
fn unpoisoned<G>(lock: Result<G, PoisonError<G>>) -> G {
    lock.unwrap_or_else(PoisonError::into_inner)
}
