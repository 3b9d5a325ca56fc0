//! Blake's cavity: known numbers, the equation of motion, the load on its wall, and the rest to which it comes.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::cavity::Cavity;

/// A cavity whose radius and wave speed are 1.
const CAVITY: Cavity = Cavity {
    radius: 1.0,
    pressure: 0.7,
    young: 2.5,
    poisson: 0.25,
    density: 3.0,
};

#[test]
fn the_wall_has_the_known_displacement() {
    assert_relative_eq!(CAVITY.speed(), 1.0, max_relative = 1e-14);
    for (t, known) in [
        (0.5, 0.591_72),
        (1.0, 0.992_14),
        (2.0, 1.258_85),
        (4.0, 1.027_23),
    ] {
        let found = 4.0 * CAVITY.shear() / 0.7 * CAVITY.displacement(1.0, t);
        assert_relative_eq!(found, known, epsilon = 6e-6);
    }
    // At last the wall is that of Lamé's cavity.
    assert_relative_eq!(
        4.0 * CAVITY.shear() / 0.7 * CAVITY.displacement(1.0, 60.0),
        1.0,
        epsilon = 1e-10
    );
}

#[test]
fn the_wall_carries_the_pressure_and_nothing_moves_before_the_front() {
    for t in [0.0, 0.3, 1.7] {
        assert_relative_eq!(CAVITY.stress(1.0, t)[0], -0.7, max_relative = 1e-12);
    }
    assert_eq!(CAVITY.displacement(2.0, 0.9), 0.0);
    assert_eq!(CAVITY.stress(2.0, 0.9), [0.0; 2]);
}

#[test]
fn forces_move_the_mass() {
    let (r, t) = (1.4, 1.1);
    let [radial, hoop] = CAVITY.stress(r, t);
    let rise = derivative(|d| CAVITY.stress(r + d, t)[0], 1e-3);
    let acceleration = derivative(|d| CAVITY.velocity(r, t + d), 1e-3);
    assert_relative_eq!(
        rise + 2.0 * (radial - hoop) / r,
        3.0 * acceleration,
        epsilon = 1e-9
    );
    let velocity = derivative(|d| CAVITY.displacement(r, t + d), 1e-3);
    assert_relative_eq!(velocity, CAVITY.velocity(r, t), epsilon = 1e-10);
    let slope = derivative(|d| CAVITY.velocity(r + d, t), 1e-3);
    assert_relative_eq!(slope, CAVITY.velocity_slope(r, t), epsilon = 1e-9);
    // The law: lambda = mu at a Poisson's ratio of a quarter.
    let along = derivative(|d| CAVITY.displacement(r + d, t), 1e-3);
    let around = CAVITY.displacement(r, t) / r;
    assert_relative_eq!(radial, 3.0 * along + 2.0 * around, epsilon = 1e-9);
    assert_relative_eq!(hoop, along + 4.0 * around, epsilon = 1e-9);
}
