//! The first problem of the mill that misses a gate: the mill alone, for seeded faults (`scripts/faults --mill`).
//!
//!     cargo run --release --package proctor-verification --example mill -- SEED SECONDS NUMBER|FIRST..END ...
//!
//! Judges the problems of these numbers of a seed, in their order, on all processors, until the first miss or until the seconds
//! are over. Prints a line for each: errors and gates. Exit code 0: none missed; 1: one did, and the last line names it; 2: wrong
//! arguments.

use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use proctor_verification::mill::expected::Gate;
use proctor_verification::mill::{self, Answer};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some((seed, seconds, numbers)) = read(&words) else {
        eprintln!(
            "found {words:?}; accepted: SEED SECONDS NUMBER|FIRST..END ..., whole numbers, as in 7 300 0..40"
        );
        return ExitCode::from(2);
    };
    let (begun, next) = (Instant::now(), AtomicUsize::new(0));
    let late = || begun.elapsed() > Duration::from_secs(seconds);
    let (sender, receiver) = mpsc::channel();
    let mut judged = 0;
    let miss = thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let (sender, next, numbers) = (sender.clone(), &next, &numbers);
            scope.spawn(move || {
                while !late() {
                    let Some(&number) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) else {
                        return;
                    };
                    let (begun, answer) = (Instant::now(), mill::answer(seed, number));
                    let told = sender.send((number, answer, begun.elapsed().as_secs_f64()));
                    if told.is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        // A number whose draws were all refused has no problem and counts as judged.
        let mut misses = (receiver.into_iter())
            .inspect(|(number, answer, seconds)| {
                judged += 1;
                println!("problem {number}: {}, {seconds:.2} s", line(answer));
            })
            .filter_map(|(_, answer, _)| answer.ok().filter(Answer::misses));
        let miss = misses.next();
        next.store(numbers.len(), Ordering::Relaxed);
        miss
    });
    let seconds = begun.elapsed().as_secs_f64();
    let Some(answer) = miss else {
        println!("no miss in {judged} problems, {seconds:.1} s");
        return ExitCode::SUCCESS;
    };
    let missed: Vec<_> = (answer.gates.iter())
        .filter(|gate| !gate.holds())
        .map(|gate| gate.what)
        .collect();
    println!(
        "MISS: problem {}, {}: {}; {judged} judged, {seconds:.1} s",
        answer.number,
        kind(&answer),
        answer.found.err().unwrap_or_else(|| missed.join(", "))
    );
    ExitCode::FAILURE
}

/// Seed, seconds and numbers of problems.
fn read(words: &[String]) -> Option<(u64, u64, Vec<u64>)> {
    let [seed, seconds, rest @ ..] = words else {
        return None;
    };
    let mut numbers = vec![];
    for word in rest {
        match word.split_once("..") {
            Some((first, end)) => numbers.extend(first.parse::<u64>().ok()?..end.parse().ok()?),
            None => numbers.push(word.parse().ok()?),
        }
    }
    let is_given = !numbers.is_empty();
    is_given.then_some((seed.parse().ok()?, seconds.parse().ok()?, numbers))
}

/// Family, law and method of a problem.
fn kind(answer: &Answer) -> String {
    let problem = &answer.problem;
    let (family, law) = (problem.family.word(), problem.material.kind.word());
    format!("{family}, {law}, {}", problem.method)
}

/// Problem, errors on its ladder and gates.
fn line(answer: &Result<Answer, Vec<String>>) -> String {
    let Ok(answer) = answer else {
        return "all draws refused".to_owned();
    };
    let refused = answer.refused.len();
    let found = match &answer.found {
        Ok(errors) => (errors.iter())
            .flat_map(|rung| {
                [rung.displacement, rung.stress]
                    .into_iter()
                    .chain(rung.variable)
            })
            .map(|error| format!("{error:e}"))
            .collect::<Vec<_>>()
            .join(" "),
        Err(reason) => reason.clone(),
    };
    let value = |gate: &Gate| format!("{} {:.4} of {}", gate.what, gate.value, gate.bound);
    let gates: Vec<_> = answer.gates.iter().map(value).collect();
    format!(
        "{}, {refused} refused; errors {found}; {}",
        kind(answer),
        gates.join("; ")
    )
}
