//! The search for a limit, on functions whose limit is known.

use proctor_verification::stability::measured::{Class, MeasuredLimit, RANGE, bisect};

/// Largest ratio of the ends of the range of a limit.
const NARROW: f64 = 1.02;

fn found(limit: f64, guess: f64) -> MeasuredLimit {
    bisect::<()>(guess, RANGE, |c| Ok(c < limit)).expect("no error")
}

#[test]
fn a_limit_is_enclosed_wherever_the_guess_was() {
    for guess in [0.01, 0.5, 0.7, 0.71, 3.0, f64::INFINITY] {
        let found = found(0.7, guess);
        let (low, high) = (found.stable.expect("low"), found.unstable.expect("high"));
        assert!(low < 0.7 && 0.7 <= high, "{guess}: {found:?}");
        assert!(high / low <= NARROW, "{guess}: {found:?}");
        assert_eq!(found.class, Some(Class::TimeStep));
    }
    assert!(found(0.7, 0.7).runs <= 3);
}

#[test]
fn no_limit_in_the_range_is_none() {
    let high = found(100.0, 1.0);
    assert_eq!((high.stable, high.unstable), (Some(RANGE[1]), None));
    let low = found(0.0, 1.0);
    assert_eq!((low.stable, low.unstable), (None, Some(RANGE[0])));
    assert_eq!(low.class, Some(Class::OtherCause));
}
