//! The vibrating bar: the numbers of the verification notes (A4), its equation and its ends.

use approx::assert_relative_eq;
use proctor_verification::exact::bar::{Bar, FarEnd};

fn bar(far_end: FarEnd, mode: u32) -> Bar {
    Bar {
        length: 25.0,
        modulus: 100.0,
        density: 1.0,
        velocity_amplitude: 0.1,
        mode,
        far_end,
    }
}

#[test]
fn fixed_free_has_the_published_numbers() {
    let bar = bar(FarEnd::Free, 1);
    assert_relative_eq!(
        std::f64::consts::TAU / bar.angular_frequency(),
        10.0,
        max_relative = 1e-14
    );
    assert_relative_eq!(bar.displacement(25.0, 2.5), 0.159_155, max_relative = 1e-6);
    assert_relative_eq!(bar.mean_velocity(0.0), 0.063_662_0, max_relative = 1e-6);
}

#[test]
fn waves_and_ends() {
    for (far_end, mode) in [
        (FarEnd::Free, 1),
        (FarEnd::Free, 3),
        (FarEnd::Fixed, 1),
        (FarEnd::Fixed, 2),
    ] {
        let bar = bar(far_end, mode);
        let h = 1e-2;
        let (x, t) = (7.3, 1.7);
        let u = |x: f64, t: f64| bar.displacement(x, t);
        let u_tt = (u(x, t + h) - 2.0 * u(x, t) + u(x, t - h)) / (h * h);
        let s_x = (bar.stress(x + h, t) - bar.stress(x - h, t)) / (2.0 * h);
        // Second-order differences: (w h)^2/12 = 3e-5 of the amplitude in the highest of these modes.
        let amplitude = 0.1 * bar.angular_frequency();
        assert!(
            (u_tt - s_x).abs() < 2e-4 * amplitude,
            "{u_tt} and {s_x} of {amplitude}"
        );
        assert_relative_eq!(
            (u(x, t + h) - u(x, t - h)) / (2.0 * h),
            bar.velocity(x, t),
            epsilon = 1e-5
        );
        assert_relative_eq!(
            100.0 * (u(x + h, t) - u(x - h, t)) / (2.0 * h),
            bar.stress(x, t),
            epsilon = 1e-5
        );
        assert_eq!(bar.displacement(0.0, t), 0.0);
        let end = match far_end {
            FarEnd::Free => bar.stress(25.0, t),
            FarEnd::Fixed => bar.velocity(25.0, t),
        };
        assert!(end.abs() < 1e-14);
        // Midpoint mean of the velocity.
        let n = 2000;
        let mean: f64 = (0..n)
            .map(|i| bar.velocity(25.0 * (f64::from(i) + 0.5) / f64::from(n), t))
            .sum();
        assert_relative_eq!(mean / f64::from(n), bar.mean_velocity(t), epsilon = 1e-7);
    }
}

#[test]
fn the_velocity_gradient_is_the_derivative_of_the_velocity() {
    let bar = bar(FarEnd::Free, 2);
    let (x, t, d) = (7.0, 1.3, 1e-4);
    let difference = (bar.velocity(x + d, t) - bar.velocity(x - d, t)) / (2.0 * d);
    assert_relative_eq!(bar.velocity_gradient(x, t), difference, max_relative = 1e-8);
}
