//! The first problem of the mill that misses a gate: the mill alone, for seeded faults (`scripts/faults --mill`).
//!
//!     cargo run --release --package proctor-verification --example mill -- SEED COUNT SECONDS [NUMBER ...]
//!
//! Judges the problems 0 to COUNT of a seed but for those of these numbers, on all processors, until the first miss or until
//! the seconds are over. Exit code 0: none missed; 1: one did, and it is named; 2: wrong arguments.

use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use proctor_verification::mill::{self, Answer};

fn main() -> ExitCode {
    let numbers: Vec<u64> = (std::env::args().skip(1))
        .map_while(|word| word.parse().ok())
        .collect();
    let [seed, count, seconds, ref left_out @ ..] = numbers[..] else {
        eprintln!("accepted: SEED COUNT SECONDS [NUMBER ...], whole numbers");
        return ExitCode::from(2);
    };
    let (begun, next) = (Instant::now(), AtomicU64::new(0));
    let late = || begun.elapsed() > Duration::from_secs(seconds);
    let (sender, receiver) = mpsc::channel();
    let mut judged = 0;
    let miss = thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while !late() {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if left_out.contains(&number) {
                        continue;
                    }
                    let ended = number >= count;
                    if ended || sender.send(mill::answer(seed, number)).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        // A number whose draws were all refused has no problem and counts as judged.
        let mut misses = (receiver.into_iter())
            .inspect(|_| judged += 1)
            .filter_map(|answer| answer.ok().filter(Answer::misses));
        let miss = misses.next();
        next.store(count, Ordering::Relaxed);
        miss
    });
    let seconds = begun.elapsed().as_secs_f64();
    let Some(answer) = miss else {
        println!("no miss in {judged} problems, {seconds:.1} s");
        return ExitCode::SUCCESS;
    };
    let (number, problem) = (answer.number, &answer.problem);
    let missed: Vec<_> = (answer.gates.iter())
        .filter(|gate| !gate.holds())
        .map(|gate| gate.what)
        .collect();
    let why = answer.found.err().unwrap_or_else(|| missed.join(", "));
    let (family, law, method) = (
        problem.family.word(),
        problem.material.kind.word(),
        problem.method,
    );
    println!(
        "MISS: problem {number}, {family}, {law}, {method}: {why}; {judged} judged, {seconds:.1} s"
    );
    ExitCode::FAILURE
}
