//! Gates are judged from their rows alone.

use proctor_benchmark::record::Row;
use proctor_benchmark::record::gate::GateRow;

#[test]
fn a_gate_holds_by_its_numbers_alone() {
    // Keys of a record, as every reader of records has them.
    let row = |value: f64, bound: f64, side: &str| {
        let mut row = Row::aggregate("bar: error: of u", "gate", 1);
        row.count("gate_value", value);
        row.count("gate_bound", bound);
        row.label("gate_side", side);
        row
    };
    for (value, bound, side, holds) in [
        (1.0, 1.0, "at most", true),
        (1.1, 1.0, "at most", false),
        (1.0, 1.0, "at least", true),
        (0.9, 1.0, "at least", false),
        (f64::NAN, 1.0, "at most", false),
        (1.0, f64::NAN, "at least", false),
    ] {
        let row = row(value, bound, side);
        let gate = GateRow::of(&row).expect("a gate");
        assert_eq!((gate.case, gate.name), ("bar", "error: of u"));
        assert_eq!(gate.holds(), holds, "{value} {side} {bound}");
    }
    assert_eq!(GateRow::of(&Row::sample("bar: a", 0, 1)), None);
}
