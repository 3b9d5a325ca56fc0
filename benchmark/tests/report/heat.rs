//! The map of run times on the page.

use proctor_benchmark::report::heat::milliseconds;

#[test]
fn milliseconds_are_short() {
    for (seconds, text) in [
        (3.61e-4, ".36"),
        (1.24e-3, "1.2"),
        (0.095, "95"),
        (0.7509, "751"),
        (12.3, "12k"),
    ] {
        assert_eq!(milliseconds(seconds), text);
    }
}
