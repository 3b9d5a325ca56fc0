//! Jobs side by side, whose results come in their order.

use proctor_benchmark::side_by_side::{all_of, side_by_side};
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn results_come_in_the_order_of_the_jobs_whatever_began_first() {
    let jobs: Vec<u32> = (0..40).collect();
    let order: Vec<usize> = (0..40).rev().collect();
    let mut heard = vec![];
    let ended = side_by_side(
        &jobs,
        &order,
        3,
        &|| true,
        |k, job| (k, *job),
        |(k, job)| {
            assert_eq!(k, job as usize);
            heard.push(job);
            if job < 20 { Ok(()) } else { Err(job) }
        },
    );
    assert_eq!(ended, Err(20));
    assert_eq!(heard, (0..=20).collect::<Vec<u32>>());
    assert_eq!(all_of(&jobs, |job| 2 * job)[39], 78);
    assert!(all_of(&[], |job: &u32| *job).is_empty());
}

#[test]
fn jobs_done_before_a_stop_are_heard_although_one_before_them_was_not() {
    let done = AtomicUsize::new(0);
    let go = || done.load(Ordering::Relaxed) < 2;
    let mut heard = vec![];
    let work = |k, (): &()| {
        done.fetch_add(1, Ordering::Relaxed);
        k
    };
    let Ok(()) = side_by_side(&[(); 4], &[3, 1, 0, 2], 1, &go, work, |k| {
        heard.push(k);
        Ok::<(), Infallible>(())
    });
    assert_eq!(heard, [1, 3]);
}
