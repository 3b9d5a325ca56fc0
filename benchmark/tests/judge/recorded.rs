//! The judge of times, on samples of noisy machines: one program against itself, and slowed down by arithmetic.
//!
//! To multiply the times of one side is what a slower program does to them as long as the noise is a factor too, which
//! other work on the same processors is.

use oorandom::Rand64;
use proctor_benchmark::judge::time::{Pace, compare};
use proctor_benchmark::record::Series;
use std::collections::BTreeMap;
use std::path::Path;

/// Pairs of a comparison, as `scripts/compare-commits` has them.
const PAIRS: usize = 12;
/// Comparisons drawn from each case.
const DRAWS: usize = 200;

/// Times of both sides of a pair \[s\]: by the clock and on the processors.
type Pair = [[f64; 2]; 2];

/// Times that were recorded of a case.
struct RecordedTimes {
    name: String,
    threads: u64,
    pairs: Vec<Pair>,
}

/// Content of a file of `fixtures/noise`: `busy` is what the rules were tuned on, `later` was recorded after them.
fn recording(file: &str) -> Vec<RecordedTimes> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/noise");
    let text = std::fs::read_to_string(root.join(format!("{file}.csv"))).expect("the samples");
    let mut cases: Vec<RecordedTimes> = vec![];
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let time = |at: usize| cells[at].parse::<f64>().expect("microseconds") * 1e-6;
        let pair = [[time(3), time(4)], [time(5), time(6)]];
        let name = format!("{file}: {}", cells[0]);
        match cases.iter_mut().find(|case| case.name == name) {
            Some(case) => case.pairs.push(pair),
            None => cases.push(RecordedTimes {
                name,
                threads: cells[1].parse().expect("threads"),
                pairs: vec![pair],
            }),
        }
    }
    cases
}

impl RecordedTimes {
    /// Pairs that followed each other, from a random start, the sides exchanged or not.
    fn draw(&self, random: &mut Rand64) -> Vec<Pair> {
        let n = self.pairs.len();
        let start = random.rand_range(0..(n - PAIRS + 1) as u64) as usize;
        let turned = random.rand_float() < 0.5;
        let pairs = self.pairs[start..start + PAIRS].iter().copied();
        pairs
            .map(|[a, b]| if turned { [b, a] } else { [a, b] })
            .collect()
    }

    /// `cpu` is whether the time on the processors was recorded too.
    fn judged(&self, pairs: &[Pair], factor: f64, cpu: bool) -> Result<Pace, String> {
        let side = |which: usize, factor: f64| {
            let mut series = Series {
                threads: [self.threads].into(),
                ..Series::default()
            };
            let times = |clock: usize| -> BTreeMap<u64, Vec<f64>> {
                let times = pairs.iter().map(|pair| vec![factor * pair[which][clock]]);
                (0..).zip(times).collect()
            };
            series.wall = times(0);
            if cpu {
                series.cpu = times(1);
            }
            series
        };
        compare(&side(0, 1.0), &side(1, factor), None).map(|time| time.pace)
    }

    /// Shares of draws that are called slower, called faster, and not judged at all.
    fn shares(&self, factor: f64, cpu: bool) -> [f64; 3] {
        let mut random = Rand64::new(1);
        let mut counts = [0.0; 3];
        for _ in 0..DRAWS {
            match self.judged(&self.draw(&mut random), factor, cpu) {
                Ok(Pace::Slower) => counts[0] += 1.0,
                Ok(Pace::Faster) => counts[1] += 1.0,
                Ok(Pace::Same) => {}
                Ok(Pace::Unclear) | Err(_) => counts[2] += 1.0,
            }
        }
        counts.map(|count| count / DRAWS as f64)
    }
}

#[test]
fn two_hundred_comparisons_of_a_program_with_itself_give_no_alarm() {
    for case in recording("busy") {
        for cpu in [true, false] {
            let [slower, faster, hidden] = case.shares(1.0, cpu);
            println!("{}, CPU time {cpu}: not judged {hidden:.3}", case.name);
            assert_eq!((slower, faster), (0.0, 0.0), "{}, {cpu}", case.name);
        }
    }
}

#[test]
#[ignore = "takes 6 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn ten_per_cent_are_found_in_nine_of_ten_comparisons() {
    for case in recording("busy") {
        let found: Vec<[f64; 3]> = [1.05, 1.1, 1.2].map(|f| case.shares(f, true)).to_vec();
        let said: Vec<String> = found.iter().map(|f| format!("{:.3}", f[0])).collect();
        let [_, [slower, _, hidden], _] = found[..] else {
            unreachable!("three factors");
        };
        println!(
            "{}: 5, 10, 20 % slower found in {}; not judged {hidden:.3}",
            case.name,
            said.join(", "),
        );
        // With two threads the clock decides. Among so much other work it shows little, which is said, and not green.
        let stopped = slower + if case.threads > 1 { hidden } else { 0.0 };
        assert!(stopped >= 0.9, "{}: {stopped}", case.name);
    }
}

#[test]
#[ignore = "takes 11 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn where_load_comes_and_goes_ten_per_cent_are_not_green_and_alarms_are_rare() {
    let mut means = [[0.0; 3]; 2];
    let cases = recording("later");
    for case in &cases {
        let [same, slow] = [1.0, 1.1].map(|factor| case.shares(factor, true));
        println!(
            "{}: with itself [slower, faster, not judged] {same:.3?}; 10 % slower {slow:.3?}",
            case.name
        );
        let green = 1.0 - slow[0] - slow[2];
        assert!(green <= 0.1, "{}: green in {green:.3}", case.name);
        for (mean, of_case) in means.iter_mut().zip([same, slow]) {
            for (mean, share) in mean.iter_mut().zip(of_case) {
                *mean += share / cases.len() as f64;
            }
        }
    }
    println!(
        "all: with itself {:.4?}; 10 % slower {:.4?}",
        means[0], means[1]
    );
    let [alarms, praise, _] = means[0];
    assert!(alarms + praise <= 1.0 / DRAWS as f64, "{alarms}, {praise}");
}
