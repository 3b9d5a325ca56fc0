//! Meanings of the numbers and words of a record.

use proctor_benchmark::record::Meaning;

#[test]
fn the_key_says_what_a_number_is() {
    for (key, meaning) in [
        ("error_l2_u", Meaning::Error),
        ("observed_order_bar_l2_u", Meaning::Order),
        ("uncertainty_tip_uy", Meaning::Uncertainty),
        ("balance_momentum", Meaning::Balance),
        ("value_force", Meaning::Figure),
        ("exact_force", Meaning::Reference),
        ("gate_value", Meaning::GateValue),
        ("gate_bound", Meaning::GateBound),
        ("instructions", Meaning::Count),
        ("steps", Meaning::Count),
        ("particles", Meaning::Setting),
        ("particle_steps_per_second", Meaning::Information),
        ("ns_solve", Meaning::Information),
    ] {
        assert_eq!(Meaning::of(key), meaning, "{key}");
    }
    assert_eq!(Meaning::of_label("state_hash"), Meaning::Hash);
    assert_eq!(Meaning::of_label("verdict"), Meaning::Settling);
    assert_eq!(Meaning::of_label("lanes"), Meaning::Information);
}
