//! Point contact of Hertz against the load, and against the deflection of a half-space (Boussinesq).

use proctor_verification::exact::hertz::contact_modulus;
use proctor_verification::exact::hertz_sphere::HertzSphere;
use proctor_verification::exact::special::gauss_legendre;
use std::f64::consts::PI;

fn sphere() -> HertzSphere {
    HertzSphere {
        radius: 8.0,
        load: 60.0,
        modulus: contact_modulus([200.0, f64::INFINITY], [0.3, 0.0]),
    }
}

/// Integral over [0, end] with r = end sin(t), which takes a root at the end away.
fn integrate(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    gauss_legendre(100)
        .iter()
        .map(|(t, w)| {
            let angle = 0.25 * PI * (t + 1.0);
            0.25 * PI * w * end * angle.cos() * f(end * angle.sin())
        })
        .sum()
}

#[test]
fn the_pressure_carries_the_load() {
    let hertz = sphere();
    let a = hertz.contact_radius();
    let force = integrate(a, |r| 2.0 * PI * r * hertz.pressure(r));
    assert!((force / hertz.load - 1.0).abs() < 1e-12);
    assert_eq!(hertz.pressure(1.0001 * a), 0.0);
    // The second moment that defines the effective radius elsewhere: 2/5 a².
    let moment = integrate(a, |r| 2.0 * PI * r.powi(3) * hertz.pressure(r));
    assert!((moment / (0.4 * a * a * hertz.load) - 1.0).abs() < 1e-12);
    for end in [0.1 * a, 0.5 * a, a] {
        let within = integrate(end, |r| 2.0 * PI * r * hertz.pressure(r));
        assert!((within / (PI * end * end * hertz.mean_within(end)) - 1.0).abs() < 1e-8);
    }
}

/// The surface of the half-space must follow the sphere under the contact: w(r) = delta - r²/(2 R), with
/// w = 1/(pi E*) int p dA/distance taken in polar coordinates about the point, where the distance cancels.
#[test]
fn the_surface_follows_the_sphere() {
    let hertz = sphere();
    let a = hertz.contact_radius();
    for share in [0.0, 0.3, 0.7, 0.95] {
        let r = share * a;
        let directions = 2000;
        let sum: f64 = (0..directions)
            .map(|k| {
                let (sin, cos) =
                    (2.0 * PI * (f64::from(k) + 0.5) / f64::from(directions)).sin_cos();
                // Along the ray to the edge; the pressure ends there with a root.
                let edge = -r * cos + (a * a - (r * sin).powi(2)).sqrt();
                integrate(edge, |s| {
                    hertz.pressure((r * r + s * s + 2.0 * r * s * cos).sqrt())
                })
            })
            .sum();
        let deflection = sum * 2.0 * PI / f64::from(directions) / (PI * hertz.modulus);
        let exact = hertz.approach() - r * r / (2.0 * hertz.radius);
        assert!(
            (deflection / exact - 1.0).abs() < 1e-6,
            "{share}: {deflection} {exact}"
        );
    }
}

/// Johnson, eq. 4.22 to 4.24, with the numbers of a steel ball of 10 mm under 100 N on rigid ground.
#[test]
fn a_steel_ball() {
    let ball = HertzSphere {
        radius: 5.0e-3,
        load: 100.0,
        modulus: contact_modulus([2.1e11, f64::INFINITY], [0.3, 0.0]),
    };
    // delta³ = 9 F²/(16 R E*²), p_0³ = 6 F E*²/(pi³ R²).
    let delta = (9.0 * 1.0e4 / (16.0 * 5.0e-3 * ball.modulus.powi(2))).cbrt();
    let peak = (6.0 * 100.0 * ball.modulus.powi(2) / (PI.powi(3) * 25.0e-6)).cbrt();
    assert!((ball.approach() / delta - 1.0).abs() < 1e-12);
    assert!((ball.peak() / peak - 1.0).abs() < 1e-12);
}
