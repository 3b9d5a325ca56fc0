//! Jobs side by side, one thread each, whose results come in their order.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Threads that the machine can run at once.
pub(crate) fn processors() -> usize {
    thread::available_parallelism().map_or(1, NonZeroUsize::get)
}

/// Runs the items of `order` out of `jobs`, `workers` at a time, as long as `go` says so before each, and hands the results of
/// `work`, which gets the number of a job and the job, to `each` in the order of `jobs`, until one of them fails.
///
/// # Errors
/// The first error of `each`.
pub fn side_by_side<J: Sync, R: Send, E>(
    jobs: &[J],
    order: &[usize],
    workers: usize,
    go: &(dyn Fn() -> bool + Sync),
    work: impl Fn(usize, &J) -> R + Sync,
    mut each: impl FnMut(R) -> Result<(), E>,
) -> Result<(), E> {
    let next = AtomicUsize::new(0);
    let failed = AtomicBool::new(false);
    let go = || go() && !failed.load(Ordering::Relaxed);
    thread::scope(|scope| {
        let (send, receive) = mpsc::channel();
        for _ in 0..workers.clamp(1, jobs.len().max(1)) {
            let send = send.clone();
            let (next, work, go) = (&next, &work, &go);
            scope.spawn(move || {
                while let Some(&k) = order
                    .get(next.fetch_add(1, Ordering::Relaxed))
                    .filter(|_| go())
                {
                    // Nobody listens any more once the other side has failed.
                    if send.send((k, work(k, &jobs[k]))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        let mut hear = |result| each(result).inspect_err(|_| failed.store(true, Ordering::Relaxed));
        let mut waiting: BTreeMap<usize, R> = BTreeMap::new();
        let mut due = 0;
        for (k, done) in receive {
            waiting.insert(k, done);
            while let Some(done) = waiting.remove(&due) {
                due += 1;
                hear(done)?;
            }
        }
        // What was done out of order before a stop.
        waiting.into_values().try_for_each(hear)
    })
}

/// The results of `work` of all items, in their order, on all processors.
pub fn all_of<J: Sync, R: Send>(items: &[J], work: impl Fn(&J) -> R + Sync) -> Vec<R> {
    let order: Vec<usize> = (0..items.len()).collect();
    let mut results = Vec::with_capacity(items.len());
    let work = |_, item: &J| work(item);
    let Ok(()) = side_by_side(items, &order, processors(), &|| true, work, |result| {
        results.push(result);
        Ok::<(), Infallible>(())
    });
    results
}
