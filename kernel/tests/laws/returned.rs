//! Properties of the stress of every law with a yield surface, whatever its values.

use crate::laws::support::{DENSITY, midpoint, numbers, tensor};
use nalgebra::Matrix3;
use proctor_laws::{
    AnyLaw, ConeMatch, DruckerPrager, LinearElastic, MohrCoulomb, Point, Residual, Softening,
    Tresca, VonMises,
};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;

/// Laws of a stiffness and strength, all scaled.
pub(crate) fn laws(scale: f64) -> Vec<AnyLaw> {
    let young = YOUNG * scale;
    let softens = Residual {
        friction: Some(10.0),
        cohesion: Some(0.1 * scale),
        dilation: Some(-2.0),
        tensile: Some(0.05 * scale),
    };
    vec![
        VonMises::new(young, POISSON, scale, 5.0 * scale).into(),
        VonMises::new(young, POISSON, scale, 0.0)
            .saturating(0.5 * scale, 30.0)
            .into(),
        VonMises::new(young, POISSON, scale, 0.0)
            .along(&[[0.01, 1.4 * scale], [0.02, 1.2 * scale], [0.1, 2.0 * scale]])
            .into(),
        Tresca::new(young, POISSON, scale).into(),
        Tresca::new(young, POISSON, scale)
            .with_tensile(0.3 * scale)
            .into(),
        MohrCoulomb::new(young, POISSON, [30.0, scale, 10.0]).into(),
        MohrCoulomb::new(young, POISSON, [30.0, scale, 10.0])
            .with_tensile(0.4 * scale)
            .softening(Softening::Exponential { eta: 20.0 }, softens)
            .into(),
        MohrCoulomb::new(young, POISSON, [35.0, 0.0, 0.0]).into(),
        DruckerPrager::new(young, POISSON, [30.0, scale, 10.0], ConeMatch::PlaneStrain).into(),
        DruckerPrager::new(young, POISSON, [30.0, scale, 0.0], ConeMatch::Outer)
            .with_tensile(0.4 * scale)
            .into(),
    ]
}

fn random_step(next: &mut impl FnMut() -> f64, size: f64) -> Matrix3<f64> {
    Matrix3::from_fn(|_, _| size * next())
}

/// A path of random strains; stress and variables at its end.
fn walked(law: &AnyLaw, seed: u64, scale: f64, size: f64) -> (Vec<u64>, Vec<f64>) {
    let mut next = numbers(seed);
    let start: [f64; 6] = std::array::from_fn(|_| 0.1 * scale * next());
    let mut point = Point::new(law, DENSITY, start);
    for _ in 0..50 {
        let gradient = midpoint(&random_step(&mut next, size));
        point.step(&gradient, 1.0).expect("a finite stress");
    }
    let bits = |s: f64| (s / scale).to_bits();
    (point.stress().map(bits).to_vec(), point.variables())
}

/// Multiplying all stresses and moduli by a power of two changes no digit: there is no hidden unit.
#[test]
fn units_of_stress_do_not_matter() {
    for (one, other) in laws(1.0).iter().zip(laws(2.0_f64.powi(40))) {
        for seed in 1..20 {
            let (stress, variables) = walked(one, seed, 1.0, 0.01);
            let (same, of_same) = walked(&other, seed, 2.0_f64.powi(40), 0.01);
            assert_eq!(stress, same, "{one:?}");
            assert_eq!(variables[0].to_bits(), of_same[0].to_bits(), "{one:?}");
        }
    }
}

/// Below the surface a law has the bits of elasticity.
#[test]
fn what_does_not_yield_is_elastic_to_the_last_bit() {
    let elastic: AnyLaw = LinearElastic::new(YOUNG, POISSON).into();
    for law in laws(1.0)
        .into_iter()
        .filter(|law| !format!("{law:?}").contains("35.0"))
    {
        for seed in 1..20 {
            let (stress, variables) = walked(&law, seed, 1.0, 1e-5);
            assert_eq!(stress, walked(&elastic, seed, 1.0, 1e-5).0, "{law:?}");
            assert!(variables.iter().all(|v| *v == 0.0), "{variables:?}");
        }
    }
}

/// Plastic work and plastic strain never fall, whatever the path.
#[test]
fn dissipation_is_never_negative() {
    for law in laws(1.0) {
        let mut next = numbers(77);
        let mut point = Point::new(&law, DENSITY, [0.0; 6]);
        let mut before = point.variables();
        for _ in 0..4000 {
            let gradient = midpoint(&random_step(&mut next, 0.01));
            point.step(&gradient, 1.0).expect("a finite stress");
            let now = point.variables();
            assert!(
                now[0] >= before[0] && now[1] >= before[1] - 1e-16,
                "{law:?}: {before:?} {now:?}"
            );
            before = now;
        }
        assert!(before[0] > 0.1, "{law:?} did not yield: {before:?}");
    }
}

/// States on edges and at the apex, zeros, and scales far from 1: finite, and not moved by being asked again.
#[test]
fn corners_are_states_like_others() {
    let states = [
        [1.0, 1.0, -2.0],
        [2.0, -1.0, -1.0],
        [1.0, 1.0, 1.0],
        [3.0_f64.sqrt(); 3],
        [0.0, 0.0, 0.0],
        [-1.0, -1.0, -1.0],
        [1.0, 0.0, -1.0],
        [5.0, 5.0, 5.0],
        [5.0, 5.0, 4.999_999_999_999],
        [0.4, 0.4, -3.0],
    ];
    for scale in [1.0, 1e-200, 1e140] {
        for law in laws(scale) {
            for state in states {
                let [a, b, c] = state.map(|s| s * scale);
                let mut point = Point::new(&law, DENSITY, [a, b, c, 0.0, 0.0, 0.0]);
                let still = [[0.0; 3]; 3];
                point.step(&still, 1.0).expect("a finite stress");
                let once = point.stress();
                if format!("{law:?}").contains("Exponential")
                    || format!("{law:?}").contains("VonMises")
                {
                    // What softens or hardens goes on with the strength of the step before.
                    continue;
                }
                point.step(&still, 1.0).expect("a finite stress");
                let moved = (tensor(point.stress()) - tensor(once)).amax();
                assert!(moved <= 4e-15 * 5.0 * scale, "{law:?} {state:?}: {moved:e}");
            }
        }
    }
}

/// A stress that is not a number is a fault, not zero.
#[test]
fn what_is_no_number_is_a_fault() {
    for law in laws(1.0) {
        let mut point = Point::new(&law, DENSITY, [f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0]);
        point.step(&[[0.0; 3]; 3], 1.0).expect_err("no number");
    }
}
