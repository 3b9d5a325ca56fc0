//! The threads that share the work: the same answers for any number, and nobody else woken by one alone.

use proctor_kernel::simulation::{Options, Simulation};
use proctor_kernel::team::Team;
use std::collections::HashSet;
use std::sync::Mutex;
use std::thread::{self, ThreadId};

mod common;

/// More than is shared out at once.
const MANY: usize = 100_000;

fn teams() -> [Team; 3] {
    [1, 2, 5].map(|count| Team::new(count).expect("a few threads"))
}

#[test]
fn answers_come_in_order_for_any_number_of_threads() {
    for team in teams() {
        let squares = team.collect(7..MANY, |i| i * i);
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
    team.collect(0..MANY, |_| note());
    team.sort_by(&mut (0..MANY).rev().collect::<Vec<_>>(), |a, b| {
        note();
        a.cmp(b)
    });
    seen.into_inner().expect("no panic")
}

#[test]
fn one_alone_is_the_caller() {
    let caller = HashSet::from([thread::current().id()]);
    assert_eq!(workers(&Team::ALONE), caller);
    assert!(workers(&Team::new(2).expect("two threads")).is_disjoint(&caller));
}

#[test]
fn a_small_scene_takes_one_thread_unless_more_are_asked_for() {
    let scene = common::block(common::DIMENSIONS[0]);
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
