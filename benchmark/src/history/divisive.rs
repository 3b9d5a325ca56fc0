//! Change points of a noisy series: E-divisive means in windows, with a t-test.
//!
//! Matteson and James 2014 (Journal of the American Statistical Association 109, 334-345) split a series where the energy
//! distance between both sides is largest. Fleming, Kołaczkowski and others 2023 (Hunter, ICPE) judge a split by Student's
//! t-test instead of permutations, so that the same numbers give the same points, look at windows, so that late changes do
//! not hide behind early ones, and take back the weakest splits until all that are left are significant. Unlike Hunter a split is
//! first tested on the stretch in which it is best, so that a later change does not hide it.

use libm::{exp, lgamma, log};

/// Points of a window.
const WINDOW: usize = 50;
/// Chance of a split that is none, below which it is taken.
pub const CHANCE: f64 = 0.001;
/// The same of a split that may be taken back later.
const WEAK: f64 = 10.0 * CHANCE;
/// The same where the end of the stretch was chosen among fifty so that the split is best.
const CHOSEN: f64 = WEAK / WINDOW as f64;

/// A place where a series changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Index of the first value after it.
    pub at: usize,
    /// Mean of the stretch before it.
    pub before: f64,
    /// Mean of the stretch after it.
    pub after: f64,
    /// Chance of such a difference without a change.
    pub chance: f64,
}

/// The change points of a series of finite values, in order.
#[must_use]
pub fn splits(values: &[f64]) -> Vec<Split> {
    let mut at: Vec<usize> = vec![];
    let mut begin = 0;
    while begin < values.len() {
        let end = (begin + WINDOW).min(values.len());
        let found = in_window(&values[begin..end]);
        let last = found.last().map_or(0, |split| begin + split);
        at.extend(found.into_iter().map(|split| begin + split));
        begin = last.max(begin + WINDOW / 2);
    }
    at.sort_unstable();
    at.dedup();
    // The weakest is taken back, and its neighbours are judged again.
    loop {
        let all = judged(values, &at);
        let weakest = (0..all.len()).max_by(|&i, &j| all[i].chance.total_cmp(&all[j].chance));
        match weakest {
            Some(weakest) if all[weakest].chance >= CHANCE => at.remove(weakest),
            _ => return all,
        };
    }
}

/// Each split with the stretches to its neighbours.
fn judged(values: &[f64], at: &[usize]) -> Vec<Split> {
    let split = |number: usize| {
        let from = if number == 0 { 0 } else { at[number - 1] };
        let to = at.get(number + 1).copied().unwrap_or(values.len());
        judge(
            &values[from..at[number]],
            &values[at[number]..to],
            at[number],
        )
    };
    (0..at.len()).map(split).collect()
}

fn judge(left: &[f64], right: &[f64], at: usize) -> Split {
    let mean = |side: &[f64]| side.iter().sum::<f64>() / side.len() as f64;
    Split {
        at,
        before: mean(left),
        after: mean(right),
        chance: t_test(left, right),
    }
}

/// Splits of a window, each the best of a stretch, as long as the best of all is significant.
fn in_window(values: &[f64]) -> Vec<usize> {
    let distances = Distances::new(values);
    let mut at: Vec<usize> = vec![];
    loop {
        let ends = at.iter().copied().chain([values.len()]);
        let begins = std::iter::once(0).chain(at.iter().copied());
        let candidates = begins
            .zip(ends)
            .filter_map(|(from, to)| distances.best(from, to));
        let Some(best) = candidates.max_by(|a, b| a.distance.total_cmp(&b.distance)) else {
            return at;
        };
        let Candidate {
            from,
            split,
            end,
            to,
            ..
        } = best;
        let chance = |to: usize| t_test(&values[from..split], &values[split..to]);
        if chance(to) >= WEAK && chance(end) >= CHOSEN {
            return at;
        }
        let place = at.partition_point(|known| *known < split);
        at.insert(place, split);
    }
}

/// The best split of a stretch.
struct Candidate {
    /// Energy distance between what is before the split and what is behind it.
    distance: f64,
    /// First value of the stretch.
    from: usize,
    /// First value behind the split.
    split: usize,
    /// First value behind those that are compared.
    end: usize,
    /// End of the stretch.
    to: usize,
}

/// Sums of distances between the values of a window.
struct Distances {
    count: usize,
    /// Sum at `i * count + j` of the distances of value `j` from all values before `i`.
    before: Vec<f64>,
}

impl Distances {
    fn new(values: &[f64]) -> Self {
        let count = values.len();
        let mut before = vec![0.0; (count + 1) * count];
        for i in 0..count {
            for j in 0..count {
                before[(i + 1) * count + j] = before[i * count + j] + (values[i] - values[j]).abs();
            }
        }
        Self { count, before }
    }

    /// Sum of the distances of value `j` from the values `from..to`.
    fn sum_from(&self, from: usize, to: usize, j: usize) -> f64 {
        self.before[to * self.count + j] - self.before[from * self.count + j]
    }

    /// Split of a stretch with the largest energy distance between the values before it and the values from it to a later
    /// end; none for fewer than two values, or where all are equal.
    fn best(&self, from: usize, to: usize) -> Option<Candidate> {
        let mut best: Option<Candidate> = None;
        let mut left = 0.0;
        for split in from + 1..to {
            left += self.sum_from(from, split - 1, split - 1);
            let n = (split - from) as f64;
            let (mut between, mut right) = (0.0, 0.0);
            for end in split + 1..=to {
                between += self.sum_from(from, split, end - 1);
                right += self.sum_from(split, end - 1, end - 1);
                let m = (end - split) as f64;
                let own = |sum: f64, count: f64, other: f64| {
                    if count > 1.0 {
                        other * sum / (count - 1.0)
                    } else {
                        0.0
                    }
                };
                let distance = 2.0 / (m + n) * (between - own(left, n, m) - own(right, m, n));
                if distance > best.as_ref().map_or(0.0, |best| best.distance) {
                    best = Some(Candidate {
                        distance,
                        from,
                        split,
                        end,
                        to,
                    });
                }
            }
        }
        best
    }
}

/// Student's two-sided t-test of equal means, variances taken as equal: the chance (0 to 1) of such a difference of the means
/// without a change; 1 where it cannot tell.
#[must_use]
pub fn t_test(left: &[f64], right: &[f64]) -> f64 {
    let (n, m) = (left.len() as f64, right.len() as f64);
    let freedom = n + m - 2.0;
    if freedom < 1.0 || left.is_empty() || right.is_empty() {
        return 1.0;
    }
    let mean = |side: &[f64]| side.iter().sum::<f64>() / side.len() as f64;
    let (a, b) = (mean(left), mean(right));
    let squares = |side: &[f64], mean: f64| side.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    let variance = (squares(left, a) + squares(right, b)) / freedom;
    let difference = (a - b).abs();
    if difference == 0.0 {
        return 1.0;
    }
    if variance == 0.0 {
        return 0.0;
    }
    let t2 = difference * difference / (variance * (1.0 / n + 1.0 / m));
    incomplete_beta(freedom / 2.0, 0.5, freedom / (freedom + t2))
}

/// Regularised incomplete beta function, by its continued fraction (Abramowitz and Stegun 26.5.8).
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(b, a, 1.0 - x);
    }
    let front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log(1.0 - x)) / a;
    // Lentz's method: no denominator comes nearer to zero than this.
    let least = |value: f64| if value.abs() < 1e-300 { 1e-300 } else { value };
    let (mut c, mut d) = (1.0, 1.0 / least(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for k in 1..300 {
        let k = f64::from(k);
        let even = k * (b - k) * x / ((a + 2.0 * k - 1.0) * (a + 2.0 * k));
        let odd = -(a + k) * (a + b + k) * x / ((a + 2.0 * k) * (a + 2.0 * k + 1.0));
        for term in [even, odd] {
            d = 1.0 / least(1.0 + term * d);
            c = least(1.0 + term / c);
            fraction *= c * d;
        }
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    front * fraction
}
