//! Comparisons of records, for people.

use proctor_benchmark::record::CaseKey;
use proctor_benchmark::show::comparison::{NAME, chance, escaped, factor, short_name};
use proctor_benchmark::show::shortened;

#[test]
fn chances_and_factors_are_short() {
    assert_eq!(chance(0.00001), "<.001");
    assert_eq!(chance(0.25), ".250");
    assert_eq!(chance(1.0), "1.000");
    assert_eq!(factor(1.0), "=");
    assert_eq!(factor(1.02), "x1.020");
    assert_eq!(factor(1e-7), "x1.0e-7");
}

#[test]
fn solver_and_case_can_be_read() {
    let key = |name: &str| CaseKey {
        name: name.to_owned(),
        aggregate: None,
    };
    for (name, short) in [
        (
            "precision/step-bar/peer/tiny/h=1.2500e-1",
            "step-bar tiny h=1.2500e-1",
        ),
        ("bar/h=1", "bar/h=1"),
    ] {
        assert_eq!(shortened(&short_name(&key(name)), NAME), short);
    }
}

#[test]
fn markdown_signs_in_names_are_escaped() {
    assert_eq!(escaped("a|b_c\n"), "a\\|b\\_c ");
}
