//! The column under its own weight: published heights, and quadrature of the stretch.

use approx::assert_relative_eq;
use proctor_verification::exact::self_weight::{Law, SelfWeightColumn};

const LAWS: [Law; 4] = [
    Law::SmallStrain,
    Law::RateElastic,
    Law::Hencky,
    Law::NeoHookean,
];

/// E = 10 kPa, nu = 0, H = 50 m, 80 kg/m^3, g = 10 m/s^2: S = 4.
fn soft(law: Law) -> SelfWeightColumn {
    SelfWeightColumn {
        law,
        height: 50.0,
        density: 80.0,
        gravity: 10.0,
        lambda: 0.0,
        mu: 5000.0,
    }
}

fn stiff(law: Law) -> SelfWeightColumn {
    SelfWeightColumn {
        law,
        height: 2.0,
        density: 1500.0,
        gravity: 9.81,
        lambda: 4e4,
        mu: 3e4,
    }
}

/// Verification notes, A5.
#[test]
fn published_heights() {
    for (law, height) in [
        (Law::Hencky, 24.059_646),
        (Law::RateElastic, 12.271_055),
        (Law::NeoHookean, 16.169_594),
    ] {
        let column = soft(law);
        assert_relative_eq!(column.load_number(), 4.0, max_relative = 1e-14);
        assert_relative_eq!(column.position(50.0), height, max_relative = 1e-7);
    }
    let small = stiff(Law::SmallStrain);
    let s = small.load_number();
    assert_relative_eq!(
        small.position(2.0),
        2.0 * (1.0 - 0.5 * s),
        max_relative = 1e-13
    );
    // Stretch at the base: e^-S for the rate law, e^-w with w e^w = S for Hencky, W(4) = 1.2021678731970429.
    assert_relative_eq!(
        soft(Law::RateElastic).stretch(0.0),
        (-4.0_f64).exp(),
        max_relative = 1e-13
    );
    assert_relative_eq!(
        soft(Law::Hencky).stretch(0.0),
        (-1.202_167_873_197_043_f64).exp(),
        max_relative = 1e-13
    );
}

/// `y(Y)` against Simpson's rule on the stretch, and the stress against the law.
#[test]
fn positions_are_the_integral_of_the_stretch() {
    for law in LAWS {
        let column = stiff(law);
        let y0 = 1.3;
        let n = 200;
        let h = y0 / f64::from(n);
        let simpson: f64 = (0..=n)
            .map(|i| {
                let weight = match i {
                    0 => 1.0,
                    i if i == n => 1.0,
                    i if i % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight * h / 3.0 * column.stretch(h * f64::from(i))
            })
            .sum();
        assert_relative_eq!(column.position(y0), simpson, max_relative = 1e-10);
        assert_eq!(column.position(0.0), 0.0);

        let f = column.stretch(y0);
        let (lambda, mu) = (column.lambda, column.mu);
        let m = lambda + 2.0 * mu;
        let nominal = match law {
            Law::SmallStrain => m * (f - 1.0),
            Law::RateElastic => m * f.ln(),
            Law::Hencky => m * f.ln() / f,
            Law::NeoHookean => lambda * f.ln() / f + mu * (f - 1.0 / f),
        };
        assert_relative_eq!(nominal, -1500.0 * 9.81 * 0.7, max_relative = 1e-12);
        assert_relative_eq!(column.vertical_stress(y0), nominal, max_relative = 1e-12);
    }
}

#[test]
fn light_columns_agree_whatever_the_law() {
    for law in LAWS {
        let column = SelfWeightColumn {
            gravity: 1e-5,
            ..stiff(law)
        };
        let s = column.load_number();
        assert_relative_eq!(column.position(2.0), 2.0 - s, max_relative = 1e-9);
        assert_relative_eq!(
            column.lateral_stress(0.5),
            0.4 * column.vertical_stress(0.5),
            max_relative = 1e-6
        );
    }
    assert_eq!(
        SelfWeightColumn {
            gravity: 0.0,
            ..stiff(Law::Hencky)
        }
        .position(1.5),
        1.5
    );
    assert!(
        soft(Law::SmallStrain).stretch(0.0).is_nan(),
        "no equilibrium at S = 4"
    );
}
