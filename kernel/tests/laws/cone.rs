//! Drucker-Prager against closed forms, and against Mohr-Coulomb where both agree.

use crate::laws::support::{DENSITY, close, numbers, point, shear, strain, uniaxial};
use nalgebra::{Matrix3, Vector3};
use proctor_laws::{AnyLaw, ConeMatch, DruckerPrager, Point};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.2;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
const CONFINED: f64 = BULK + 4.0 * SHEAR / 3.0;

fn soil(friction: f64, cohesion: f64, dilation: f64, matched: ConeMatch) -> DruckerPrager {
    DruckerPrager::new(YOUNG, POISSON, [friction, cohesion, dilation], matched)
}

/// Mean stress and sqrt(J_2).
fn invariants(s: &[f64; 6]) -> (f64, f64) {
    let mean = (s[0] + s[1] + s[2]) / 3.0;
    let normal: f64 = s[..3].iter().map(|x| (x - mean).powi(2)).sum();
    let beside: f64 = s[3..].iter().map(|x| x * x).sum();
    (mean, (0.5 * normal + beside).sqrt())
}

#[test]
fn an_oedometer_yields() {
    for (friction, dilation) in [(20.0, 20.0), (20.0, 5.0), (15.0, 0.0)] {
        for matched in [ConeMatch::PlaneStrain, ConeMatch::Outer, ConeMatch::Inner] {
            let law = soil(friction, 0.01, dilation, matched);
            let [eta, limit, flow] = law.cone();
            let root = 2.0 * SHEAR / 3.0_f64.sqrt();
            let first = limit / (root - eta * BULK);
            assert!(first > 0.0, "{friction} {matched:?}");
            let slope =
                CONFINED - (root - eta * BULK) * (root - flow * BULK) / (SHEAR + BULK * eta * flow);
            for steps in [1, 10, 100] {
                let mut point = point(&law.into());
                strain(&mut point, &uniaxial(-4.0 * first), steps);
                let exact = -CONFINED * first - slope * 3.0 * first;
                close(point.stress()[0], exact, 1e-11, exact.abs());
            }
        }
    }
}

/// Sheared in the plane until it flows, a matched cone has the strength of Mohr and Coulomb there.
#[test]
fn flow_in_plane_strain_has_the_strength_of_mohr_and_coulomb() {
    for (friction, dilation) in [(30.0_f64, 0.0), (30.0, 30.0), (25.0, 10.0)] {
        let law: AnyLaw = soil(friction, 0.01, dilation, ConeMatch::PlaneStrain).into();
        let mut point = Point::new(&law, DENSITY, [-1.0, -1.0, -1.0, 0.0, 0.0, 0.0]);
        // The plane swells as flow does, so that stresses come to rest.
        let swelling = 0.5 * 0.2 * dilation.to_radians().sin();
        let path = shear(0.2) + Matrix3::from_diagonal(&Vector3::new(swelling, swelling, 0.0));
        strain(&mut point, &path, 2000);
        let s = point.stress();
        let (mean, radius) = (
            0.5 * (s[0] + s[1]),
            (0.25 * (s[0] - s[1]).powi(2) + s[5] * s[5]).sqrt(),
        );
        let (sine, cosine) = friction.to_radians().sin_cos();
        let exact = 0.01 * cosine - mean * sine;
        close(radius, exact, 1e-6, exact);
    }
}

#[test]
fn outer_and_inner_cones_touch_the_edges() {
    let (friction, cohesion) = (30.0_f64, 1.0);
    let (sine, cosine) = friction.to_radians().sin_cos();
    // Stresses of Mohr and Coulomb with two equal ones: s3 < s2 = s1, and s1 > s2 = s3.
    let large = -2.0;
    let small = ((1.0 + sine) * large - 2.0 * cohesion * cosine) / (1.0 - sine);
    for (s, matched) in [
        ([large, large, small], ConeMatch::Outer),
        ([large, small, small], ConeMatch::Inner),
    ] {
        let [eta, limit, _] = soil(friction, cohesion, 0.0, matched).cone();
        let (mean, radius) = invariants(&[s[0], s[1], s[2], 0.0, 0.0, 0.0]);
        close(radius + eta * mean, limit, 1e-14, 10.0);
    }
}

/// After a return no stress lies beyond the cone or its end, what comes back twice stays, and flow is that of the surface.
#[test]
fn a_return_keeps_what_defines_it() {
    let mut next = numbers(4);
    for (friction, dilation, cohesion, tensile) in [
        (30.0, 30.0, 1.0, 0.0),
        (30.0, 5.0, 1.0, 0.5),
        (30.0, -5.0, 1.0, 0.5),
        (0.0, 0.0, 1.0, 0.0),
        (0.0, 0.0, 1.0, 0.2),
        (35.0, 0.0, 0.0, 0.0),
    ] {
        for matched in [ConeMatch::PlaneStrain, ConeMatch::Outer, ConeMatch::Inner] {
            let law = soil(friction, cohesion, dilation, matched).with_tensile(tensile);
            let [eta, limit, flow] = law.cone();
            let apex = if eta > 0.0 {
                cohesion / friction.to_radians().tan()
            } else {
                f64::INFINITY
            };
            let most = if tensile > 0.0 {
                apex.min(tensile)
            } else {
                apex
            };
            let law: AnyLaw = law.into();
            for _ in 0..300 {
                let trial: [f64; 6] = std::array::from_fn(|_| 6.0 * next());
                let mut point = Point::new(&law, DENSITY, trial);
                point.step(&[[0.0; 3]; 3], 1.0).expect("a finite stress");
                let after = point.stress();
                let (before, (mean, radius)) = (invariants(&trial), invariants(&after));
                let scale = 10.0;
                assert!(
                    radius + eta * mean - limit < 4e-15 * scale,
                    "{trial:?} {after:?}"
                );
                assert!(mean - most < 4e-15 * scale, "{trial:?} {after:?}");
                let mut again = Point::new(&law, DENSITY, after);
                again.step(&[[0.0; 3]; 3], 1.0).expect("a finite stress");
                for (a, b) in again.stress().iter().zip(after) {
                    close(*a, b, 1e-14, scale);
                }
                // Plastic strain: shear along the deviator, volume by flow from the cone and freely from its end.
                let sheared = (before.1 - radius) / SHEAR;
                let swollen = (before.0 - mean) / BULK;
                assert!(sheared >= -1e-15, "{sheared}");
                if (mean - most).abs() > 1e-9 {
                    close(swollen, flow * sheared, 1e-14, scale / SHEAR);
                } else {
                    assert!(swollen - flow * sheared > -1e-14, "{swollen} {sheared}");
                }
                let variables = point.variables();
                close(variables[0], sheared / 3.0_f64.sqrt(), 1e-13, 1.0);
                close(variables[1], radius * sheared + mean * swollen, 1e-13, 1.0);
            }
        }
    }
}

/// Pulled apart, a soil is left with its tensile strength and no shear at the apex, also without dilation.
#[test]
fn the_apex_needs_no_dilation() {
    let law: AnyLaw = soil(30.0, 1.0, 0.0, ConeMatch::PlaneStrain).into();
    let mut point = point(&law);
    let strain_of = Matrix3::from_diagonal(&Vector3::new(0.05, 0.04, 0.05));
    strain(&mut point, &strain_of, 10);
    let (mean, radius) = invariants(&point.stress());
    close(mean, 1.0 / 30.0_f64.to_radians().tan(), 1e-14, 2.0);
    assert!(radius < 1e-14, "{radius}");
}
