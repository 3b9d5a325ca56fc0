//! Rigid rotation: the growth factors against the updates they predict, step by step.

use approx::assert_relative_eq;
use nalgebra::Matrix3;
use proctor_verification::exact::rotation::{
    forward_deformation_growth, forward_jaumann_growth, rotated_stress,
};

#[test]
fn published_growth() {
    assert_relative_eq!(forward_jaumann_growth(1000), 1.082_151, max_relative = 1e-6);
    assert_relative_eq!(
        forward_deformation_growth(1000),
        1.0403,
        max_relative = 1e-4
    );
}

#[test]
fn factors_are_what_the_updates_do() {
    let steps = 400;
    let angle = std::f64::consts::TAU / f64::from(steps);
    let spin = Matrix3::new(0.0, -angle, 0.0, angle, 0.0, 0.0, 0.0, 0.0, 0.0);
    let start = Matrix3::new(3.0, 1.0, 0.0, 1.0, -2.0, 0.0, 0.0, 0.0, 5.0);
    let (mut stress, mut deformation) = (start, Matrix3::identity());
    for _ in 0..steps {
        stress += spin * stress - stress * spin;
        deformation += spin * deformation;
    }
    let deviator = |s: &Matrix3<f64>| (0.5 * (s[(0, 0)] - s[(1, 1)])).hypot(s[(0, 1)]);
    assert_relative_eq!(
        deviator(&stress) / deviator(&start),
        forward_jaumann_growth(400),
        max_relative = 1e-11
    );
    assert_relative_eq!(
        deformation.determinant(),
        forward_deformation_growth(400),
        max_relative = 1e-11
    );
    // The mean stress and the out-of-plane stress do not turn.
    assert_relative_eq!(stress.trace(), start.trace(), max_relative = 1e-12);
}

#[test]
fn exact_stress_turns_with_the_body() {
    let stress = Matrix3::new(3.0, 1.0, 0.0, 1.0, -2.0, 0.0, 0.0, 0.0, 5.0);
    let quarter = rotated_stress(&stress, std::f64::consts::FRAC_PI_2);
    let expected = Matrix3::new(-2.0, -1.0, 0.0, -1.0, 3.0, 0.0, 0.0, 0.0, 5.0);
    assert_relative_eq!(quarter, expected, epsilon = 1e-14);
    assert_relative_eq!(
        rotated_stress(&stress, std::f64::consts::TAU),
        stress,
        epsilon = 1e-13
    );
}
