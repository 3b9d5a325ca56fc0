//! The manufactured motion of a body of revolution, against differences and against turned boxes in space.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::revolved_mms::RevolvedMms;

const MMS: RevolvedMms = RevolvedMms {
    lambda: 3.0,
    mu: 2.0,
    density: 1.5,
    amplitude: 0.07,
    angular_frequency: 2.5,
};
const T: f64 = 0.4;

/// The place of material in space, at an angle about the axis.
fn place(x: [f64; 3]) -> [f64; 3] {
    let r = x[0].hypot(x[1]);
    let [along, up] = MMS.displacement([r, x[2]], T);
    [
        x[0] * (1.0 + along / r),
        x[1] * (1.0 + along / r),
        x[2] + up,
    ]
}

/// Deformation gradient in space, by differences.
fn gradient(x: [f64; 3]) -> matrix::Matrix {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            derivative(
                |d| {
                    let mut at = x;
                    at[j] += d;
                    place(at)[i]
                },
                1e-3,
            )
        })
    })
}

mod matrix {
    pub type Matrix = [[f64; 3]; 3];

    pub fn determinant(f: &Matrix) -> f64 {
        (0..3).map(|i| f[0][i] * cofactor(f, 0, i)).sum()
    }

    pub fn cofactor(f: &Matrix, i: usize, j: usize) -> f64 {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        f[a][c] * f[b][d] - f[a][d] * f[b][c]
    }
}

/// First Piola-Kirchhoff stress in space.
fn nominal(x: [f64; 3]) -> matrix::Matrix {
    let f = gradient(x);
    let j = matrix::determinant(&f);
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let inverse = matrix::cofactor(&f, a, b) / j;
            MMS.lambda * j.ln() * inverse + MMS.mu * (f[a][b] - inverse)
        })
    })
}

/// The body force is that of the same motion in space, at an angle where no axis is special.
#[test]
fn the_force_is_that_of_the_motion_in_space() {
    let (r, z, angle) = (0.45_f64, 0.3, 0.6_f64);
    let x = [r * angle.cos(), r * angle.sin(), z];
    let divergence: [f64; 3] = std::array::from_fn(|i| {
        (0..3)
            .map(|j| {
                derivative(
                    |d| {
                        let mut at = x;
                        at[j] += d;
                        nominal(at)[i][j]
                    },
                    2e-3,
                )
            })
            .sum()
    });
    let u = MMS.displacement([r, z], T);
    let inertia = u.map(|u| -MMS.angular_frequency.powi(2) * u);
    let [along, up] = MMS.body_force([r, z], T);
    assert_relative_eq!(
        along,
        inertia[0] - (divergence[0] * angle.cos() + divergence[1] * angle.sin()) / MMS.density,
        epsilon = 1e-6
    );
    assert_relative_eq!(up, inertia[1] - divergence[2] / MMS.density, epsilon = 1e-6);
}

#[test]
fn the_stress_is_that_of_the_motion_in_space() {
    let (r, z) = (0.45, 0.3);
    let (f, p) = (gradient([r, 0.0, z]), nominal([r, 0.0, z]));
    let j = matrix::determinant(&f);
    let cauchy = |a: usize, b: usize| (0..3).map(|k| p[a][k] * f[b][k]).sum::<f64>() / j;
    let [rr, zz, tt, rz] = MMS.stress([r, z], T);
    for (found, known) in [
        (rr, cauchy(0, 0)),
        (tt, cauchy(1, 1)),
        (zz, cauchy(2, 2)),
        (rz, cauchy(0, 2)),
    ] {
        assert_relative_eq!(found, known, epsilon = 1e-8);
    }
}

#[test]
fn planes_hold_and_the_axis_slides() {
    for (x, held) in [
        ([1.0, 0.3], [true, true]),
        ([0.4, 0.0], [true, true]),
        ([0.4, 1.0], [true, true]),
        ([0.0, 0.3], [true, false]),
    ] {
        let v = MMS.velocity(x, 0.0);
        for axis in 0..2 {
            assert_eq!(v[axis].abs() < 1e-15, held[axis], "{x:?}");
        }
    }
    let x = [0.45, 0.3];
    let [rr, rz, zr, zz, tt] = MMS.velocity_gradient(x);
    let of = |i: usize, dr: f64, dz: f64| MMS.velocity([x[0] + dr, x[1] + dz], 0.0)[i];
    assert_relative_eq!(rr, derivative(|d| of(0, d, 0.0), 1e-3), epsilon = 1e-9);
    assert_relative_eq!(rz, derivative(|d| of(0, 0.0, d), 1e-3), epsilon = 1e-9);
    assert_relative_eq!(zr, derivative(|d| of(1, d, 0.0), 1e-3), epsilon = 1e-9);
    assert_relative_eq!(zz, derivative(|d| of(1, 0.0, d), 1e-3), epsilon = 1e-9);
    assert_relative_eq!(tt, of(0, 0.0, 0.0) / x[0], epsilon = 1e-12);
}
