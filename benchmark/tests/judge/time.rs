//! Time: no false alarm, and real losses found.

use crate::synthetic::{Machine, compare, of, record, sample, steady};
use proctor_benchmark::judge::{self, CaseVerdict, Comparison, Rules, Verdict, noise};

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
        machine.passes = 3;
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
    let [base, head] = machine.records(1000, 1.10);
    let comparison = compare(&base, &head);
    assert_eq!(share(&comparison, CaseVerdict::Worse), 1.0);
    assert_eq!(comparison.verdict(), Verdict::Worse);
    let [base, head] = machine.records(1000, 1.05);
    let found = share(&compare(&base, &head), CaseVerdict::Worse);
    println!("five per cent slower: found in {found} of the cases");
    assert!(found > 0.8, "{found}");
    let [base, head] = machine.records(1000, 1.0 / 1.10);
    assert_eq!(share(&compare(&base, &head), CaseVerdict::Better), 1.0);
}

#[test]
fn one_pass_that_is_not_slower_acquits() {
    let base = record(steady("a", 1.0));
    let mut slow = steady("a", 1.5);
    assert_eq!(
        of(&compare(&base, &record(slow.clone())), "a").0,
        CaseVerdict::Worse
    );
    // One run of one pass as fast as before is enough: whatever else goes on only adds time.
    slow[4] = sample("a", 1, 1, 1.0);
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
    assert_eq!(time.ratios, [1.25; 3]);
    assert_eq!((time.median, time.interval), (1.25, (1.25, 1.25)));
    assert!(time.chance < 1e-3);
}
