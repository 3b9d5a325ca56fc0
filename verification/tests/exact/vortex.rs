//! The vortex against its balance of momentum, by finite differences, and what wrong signs leave in it.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::vortex::{RADII, Vortex};

const VORTEX: Vortex = Vortex {
    shear: 400.0,
    density: 2.0,
    amplitude: 1.0,
    angular_frequency: std::f64::consts::PI,
    power: 2,
};
const LAMBDA: f64 = 600.0;
/// Points and times away from zeros of the profile and of the sine.
const POINTS: [[f64; 2]; 4] = [[0.8, 0.1], [-0.3, 0.9], [0.2, -1.1], [-0.7, -0.9]];
const TIMES: [f64; 3] = [0.1, 0.37, 0.8];

/// Derivative along an axis of the initial position.
fn along(f: impl Fn([f64; 2]) -> f64, x: [f64; 2], axis: usize) -> f64 {
    let moved = |e: f64| {
        let mut y = x;
        y[axis] += e;
        f(y)
    };
    derivative(moved, 2e-4)
}

/// F^-T of a deformation gradient, and J.
fn inverse_transposed(f: [[f64; 2]; 2]) -> ([[f64; 2]; 2], f64) {
    let j = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    let g = [[f[1][1] / j, -f[1][0] / j], [-f[0][1] / j, f[0][0] / j]];
    (g, j)
}

/// Nominal stress of the neo-Hookean law.
fn nominal(f: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let (g, j) = inverse_transposed(f);
    std::array::from_fn(|a| {
        std::array::from_fn(|b| LAMBDA * j.ln() * g[a][b] + VORTEX.shear * (f[a][b] - g[a][b]))
    })
}

/// Residual of the balance of momentum at a point with a body force (m/s²).
fn residual(x: [f64; 2], t: f64, body_force: [f64; 2]) -> [f64; 2] {
    residual_of(&VORTEX, x, t, body_force)
}

fn residual_of(vortex: &Vortex, x: [f64; 2], t: f64, body_force: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|i| {
        let inertia = derivative(|e| vortex.velocity(x, t + e)[i], 1e-4);
        let divergence: f64 = (0..2)
            .map(|j| along(|y| nominal(vortex.deformation(y, t))[i][j], x, j))
            .sum();
        inertia - divergence / vortex.density - body_force[i]
    })
}

/// Largest residual over all points and times, over the largest body force.
fn worst(body_force: impl Fn([f64; 2], f64) -> [f64; 2]) -> f64 {
    let (mut largest, mut scale) = (0.0_f64, 0.0_f64);
    for x in POINTS {
        for t in TIMES {
            let [a, b] = residual(x, t, body_force(x, t));
            largest = largest.max(a.hypot(b));
            let [a, b] = VORTEX.body_force(x, t);
            scale = scale.max(a.hypot(b));
        }
    }
    largest / scale
}

#[test]
fn momentum_balances() {
    let left = worst(|x, t| VORTEX.body_force(x, t));
    assert!(left < 1e-7, "{left:e}");
    let smoother = Vortex { power: 3, ..VORTEX };
    for x in POINTS {
        for t in TIMES {
            let force = smoother.body_force(x, t);
            let [a, b] = residual_of(&smoother, x, t, force);
            assert!(a.hypot(b) < 1e-6 * force[0].hypot(force[1]), "{x:?} {t}");
        }
    }
}

/// The published profile has a force that jumps where the rings end; one power more has none.
#[test]
fn the_published_force_jumps_at_the_radii() {
    let force = |power: i32, radius: f64| {
        let vortex = Vortex { power, ..VORTEX };
        let [a, b] = vortex.body_force([radius, 0.0], 0.4);
        a.hypot(b)
    };
    for (radius, inside) in [(RADII[0], 1e-9), (RADII[1], -1e-9)] {
        assert_eq!(force(2, radius - inside), 0.0);
        // mu/rho R times the second derivative, 128 A sin(W t), or nothing.
        let jump = 200.0 * radius * 128.0 * (0.4 * std::f64::consts::PI).sin();
        assert_relative_eq!(force(2, radius + inside), jump, max_relative = 1e-6);
        assert!(force(3, radius + inside) < 1e-6 * jump);
    }
}

/// In the basis of the initial position the published components are -b_t sin(alpha) + b_r cos(alpha) and
/// b_t cos(alpha) + b_r sin(alpha). One program has R (d alpha/dt)² in the second with a plus.
#[test]
fn the_published_wrong_sign_leaves_a_residual() {
    let wrong = |x: [f64; 2], t: f64| {
        let turn = VORTEX.turn(x, t);
        let [r, s] = VORTEX.turned_body_force(x, t);
        let (sin, cos) = turn.angle.sin_cos();
        let centripetal = turn.radius * turn.rate * turn.rate;
        let radial = r * cos - s * sin;
        let tangential = r * sin + s * cos + 2.0 * centripetal * sin;
        let (sin, cos) = turn.start.sin_cos();
        [
            cos * radial - sin * tangential,
            sin * radial + cos * tangential,
        ]
    };
    // One term among forces of stress that are larger, but a thousand times what the right sign leaves.
    let left = worst(wrong);
    assert!(left > 1e-4, "{left:e}");
    for x in POINTS {
        let t = TIMES[0];
        let turn = VORTEX.turn(x, t);
        let [a, b] = residual(x, t, wrong(x, t));
        let expected = 2.0 * turn.radius * turn.rate * turn.rate * turn.angle.sin().abs();
        let scale = VORTEX.body_force(x, t);
        let round_off = 1e-7 * scale[0].hypot(scale[1]);
        assert!((a.hypot(b) - expected).abs() < round_off.max(1e-6 * expected));
    }
}

/// The force belongs to the basis that has turned by theta + alpha.
#[test]
fn a_force_in_a_wrong_basis_leaves_a_residual() {
    for share in [0.0, -1.0, 0.9, 1.1] {
        let left = worst(|x, t| {
            let mut turn = VORTEX.turn(x, t);
            turn.angle *= share;
            turn.in_plane(VORTEX.turned_body_force(x, t))
        });
        assert!(left > 1e-2, "{share}: {left:e}");
    }
}

/// Each of the terms counts: with any sign turned round momentum does not balance.
#[test]
fn every_term_has_its_sign() {
    for term in 0..4 {
        let left = worst(|x, t| {
            let turn = VORTEX.turn(x, t);
            let (r, stiffness) = (turn.radius, VORTEX.shear / VORTEX.density);
            let mut terms = [
                stiffness * r * turn.slope * turn.slope,
                -r * turn.rate * turn.rate,
                r * turn.acceleration,
                -stiffness * (3.0 * turn.slope + r * turn.curvature),
            ];
            terms[term] = -terms[term];
            turn.in_plane([terms[0] + terms[1], terms[2] + terms[3]])
        });
        assert!(left > 1e-4, "{term}: {left:e}");
    }
}

#[test]
fn deformation_velocity_and_gradient_are_derivatives() {
    for x in POINTS {
        for t in TIMES {
            let f = VORTEX.deformation(x, t);
            for i in 0..2 {
                for j in 0..2 {
                    let one = f64::from(u8::from(i == j));
                    let u = along(|y| VORTEX.displacement(y, t)[i], x, j);
                    assert!((one + u - f[i][j]).abs() < 1e-9, "{x:?} {t} {i}{j}");
                }
                let v = derivative(|e| VORTEX.displacement(x, t + e)[i], 1e-4);
                assert!((v - VORTEX.velocity(x, t)[i]).abs() < 1e-9);
            }
            assert_relative_eq!(inverse_transposed(f).1, 1.0, max_relative = 1e-12);
        }
        let gradient = VORTEX.velocity_gradient(x);
        for i in 0..2 {
            for j in 0..2 {
                let slope = along(|y| VORTEX.velocity(y, 0.0)[i], x, j);
                assert!((gradient[i][j] - slope).abs() < 1e-8, "{x:?} {i}{j}");
            }
        }
    }
}

/// sigma = P F^T / J with J = 1, and lambda has no say.
#[test]
fn the_stress_is_that_of_the_law() {
    for x in POINTS {
        for t in TIMES {
            let f = VORTEX.deformation(x, t);
            let p = nominal(f);
            let [xx, yy, zz, xy] = VORTEX.stress(x, t);
            let cauchy =
                |i: usize, j: usize| -> f64 { (0..2).map(|k| p[i][k] * f[j][k]).sum::<f64>() };
            let scale = 1e-9 * VORTEX.shear * 50.0;
            assert!((cauchy(0, 0) - xx).abs() < scale);
            assert!((cauchy(1, 1) - yy).abs() < scale);
            assert!((cauchy(0, 1) - xy).abs() < scale);
            assert!((cauchy(1, 0) - xy).abs() < scale);
            assert_eq!(zz, 0.0);
        }
    }
}

#[test]
fn both_circles_are_free_of_stress_and_the_rest_is_at_rest() {
    let t = 0.4;
    for radius in [0.3, RADII[0], RADII[1], 1.4] {
        let x = [0.6 * radius, 0.8 * radius];
        assert!(VORTEX.stress(x, t).iter().all(|s| s.abs() < 1e-9));
        assert!(VORTEX.displacement(x, t).iter().all(|u| u.abs() < 1e-15));
    }
    // Just inside them nothing jumps.
    for radius in [RADII[0] + 1e-6, RADII[1] - 1e-6] {
        let stress = VORTEX.stress([0.0, radius], t);
        assert!(stress.iter().all(|s| s.abs() < 0.1), "{stress:?}");
    }
}

/// The notes: with A = 1 the largest shear is 7.07, at R = 1.150.
#[test]
fn the_largest_shear_is_the_published_one() {
    let (shear, radius) = (7500..12500)
        .map(|i| f64::from(i) * 1e-4)
        .map(|r| (VORTEX.turn([r, 0.0], 0.5).shear().abs(), r))
        .fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
    assert_relative_eq!(shear, 7.07, max_relative = 1e-3);
    assert_relative_eq!(radius, 1.150, max_relative = 1e-3);
}
