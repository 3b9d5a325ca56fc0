//! Work done side by side, one thread each, and told in its order.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Runs the items of `order` out of `jobs`, `workers` at a time, as long as `go` says so before each, and hands the results of
/// `work` to `each` in the order of `jobs`.
pub fn side_by_side<J: Sync, R: Send>(
    jobs: &[J],
    order: &[usize],
    workers: usize,
    go: &(dyn Fn() -> bool + Sync),
    work: impl Fn(&J) -> R + Sync,
    mut each: impl FnMut(R),
) {
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        let (send, receive) = mpsc::channel();
        for _ in 0..workers.clamp(1, jobs.len().max(1)) {
            let send = send.clone();
            let (next, work) = (&next, &work);
            scope.spawn(move || {
                while let Some(&k) = order
                    .get(next.fetch_add(1, Ordering::Relaxed))
                    .filter(|_| go())
                {
                    // Nobody listens any more once the other side has failed.
                    if send.send((k, work(&jobs[k]))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        let mut waiting: BTreeMap<usize, R> = BTreeMap::new();
        let mut due = 0;
        for (k, done) in receive {
            waiting.insert(k, done);
            while let Some(done) = waiting.remove(&due) {
                due += 1;
                each(done);
            }
        }
        // What was done out of order before a stop.
        for (_, done) in waiting {
            each(done);
        }
    });
}
