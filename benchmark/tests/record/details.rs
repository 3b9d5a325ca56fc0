//! Gates as a record keeps them.

use proctor_benchmark::record::details::gate;
use proctor_verification::case::Gate;

#[test]
fn a_gate_uses_up_a_share_of_its_bound() {
    let at_most = |value, bound| gate(&Gate::at_most(String::new(), value, bound, "")).used();
    let at_least = |value, bound| gate(&Gate::at_least(String::new(), value, bound, "")).used();
    assert_eq!(at_most(0.004, 0.005), 0.8);
    assert_eq!(at_least(2.0, 1.8), 0.9);
    assert_eq!(at_most(-4.0, -2.0), 0.5);
    assert_eq!(at_least(-2.0, -4.0), 0.5);
    // Nothing is allowed and nothing was found; and on the far side of zero.
    assert_eq!(at_most(0.0, 0.0), 0.0);
    assert_eq!(at_most(-1.0, 2.0), 0.0);
    assert_eq!(at_least(0.1, 0.0), 0.0);
    // What does not hold uses up more than all of it.
    assert_eq!(at_most(0.01, 0.005), 2.0);
    assert_eq!(at_least(0.9, 1.8), 2.0);
    for share in [
        at_most(f64::NAN, 1.0),
        at_most(1e-9, 0.0),
        at_least(-1.0, 1.8),
        at_least(-1.0, 0.0),
    ] {
        assert_eq!(share, f64::INFINITY);
    }
}
