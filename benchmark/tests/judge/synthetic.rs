//! Records that were never measured.

use oorandom::Rand64;
use proctor_benchmark::judge::{self, CaseVerdict, Comparison, Rules};
use proctor_benchmark::measure::Spent;
use proctor_benchmark::record::{Record, Row};
use proctor_scene::simulation::Options;
use std::time::Duration;

/// The least passes of which times are judged, and repetitions of each.
pub const PASSES: u64 = 10;
pub const REPETITIONS: u64 = 3;

pub fn record(rows: impl IntoIterator<Item = Row>) -> Record {
    let mut record = Record::new(&Options::default());
    record.rows.extend(rows);
    record
}

pub fn sample(name: &str, pass: u64, repetition: u64, seconds: f64) -> Row {
    let time = Duration::from_secs_f64(seconds);
    let mut row = Row::sample(name, repetition, 1).timed(Spent {
        wall: time,
        cpu: time,
    });
    row.set_pass(pass);
    row
}

/// Samples of a case whose every run takes the same time.
pub fn steady(name: &str, seconds: f64) -> Vec<Row> {
    (0..PASSES)
        .flat_map(|pass| (0..REPETITIONS).map(move |r| (pass, r)))
        .map(|(pass, r)| sample(name, pass, r, seconds))
        .collect()
}

/// The same with a counter in every row.
pub fn steady_with(name: &str, seconds: f64, counters: &[(&str, f64)]) -> Vec<Row> {
    let mut rows = steady(name, seconds);
    for row in &mut rows {
        for (key, value) in counters {
            row.count(*key, *value);
        }
    }
    rows
}

pub fn compare(base: &Record, head: &Record) -> Comparison {
    judge::compare(base, head, &Rules::default())
}

/// Verdict and reasons of the only case, or of the one with that name.
pub fn of(comparison: &Comparison, name: &str) -> (CaseVerdict, String) {
    let mut findings = comparison.findings.iter();
    let finding = findings.find(|finding| finding.case.name == name);
    let finding = finding.expect("a finding");
    (finding.verdict, finding.reasons.join("; "))
}

/// Disturbance of a measurement by a machine.
pub struct Machine {
    random: Rand64,
    /// Passes of a record.
    pub passes: u64,
    /// Logarithmic standard deviation of a run.
    pub noise: f64,
    /// Share of runs that something else slows down, by up to a factor of two.
    pub outliers: f64,
    /// Logarithmic standard deviation of the speed between passes, and a tenth of it between runs.
    pub drift: f64,
}

impl Machine {
    /// One per cent of noise, three disturbed runs in a hundred, five per cent between passes.
    pub fn usual(seed: u64) -> Self {
        Self {
            random: Rand64::new(u128::from(seed)),
            passes: PASSES,
            noise: 0.01,
            outliers: 0.03,
            drift: 0.05,
        }
    }

    /// Standard normal (Box and Muller).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.random.rand_float()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.random.rand_float()).cos()
    }

    /// Interleaved samples of a case that takes `base` and `head` seconds without noise.
    pub fn pair(&mut self, name: &str, base: f64, head: f64) -> [Vec<Row>; 2] {
        let mut rows = [vec![], vec![]];
        for pass in 0..self.passes {
            let mut speed = self.drift * self.normal();
            for repetition in 0..REPETITIONS {
                for (rows, seconds) in rows.iter_mut().zip([base, head]) {
                    // The machine warms up and slows down while it works.
                    speed += 0.1 * self.noise * self.normal();
                    let mut time = seconds * (speed + self.noise * self.normal()).exp();
                    if self.random.rand_float() < self.outliers {
                        time *= 1.1 + 0.9 * self.random.rand_float();
                    }
                    rows.push(sample(name, pass, repetition, time));
                }
            }
        }
        rows
    }

    /// Two records of `cases` cases, HEAD slower by `factor`.
    pub fn records(&mut self, cases: usize, factor: f64) -> [Record; 2] {
        let (mut base, mut head) = (record([]), record([]));
        for case in 0..cases {
            let [b, h] = self.pair(&format!("case/{case}"), 0.1, 0.1 * factor);
            base.rows.extend(b);
            head.rows.extend(h);
        }
        [base, head]
    }
}
