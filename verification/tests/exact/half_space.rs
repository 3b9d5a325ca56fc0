//! The half-space under a point and under a disc: each against the other, and stress against displacement.

use approx::assert_relative_eq;
use proctor_verification::exact::boussinesq_half_space::vertical_displacement;
use proctor_verification::exact::half_space::HalfSpace;
use std::f64::consts::PI;

const SPACE: HalfSpace = HalfSpace {
    young: 1000.0,
    poisson: 0.3,
};

#[test]
fn a_point_has_the_displacement_of_the_manual() {
    for (r, z) in [(0.0, 1.0), (1.0, 0.0), (0.7, 1.9)] {
        let [_, down] = SPACE.point_displacement(5.0, r, z);
        let manual = vertical_displacement(1000.0, 0.3, 5.0, r, z);
        assert_relative_eq!(down, -manual, max_relative = 1e-14);
    }
}

/// Stress from the strain of the displacement, by differences.
#[test]
fn stress_of_a_point_is_that_of_its_displacement() {
    let (r, z, h) = (0.8, 1.3, 1e-5);
    let u = |r: f64, z: f64| SPACE.point_displacement(5.0, r, z);
    let along_r: [f64; 2] = std::array::from_fn(|i| (u(r + h, z)[i] - u(r - h, z)[i]) / (2.0 * h));
    let along_z: [f64; 2] = std::array::from_fn(|i| (u(r, z + h)[i] - u(r, z - h)[i]) / (2.0 * h));
    let (rr, zz, tt) = (along_r[0], along_z[1], u(r, z)[0] / r);
    let shear = 1000.0 / 2.6;
    let lame = 2.0 * shear * 0.3 / 0.4;
    let exact = SPACE.point_stress(5.0, r, z);
    for (i, strain) in [rr, zz, tt].into_iter().enumerate() {
        let stress = lame * (rr + zz + tt) + 2.0 * shear * strain;
        assert_relative_eq!(stress, exact[i], epsilon = 1e-7);
    }
    assert_relative_eq!(shear * (along_z[0] + along_r[1]), exact[3], epsilon = 1e-7);
}

#[test]
fn a_disc_is_a_sum_of_points() {
    let load = [2.0, 0.5];
    // Far away it is one point.
    let far = SPACE.disc_displacement(load, [300.0, 400.0]);
    let point = SPACE.point_displacement(2.0 * PI * 0.25, 300.0, 400.0);
    assert_relative_eq!(far[0], point[0], max_relative = 1e-5);
    assert_relative_eq!(far[1], point[1], max_relative = 1e-5);
    // On the axis it is the closed form.
    for depth in [0.75, 1.5, 4.0] {
        let sum = SPACE.disc_displacement(load, [0.0, depth])[1];
        assert_relative_eq!(
            sum,
            SPACE.axis_displacement(load, depth),
            max_relative = 1e-9
        );
    }
}

#[test]
fn the_axis_has_the_known_numbers() {
    let load = [1.0, 1.0];
    let [radial, vertical] = SPACE.axis_stress(load, 1.0);
    assert_relative_eq!(vertical, -0.646_447, max_relative = 1e-6);
    assert_relative_eq!(radial, -0.057_538, max_relative = 1e-4);
    let settlement = SPACE.axis_displacement(load, 1.0) * 1000.0;
    assert_relative_eq!(settlement, 1.134_630, max_relative = 1e-6);
    assert_relative_eq!(
        SPACE.axis_displacement(load, 0.0),
        2.0 * 0.91 / 1000.0,
        max_relative = 1e-14
    );
}

#[test]
fn a_punch_is_a_sum_of_points_with_a_flat_middle() {
    let punch = [2e-3, 0.5];
    let load = SPACE.punch_load(punch);
    assert_relative_eq!(load, 2.0 * 1000.0 * 0.5 * 2e-3 / 0.91, max_relative = 1e-14);
    // Far away it is one point.
    let far = SPACE.punch_displacement(punch, [300.0, 400.0]);
    let point = SPACE.point_displacement(load, 300.0, 400.0);
    assert_relative_eq!(far[0], point[0], max_relative = 1e-5);
    assert_relative_eq!(far[1], point[1], max_relative = 1e-5);
    // The surface beside it sinks by 2 d/pi asin(a/r) (Johnson 1985, eq. 3.38).
    for radius in [0.75_f64, 1.5, 4.0] {
        let down = SPACE.punch_displacement(punch, [radius, 0.0])[1];
        let exact = 2.0 * 2e-3 / PI * (0.5 / radius).asin();
        assert_relative_eq!(down, exact, max_relative = 1e-9);
    }
    // On the axis, stress from the strain of the displacement, by differences.
    let (z, h) = (0.9, 1e-4);
    let u = |r: f64, z: f64| SPACE.punch_displacement(punch, [r, z]);
    let (across, along) = (
        u(h, z)[0] / h,
        (u(0.0, z + h)[1] - u(0.0, z - h)[1]) / (2.0 * h),
    );
    let shear = 1000.0 / 2.6;
    let lame = 2.0 * shear * 0.3 / 0.4;
    let stress = lame * (2.0 * across + along) + 2.0 * shear * along;
    assert_relative_eq!(
        stress,
        SPACE.punch_axis_stress(punch, z),
        max_relative = 1e-5
    );
}
