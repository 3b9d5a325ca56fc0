//! The suddenly pressed bar: its modes, balances of momentum and energy, jumps at the front, and its ends.

use approx::assert_relative_eq;
use proctor_verification::exact::step_bar::StepBar;
use std::f64::consts::PI;

const BAR: StepBar = StepBar {
    length: 2.0,
    modulus: 900.0,
    density: 4.0,
    pressure: 0.3,
};

/// By separation of variables: the static solution less its modes.
fn series(x: f64, t: f64) -> f64 {
    let sum: f64 = (1..40_000)
        .map(|n| {
            let k = (f64::from(n) - 0.5) * PI / BAR.length;
            let sign = if n % 2 == 0 { -1.0 } else { 1.0 };
            let shape = 2.0 * sign / (BAR.length * k * k);
            shape * (k * x).sin() * (k * BAR.wave_speed() * t).cos()
        })
        .sum();
    -BAR.pressure / BAR.modulus * (x - sum)
}

#[test]
fn it_is_the_sum_of_its_modes() {
    let scale = BAR.pressure / BAR.modulus * BAR.length;
    for x in [0.0, 0.3, 1.1, 1.9, 2.0] {
        for t in [0.0, 0.05, 0.13, 0.2, 0.35, 0.52, 1.9] {
            let difference = BAR.displacement(x, t) - series(x, t);
            assert!(difference.abs() < 1e-4 * scale, "{x} {t} {difference:e}");
        }
    }
}

#[test]
fn the_notes_have_front_velocity_and_doubling() {
    let (c, transit) = (BAR.wave_speed(), BAR.transit());
    assert_relative_eq!(c, 15.0);
    let v = BAR.pressure / (BAR.density * c);
    for share in [0.25, 0.75] {
        let (t, front) = (share * transit, BAR.length - share * BAR.length);
        assert_eq!(BAR.velocity(front - 1e-9, t), 0.0);
        assert_eq!(BAR.stress(front - 1e-9, t), 0.0);
        assert_relative_eq!(BAR.velocity(front + 1e-9, t), -v);
        assert_relative_eq!(BAR.stress(front + 1e-9, t), -BAR.pressure);
    }
    for (transits, stress) in [
        (0.5, 0.0),
        (1.5, -2.0),
        (2.5, -2.0),
        (3.5, 0.0),
        (5.5, -2.0),
    ] {
        let found = BAR.stress(0.0, transits * transit);
        assert!((found - stress * BAR.pressure).abs() < 1e-14, "{transits}");
    }
}

/// Between fronts velocity and stress do not vary, so that both sides of the wave equation are zero. Across a front that runs
/// with s = +-c momentum asks for [stress] = -rho s [v], and what stays together for [u] = 0.
#[test]
fn jumps_carry_momentum() {
    let (d, c, x) = (1e-7, BAR.wave_speed(), 0.317);
    let jump = |f: &dyn Fn(f64) -> f64, t: f64| f(t + d) - f(t - d);
    for k in 0..6 {
        let way = (2.0 * f64::from(k) + 1.0) * BAR.length;
        // Fronts from the loaded end run towards -x, those from the held end towards +x.
        for (t, s) in [((way - x) / c, -c), ((way + x) / c, c)] {
            let stress = jump(&|t| BAR.stress(x, t), t);
            let velocity = jump(&|t| BAR.velocity(x, t), t);
            let displacement = jump(&|t| BAR.displacement(x, t), t);
            assert_relative_eq!(stress.abs(), BAR.pressure, max_relative = 1e-12);
            assert_relative_eq!(stress, -BAR.density * s * velocity, max_relative = 1e-12);
            assert!(displacement.abs() < 4.0 * d * velocity.abs());
        }
    }
    // From one front to the next nothing else changes.
    let constant = |t: f64| [BAR.stress(x, t), BAR.velocity(x, t)];
    let first = (BAR.length - x) / c;
    assert_eq!(constant(first + d), constant((BAR.length + x) / c - d));
}

/// Momentum is the impulse of pressure and wall, energy the work of the pressure. A wall that gave way, or one whose stress
/// did not double, would break both.
#[test]
fn momentum_and_energy_balance() {
    let n = 4000;
    let dx = BAR.length / f64::from(n);
    let integral = |f: &dyn Fn(f64) -> f64| -> f64 {
        (0..n).map(|i| f((f64::from(i) + 0.5) * dx)).sum::<f64>() * dx
    };
    for transits in [0.3_f64, 0.9, 1.4, 2.2, 3.3, 4.9, 6.5] {
        let t = transits * BAR.transit();
        let momentum = integral(&|x| BAR.density * BAR.velocity(x, t));
        // The wall pushes with 2 p from the first to the third transit of every four.
        let of_cycle = |k: i32| (transits - f64::from(4 * k + 1)).clamp(0.0, 2.0);
        let pushed: f64 = (0..2).map(of_cycle).sum();
        let wall = 2.0 * BAR.pressure * BAR.transit() * pushed;
        let expected = wall - BAR.pressure * t;
        let scale = BAR.pressure * BAR.transit();
        assert!(
            (momentum - expected).abs() < 2e-3 * scale,
            "{transits}: {momentum} {expected}"
        );
        let energy = integral(&|x| {
            0.5 * BAR.density * BAR.velocity(x, t).powi(2)
                + 0.5 * BAR.stress(x, t).powi(2) / BAR.modulus
        });
        let work = -BAR.pressure * BAR.displacement(BAR.length, t);
        let scale = BAR.pressure.powi(2) * BAR.length / BAR.modulus;
        assert!((energy - work).abs() < 4e-3 * scale, "{transits}");
        assert_eq!(BAR.displacement(0.0, t), 0.0);
    }
}
