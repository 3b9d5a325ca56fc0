//! The bar with a cohesive band.

use approx::assert_relative_eq;
use proctor_verification::exact::softening_bar::SofteningBar;

const BAR: SofteningBar = SofteningBar {
    length: 2.0,
    young: 50.0,
    strength: 0.3,
    opening: 0.04,
};

/// The band takes the work of the end until it has parted: the bar has given back its stored energy.
#[test]
fn the_work_at_the_end_is_the_fracture_energy() {
    let n = 200_000;
    let du = BAR.opening / f64::from(n);
    let work: f64 = (0..n)
        .map(|i| BAR.stress((f64::from(i) + 0.5) * du) * du)
        .sum();
    assert_relative_eq!(work, BAR.fracture_energy(), max_relative = 1e-6);
    assert_eq!(BAR.stress(1.01 * BAR.opening), 0.0);
    assert_relative_eq!(
        BAR.stress(BAR.elastic_end()),
        BAR.strength,
        max_relative = 1e-12
    );
}

/// On the way down the opening and the stretch of the bar add up.
#[test]
fn opening_and_stretch_add_up() {
    for u in [0.015, 0.02, 0.035] {
        let stress = BAR.stress(u);
        let opened = BAR.opening * (1.0 - stress / BAR.strength);
        assert_relative_eq!(
            opened + stress * BAR.length / BAR.young,
            u,
            max_relative = 1e-12
        );
    }
}
