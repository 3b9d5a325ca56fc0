//! The threads that share the work: the same answers for any number, and nobody else woken by one alone.

use proctor_kernel::team::{ItemCost, Team};
use proctor_scene::simulation::{Options, Simulation};
use std::collections::HashSet;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, ThreadId};

/// More than is shared out at once.
const MANY: usize = 100_000;

fn teams() -> [Team; 3] {
    [1, 2, 5].map(|count| Team::new(count).expect("a few threads"))
}

#[test]
fn answers_come_in_order_for_any_number_of_threads() {
    for team in teams() {
        // What a list holds before is written over, and what it grows by.
        let mut squares = vec![1; 10];
        team.fill(7..MANY, ItemCost::Small, |i| i * i, &0, &mut squares);
        assert_eq!(squares.len(), MANY - 7);
        assert!(squares.iter().zip(7..).all(|(square, i)| *square == i * i));
        let parts = team.map((0..20).collect(), |part: usize| part + 1);
        assert!(parts.iter().copied().eq(1..21));
    }
}

#[test]
fn a_sort_keeps_the_order_of_equals_for_any_number_of_threads() {
    for team in teams() {
        let mut items: Vec<(usize, usize)> = (0..MANY).map(|i| (i * 7919 % 101, i)).collect();
        team.sort_by(&mut items, |a, b| a.0.cmp(&b.0));
        assert!(items.is_sorted(), "{} threads", team.count());
    }
}

/// Threads on which a team does all it can do.
fn workers(team: &Team) -> HashSet<ThreadId> {
    let seen = Mutex::new(HashSet::new());
    let note = || {
        seen.lock()
            .expect("no panic")
            .insert(thread::current().id())
    };
    team.lead(note);
    team.map(vec![(); 100], |()| note());
    team.fill(
        0..MANY,
        ItemCost::Small,
        |_| u8::from(note()),
        &0,
        &mut vec![],
    );
    team.sort_by(&mut (0..MANY).rev().collect::<Vec<_>>(), |a, b| {
        note();
        a.cmp(b)
    });
    seen.into_inner().expect("no panic")
}

#[test]
fn parts_are_taken_by_whoever_is_free() {
    let team = Team::new(2).expect("two threads");
    // While one thread is held by the first part, the other does all others.
    let (done, last) = (AtomicUsize::new(0), 7);
    let parts = team.map((0..=last).collect(), |part: usize| {
        while part == 0 && done.load(Ordering::Acquire) < last {
            thread::yield_now();
        }
        done.fetch_add(1, Ordering::Release);
        part
    });
    assert!(parts.into_iter().eq(0..=last));
}

#[test]
fn teams_within_a_team_and_fewer_parts_than_threads() {
    let team = Team::new(3).expect("three threads");
    let sums = team.map(vec![10, 20], |count: usize| {
        let parts = team.map((0..count).collect(), |part: usize| part);
        parts.into_iter().sum::<usize>()
    });
    assert_eq!(sums, [45, 190]);
}

#[test]
fn a_panic_in_a_part_is_that_of_the_caller() {
    let team = Team::new(2).expect("two threads");
    let caught = panic::catch_unwind(AssertUnwindSafe(|| {
        team.map((0..8).collect(), |part: usize| {
            assert!(part != 3, "the third");
            part
        })
    }));
    assert!(caught.is_err());
    assert_eq!(team.map(vec![1, 2], |part: usize| part), [1, 2]);
}

#[test]
fn one_alone_is_the_caller() {
    let caller = HashSet::from([thread::current().id()]);
    assert_eq!(workers(&Team::ALONE), caller);
    assert!(workers(&Team::new(2).expect("two threads")).is_disjoint(&caller));
}

#[test]
fn a_small_scene_takes_one_thread_unless_more_are_asked_for() {
    let scene = crate::common::block(crate::common::DIMENSIONS[0]);
    let threads = |threads| {
        let options = Options {
            threads,
            ..Options::default()
        };
        let simulation = Simulation::new(&scene, &options).expect("the scene is sound");
        simulation.threads()
    };
    assert_eq!(threads(None), 1);
    assert_eq!(threads(Some(3)), 3);
}
