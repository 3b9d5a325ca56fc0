//! Text of charts.

use proctor_benchmark::show::chart::text::{lines, superscript};

#[test]
fn exponents_and_breaks() {
    assert_eq!(superscript(-304), "⁻³⁰⁴");
    assert_eq!(lines("one two three", 10.0, 50.0), ["one two", "three"]);
    assert_eq!(lines("unbreakable", 10.0, 5.0), ["unbreakable"]);
}
