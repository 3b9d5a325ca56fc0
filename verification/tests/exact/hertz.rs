//! Hertz contact against published values and against the integral that makes it.

use proctor_verification::exact::hertz::{Hertz, contact_modulus};
use proctor_verification::exact::special::gauss_legendre;
use std::f64::consts::PI;

/// Liang et al. 2024, section 4.2: R = 8 m under 0.625 Pa, E = 200 Pa, nu = 0.3, on a rigid plane.
fn paper() -> Hertz {
    Hertz {
        radius: 8.0,
        load: 2.0 * 8.0 * 0.625,
        modulus: contact_modulus([200.0, f64::INFINITY], [0.3, 0.0]),
    }
}

/// Integral over the contact with x = b sin(t), which takes the root at its ends away.
fn integrate(hertz: &Hertz, f: impl Fn(f64) -> f64) -> f64 {
    let b = hertz.half_width();
    gauss_legendre(400)
        .iter()
        .map(|(t, w)| {
            let angle = 0.5 * PI * t;
            0.5 * PI * w * b * angle.cos() * f(b * angle.sin())
        })
        .sum()
}

#[test]
fn the_papers_numbers() {
    let hertz = paper();
    assert!((hertz.half_width() - 0.681).abs() < 5e-4);
    assert!((hertz.peak() - 9.35).abs() < 5e-3);
    // Eq. 58 at the middle.
    let peak = 4.0 * 8.0 * 0.625 / (PI * hertz.half_width());
    assert!((hertz.peak() - peak).abs() < 1e-13);
}

#[test]
fn the_pressure_carries_the_load_and_ends_at_the_half_width() {
    let hertz = paper();
    assert!((integrate(&hertz, |x| hertz.pressure(x)) - hertz.load).abs() < 1e-12);
    // The second moment that defines the effective half-width elsewhere: b²/4.
    let moment = integrate(&hertz, |x| x * x * hertz.pressure(x)) / hertz.load;
    assert!((4.0 * moment - hertz.half_width().powi(2)).abs() < 1e-12);
    assert_eq!(hertz.pressure(1.0001 * hertz.half_width()), 0.0);
}

/// The deflection must follow the cylinder under the contact: d/dx of -2/(pi E*) int p ln|x - s| ds is -x/R (the
/// principal value is taken by subtracting the constant pressure).
#[test]
fn the_surface_follows_the_cylinder() {
    let hertz = paper();
    let deflection = |x: f64| {
        // ln|x - s| with s = b sin(t) integrated over many points; x lies between them.
        let n = 200_000;
        let b = hertz.half_width();
        -(0..n)
            .map(|i| {
                let t = PI * ((f64::from(i) + 0.5) / f64::from(n) - 0.5);
                hertz.peak() * t.cos() * t.cos() * (x - b * t.sin()).abs().ln()
            })
            .sum::<f64>()
            * b
            * PI
            / f64::from(n)
            * 2.0
            / (PI * hertz.modulus)
    };
    let base = deflection(0.0);
    for share in [0.25, 0.5, 0.9] {
        let x = share * hertz.half_width();
        let exact = -x * x / (2.0 * hertz.radius);
        assert!((deflection(x) - base - exact).abs() < 1e-4 * exact.abs());
    }
}

/// Stresses on the axis from the point load of Flamant, summed over the pressure.
#[test]
fn stresses_on_the_axis_are_flamants() {
    let hertz = paper();
    for share in [0.1, 0.5, 0.78, 2.0, 10.0] {
        let z = share * hertz.half_width();
        let [sx, sz] = hertz.stress_on_axis(z);
        let flamant = |power: i32| {
            integrate(&hertz, |s| {
                let r2 = s * s + z * z;
                -2.0 / PI * hertz.pressure(s) * s.powi(2 - power) * z.powi(1 + power) / (r2 * r2)
            })
        };
        assert!((sx - flamant(0)).abs() < 1e-4 * hertz.peak(), "{share}");
        assert!((sz - flamant(2)).abs() < 1e-4 * hertz.peak(), "{share}");
    }
}

/// Johnson, section 4.3: the largest shear stress is 0.30 p_0, 0.78 b under the surface.
#[test]
fn the_largest_shear_is_johnsons() {
    let hertz = paper();
    let shear = |share: f64| {
        let [sx, sz] = hertz.stress_on_axis(share * hertz.half_width());
        0.5 * (sx - sz) / hertz.peak()
    };
    let deepest = (1..300)
        .map(|k| f64::from(k) * 0.01)
        .max_by(|a, b| shear(*a).total_cmp(&shear(*b)));
    let deepest = deepest.expect("not empty");
    assert!((deepest - 0.78).abs() < 0.015, "{deepest}");
    assert!((shear(deepest) - 0.30).abs() < 0.005);
}

#[test]
fn two_equal_bodies_are_half_as_stiff() {
    let one = contact_modulus([200.0, f64::INFINITY], [0.3, 0.0]);
    assert!((one - 200.0 / 0.91).abs() < 1e-12);
    assert!((contact_modulus([200.0; 2], [0.3; 2]) - 0.5 * one).abs() < 1e-12);
}
