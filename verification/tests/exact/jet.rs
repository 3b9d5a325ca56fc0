//! Jets against closed forms and differences.

use proctor_verification::exact::jet::{Jet, Scalar};

/// A formula with every operation.
fn formula<T: Scalar>(x: T, y: T) -> T {
    let wave = (x * y).sin() + (x - y).cos();
    wave / (x.power(3) + y.exp()) - (x + y).sqrt() * (-y).exp() + x.ln()
}

#[test]
fn rules_of_powers_and_elementary_functions() {
    let x = Jet::<1>::variable(0.7, 0);
    for (found, value, slope) in [
        (x.power(4), 0.7_f64.powi(4), 4.0 * 0.7_f64.powi(3)),
        (x.sin(), 0.7_f64.sin(), 0.7_f64.cos()),
        (x.cos(), 0.7_f64.cos(), -0.7_f64.sin()),
        (x.sqrt(), 0.7_f64.sqrt(), 0.5 / 0.7_f64.sqrt()),
        (x.ln(), 0.7_f64.ln(), 1.0 / 0.7),
        (x.exp(), 0.7_f64.exp(), 0.7_f64.exp()),
        (Jet::of(2.0) / x, 2.0 / 0.7, -2.0 / 0.49),
        (-x * x, -0.49, -1.4),
        (x.power(0), 1.0, 0.0),
    ] {
        assert!((found.value - value).abs() < 1e-15 * value.abs().max(1.0));
        assert!((found.partials[0] - slope).abs() < 4e-15 * slope.abs().max(1.0));
    }
}

#[test]
fn partials_are_the_limit_of_differences() {
    let at = [0.6, 0.9];
    let [x, y] = [0, 1].map(|i| Jet::<2>::variable(at[i], i));
    let found = formula(x, y);
    let step = 1e-5;
    let difference = [
        formula(at[0] + step, at[1]) - formula(at[0] - step, at[1]),
        formula(at[0], at[1] + step) - formula(at[0], at[1] - step),
    ];
    assert_eq!(found.value, formula(at[0], at[1]));
    for (partial, difference) in found.partials.iter().zip(difference) {
        assert!((partial - difference / (2.0 * step)).abs() < 1e-9);
    }
}

/// A jet of jets has the matrix of second derivatives, which is symmetric.
#[test]
fn second_derivatives_of_a_product() {
    let at = [0.4, 1.3];
    let [x, y] = [0, 1].map(|i| Jet::<2, Jet<2>>::variable(Jet::variable(at[i], i), i));
    // x² sin y: 2 sin y, 2 x cos y, -x² sin y.
    let found = x * x * y.sin();
    let second = found.partials.map(|partial| partial.partials);
    let mixed = 2.0 * 0.4 * 1.3_f64.cos();
    let expected = [[2.0 * 1.3_f64.sin(), mixed], [mixed, -0.16 * 1.3_f64.sin()]];
    for i in 0..2 {
        for j in 0..2 {
            assert!((second[i][j] - expected[i][j]).abs() < 1e-15);
        }
    }
}
