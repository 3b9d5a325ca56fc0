//! The half-space column of the table in the verification notes, section 2.

use approx::assert_relative_eq;
use proctor_verification::exact::boussinesq_half_space::vertical_displacement;

#[test]
fn table_values() {
    // (horizontal distance, depth, u_z in 1e-9 m) for E = 200 MPa, nu = 0.25, P = 1 N.
    let table = [
        (0.0, 0.05, -49.735_920),
        (0.0, 0.5, -4.973_592),
        (0.0, 0.9, -2.763_107),
        (0.1, 0.1, -14.067_442),
        (0.25, 0.25, -5.626_977),
        (0.5_f64.hypot(0.5), 0.5, -2.105_770),
        (0.5, 0.5, -2.813_488),
        (0.05, 0.0, -29.841_552),
        (0.5, 0.0, -2.984_155),
        (0.5_f64.hypot(0.5), 0.0, -2.110_116),
    ];
    for (radius, depth, expected) in table {
        assert_relative_eq!(
            vertical_displacement(200e6, 0.25, 1.0, radius, depth),
            expected * 1e-9,
            max_relative = 3e-7
        );
    }
}

#[test]
fn infinite_at_the_load() {
    assert_eq!(
        vertical_displacement(1.0, 0.2, 1.0, 0.0, 0.0),
        f64::NEG_INFINITY
    );
}
