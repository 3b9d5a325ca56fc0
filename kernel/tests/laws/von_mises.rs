//! Von Mises against closed forms (Krieg and Krieg 1977, and by hand).

use crate::laws::support::{close, first_order, point, shear, strain, tensor, uniaxial};
use nalgebra::{Matrix3, Vector3};
use proctor_laws::{AnyLaw, Point, VonMises};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.1;
const HARDENING: f64 = 10.0;
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
const CONFINED: f64 = BULK + 4.0 * SHEAR / 3.0;

fn law(hardening: f64) -> AnyLaw {
    VonMises::new(YOUNG, POISSON, YIELD, hardening).into()
}

/// Strained along one axis the stress has the slope M_c up to e = Y/2G and M_p = K + 4G/3 H/(3G + H) from there on; turned
/// back it is elastic for 2 Y(k)/2G. Any number of steps is exact.
#[test]
fn uniaxial_strain_has_two_slopes() {
    for hardening in [0.0, HARDENING, -20.0] {
        let plastic = BULK + 4.0 * SHEAR / 3.0 * hardening / (3.0 * SHEAR + hardening);
        for steps in [1, 2, 7, 100] {
            let mut point = point(&law(hardening));
            let first = YIELD / (2.0 * SHEAR);
            let most = 4.0 * first;
            strain(&mut point, &uniaxial(most), steps);
            let k = 2.0 * SHEAR * (most - first) / (3.0 * SHEAR + hardening);
            let stress = CONFINED * first + plastic * (most - first);
            close(point.stress()[0], stress, 1e-14 * f64::from(steps), stress);
            close(point.variables()[0], k, 1e-13, k);
            let now = YIELD + hardening * k;
            let back = 2.0 * now / (2.0 * SHEAR);
            strain(&mut point, &uniaxial(-back), steps);
            close(point.stress()[0], stress - CONFINED * back, 2e-13, stress);
            close(point.variables()[0], k, 1e-13, k);
            strain(&mut point, &uniaxial(-first), steps);
            let turned = stress - CONFINED * back - plastic * first;
            close(point.stress()[0], turned, 2e-13, stress);
        }
    }
}

/// Work done on the way is what is stored, what is dissipated, and a part that falls with the step.
#[test]
fn work_is_stored_or_dissipated() {
    // So stiff that volumes are those at rest to a millionth.
    let stiff = 1e4;
    let law: AnyLaw = VonMises::new(stiff * YOUNG, POISSON, YIELD, stiff * HARDENING).into();
    let missing = |steps: u32| {
        let mut point = point(&law);
        let e = 5.0 * YIELD / (2.0 * stiff * SHEAR);
        let (mut work, mut before) = (0.0, 0.0);
        for _ in 0..steps {
            strain(&mut point, &uniaxial(e / f64::from(steps)), 1);
            // The trapezoidal rule.
            work += 0.5 * (before + point.stress()[0]) * e / f64::from(steps);
            before = point.stress()[0];
        }
        ((work - point.energy() - point.dissipated()) / work).abs()
    };
    let found = [100, 200, 400].map(missing);
    first_order(&found);
    assert!(found[2] < 1e-3, "{found:?}");
}

#[test]
fn shear_has_two_slopes() {
    let tangent = SHEAR * HARDENING / (3.0 * SHEAR + HARDENING);
    let first = YIELD / 3.0_f64.sqrt() / SHEAR;
    for steps in [1, 10, 33] {
        let mut point = point(&law(HARDENING));
        strain(&mut point, &shear(5.0 * first), steps);
        let stress = YIELD / 3.0_f64.sqrt() + tangent * 4.0 * first;
        close(point.stress()[5], stress, 1e-13, stress);
        let k = SHEAR * 4.0 * first * 3.0_f64.sqrt() / (3.0 * SHEAR + HARDENING);
        close(point.variables()[0], k, 1e-13, k);
    }
}

/// From a deviator on the surface across the rate of strain: tau = k tanh(G g/k) without hardening, at first order.
#[test]
fn a_deviator_turns_towards_the_rate() {
    let limit = YIELD / 3.0_f64.sqrt();
    let start = [-YIELD / 3.0, -YIELD / 3.0, 2.0 * YIELD / 3.0, 0.0, 0.0, 0.0];
    let g = 3.0 * limit / SHEAR;
    let error = |steps: u32| {
        let mut point = Point::new(&law(0.0), 1.0, start);
        strain(&mut point, &shear(g), steps);
        let exact = limit * (SHEAR * g / limit).tanh();
        (point.stress()[5] - exact).abs() / limit
    };
    // The relative error falls to 1e-3 where tanh has nearly ended; its order is seen on the way there.
    let half = |steps: u32| {
        let mut point = Point::new(&law(0.0), 1.0, start);
        strain(&mut point, &shear(0.3 * g), steps);
        (point.stress()[5] - limit * (0.3 * SHEAR * g / limit).tanh()).abs() / limit
    };
    first_order(&[40, 80, 160, 320].map(half));
    assert!(error(100) < 1e-2, "{}", error(100));
}

/// Saturating hardening: q = sqrt3 G g - 3 G k and q = Y(k), solved by bisection.
#[test]
fn a_yield_stress_saturates() {
    let (saturation, rate) = (0.2, 60.0);
    let law: AnyLaw = VonMises::new(YOUNG, POISSON, YIELD, HARDENING)
        .saturating(saturation, rate)
        .into();
    let yield_stress = |k: f64| YIELD + HARDENING * k + saturation * (1.0 - (-rate * k).exp());
    for g in [0.003, 0.01, 0.1] {
        let (mut low, mut high) = (0.0, g);
        for _ in 0..200 {
            let k = 0.5 * (low + high);
            let q = 3.0_f64.sqrt() * SHEAR * g - 3.0 * SHEAR * k;
            if q > yield_stress(k) {
                low = k;
            } else {
                high = k;
            }
        }
        let mut point = point(&law);
        strain(&mut point, &shear(g), 50);
        let stress = yield_stress(low) / 3.0_f64.sqrt();
        close(point.stress()[5], stress, 1e-12, stress);
        close(point.variables()[0], low, 1e-12, low);
    }
}

/// A yielded stress that turns with its body does not yield further.
#[test]
fn rotation_is_no_plastic_work() {
    let mut point = point(&law(0.0));
    strain(&mut point, &uniaxial(4.0 * YIELD / (2.0 * SHEAR)), 10);
    let (before, start) = (point.variables(), tensor(point.stress()));
    let steps = 400;
    let angle = 2.0 * std::f64::consts::PI / f64::from(steps);
    let axis = nalgebra::Unit::new_normalize(Vector3::new(1.0, 2.0, -0.5));
    let turn = *nalgebra::Rotation3::from_axis_angle(&axis, angle).matrix() - Matrix3::identity();
    let gradient = std::array::from_fn(|i| std::array::from_fn(|j| turn[(i, j)]));
    for _ in 0..steps {
        point.step(&gradient, 1.0).expect("a finite stress");
    }
    close(point.variables()[0], before[0], 1e-12, before[0]);
    close(point.variables()[1], before[1], 1e-12, before[1]);
    let off = (tensor(point.stress()) - start).amax();
    // Round-off of 400 strain increments times a modulus of 1000 yield stresses.
    assert!(off < 1e-10 * YIELD, "{off:e}");
}

/// A stress beyond the surface returns to it as exp(-t/tau) (Duvaut and Lions), at first order in the step.
#[test]
fn an_excess_relaxes() {
    let tau = 0.02;
    let law: AnyLaw = VonMises::new(YOUNG, POISSON, YIELD, 0.0)
        .relaxing(tau)
        .into();
    let limit = YIELD / 3.0_f64.sqrt();
    let error = |steps: u32| {
        let mut point = Point::new(&law, 1.0, [0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * limit]);
        let still = [[0.0; 3]; 3];
        for _ in 0..steps {
            point
                .step(&still, tau / f64::from(steps))
                .expect("a finite stress");
        }
        (point.stress()[5] / limit - 1.0 - (-1.0_f64).exp()).abs()
    };
    first_order(&[40, 80, 160].map(error));
}

/// The rule is implicit: a step that is long beside the relaxation time leaves 1/(1 + dt/tau) of the excess.
#[test]
fn a_long_step_relaxes_no_further_than_the_surface() {
    let tau = 0.02;
    let law: AnyLaw = VonMises::new(YOUNG, POISSON, YIELD, 0.0)
        .relaxing(tau)
        .into();
    let limit = YIELD / 3.0_f64.sqrt();
    for times in [0.5, 3.0, 1e3] {
        let mut point = Point::new(&law, 1.0, [0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * limit]);
        point
            .step(&[[0.0; 3]; 3], times * tau)
            .expect("a finite stress");
        let left = limit / (1.0 + times);
        close(point.stress()[5], limit + left, 1e-14, limit);
    }
}
