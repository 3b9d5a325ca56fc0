//! Grains that flow: the friction of steady shear is mu(I), whatever the step; what has parted bears nothing.

use proctor_laws::{AnyLaw, GranularFlow, Law, Point};

const YOUNG: f64 = 1e7;
const PRESSURE: f64 = 1e3;
const DIAMETER: f64 = 5e-4;
const GRAIN: f64 = 2500.0;
const DENSITY: f64 = 1500.0;

fn grains() -> GranularFlow {
    GranularFlow::new(YOUNG, 0.3, [0.38, 0.64, 0.279], [DIAMETER, GRAIN])
}

/// Pressure and sqrt(J_2) of a point.
fn invariants(point: &Point) -> [f64; 2] {
    let s = point.stress();
    let mean = (s[0] + s[1] + s[2]) / 3.0;
    let normal: f64 = s[..3].iter().map(|x| (x - mean) * (x - mean)).sum();
    let shear: f64 = s[3..].iter().map(|x| x * x).sum();
    [-mean, (0.5 * normal + shear).sqrt()]
}

/// A point that flows at a rate of shear sqrt(2 e : e) \[1/s\] until it has sheared by 1 %.
fn flowing(law: &AnyLaw, rate: f64, step: f64) -> Point {
    let mut point = Point::new(
        law,
        DENSITY,
        [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0, 0.0],
    );
    // Of (e, -e/2, -e/2) it is sqrt(3) e.
    let e = step / 3.0_f64.sqrt();
    for _ in 0..(0.01 / step) as usize {
        point
            .strain(&[e, -0.5 * e, -0.5 * e, 0.0, 0.0, 0.0], step / rate)
            .expect("a step");
    }
    point
}

#[test]
fn the_friction_of_steady_flow_is_mu_of_its_inertial_number() {
    let law = grains();
    for rate in [0.1, 1.0, 10.0, 100.0] {
        for step in [1e-5, 4e-5] {
            let [p, tau] = invariants(&flowing(&law.into(), rate, step));
            let number = rate * DIAMETER * (GRAIN / p).sqrt();
            // Jop, Forterre and Pouliquen 2006.
            let exact = 0.38 + 0.26 / (0.279 / number + 1.0);
            assert!((law.friction(number) / exact - 1.0).abs() < 1e-14);
            // The volume of a step of this strain is off by its square, which moves the pressure.
            assert!(
                (tau / p / exact - 1.0).abs() < 1e-5,
                "{rate} {step}: {} {exact}",
                tau / p
            );
        }
    }
}

/// Twice the shear modulus times the strain, below the static friction.
#[test]
fn what_does_not_flow_is_elastic() {
    let law: AnyLaw = grains().into();
    let mut point = Point::new(
        &law,
        DENSITY,
        [-PRESSURE, -PRESSURE, -PRESSURE, 0.0, 0.0, 0.0],
    );
    let e = 1e-5;
    point
        .strain(&[e, -0.5 * e, -0.5 * e, 0.0, 0.0, 0.0], 1e-3)
        .expect("a step");
    let [_, tau] = invariants(&point);
    let exact = YOUNG / 2.6 * 3.0_f64.sqrt() * e;
    assert!((tau / exact - 1.0).abs() < 1e-4, "{tau} {exact}");
}

/// Work of the flow is the stress times the shear, and grains that part lose their stress and find it again where they met.
#[test]
fn what_has_parted_bears_nothing_and_meets_again() {
    let law: AnyLaw = grains().into();
    let mut point = flowing(&law, 1.0, 1e-5);
    let [p, _] = invariants(&point);
    let apart = [1e-2, 1e-2, 1e-2, 0.0, 0.0, 0.0];
    point.strain(&apart, 1e-3).expect("a step");
    let [none, sheared] = invariants(&point);
    assert!(none.abs() < 1e-9 && sheared < 1e-9, "{none} {sheared}");
    let back = apart.map(|e: f64| -e);
    point.strain(&back, 1e-3).expect("a step");
    let [again, _] = invariants(&point);
    assert!((again / p - 1.0).abs() < 1e-6, "{again} {p}");
}

#[test]
fn friction_that_does_not_grow_is_refused() {
    let law = GranularFlow::new(YOUNG, 0.3, [0.5, 0.5, 0.3], [DIAMETER, GRAIN]);
    assert_eq!(law.problems()[0].key, "largest_friction");
    assert!(grains().problems().is_empty());
}
