//! Error bars, for people.

use proctor_benchmark::show::refine::{one_decimal, share, two_digits, with_bar};

#[test]
fn a_bar_has_two_digits_and_its_value_as_many_decimals() {
    let told = |value, bar| with_bar(value, bar);
    assert_eq!(told(-1.52512, 0.0164), ("-1.525".into(), "0.016".into()));
    assert_eq!(told(20934.2, 153.0), ("20934".into(), "153".into()));
    assert_eq!(told(1.5e-9, 2e-11), ("1.5000e-9".into(), "2.0e-11".into()));
    assert_eq!(told(2.0, 0.0), ("2".into(), "0".into()));
    assert_eq!(share(0.0123), "1.2 %");
    assert_eq!(share(1e-6), "0.00 %");
    assert_eq!(two_digits(0.0712), "0.071");
    assert_eq!(
        (one_decimal(-0.04), one_decimal(-1.26)),
        ("0.0".into(), "-1.3".into())
    );
}
