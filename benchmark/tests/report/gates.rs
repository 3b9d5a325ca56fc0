//! Names and numbers of gates on the page.

use proctor_benchmark::report::gates::{short_name, value_of_case};

#[test]
fn a_name_says_nothing_twice() {
    for (name, short) in [
        (
            "shear, Hughes-Winget 3D: error of difference of stress over G, shear, Hughes-Winget 3D, steps=250",
            "shear, Hughes-Winget 3D: error of difference of stress over G, steps=250",
        ),
        (
            "node: observed order of L2(u)",
            "node: observed order of L2(u)",
        ),
        ("usl: error, usla", "usl: error, usla"),
        ("error, error", "error, error"),
    ] {
        assert_eq!(short_name(name), short);
    }
}

#[test]
fn numbers_of_a_gate_are_in_per_cent_unless_its_name_says_otherwise() {
    for (name, value, written) in [
        ("error of L2(u), H/h=64", 0.0125, "1.25 %"),
        ("sum of momenta over that of one ring", 2e-17, "2.0e-15 %"),
        ("node: observed order of L2(u)", 1.96, "1.96"),
        (
            "increase by friction of the force at 60 s, less 5.4 N",
            0.5,
            "0.5 N",
        ),
        ("largest number of vertices inside another grain", 0.0, "0"),
    ] {
        assert_eq!(value_of_case(name, value), written, "{name}");
    }
}
