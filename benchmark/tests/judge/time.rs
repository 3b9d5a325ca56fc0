//! Time: no false alarm, and real losses found.

use crate::judge::synthetic::{Machine, compare, of, record, sample, steady};
use proctor_benchmark::judge::time::{Clock, LEAST, NEARLY_ALL};
use proctor_benchmark::judge::{self, CaseVerdict, Comparison, Rules, Verdict, noise};
use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::{Record, Row};
use proctor_benchmark::statistics::signed_rank;
use std::time::Duration;

/// Share of cases with a verdict.
fn share(comparison: &Comparison, verdict: CaseVerdict) -> f64 {
    let with = comparison.findings.iter().filter(|f| f.verdict == verdict);
    with.count() as f64 / comparison.findings.len() as f64
}

#[test]
fn four_thousand_pairs_without_a_change_give_no_alarm() {
    let mut machine = Machine::usual(1);
    for _ in 0..40 {
        let [base, head] = machine.records(100, 1.0);
        let comparison = compare(&base, &head);
        assert_eq!(
            comparison.verdict(),
            Verdict::Fine,
            "{:?}",
            comparison.findings
        );
        assert_eq!(
            share(&comparison, CaseVerdict::Same),
            1.0,
            "praise is false as well"
        );
    }
}

#[test]
fn a_noisy_machine_gives_no_alarm_once_its_noise_is_measured() {
    let mut machine = Machine::usual(2);
    machine.noise = 0.04;
    machine.outliers = 0.1;
    for _ in 0..10 {
        machine.passes = 9;
        let bands = record(noise::bands(&machine.records(100, 1.0), 12).expect("bands"));
        machine.passes = 10;
        let [base, head] = machine.records(100, 1.0);
        let rules = Rules {
            noise: Some(&bands),
            ..Rules::default()
        };
        let comparison = judge::compare(&base, &head, &rules);
        assert_eq!(share(&comparison, CaseVerdict::Worse), 0.0);
        // Three disturbed runs in one of the passes that measured the noise: rare, and said.
        let too_noisy = share(&comparison, CaseVerdict::CannotCompare);
        assert!(too_noisy < 0.05, "{too_noisy}");
    }
}

#[test]
fn ten_per_cent_is_always_found_and_five_in_most() {
    let mut machine = Machine::usual(3);
    // As many pairs as `scripts/compare-commits` makes. Of ten every single one must say it, which they do less often.
    machine.passes = 12;
    let [base, head] = machine.records(300, 1.10);
    let comparison = compare(&base, &head);
    assert_eq!(share(&comparison, CaseVerdict::Worse), 1.0);
    assert_eq!(comparison.verdict(), Verdict::Worse);
    let [base, head] = machine.records(300, 1.05);
    let found = share(&compare(&base, &head), CaseVerdict::Worse);
    println!("five per cent slower: found in {found} of the cases");
    assert!(found > 0.8, "{found}");
    let [base, head] = machine.records(300, 1.0 / 1.10);
    assert_eq!(share(&compare(&base, &head), CaseVerdict::Better), 1.0);
}

/// One binary against itself on a busy machine: three pairs called it slower in four of thirty.
#[test]
fn three_pairs_are_not_judged() {
    let mut machine = Machine::usual(7);
    machine.noise = 0.1;
    machine.passes = 3;
    let [base, head] = machine.records(300, 1.0);
    let comparison = compare(&base, &head);
    assert_eq!(share(&comparison, CaseVerdict::CannotCompare), 1.0);
    let (_, reason) = of(&comparison, "case/0");
    assert!(
        reason.contains("3 passes in common, at least 10 are needed"),
        "{reason}"
    );
}

#[test]
fn one_pass_that_is_not_slower_forbids_to_say_so() {
    let base = record(steady("a", 1.0));
    let mut slow = steady("a", 1.5);
    assert_eq!(
        of(&compare(&base, &record(slow.clone())), "a").0,
        CaseVerdict::Worse
    );
    // One run of one pass as fast as before is enough: whatever else goes on only adds time. Where most passes took half
    // as long again, it is not called the same either.
    slow[4] = sample("a", 1, 1, 1.0);
    let (verdict, reason) = of(&compare(&base, &record(slow.clone())), "a");
    assert_eq!(verdict, CaseVerdict::CannotCompare);
    assert!(reason.contains("50.0 % apart"), "{reason}");
    for pass in [0, 2, 3, 4, 5] {
        slow[3 * pass + 1] = sample("a", pass as u64, 1, 1.0);
    }
    assert_eq!(of(&compare(&base, &record(slow)), "a").0, CaseVerdict::Same);
}

#[test]
fn the_tolerance_is_three_per_cent_or_twice_the_band() {
    let base = record(steady("a", 1.0));
    let judged = |factor: f64, band: Option<f64>| {
        let mut bands = record(noise::bands(&[base.clone(), base.clone()], 12).expect("bands"));
        bands.rows[0].count("noise_band", band.unwrap_or(0.0));
        let rules = Rules {
            noise: Some(&bands),
            ..Rules::default()
        };
        of(
            &judge::compare(&base, &record(steady("a", factor)), &rules),
            "a",
        )
        .0
    };
    assert_eq!(judged(1.029, None), CaseVerdict::Same);
    assert_eq!(judged(1.031, None), CaseVerdict::Worse);
    assert_eq!(judged(1.031, Some(0.01)), CaseVerdict::Worse);
    assert_eq!(judged(1.079, Some(0.04)), CaseVerdict::Same);
    assert_eq!(judged(1.081, Some(0.04)), CaseVerdict::Worse);
}

#[test]
fn the_figures_beside_the_verdict_are_those_of_the_samples() {
    let base = record(steady("a", 1.0));
    let comparison = compare(&base, &record(steady("a", 1.25)));
    let time = comparison.findings[0].time.as_ref().expect("judged");
    assert_eq!(time.ratios, [1.25; 10]);
    assert_eq!((time.median, time.interval), (1.25, (1.25, 1.25)));
    assert!(time.chance < 1e-3);
}

/// Twelve pairs of runs on one thread that take these times by the clock and on the processors.
fn pairs(times: impl Fn(u64) -> (f64, f64)) -> Record {
    record((0..12).map(|pair| {
        let (wall, cpu) = times(pair);
        let mut row = Row::sample("a", 0, 1).timed(Spent {
            wall: Duration::from_secs_f64(wall),
            cpu: Duration::from_secs_f64(cpu),
        });
        row.set_pass(pair);
        row
    }))
}

#[test]
fn one_thread_is_judged_by_its_time_on_the_processors() {
    // The clock jumps by factors, in another order on either side.
    let jumps = |pair: u64| [1.0, 3.0, 7.0, 2.0, 5.0][(pair % 5) as usize];
    let base = pairs(|pair| (jumps(pair), 1.0 + 0.001 * pair as f64));
    let head = pairs(|pair| (jumps(pair + 1), 1.06 + 0.001 * pair as f64));
    let comparison = compare(&base, &head);
    let (verdict, reason) = of(&comparison, "a");
    assert_eq!(verdict, CaseVerdict::Worse);
    assert!(reason.contains("of CPU time"), "{reason}");
    let time = comparison.findings[0].time.as_ref().expect("judged");
    assert_eq!((time.clock, time.sees()), (Clock::Cpu, Some(0.05)));
}

#[test]
fn what_waits_instead_of_working_is_found_by_the_clock() {
    let base = pairs(|_| (1.0, 1.0));
    let (verdict, reason) = of(&compare(&base, &pairs(|_| (1.1, 1.0))), "a");
    assert_eq!(verdict, CaseVerdict::Worse);
    assert!(reason.contains("of wall time"), "{reason}");
}

#[test]
fn the_fastest_quarter_is_found_slower_where_every_second_process_is() {
    // 18 % longer in every second process of BASE, in every third of HEAD.
    let slow = |pair: u64, of: u64| if pair.is_multiple_of(of) { 1.18 } else { 1.0 };
    let base = pairs(|pair| (1.0, slow(pair, 2) + 0.001 * pair as f64));
    let head = |factor: f64| pairs(|pair| (1.0, factor * slow(pair + 1, 3) + 0.001 * pair as f64));
    assert_eq!(of(&compare(&base, &head(1.0)), "a").0, CaseVerdict::Same);
    assert_eq!(of(&compare(&base, &head(1.1)), "a").0, CaseVerdict::Worse);
    assert_eq!(of(&compare(&head(1.1), &base), "a").0, CaseVerdict::Better);
    // A single pair without the fast mode of the other side is no finding.
    let rare = pairs(|pair| (1.0, if pair == 3 { 1.0 } else { 1.18 }));
    let never = pairs(|_| (1.0, 1.18));
    assert_eq!(of(&compare(&rare, &never), "a").0, CaseVerdict::Same);
}

/// A time from 1 on, up to `width` longer, in no order (multiples of the golden ratio).
fn spread(pair: u64, width: f64) -> f64 {
    1.0 + width * (0.618_034 * pair as f64).fract()
}

/// CPU time of HEAD over BASE in twelve pairs of *moving-2d* on one thread, while builds ran beside it: a stage of HEAD was
/// slower by 12 %, the medians lay 20 % apart, and three pairs said the contrary.
const CONTRADICTING: [f64; 12] = [
    1.194, 0.926, 0.917, 1.374, 1.075, 1.193, 1.165, 1.095, 1.166, 1.305, 0.959, 1.138,
];

#[test]
fn pairs_that_contradict_each_other_and_lie_far_apart_are_not_the_same() {
    let base = pairs(|pair| (1.0, spread(pair, 0.2)));
    let head = pairs(|pair| (1.0, spread(pair, 0.2) * CONTRADICTING[pair as usize]));
    let comparison = compare(&base, &head);
    let (verdict, reason) = of(&comparison, "a");
    assert_eq!(verdict, CaseVerdict::CannotCompare, "{reason}");
    assert!(reason.contains("15.1 % apart in CPU time"), "{reason}");
    // Its figures are told nevertheless.
    assert!(comparison.findings[0].time.is_some());
}

#[test]
fn the_same_is_said_only_where_a_tenth_would_have_been_seen() {
    let noisy = |width: f64, shift: u64| pairs(move |pair| (1.0, spread(pair + shift, width)));
    let judged = |width: f64| of(&compare(&noisy(width, 0), &noisy(width, 6)), "a");
    assert_eq!(judged(0.02).0, CaseVerdict::Same);
    let (verdict, reason) = judged(0.8);
    assert_eq!(verdict, CaseVerdict::CannotCompare, "{reason}");
    assert!(reason.contains("hides every change below"), "{reason}");
}

#[test]
fn noise_that_hides_a_half_is_not_green() {
    // By the clock alone, as with several threads.
    let noisy = |shift: u64| {
        record((0..12).map(|pair| {
            let jump = [1.0, 9.0, 2.0, 30.0, 4.0, 13.0, 3.0][((pair * 5 + shift) % 7) as usize];
            let mut row = sample("a", pair, 0, jump);
            row.threads = 2;
            row
        }))
    };
    let (verdict, reason) = of(&compare(&noisy(0), &noisy(3)), "a");
    assert_eq!(verdict, CaseVerdict::CannotCompare);
    assert!(reason.contains("hides every change below 50 %"), "{reason}");
}

#[test]
fn the_least_pairs_follow_from_the_error_rate_of_the_rule() {
    let least_chance = |pairs: usize| signed_rank(&vec![1.0; pairs]);
    assert!(least_chance(LEAST) <= NEARLY_ALL);
    assert!(least_chance(LEAST - 1) > NEARLY_ALL);
}
