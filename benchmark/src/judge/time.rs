//! Time, by pairs of runs that followed each other.
//!
//! A pair is one pass of both records. On a machine with other things to do, the clock tells more of them than of the
//! program, and even the time on the processors jumps between processes: one and the same program was seen 18 % slower in
//! every second process, because of where its stack happened to begin. Two rules find what is really slower:
//!
//! - nearly every pair says so: the signed-rank test of the logarithms of the ratios, less the tolerance;
//! - from twelve pairs on, the fastest quarter of HEAD is slower than that of BASE, rank by rank, by more than the
//!   tolerance and more than twice of what these quarters spread. Whatever else goes on in a machine only adds time, so
//!   that the fastest of many are those that show the program.
//!
//! A run on one thread computes and waits for nothing: its time on the processors is its time, and both rules judge it.
//! With more threads the clock decides. The other of the two times is judged by the first rule alone.
//!
//! A time for which neither rule shows a change is not yet the same. Two conditions make it the same: nine of ten such
//! measurements would have shown a loss of a tenth, and the two sides differ by less than a tenth. Otherwise the verdict is
//! open, which is not green.

use crate::record::Series;
use crate::statistics::{mann_whitney, median, ratio_interval, signed_rank};
use oorandom::Rand64;
use std::collections::BTreeMap;

/// Fewest passes from which noise is estimated.
pub const PASSES: usize = 3;
/// Pairs without which time is not judged: with fewer the signed ranks cannot be as unlikely as the judge asks, even if
/// all of them say the same.
pub const LEAST: usize = 10;
/// Smallest relative change of time that is one.
pub const TOLERANCE: f64 = 0.03;
/// Loss of time that is not to pass unseen: what is called the same would have shown it in nine of ten measurements.
pub const UNSEEN: f64 = 0.1;
/// Largest change of which is tried whether it would be seen.
const USELESS: f64 = 0.5;
/// Seed of the bootstrap.
const SEED: u64 = 1;
/// Pairs from which on there is a fastest quarter.
const MANY: usize = 12;
/// Chance of the signed ranks if nearly every pair is to say it: how often a program is called slower than itself by this rule,
/// at most. Of the least pairs every single one must say it.
pub const NEARLY_ALL: f64 = 1e-3;
/// The same beside the fastest quarter: most pairs must not speak against it. By the clock, which all other work reaches,
/// more of them must speak for it.
const MOST_CPU: f64 = 0.25;
const MOST_WALL: f64 = 0.05;
/// Resamples from which is said how small a change is found.
const RESAMPLES: usize = 100;
/// Changes that are tried for it.
const CHANGES: [f64; 7] = [0.05, 0.07, 0.1, 0.15, 0.2, 0.3, USELESS];
/// Share of the resamples in which a change is to be found.
const FOUND: f64 = 0.9;

/// Verdict on a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// No change that the pairs show.
    Same,
    /// Faster by more than the tolerance.
    Faster,
    /// Slower by more than the tolerance.
    Slower,
    /// No change that the pairs show, but among such noise, or at such a distance, that is no finding.
    Unclear,
}

/// Kind of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Time by the clock on the wall.
    Wall,
    /// Time on the processors.
    Cpu,
}

impl Clock {
    /// Name of the time.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wall => "wall time",
            Self::Cpu => "CPU time",
        }
    }
}

/// The times of a case in both records.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// The time that decides.
    pub clock: Clock,
    /// HEAD over BASE, pair by pair, of that time.
    pub ratios: Vec<f64>,
    /// Ratio of the fastest quarters of that time, of three runs at least.
    pub fastest: f64,
    /// Ratio of the medians of all its samples.
    pub median: f64,
    /// The same for CPU time.
    pub cpu: Option<f64>,
    /// 95 % interval of the ratio of medians.
    pub interval: (f64, f64),
    /// Probability of such an order of the samples by chance (Mann-Whitney).
    pub chance: f64,
    /// Relative change below which nothing is said.
    pub tolerance: f64,
    /// True if there are many pairs, and a change of [`UNSEEN`] would be found in fewer than nine of ten such measurements.
    hides: bool,
    /// Verdict of the pairs.
    pub pace: Pace,
    /// The time that shows it, of the two.
    pub shown_by: Clock,
    deciding: Pairs,
    other: Option<Pairs>,
}

impl Time {
    /// Verdict of the pairs if every time of HEAD were multiplied by `factor`.
    #[must_use]
    pub fn pace_at(&self, factor: f64) -> Pace {
        self.told_at(factor).0
    }

    /// Least of some changes that would have been found in nine of ten such measurements; `None` with few pairs, and where
    /// that is none of them.
    #[must_use]
    pub fn sees(&self) -> Option<f64> {
        self.deciding.sees(self.deciding.list.len(), self.tolerance)
    }

    /// Reason for which a time is [`Pace::Unclear`].
    pub(super) fn unclear(&self) -> String {
        let apart = self.deciding.apart();
        let mut reasons = vec![];
        if apart > 1.0 + UNSEEN {
            reasons.push(format!(
                "the pairs lie {:.1} % apart in {}, but contradict each other",
                100.0 * (apart - 1.0),
                self.clock.name()
            ));
        }
        if self.hides {
            reasons.push(hides(self.sees().unwrap_or(USELESS)));
        }
        hidden(&reasons.join(", and "))
    }

    /// Finding of the pairs, in words: the time, the change, and the number of pairs that show it.
    pub(super) fn said(&self, word: &str) -> String {
        let pairs = match &self.other {
            Some(other) if self.shown_by != self.clock => other,
            _ => &self.deciding,
        };
        let fastest = pairs.fastest();
        let by = if word == "slower" {
            fastest - 1.0
        } else {
            1.0 - fastest
        };
        let ratios = pairs.ratios();
        let agree = ratios.iter().filter(|r| (**r > 1.0) == (word == "slower"));
        format!(
            "{word} by {:.1} % of {} in the fastest runs, and in {} of {} pairs (tolerance {:.1} %)",
            100.0 * by,
            self.shown_by.name(),
            agree.count(),
            ratios.len(),
            100.0 * self.tolerance
        )
    }

    fn told_at(&self, factor: f64) -> (Pace, Clock) {
        let (own, other) = (self.clock, self.clock.other());
        let decided = self.deciding.scaled(factor).pace(self.tolerance);
        let beside = self.other.as_ref().map_or(Pace::Same, |pairs| {
            pairs.scaled(factor).pace_of_pairs(self.tolerance)
        });
        match (decided, beside) {
            (Pace::Slower, _) => (Pace::Slower, own),
            (_, Pace::Slower) => (Pace::Slower, other),
            (Pace::Same, _) if self.is_unclear_at(factor) => (Pace::Unclear, own),
            (pace, _) => (pace, own),
        }
    }

    /// True if a loss of [`UNSEEN`] could hide in times that show no change.
    fn is_unclear_at(&self, factor: f64) -> bool {
        self.hides || self.deciding.scaled(factor).apart() > 1.0 + UNSEEN
    }
}

/// Words on a change that noise hides.
fn hides(change: f64) -> String {
    format!("the noise hides every change below {:.0} %", 100.0 * change)
}

/// Reason for which a time is not judged.
fn hidden(reason: &str) -> String {
    format!("time: {reason}; measure more pairs or on a quiet machine, or leave times out")
}

impl Clock {
    fn other(self) -> Self {
        match self {
            Self::Wall => Self::Cpu,
            Self::Cpu => Self::Wall,
        }
    }
}

/// Compares the times of a case.
///
/// `band` is the measured noise of the case, as a relative change.
///
/// # Errors
/// Says why there is no answer, such as fewer than [`LEAST`] passes in common, or noise that would hide anything.
pub fn compare(base: &Series, head: &Series, band: Option<f64>) -> Result<Time, String> {
    if !base.wall.is_empty() && !head.wall.is_empty() && base.threads != head.threads {
        let said = |series: &Series| {
            let numbers: Vec<String> = series.threads.iter().map(u64::to_string).collect();
            numbers.join(", ")
        };
        return Err(format!(
            "time: another number of threads, {} in BASE, {} in HEAD",
            said(base),
            said(head)
        ));
    }
    let wall = Pairs::of(Clock::Wall, base, head);
    let cpu = Pairs::of(Clock::Cpu, base, head);
    // Where the passes of one record lack a time, it is no witness.
    let cpu = (cpu.list.len() == wall.list.len()).then_some(cpu);
    if wall.list.len() < LEAST {
        return Err(match (base.wall.is_empty(), head.wall.is_empty()) {
            (true, _) => "BASE has no time".to_owned(),
            (_, true) => "HEAD has no time".to_owned(),
            _ => format!(
                "time: {} in common, at least {LEAST} are needed: fewer cannot show a change at a chance of {NEARLY_ALL}",
                match wall.list.len() {
                    1 => "1 pass".to_owned(),
                    n => format!("{n} passes"),
                }
            ),
        });
    }
    let tolerance = TOLERANCE.max(2.0 * band.unwrap_or(0.0));
    if tolerance > USELESS {
        return Err(hidden(&hides(tolerance)));
    }
    let (clock, deciding, other) = match cpu {
        Some(cpu) if alone(base) => (Clock::Cpu, cpu, Some(wall)),
        cpu => (Clock::Wall, wall, cpu),
    };
    let all = |times: &BTreeMap<u64, Vec<f64>>| -> Vec<f64> {
        times.values().flatten().copied().collect()
    };
    let (base_all, head_all) = match clock {
        Clock::Cpu => (all(&base.cpu), all(&head.cpu)),
        Clock::Wall => (base.all_wall(), head.all_wall()),
    };
    let none = || "a time of zero".to_owned();
    let ratio = |head: &[f64], base: &[f64]| {
        let ratio = median(head)? / median(base)?;
        ratio.is_finite().then_some(ratio)
    };
    let mut time = Time {
        clock,
        ratios: deciding.ratios(),
        fastest: deciding.fastest(),
        median: ratio(&head_all, &base_all).ok_or_else(none)?,
        cpu: ratio(&all(&head.cpu), &all(&base.cpu)),
        interval: ratio_interval(&base_all, &head_all, SEED).ok_or_else(none)?,
        chance: mann_whitney(&base_all, &head_all).ok_or_else(none)?,
        tolerance,
        hides: deciding.list.len() >= MANY
            && !Pairs::finds(&deciding.resamples(deciding.list.len()), UNSEEN, tolerance),
        pace: Pace::Same,
        shown_by: clock,
        deciding,
        other,
    };
    (time.pace, time.shown_by) = time.told_at(1.0);
    Ok(time)
}

/// True if all runs had one thread, which waits for nobody.
fn alone(series: &Series) -> bool {
    series.threads.iter().eq(&[1])
}

/// The time that decides, and HEAD over BASE in it, pass by pass, of the fastest run of each.
#[must_use]
pub fn ratios(base: &Series, head: &Series) -> (Clock, Vec<f64>) {
    let wall = Pairs::of(Clock::Wall, base, head);
    let cpu = Pairs::of(Clock::Cpu, base, head);
    let decides = if alone(base) && cpu.list.len() == wall.list.len() {
        cpu
    } else {
        wall
    };
    (decides.clock, decides.ratios())
}

/// Least of some changes that `pairs` pairs of runs would show in nine of ten measurements, from HEAD over BASE in pairs
/// of the same program; `None` where all of them are hidden, or so few pairs never tell.
#[must_use]
pub fn seen_by(pairs: usize, clock: Clock, ratios: &[f64]) -> Option<f64> {
    // Each ratio as one that may stand on either side.
    let list = ratios.iter().flat_map(|r| [(0.0, r.ln()), (r.ln(), 0.0)]);
    let list = Pairs {
        clock,
        list: list.collect(),
    };
    list.sees(pairs, TOLERANCE)
}

/// Logarithms of the fastest run of BASE and of HEAD in each pass.
#[derive(Clone, Debug, PartialEq)]
struct Pairs {
    clock: Clock,
    list: Vec<(f64, f64)>,
}

impl Pairs {
    fn of(clock: Clock, base: &Series, head: &Series) -> Self {
        let [base, head] = [base, head].map(|series| match clock {
            Clock::Wall => &series.wall,
            Clock::Cpu => &series.cpu,
        });
        let fastest = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min).ln();
        let list = base
            .iter()
            .filter_map(|(pass, times)| Some((fastest(times), fastest(head.get(pass)?))))
            .filter(|(base, head)| base.is_finite() && head.is_finite())
            .collect();
        Self { clock, list }
    }

    fn ratios(&self) -> Vec<f64> {
        let ratios = self.list.iter().map(|(base, head)| (head - base).exp());
        ratios.collect()
    }

    fn with(&self, list: Vec<(f64, f64)>) -> Self {
        Self {
            clock: self.clock,
            list,
        }
    }

    /// Pairs with the times of HEAD multiplied by `factor`.
    fn scaled(&self, factor: f64) -> Self {
        let list = self.list.iter().map(|&(b, h)| (b, h + factor.ln()));
        self.with(list.collect())
    }

    /// Pairs with the two sides exchanged.
    fn turned(&self) -> Self {
        let list = self.list.iter().map(|&(b, h)| (h, b));
        self.with(list.collect())
    }

    /// The fastest quarter of both sides, in order; three at least.
    fn quarters(&self) -> [Vec<f64>; 2] {
        let count = (self.list.len() / 4).max(PASSES);
        let sides: [Vec<f64>; 2] = [
            self.list.iter().map(|pair| pair.0).collect(),
            self.list.iter().map(|pair| pair.1).collect(),
        ];
        sides.map(|mut side| {
            side.sort_by(f64::total_cmp);
            side.truncate(count);
            side
        })
    }

    /// Ratio of the means of the fastest quarters.
    fn fastest(&self) -> f64 {
        let [base, head] = self.quarters();
        let sum: f64 = base.iter().zip(&head).map(|(base, head)| head - base).sum();
        (sum / base.len().max(1) as f64).exp()
    }

    /// Distance of the two sides: the median of the pairs, or the ratio of the fastest quarters if that is larger.
    fn apart(&self) -> f64 {
        let median = median(&self.ratios()).unwrap_or(1.0);
        if self.list.len() < MANY {
            return median;
        }
        median.max(self.fastest())
    }

    /// Verdict of both rules.
    fn pace(&self, tolerance: f64) -> Pace {
        let slower = |pairs: &Self| {
            pairs.nearly_all_slower(tolerance) || pairs.fastest_are_slower(tolerance)
        };
        self.either(slower)
    }

    /// Verdict of the first rule.
    fn pace_of_pairs(&self, tolerance: f64) -> Pace {
        self.either(|pairs| pairs.nearly_all_slower(tolerance))
    }

    fn either(&self, slower: impl Fn(&Self) -> bool) -> Pace {
        if slower(self) {
            Pace::Slower
        } else if slower(&self.turned()) {
            Pace::Faster
        } else {
            Pace::Same
        }
    }

    /// Chance of ranks of the differences less `limit` that are as high as these.
    fn chance_above(&self, limit: f64) -> f64 {
        let differences = self.list.iter().map(|(base, head)| head - base - limit);
        signed_rank(&differences.collect::<Vec<_>>())
    }

    fn nearly_all_slower(&self, tolerance: f64) -> bool {
        self.chance_above(tolerance.ln_1p()) <= NEARLY_ALL
    }

    fn fastest_are_slower(&self, tolerance: f64) -> bool {
        if self.list.len() < MANY {
            return false;
        }
        let most = match self.clock {
            Clock::Wall => MOST_WALL,
            Clock::Cpu => MOST_CPU,
        };
        let [base, head] = self.quarters();
        let spread = |side: &[f64]| side[side.len() - 1] - side[0];
        let limit = tolerance
            .ln_1p()
            .max(2.0 * spread(&base).max(spread(&head)));
        base.iter()
            .zip(&head)
            .all(|(base, head)| head - base > limit)
            && self.chance_above(0.0) <= most
    }

    /// The smallest change that `pairs` pairs find in nine of ten measurements; `None` with few pairs, or if none is.
    fn sees(&self, pairs: usize, tolerance: f64) -> Option<f64> {
        if pairs < MANY {
            return None;
        }
        let resamples = self.resamples(pairs);
        let mut changes = CHANGES.into_iter();
        changes.find(|change| Self::finds(&resamples, *change, tolerance))
    }

    /// Measurements of `pairs` pairs drawn from these, without the change that they show.
    fn resamples(&self, pairs: usize) -> Vec<Self> {
        let level = self.scaled(1.0 / self.fastest()).list;
        let mut random = Rand64::new(u128::from(SEED));
        let n = level.len() as u64;
        (0..RESAMPLES)
            .map(|_| {
                let drawn = (0..pairs).map(|_| level[random.rand_range(0..n) as usize]);
                self.with(drawn.collect())
            })
            .collect()
    }

    /// True if a change is found in nine of ten of them.
    fn finds(resamples: &[Self], change: f64, tolerance: f64) -> bool {
        let slower = |pairs: &&Self| pairs.scaled(1.0 + change).pace(tolerance) == Pace::Slower;
        resamples.iter().filter(slower).count() as f64 >= FOUND * RESAMPLES as f64
    }
}
