//! Statistics of samples: order statistics, a bootstrap interval, a rank test. Nothing here draws from the clock: the
//! same samples give the same numbers.

use oorandom::Rand64;

/// Resamples of a bootstrap: Efron and Tibshirani (chapter 14) ask for about 1000 where percentiles are wanted.
const RESAMPLES: usize = 1000;
/// Largest sample for which the rank test counts all arrangements; beyond it the normal distribution is as good.
const EXACT: usize = 50;

/// Order statistics of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Number of values.
    pub count: usize,
    /// Least value.
    pub minimum: f64,
    /// First quartile.
    pub lower_quartile: f64,
    /// Median.
    pub median: f64,
    /// Third quartile.
    pub upper_quartile: f64,
    /// Largest value.
    pub maximum: f64,
}

impl Summary {
    /// Statistics of finite values; `None` if there are none.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let sorted = sorted(values);
        Some(Self {
            count: sorted.len(),
            minimum: *sorted.first()?,
            lower_quartile: quantile(&sorted, 0.25)?,
            median: quantile(&sorted, 0.5)?,
            upper_quartile: quantile(&sorted, 0.75)?,
            maximum: *sorted.last()?,
        })
    }

    /// Largest less least value, over the median: of three or five repetitions the quartiles say little.
    #[must_use]
    pub fn spread(&self) -> f64 {
        (self.maximum - self.minimum) / self.median
    }
}

/// Median of finite values; `None` if there are none.
#[must_use]
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(&sorted(values), 0.5)
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Quantile of sorted values by linear interpolation between the two beside it (type 7 of Hyndman and Fan 1996, The
/// American Statistician 50, 361-365; the default of R and numpy).
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let at = share * last as f64;
    let below = at.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (at - below as f64) * (sorted[above] - sorted[below]))
}

/// Interval that holds the ratio of medians, `head` over `base`, with 95 % by the bootstrap (percentiles; Efron and
/// Tibshirani 1993, An Introduction to the Bootstrap, chapter 13). `None` where a sample is empty.
#[must_use]
pub fn ratio_interval(base: &[f64], head: &[f64], seed: u64) -> Option<(f64, f64)> {
    if base.is_empty() || head.is_empty() {
        return None;
    }
    let mut random = Rand64::new(u128::from(seed));
    let mut resampled = |values: &[f64]| {
        let n = values.len() as u64;
        let drawn: Vec<f64> = (0..n)
            .map(|_| values[random.rand_range(0..n) as usize])
            .collect();
        median(&drawn)
    };
    let mut ratios = Vec::with_capacity(RESAMPLES);
    for _ in 0..RESAMPLES {
        ratios.push(resampled(head)? / resampled(base)?);
    }
    ratios.sort_by(f64::total_cmp);
    Some((quantile(&ratios, 0.025)?, quantile(&ratios, 0.975)?))
}

/// Two-sided Mann-Whitney U test: the probability that two samples from one distribution are ordered as unevenly as
/// these (Mann and Whitney 1947, Annals of Mathematical Statistics 18, 50-60).
///
/// Exact where no values are equal and both samples are small, else by the normal distribution with correction for ties
/// and continuity. `None` where a sample is empty.
#[must_use]
pub fn mann_whitney(a: &[f64], b: &[f64]) -> Option<f64> {
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let (n, m) = (a.len(), b.len());
    let mut all: Vec<(f64, bool)> = a.iter().map(|&x| (x, true)).collect();
    all.extend(b.iter().map(|&x| (x, false)));
    all.sort_by(|x, y| x.0.total_cmp(&y.0));
    let (mut rank_sum, mut ties) = (0.0, 0.0);
    let mut start = 0;
    while start < all.len() {
        let equal = all[start..].iter().take_while(|x| x.0 == all[start].0);
        let count = equal.count();
        let rank = start as f64 + f64::midpoint(1.0, count as f64);
        let group = &all[start..start + count];
        rank_sum += rank * group.iter().filter(|x| x.1).count() as f64;
        let t = count as f64;
        ties += t.powi(3) - t;
        start += count;
    }
    let pairs = (n * m) as f64;
    let u = rank_sum - (n * (n + 1)) as f64 / 2.0;
    let u = u.max(pairs - u);
    if ties == 0.0 && n <= EXACT && m <= EXACT {
        return Some((2.0 * exact_tail(n, m, u as usize)).min(1.0));
    }
    let total = (n + m) as f64;
    let variance = pairs / 12.0 * (total + 1.0 - ties / (total * (total - 1.0)));
    if variance <= 0.0 {
        return Some(1.0); // all values are equal
    }
    let z = (u - pairs / 2.0 - 0.5) / variance.sqrt();
    Some(libm::erfc(z / std::f64::consts::SQRT_2).min(1.0))
}

/// Probability of a U of at least `u` among all orders of `n` and `m` values.
fn exact_tail(n: usize, m: usize, u: usize) -> f64 {
    // probability[i][u] over orders of i and j values; the largest of all belongs to the first sample with i / (i + j),
    // and then exceeds all j of the second.
    let mut probability = vec![vec![0.0; n * m + 1]; n + 1];
    for row in &mut probability {
        row[0] = 1.0;
    }
    for j in 1..=m {
        for i in 1..=n {
            let share = i as f64 / (i + j) as f64;
            let (before, from_here) = probability.split_at_mut(i);
            let (first, both) = (&before[i - 1], &mut from_here[0]);
            for (value, both) in both[..=i * j].iter_mut().enumerate() {
                let from_first = if value >= j { first[value - j] } else { 0.0 };
                *both = share * from_first + (1.0 - share) * *both;
            }
        }
    }
    probability[n][u..].iter().sum()
}

/// One-sided signed-rank test of paired differences: the probability that differences as likely below as above zero
/// have positive ranks as large as these (Wilcoxon 1945, Biometrics Bulletin 1, 80-83), exact, with mean ranks where
/// differences are equally large; zeros are left out. 1 where nothing differs.
#[must_use]
pub fn signed_rank(differences: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = differences.to_vec();
    sorted.retain(|x| *x != 0.0);
    sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    // Twice the ranks, which are whole numbers then.
    let mut ranks = Vec::with_capacity(sorted.len());
    while let Some(x) = sorted.get(ranks.len()) {
        let start = ranks.len();
        let equal = sorted[start..].iter().take_while(|y| y.abs() == x.abs());
        let end = start + equal.count();
        ranks.resize(end, start + 1 + end);
    }
    let positive = sorted.iter().zip(&ranks).filter(|(x, _)| **x > 0.0);
    let sum: usize = positive.map(|(_, rank)| rank).sum();
    // Share of all signs that give each sum.
    let mut share = vec![0.0; ranks.iter().sum::<usize>() + 1];
    share[0] = 1.0;
    let mut largest = 0;
    for &rank in &ranks {
        largest += rank;
        for at in (rank..=largest).rev() {
            share[at] = 0.5 * (share[at] + share[at - rank]);
        }
        for below in &mut share[..rank] {
            *below *= 0.5;
        }
    }
    share[sum..].iter().sum()
}
