//! Sizes and lists of processors of a machine, as numbers.

use proctor_benchmark::record::machine::{listed, size};

#[test]
fn sizes_are_in_bytes() {
    assert_eq!(size("32K"), Some(32_768));
    assert_eq!(size("8M"), Some(8 << 20));
    assert_eq!(size("512"), Some(512));
    assert_eq!(size("big"), None);
    assert_eq!(size(""), None);
}

#[test]
fn a_list_of_processors_is_counted() {
    assert_eq!(listed("0"), 1);
    assert_eq!(listed("0-3"), 4);
    assert_eq!(listed("0-3,8,10-11"), 7);
}
