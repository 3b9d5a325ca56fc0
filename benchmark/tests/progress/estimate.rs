//! The estimate of the time that is left, and its words.

use proctor_benchmark::progress::estimate::{left, words};

#[test]
fn at_the_start_an_expectation_is_told_and_nothing_else() {
    assert_eq!(words(left(Some(95.0), 0.0, 0.0)), "about 95 s left");
    assert_eq!(words(left(None, 0.0, 0.0)), "");
    assert_eq!(words(left(None, 0.001, 10.0)), "");
    assert_eq!(words(left(None, 0.02, 0.1)), "");
    for expected in [None, Some(0.0), Some(0.4), Some(50.0), Some(5000.0)] {
        for share in [0.0, 0.005, 0.1] {
            let said = words(left(expected, share, 1.0));
            assert!(!said.contains(" 0 "), "{expected:?} {share}: {said}");
        }
    }
}

#[test]
fn a_machine_half_as_fast_is_found_out_on_the_way() {
    // A hundred seconds were expected, and half of it took a hundred.
    let found = left(Some(100.0), 0.5, 100.0).expect("known");
    assert!((85.0..100.0).contains(&found), "{found}");
    let found = left(Some(100.0), 0.95, 190.0).expect("known");
    assert!((9.0..10.0).contains(&found), "{found}");
    assert_eq!(left(Some(100.0), 1.0, 300.0), Some(0.0));
}

#[test]
fn without_an_expectation_the_work_itself_tells() {
    assert_eq!(left(None, 0.25, 10.0), Some(30.0));
    assert_eq!(words(Some(300.0)), "about 5 min left");
    assert_eq!(words(Some(0.3)), "about 1 s left");
    assert_eq!(words(Some(0.0)), "about 1 s left");
}
