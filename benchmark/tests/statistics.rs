//! Statistics against values of the literature and of SciPy 1.17.1.

use proctor_benchmark::statistics::{Summary, mann_whitney, median, ratio_interval, signed_rank};

fn near(found: Option<f64>, expected: f64) {
    let found = found.expect("a value");
    assert!(
        (found - expected).abs() <= 1e-12 * expected,
        "{found} but {expected}"
    );
}

#[test]
fn quartiles_interpolate_as_numpy_does() {
    // numpy.quantile([3,1,4,1,5,9,2,6], [.25,.5,.75])
    let summary = Summary::of(&[3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0]).expect("values");
    assert_eq!(summary.lower_quartile, 1.75);
    assert_eq!(summary.median, 3.5);
    assert_eq!(summary.upper_quartile, 5.25);
    assert_eq!(
        (summary.minimum, summary.maximum, summary.count),
        (1.0, 9.0, 8)
    );
    assert_eq!(summary.spread(), 8.0 / 3.5);
}

#[test]
fn nothing_has_no_statistics() {
    assert_eq!(median(&[]), None);
    assert_eq!(Summary::of(&[]), None);
    assert_eq!(mann_whitney(&[], &[1.0]), None);
    assert_eq!(ratio_interval(&[1.0], &[], 1), None);
    assert_eq!(median(&[7.0]), Some(7.0));
}

#[test]
fn the_rank_test_is_exact_for_small_samples() {
    // Permeability of membranes, Hollander and Wolfe 1973, Nonparametric Statistical Methods, p. 69: p = 0.2544.
    let at_term = [0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46];
    let weeks_12_to_26 = [1.15, 0.88, 0.90, 0.74, 1.21];
    near(
        mann_whitney(&at_term, &weeks_12_to_26),
        0.254_412_254_412_254_4,
    );
    // Wholly apart: 2 of the C(n + m, n) orders; 20 of three and three, 48 620 of nine and nine.
    near(mann_whitney(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]), 2.0 / 20.0);
    let low: Vec<f64> = (1..=9).map(f64::from).collect();
    let high: Vec<f64> = (10..=18).map(f64::from).collect();
    near(mann_whitney(&low, &high), 2.0 / 48_620.0);
    near(mann_whitney(&high, &low), 2.0 / 48_620.0);
    // scipy.stats.mannwhitneyu(..., method="exact")
    let a = [1.1, 2.2, 3.3, 4.4, 9.9];
    let b = [2.5, 3.5, 6.1, 7.2, 8.3, 0.3];
    near(mann_whitney(&a, &b), 0.792_207_792_207_792_1);
}

#[test]
fn ties_and_large_samples_take_the_normal_distribution() {
    // scipy.stats.mannwhitneyu(..., method="asymptotic")
    let a = [1.0, 2.0, 2.0, 3.0, 4.0, 4.0, 5.0];
    let b = [2.0, 4.0, 5.0, 5.0, 6.0, 7.0, 7.0, 8.0];
    near(mann_whitney(&a, &b), 0.022_410_040_622_825_05);
    let a: Vec<f64> = (0..60).map(f64::from).collect();
    let b: Vec<f64> = (0..55).map(|i| f64::from(i) + 10.5).collect();
    near(mann_whitney(&a, &b), 0.017_466_219_103_968_242);
    near(mann_whitney(&[1.0; 3], &[1.0; 3]), 1.0);
}

#[test]
fn the_interval_is_the_same_for_the_same_seed_and_holds_the_ratio() {
    let base: Vec<f64> = (0..9).map(|i| 1.0 + 0.01 * f64::from(i)).collect();
    let head: Vec<f64> = base.iter().map(|x| 1.1 * x).collect();
    let interval = ratio_interval(&base, &head, 3).expect("an interval");
    assert_eq!(Some(interval), ratio_interval(&base, &head, 3));
    assert!(interval.0 < 1.1 && 1.1 < interval.1, "{interval:?}");
    // Medians of resamples lie within the samples: the interval can be no wider than 1.1 / 1.08 to 1.1 * 1.08.
    assert!(
        interval.0 >= 1.1 / 1.08 && interval.1 <= 1.1 * 1.08,
        "{interval:?}"
    );
    // Without noise there is nothing between its ends.
    assert_eq!(ratio_interval(&[2.0; 5], &[3.0; 5], 3), Some((1.5, 1.5)));
}

#[test]
fn the_interval_covers_the_truth_about_as_often_as_it_says() {
    // 400 pairs of samples of nine from one uniform distribution: the ratio of medians is 1.
    let mut random = oorandom::Rand64::new(11);
    let mut draw = || {
        (0..9)
            .map(|_| 1.0 + random.rand_float())
            .collect::<Vec<f64>>()
    };
    let pairs = 400;
    let held = (0..pairs)
        .filter(|&seed| {
            let (low, high) = ratio_interval(&draw(), &draw(), seed).expect("an interval");
            low <= 1.0 && 1.0 <= high
        })
        .count();
    let share = held as f64 / pairs as f64;
    // Percentile intervals of medians of few values are known to be a little too wide, never narrow by much.
    assert!((0.90..=1.0).contains(&share), "{share}");
}

#[test]
fn the_signed_rank_test_is_exact() {
    // Depression scores, Hollander and Wolfe 1973, Nonparametric Statistical Methods, p. 29: p = 0.01953 = 10 / 2^9.
    let differences = [
        0.952, -0.147, 1.022, 0.430, 0.620, 0.590, 0.490, -0.080, 0.010,
    ];
    near(Some(signed_rank(&differences)), 10.0 / 512.0);
    // All of twelve positive: one of 2^12 signs. All but the smallest: two.
    let mut all: Vec<f64> = (1..=12).map(f64::from).collect();
    near(Some(signed_rank(&all)), 1.0 / 4096.0);
    all[0] = -1.0;
    near(Some(signed_rank(&all)), 2.0 / 4096.0);
    // Ranks 1.5, 1.5 and 3, of which 4.5 or more is reached by 4.5, 4.5 and 6.
    near(Some(signed_rank(&[-1.0, 1.0, 2.0])), 3.0 / 8.0);
    near(Some(signed_rank(&[0.5; 3])), 1.0 / 8.0);
    near(Some(signed_rank(&[0.0, 0.0])), 1.0);
    near(Some(signed_rank(&[])), 1.0);
}
