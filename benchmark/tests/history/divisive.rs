//! Change points of a noisy series: found where they are, and no others.

use oorandom::Rand64;
use proctor_benchmark::history::divisive::{splits, t_test};

/// Uniform noise of half a width around levels that begin at those places.
fn noisy(levels: &[(usize, f64)], count: usize, half: f64, seed: u128) -> Vec<f64> {
    let mut random = Rand64::new(seed);
    let value = |place: usize, random: &mut Rand64| {
        let level = levels.iter().rfind(|(from, _)| *from <= place);
        level.map_or(0.0, |(_, level)| {
            level * (1.0 + half * (2.0 * random.rand_float() - 1.0))
        })
    };
    (0..count).map(|place| value(place, &mut random)).collect()
}

#[test]
fn the_t_test_gives_what_tables_give() {
    // t = 2.228 at 10 degrees of freedom is 5 % (two-sided); t = 12.706 at 1 is 5 %.
    for (freedom, t, chance) in [
        (10.0, 2.228_138_852, 0.05),
        (1.0, 12.706_204_736, 0.05),
        (30.0, 3.645_958_635, 0.001),
    ] {
        // One value against freedom + 1 others, 0, 1, 2 ..., at the distance from their mean that has this t.
        let others: Vec<f64> = (0..=freedom as u32).map(f64::from).collect();
        let count: f64 = freedom + 1.0;
        let variance = count * (count * count - 1.0) / 12.0 / freedom;
        let distance = t * (variance * (1.0 + 1.0 / count)).sqrt();
        let found = t_test(&[0.5 * freedom + distance], &others);
        assert!((found / chance - 1.0).abs() < 1e-6, "{freedom}: {found}");
    }
    // By hand: means 2 and 5, squares 2 and 2, variance 1, t² = 9 / (2/3).
    let chance = t_test(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]);
    assert!(
        (chance - 0.021_311_641_128_756_88).abs() < 1e-12,
        "{chance}"
    );
    assert_eq!(t_test(&[1.0], &[2.0]), 1.0);
    assert_eq!(t_test(&[1.0, 1.0], &[2.0]), 0.0);
}

/// Number of false change points; every true one is found, to a place.
fn false_alarms(levels: &[(usize, f64)], count: usize, half: f64) -> usize {
    let one = |seed: u128| {
        let values = noisy(levels, count, half, seed);
        let found: Vec<usize> = splits(&values).iter().map(|split| split.at).collect();
        for (due, _) in &levels[1..] {
            let near = found.iter().any(|at| at.abs_diff(*due) <= 1);
            assert!(near, "seed {seed}: {found:?} for {due}");
        }
        found.len() + 1 - levels.len()
    };
    (0..20).map(one).sum()
}

#[test]
fn levels_are_found_where_they_begin() {
    let levels = [(0, 1.0), (40, 1.1), (90, 1.0), (160, 1.3)];
    let alarms = false_alarms(&levels, 200, 0.03);
    assert!(alarms <= 4, "{alarms} in 20 series of 200");
}

#[test]
fn a_later_change_does_not_hide_an_earlier_one() {
    let alarms = false_alarms(&[(0, 1.0), (25, 1.06), (45, 0.9)], 60, 0.01);
    assert!(alarms <= 2, "{alarms} in 20 series of 60");
}

#[test]
fn noise_alone_is_rarely_a_change() {
    // Windows and stretches are many tries of each series: the chance of one of them is above that of a single test.
    let alarms = (0..200).filter(|seed| !splits(&noisy(&[(0, 1.0)], 60, 0.1, *seed)).is_empty());
    let alarms = alarms.count();
    assert!(alarms <= 10, "{alarms} of 200");
}

#[test]
fn short_and_equal_series_have_none() {
    for values in [&[][..], &[1.0], &[1.0, 2.0], &[3.0; 40]] {
        assert_eq!(splits(values), []);
    }
    // A step without noise is found at once, also with a single value after it.
    let mut step = vec![1.0; 9];
    step.push(2.0);
    assert_eq!(
        splits(&step)
            .iter()
            .map(|split| split.at)
            .collect::<Vec<_>>(),
        [9]
    );
}
