//! The cantilever: small loads against beam theory, large ones against figures of another program.

use approx::assert_relative_eq;
use proctor_verification::exact::cantilever::Cantilever;
use proctor_verification::exact::fe::NeoHookean;

fn beam(gravity: f64) -> Cantilever {
    Cantilever {
        length: 4.0,
        height: 1.0,
        material: NeoHookean::from_young(1e6, 0.3, 1050.0),
        gravity,
    }
}

#[test]
fn small_loads_swing_about_the_static_deflection() {
    // Timoshenko: q L^4/(8 E' I) + q L²/(2 k G A) with E' = E/(1 - nu²), k = 5/6; the mean over a period in which the
    // tip comes back to where it started. A clamp that also holds the section's width takes a percent or two.
    let g = 1e-3;
    let history = beam(g).extrapolated(8, &[[4.0, 0.5]], 0.01, 320).unwrap();
    let tip: Vec<f64> = history.iter().map(|u| -u[0][1]).collect();
    let (trough, largest) = tip
        .iter()
        .copied()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap();
    let q = 1050.0 * g;
    let (plane, shear) = (1e6 / 0.91, 1e6 / 2.6);
    let exact = q * 256.0 / (8.0 * plane / 12.0) + q * 16.0 / (2.0 * 5.0 / 6.0 * shear);
    let period = 2 * (trough + 1);
    let mean = tip[..period].iter().sum::<f64>() / period as f64;
    assert_relative_eq!(mean, exact, max_relative = 0.02);
    // The first mode alone would reach twice the mean.
    assert_relative_eq!(largest, 2.0 * exact, max_relative = 0.05);
}

#[test]
fn published_troughs_of_large_swings() {
    // An independent program of the same kind gave -0.745, -0.749 and -0.751 m at these points with 128 x 32 elements.
    let at = |h: f64| [4.0 - h / 6.0, h / 6.0];
    let points = [at(0.25), at(0.125), at(0.0625)];
    let history = beam(1.0).extrapolated(16, &points, 0.01, 165).unwrap();
    for (point, expected) in [-0.745, -0.749, -0.751].into_iter().enumerate() {
        let trough = history.iter().map(|u| u[point][1]).fold(0.0, f64::min);
        assert_relative_eq!(trough, expected, epsilon = 1e-3);
    }
}
