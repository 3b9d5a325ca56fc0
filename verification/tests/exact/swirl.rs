//! The swirl fulfils Navier's equation and the conditions of rollers, by differences.

use proctor_verification::exact::swirl::Swirl;

const SWIRL: Swirl = Swirl {
    side: 0.8,
    amplitude: 3e-4,
    shear: 4e6,
    density: 1200.0,
};
const STEP: f64 = 1e-3;

/// Central difference along an axis of a component of the displacement \[1\].
fn slope(x: [f64; 2], t: f64, component: usize, axis: usize) -> f64 {
    let at = |away: f64| {
        let mut place = x;
        place[axis] += away;
        SWIRL.displacement(place, t)[component]
    };
    (at(STEP) - at(-STEP)) / (2.0 * STEP)
}

#[test]
fn stresses_are_those_of_the_displacement_and_accelerate_it() {
    let t = 1.1e-3;
    // Lambda has no say, whatever it is, as the volume stays.
    for x in [[0.11, 0.23], [0.4, 0.61], [0.7, 0.05]] {
        let [[xx, xy], [yx, yy]] = [0, 1].map(|a| [0, 1].map(|b| slope(x, t, a, b)));
        let size = SWIRL.amplitude / SWIRL.side;
        assert!((xx + yy).abs() < 1e-5 * size, "the volume stays");
        assert!((xy + yx).abs() < 1e-5 * size, "no shear in these axes");
        let [stress_xx, stress_yy] = SWIRL.normal_stresses(x, t);
        let scale = 2.0 * SWIRL.shear * size;
        assert!((stress_xx - 2.0 * SWIRL.shear * xx).abs() < 1e-5 * scale);
        assert!((stress_yy - 2.0 * SWIRL.shear * yy).abs() < 1e-5 * scale);
        for axis in 0..2 {
            let at = |away: f64| {
                let mut place = x;
                place[axis] += away;
                SWIRL.normal_stresses(place, t)[axis]
            };
            let force = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let dt = 1e-6;
            let rate = SWIRL.velocity(x, t + dt)[axis] - SWIRL.velocity(x, t - dt)[axis];
            let inertia = SWIRL.density * rate / (2.0 * dt);
            assert!(
                (force - inertia).abs() < 1e-4 * scale / SWIRL.side,
                "{force} {inertia}"
            );
        }
    }
}

#[test]
fn velocities_are_those_of_the_displacement_and_rollers_hold_nothing_along() {
    let (x, t, dt) = ([0.31, 0.17], 0.7e-3, 1e-7);
    for axis in 0..2 {
        let rate = (SWIRL.displacement(x, t + dt)[axis] - SWIRL.displacement(x, t - dt)[axis])
            / (2.0 * dt);
        let velocity = SWIRL.velocity(x, t)[axis];
        assert!((rate - velocity).abs() < 1e-5 * velocity.abs());
    }
    // Across each side nothing moves, and it starts at rest where it shall swing.
    for (x, axis) in [
        ([0.0, 0.3], 0),
        ([0.8, 0.3], 0),
        ([0.3, 0.0], 1),
        ([0.3, 0.8], 1),
    ] {
        assert!(SWIRL.displacement(x, t)[axis].abs() < 1e-15 * SWIRL.side);
    }
    assert_eq!(SWIRL.displacement([0.2, 0.5], 0.0), [0.0, 0.0]);
    // The middle turns as a rigid body does: the angle is half the curl.
    let middle = [0.4, 0.4];
    let turn = 0.5 * (slope(middle, t, 1, 0) - slope(middle, t, 0, 1));
    let due =
        SWIRL.amplitude * std::f64::consts::PI / SWIRL.side * (SWIRL.angular_frequency() * t).sin();
    assert!((turn - due).abs() < 1e-5 * due.abs(), "{turn} {due}");
}
