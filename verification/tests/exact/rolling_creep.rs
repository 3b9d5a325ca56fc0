//! The creep of a rolling disk against the closed forms of a brush, and against its own limits.

use proctor_verification::exact::hertz::Hertz;
use proctor_verification::exact::hertz_layer::LayerContact;
use proctor_verification::exact::rolling_creep::RollingCreep;

/// A brush under a parabolic pressure p_0 (1 - x²/a²), on a rim so large that it does not turn.
fn parabolic(cells: usize) -> RollingCreep {
    let (half, peak) = (0.05, 3e4);
    let cell = half / cells as f64;
    let at = |k: usize| (k as f64 + 0.5) / cells as f64;
    RollingCreep {
        contact: LayerContact {
            cell,
            pressure: (0..cells).map(|k| peak * (1.0 - at(k) * at(k))).collect(),
            gap: vec![0.0; cells],
            approach: 0.0,
        },
        radius: 1e6,
        stiffness: 1e6,
        friction: 0.3,
    }
}

/// Pacejka, Tire and Vehicle Dynamics, section 3.2: with theta = 2 c a²/(3 mu N) and the slip sigma the force is
/// mu N (3 theta sigma - 3 (theta sigma)² + (theta sigma)³), and mu N from theta sigma = 1 on.
#[test]
fn under_a_parabolic_pressure_it_is_the_brush_of_tyres() {
    let brush = parabolic(2000);
    let load = 4.0 / 3.0 * 3e4 * 0.05;
    let most = 0.3 * load;
    let theta = 2.0 * 1e6 * 0.05 * 0.05 / (3.0 * most);
    for share in [0.01, 0.1, 0.3, 0.6, 0.9, 1.0, 1.5] {
        let z = f64::min(share, 1.0);
        let exact = most * (3.0 * z - 3.0 * z * z + z * z * z);
        let found = brush.force(share / theta);
        assert!(
            (found / exact - 1.0).abs() < 2e-3,
            "{share}: {found} {exact}"
        );
    }
    assert!(brush.creep(1.001 * most).is_none());
    let creep = brush.creep(0.5 * most).expect("half of it");
    assert!((brush.force(creep) / (0.5 * most) - 1.0).abs() < 1e-9);
}

/// A full sticking contact on a rim that turns: the mean of the turn x²/(2 R²), weighted as the stretch adds up from the
/// leading edge, adds to the creep. With u(x) = xi (a - x) - (a³ - x³)/(6 R²) the force is
/// c (2 a² xi - a⁴/(3 R²)).
#[test]
fn the_turn_of_the_rim_adds_to_the_creep() {
    let mut brush = parabolic(4000);
    brush.friction = 1e3;
    brush.radius = 0.5;
    let (a, c) = (0.05_f64, 1e6);
    let force = 100.0;
    let exact = (force / c + a.powi(4) / (3.0 * 0.25)) / (2.0 * a * a);
    let creep = brush.creep(force).expect("it sticks");
    assert!((creep / exact - 1.0).abs() < 2e-3, "{creep} {exact}");
}

/// Without a layer worth the name and with a stiff spring there is no creep.
#[test]
fn a_hard_narrow_contact_does_not_creep() {
    let hertz = Hertz {
        radius: 0.5,
        load: 2000.0,
        modulus: 2.7e9,
    };
    let half = hertz.half_width();
    let cells = 400;
    let cell = half / cells as f64;
    let brush = RollingCreep {
        contact: LayerContact {
            cell,
            pressure: (0..cells)
                .map(|k| hertz.pressure((k as f64 + 0.5) * cell))
                .collect(),
            gap: vec![0.0; cells],
            approach: 0.0,
        },
        radius: 0.5,
        stiffness: 1e12,
        friction: 0.3,
    };
    let creep = brush.creep(400.0).expect("below mu N = 600 N");
    assert!(creep < 1e-3, "{creep}");
    assert!((brush.half_width() - half).abs() < 1e-12);
    // The mean of p² over that of p, for an ellipse: 8/(3 pi) of the peak.
    let mean = brush.mean_pressure() / hertz.peak();
    assert!(
        (mean - 8.0 / (3.0 * std::f64::consts::PI)).abs() < 1e-3,
        "{mean}"
    );
}
