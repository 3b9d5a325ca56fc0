//! Reflection at dashpots: published shares, and no loss without dashpots.

use proctor_verification::exact::lysmer::Dashpots;

const LYSMER: Dashpots = Dashpots {
    poisson: 0.25,
    rates: [1.0; 2],
};

#[test]
fn a_free_plane_gives_all_energy_back() {
    for poisson in [0.0, 0.25, 0.4] {
        let free = Dashpots {
            poisson,
            rates: [0.0; 2],
        };
        for degrees in 0..90 {
            let reflected = free.reflected(f64::from(degrees).to_radians());
            assert!((reflected - 1.0).abs() < 1e-12, "{degrees}: {reflected}");
        }
    }
}

/// The dashpots take the work of their tractions, rho c_p v_n along the normal and rho c_s v_t along the plane: with the amplitudes
/// of all three waves at the plane, (v_n² + s v_t²)/cos theta of the energy that comes in.
#[test]
fn dashpots_take_the_energy_that_does_not_come_back() {
    let s = (1.0_f64 / 3.0).sqrt();
    for degrees in 0..90 {
        let theta = f64::from(degrees).to_radians();
        let [compression, shear] = LYSMER.amplitudes(theta);
        let (sin, cos) = theta.sin_cos();
        let sin_s = s * sin;
        let normal = cos * (compression - 1.0) - sin_s * shear;
        let along = sin * (compression + 1.0) + (1.0 - sin_s * sin_s).sqrt() * shear;
        let taken = (normal * normal + s * along * along) / cos;
        let left = LYSMER.reflected(theta);
        assert!(
            (taken + left - 1.0).abs() < 1e-12,
            "{degrees}: {taken}, {left}"
        );
    }
}

/// All is taken at normal incidence; the other shares are those of the two equations, solved apart, to four digits.
#[test]
fn shares_are_those_of_the_equations() {
    assert!(LYSMER.reflected(0.0) < 1e-30);
    for (degrees, share) in [
        (15.0, 2e-4),
        (30.0, 3e-4),
        (45.0, 3.9e-3),
        (60.0, 3.59e-2),
        (75.0, 0.2027),
    ] {
        let reflected = LYSMER.reflected(f64::to_radians(degrees));
        assert!((reflected - share).abs() < 5.1e-5, "{degrees}: {reflected}");
    }
}

#[test]
fn a_long_pulse_is_a_plane_wave_and_a_short_one_is_a_mean_over_angles() {
    let plane = LYSMER.reflected(1.0);
    let (across, along) = (10.0 * 1.0_f64.sin(), 10.0 * 1.0_f64.cos());
    assert!((LYSMER.reflected_pulse(across, along, 1e4) / plane - 1.0).abs() < 1e-6);
    // By another rule, the sum over the middles of ten thousand parts.
    let middles = (0..10_000).map(|i| along + 5.0 * ((f64::from(i) + 0.5) / 5e3 - 1.0));
    let [sum, weights] = middles.fold([0.0; 2], |[sum, weights], k| {
        let energy = (-(k - along).powi(2)).exp() * (across * across + k * k).powi(2);
        let share = LYSMER.reflected((across / k).atan());
        [sum + energy * share, weights + energy]
    });
    let mean = sum / weights;
    assert!((mean / plane - 1.0).abs() > 1e-2, "{mean} is not {plane}");
    let found = LYSMER.reflected_pulse(across, along, 1.0);
    assert!((found / mean - 1.0).abs() < 1e-4, "{found}, not {mean}");
}
